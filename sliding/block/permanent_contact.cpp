#include "sliding/block/permanent_contact.hpp"

#include "sliding/block/constant_yield_run.hpp"

namespace damslip::sliding {

namespace {

template <bool vertical>
std::size_t run_alone(ContactBlock& block, const ContactMotion& motion, std::size_t k, std::size_t last,
                      std::size_t before)
{
    PermanentContact<double, vertical> run(std::span(&block, 1), motion);
    k = run.run(k, last, before);
    run.write(std::span(&block, 1));
    return k;
}

} // namespace

std::size_t run_in_contact(ContactBlock& block, const ContactMotion& motion, std::size_t k, std::size_t last,
                           std::size_t before)
{
    return motion.a_v ? run_alone<true>(block, motion, k, last, before)
                      : run_alone<false>(block, motion, k, last, before);
}

SlipSummary run_constant_yield(const ConstantYield& yield, const ContactMotion& motion, std::size_t intervals,
                               const ConstantYieldOptions& options)
{
    SlipSummary result;
    ConstantYieldRun<double>(std::span(&yield, 1), motion, intervals, options).run(std::span(&result, 1));
    return result;
}

double upper(const GroundLinear& form, const AccelRange& r)
{
    return form.constant + form.per_a_h * (form.per_a_h > 0.0 ? r.h_max : r.h_min) +
           form.per_a_v * (form.per_a_v > 0.0 ? r.v_max : r.v_min);
}

double magnitude(const GroundLinear& form, const AccelRange& r)
{
    return std::abs(form.constant) + std::abs(form.per_a_h) * std::max(-r.h_min, r.h_max) +
           std::abs(form.per_a_v) * std::max(-r.v_min, r.v_max);
}

} // namespace damslip::sliding
