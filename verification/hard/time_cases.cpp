#include "verification/hard/hard_scenes.hpp"

#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/integrate.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

/// The dam with steps chosen by the program against steps of 0.3 ms; two runs within 1 % each, by their estimates.
HardResult chosen_steps(const Scene& scene)
{
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::RunResult limit = fe_run(soft_dam(0.7), motion, 5);
    return compared(fe_run(scene, motion, std::nullopt), limit, 0.015 * limit.max_slip);
}

HardResult large_step()
{
    Scene scene = soft_dam(0.7);
    scene.time.dt = 0.1;
    return chosen_steps(scene);
}

HardResult small_step()
{
    Scene scene = soft_dam(0.7);
    GroundMotion motion = push(4.0, 0.03, 0.1, 0.02);
    scene.sliding.run_out_max = 3.0; // the slide, and five periods of rest
    const double coarse = fe_run(scene, motion, 5).slip;
    scene.time.dt = 1e-5;
    return compared(fe_run(scene, motion, 0), coarse, 0.01 * coarse);
}

HardResult with_alpha(double alpha)
{
    Scene scene = soft_dam(0.7);
    scene.time.alpha = alpha;
    return chosen_steps(scene);
}

HardResult undamped()
{
    Scene scene = stiff_dam(0.7);
    scene.damping.method = DampingMethod::none;
    return against_rigid(scene, sines(1.0, 6.0));
}

/// The largest step the program lets pass on a rigid base, found by trying, against `limit` over the highest frequency of
/// the dense eigenproblem. The run above it is refused, the one below it comes to its end.
HardResult above_limit(fe2d::MassKind mass, double limit,
                       const std::function<fe2d::History(const fe2d::Model&, const GroundMotion&)>& run)
{
    Scene scene = soft_dam(0.7);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.reservoir.reset();
    scene.uplift.reset();
    scene.mesh.size = 15.0;
    scene.mesh.contact_size = 15.0;
    fe2d::ModelOptions model_options;
    model_options.mass = mass;
    const fe2d::Model model = fe2d::build_model(scene, model_options);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(Eigen::MatrixXd(model.stiffness),
                                                                          Eigen::MatrixXd(model.mass));
    const double omega = std::sqrt(dense.eigenvalues().maxCoeff());
    const auto runs = [&](double dt) {
        try {
            return run(model, push(1.0, 100 * dt, 300 * dt, 0.0, dt)).status == fe2d::TiedRunStatus::complete;
        } catch (const InputError&) {
            return false;
        }
    };
    double low = 0.0, high = 10.0 / omega;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (runs(middle) ? low : high) = middle;
    }
    HardResult result;
    result.value_a = low;
    result.value_b = limit / omega;
    result.tolerance = 1e-6 * result.value_b;
    result.status = runs(1.01 * result.value_b) ? "at rest" : "refused";
    return result;
}

HardResult linear_acceleration_above_limit()
{
    return above_limit(fe2d::MassKind::consistent, std::sqrt(12.0),
                       [](const fe2d::Model& model, const GroundMotion& motion) {
                           fe2d::TiedRunOptions options;
                           options.scheme = fe2d::linear_acceleration();
                           return fe2d::integrate(model, motion, options);
                       });
}

HardResult central_difference_above_limit()
{
    return above_limit(fe2d::MassKind::lumped, 2.0, [](const fe2d::Model& model, const GroundMotion& motion) {
        fe2d::TiedRunOptions options;
        options.dt = motion.dt;
        return fe2d::integrate_explicit(model, motion, options);
    });
}

} // namespace

void add_time_cases(HardCases& cases)
{
    const std::string both = "1.5 %: the chosen steps leave 1 % by their own estimate, those of 0.3 ms a part of it";
    const std::string limit = "FE, alpha = -0.05, steps of 0.3 ms";
    cases.push_back(
        {.id = "hard.time.ten-times-too-large",
         .why = "0.1 s is a third of the dam's period: the step has to be noticed, cut, and what is still open said",
         .method_a = "FE, time.dt = 0.1 s",
         .method_b = limit,
         .tolerance = "1.5 %: five halvings leave steps of 3 ms; their own estimate is above 1 %, and they say so",
         .expected_status = "tolerance missed",
         .run = large_step});
    cases.push_back({.id = "hard.time.thousand-times-too-small",
                     .why = "0.00001 s: a0 = 1/(beta dt^2) of 4e10 drowns the stiffness, slips of a step are 1e-8 m",
                     .method_a = "FE, time.dt = 1e-5 s",
                     .method_b = "FE, 0.3 ms",
                     .tolerance = "1 %: 0.3 ms of a slide of 0.1 s is 0.3 %, and rest is judged at 0.01 s",
                     .run = small_step});
    cases.push_back({.id = "hard.time.alpha-zero",
                     .why = "no numerical damping: what the step does not resolve rings on",
                     .method_a = "FE, alpha = 0",
                     .method_b = limit,
                     .tolerance = both,
                     .run = [] { return with_alpha(0.0); }});
    cases.push_back({.id = "hard.time.alpha-minus-a-third",
                     .why = "the most numerical damping there is: slip comes out too small unless the step is cut",
                     .method_a = "FE, alpha = -1/3",
                     .method_b = limit,
                     .tolerance = both,
                     .run = [] { return with_alpha(-1.0 / 3.0); }});
    cases.push_back({.id = "hard.time.undamped",
                     .why = "nothing but friction and rock calms the dam",
                     .method_a = "FE, undamped, moduli x 1e4",
                     .method_b = "event-located rigid block",
                     .tolerance = "1 %: slides end at step ends, 0.0025 s of 0.25 s",
                     .run = undamped});
    cases.push_back({.id = "hard.time.explicit-above-limit",
                     .why = "linear acceleration gains energy above sqrt(12)/omega of the highest frequency",
                     .quantity = "largest step accepted",
                     .unit = "s",
                     .method_a = "FE, by trying",
                     .method_b = "sqrt(12)/omega of the dense eigenproblem",
                     .tolerance = "1e-6: Lanczos' highest frequency",
                     .expected_status = "refused",
                     .run = linear_acceleration_above_limit});
    cases.push_back({.id = "hard.time.central-difference-above-limit",
                     .why = "one step too large and the highest mode doubles with every step",
                     .quantity = "largest step accepted",
                     .unit = "s",
                     .method_a = "FE, central difference, by trying",
                     .method_b = "2/omega of the dense eigenproblem, lumped mass",
                     .tolerance = "1e-6: Lanczos' highest frequency",
                     .expected_status = "refused",
                     .run = central_difference_above_limit});
}

} // namespace damslip::hard
