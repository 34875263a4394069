#include "analysis/modes/modes.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/measure/measures.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace damslip {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The mode of a number from 1, or the last there is.
Eigen::Index mode_at(const fe2d::NaturalModes& modes, int number)
{
    return std::min<Eigen::Index>(number - 1, modes.frequency.size() - 1);
}

/// @param total_mass  in x [kg/m]
fe2d::ModifiedRayleigh modified_damping(const Scene& scene, double total_mass, const fe2d::NaturalModes& modes,
                                        const GroundMotion& motion)
{
    std::vector<fe2d::ModalMass> masses;
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i)
        masses.push_back({two_pi * modes.frequency[i], modes.effective_mass(0, i)});
    fe2d::ModifiedRayleighOptions options;
    options.ratio = scene.damping.ratio;
    options.first_mode = static_cast<std::size_t>(mode_at(modes, scene.damping.first_mode));
    options.ordinary_mode = static_cast<std::size_t>(mode_at(modes, scene.damping.second_mode));
    options.total_mass = total_mass;
    const auto spectral_acceleration = [&](double w, double ratio) {
        return records::peak_absolute_acceleration(motion.accel_h, motion.dt, w / two_pi, ratio);
    };
    return fe2d::modified_rayleigh(masses, spectral_acceleration, options);
}

std::optional<DampingOfModes> damping_of_modes(const Scene& scene, double total_mass, const fe2d::NaturalModes& modes,
                                               const std::vector<RecordPair>& records)
{
    if (modes.frequency.size() == 0 || scene.damping.ratio <= 0) return std::nullopt;
    DampingOfModes d;
    d.first_mode = mode_at(modes, scene.damping.first_mode);
    d.second_mode = mode_at(modes, scene.damping.second_mode);
    d.first_frequency = two_pi * modes.frequency[d.first_mode];
    d.second_frequency = two_pi * modes.frequency[d.second_mode];
    d.rayleigh = fe2d::rayleigh_constants(scene.damping.ratio, d.first_frequency, d.second_frequency);
    for (const RecordPair& pair : records)
        d.modified.push_back({pair.files.name, modified_damping(scene, total_mass, modes, ground_motion(scene, pair))});
    return d;
}

/// On the rock of the scene, as in tied runs; damped by Rayleigh's constants, where the scene damps at all.
void find_transfer(const Ready& ready, std::vector<double> frequencies, ModesResult& m)
{
    fe2d::RayleighConstants damping{};
    if (m.damping && m.scene.damping.method != DampingMethod::none) damping = m.damping->rayleigh;
    const fe2d::FluidModel* water = m.water ? &*m.water : nullptr;
    if (frequencies.empty())
        for (int k = 1; k <= 200; ++k) frequencies.push_back(0.1 * k);
    if (rock_radiates(m.scene)) {
        const fe2d::Mesh& mesh = m.model.mesh;
        m.radiating =
            fe2d::radiating_rock_of(m.scene, mesh, mesh.contact.rock_nodes, ready.wave_frequency(), cache_folder());
        if (!m.radiating->rock.report.passed())
            throw NotConverged(Diagnostic{m.scene.file.string(), 0, 0, text_of(m.radiating->rock.report.missed_gate()),
                                          "transfer functions on rock that is right", "or run without --frf"});
        const fe2d::RockBelow rock{m.radiating->rock, damping.stiffness};
        m.transfer =
            fe2d::transfer_functions(m.model, fe2d::dam_on_free_base(m.model, damping), water, frequencies, &rock);
        return;
    }
    const auto on = [&](const fe2d::Model& model) {
        return fe2d::transfer_functions(model, fe2d::structure_system(model, damping).system, water, frequencies);
    };
    if (!rock_is_boxed(m.scene)) {
        m.transfer = on(m.model);
        return;
    }
    fe2d::ModelOptions moving = ready.model_options();
    if (rock_edges_are_viscous(m.scene)) moving.edges = fe2d::RockEdges::free;
    m.transfer = on(fe2d::build_model(m.scene, moving));
}

} // namespace

fe2d::NaturalModes as_natural_modes(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading)
{
    fe2d::NaturalModes natural;
    natural.frequency = modes.frequency(leading);
    natural.effective_mass = modes.effective_mass(Eigen::all, leading);
    natural.effective_share = modes.effective_share(Eigen::all, leading);
    return natural;
}

bool ModesResult::complete() const
{
    if (coupled) return coupled->status == fe2d::CoupledModesStatus::ok;
    return modes.status == fe2d::ModesStatus::ok || modes.status == fe2d::ModesStatus::no_mass;
}

ModesResult compute_modes(const Ready& ready, const ModesOptions& options)
{
    ModesResult m;
    m.scene = ready.scene;
    m.count = options.count;
    m.choice = ready.reservoir;
    m.period = ready.dam_period;
    m.model = fe2d::build_model(with_massless_rock(m.scene), ready.model_options());
    double total_mass = m.model.total_mass.x();
    if (is_acoustic(m.scene)) {
        m.water = fe2d::build_fluid(m.scene);
        const int leading = std::max({5, m.scene.damping.first_mode, m.scene.damping.second_mode});
        m.coupled = fe2d::coupled_modes_up_to(fe2d::coupled_pencil(m.model, *m.water), coupled_modes_to, leading);
        m.leading = fe2d::leading_modes(*m.coupled, leading);
        m.modes = as_natural_modes(*m.coupled, m.leading);
        total_mass = m.coupled->total_mass.x();
    } else {
        m.modes = fe2d::natural_modes(m.model, options.count.value_or(usual_modes));
    }
    if (options.damping || options.transfer)
        m.damping = damping_of_modes(m.scene, total_mass, m.modes, ready.records());
    if (options.transfer) find_transfer(ready, options.frequencies, m);
    return m;
}

namespace {

/// What a fit may come to [Pa]: rubble masonry has 1 GPa and more, weathered rock 0.1 GPa.
constexpr double least_modulus_dam = 1e9, least_modulus_rock = 1e8, largest_modulus = 1e12;
constexpr double determined =
    std::numbers::ln2; ///< a modulus whose logarithm is known to less than this follows from the frequencies

/// The scene with the water of a measurement.
Scene at_level(Scene scene, const std::optional<double>& level)
{
    if (!level) return scene;
    if (*level == 0.0) {
        scene.reservoir.reset();
        scene.gate.reset();
    } else {
        scene.reservoir->level = *level;
    }
    return scene;
}

/// With acoustic water the modes that move the dam, beyond the first without those of the reservoir. @returns 0: there is none [Hz]
double frequency_of(const ModesResult& m, int mode)
{
    int count = 0;
    for (Eigen::Index i = 0; i < m.modes.frequency.size(); ++i)
        if (i == 0 || !m.coupled || !m.coupled->of_water(m.leading[static_cast<std::size_t>(i)]))
            if (++count == mode) return m.modes.frequency[i];
    return 0.0;
}

/// What the frequencies are functions of, and the way there.
class Fit {
public:
    Fit(const Scene& given, const CalibrateOptions& options)
        : options_(options), ready_(prepare(given, Method::finite_elements, {.stop = options.stop})), scene_(given)
    {
        if (ready_.scene.reservoir && scene_.reservoir) scene_.reservoir->model = ready_.scene.reservoir->model;
    }

    const Ready& ready() const { return ready_; }

    /// @param x  logarithms of the moduli of dam and rock
    Scene with(const Eigen::Vector2d& x, Scene scene) const
    {
        scene.dam.young_modulus = std::exp(x[0]);
        if (scene.foundation) scene.foundation->material.young_modulus = std::exp(x[1]);
        return scene;
    }

    /// ln f of each measurement.
    Eigen::VectorXd logs(const Eigen::Vector2d& x) const
    {
        Eigen::VectorXd result(static_cast<Eigen::Index>(options_.measured.size()));
        std::vector<char> done(options_.measured.size(), 0);
        for (std::size_t i = 0; i < done.size(); ++i) {
            if (done[i]) continue;
            const Ready ready = prepare(with(x, at_level(scene_, options_.measured[i].level)), Method::finite_elements,
                                        ready_.pairs, {.stop = options_.stop});
            const ModesResult modes = compute_modes(ready, {.damping = false});
            for (std::size_t k = i; k < done.size(); ++k) {
                if (options_.measured[k].level != options_.measured[i].level) continue;
                const double f = frequency_of(modes, options_.measured[k].mode);
                if (!(f > 0.0))
                    throw NotConverged(Diagnostic{scene_.file.string(), 0, 0, "not all modes were found.", "",
                                                  "run  damslip modes  on the scene"});
                result[static_cast<Eigen::Index>(k)] = std::log(f);
                done[k] = 1;
            }
        }
        return result;
    }

    /// d ln f / d ln E of dam and rock.
    Eigen::MatrixX2d sensitivity(const Eigen::Vector2d& x, const Eigen::VectorXd& at) const
    {
        constexpr double step = 0.01;
        Eigen::MatrixX2d j = Eigen::MatrixX2d::Zero(at.size(), 2);
        for (const int k : {0, 1})
            if (k == 0 || scene_.foundation) j.col(k) = (logs(x + step * Eigen::Vector2d::Unit(k)) - at) / step;
        return j;
    }

private:
    const CalibrateOptions& options_;
    Ready ready_;
    Scene scene_;
};

void check(const Scene& given, const CalibrateOptions& options)
{
    if (!given.dam.young_modulus)
        refuse(given.file, "dam.young_modulus is missing.", "a first guess", "add  young_modulus_GPa = 25  to [dam]");
    const double crest = crest_level(given.section);
    for (const MeasuredFrequency& m : options.measured) {
        if (!m.level) continue;
        if (!given.reservoir)
            refuse(given.file, "a frequency at a water level of its own, but the scene has no [reservoir].",
                   "--frequency alone for a dam without water", "add [reservoir] to the scene");
        if (*m.level < 0.0 || *m.level > crest)
            refuse(given.file, fmt::format("a frequency at a water level of {:g} m.", *m.level),
                   fmt::format("metres above the heel, 0 to the crest at {:g} m", crest), "check the datum");
    }
    const Damping& d = given.damping;
    if (options.damping && (d.method == DampingMethod::none || d.mass_coefficient))
        refuse(given.file, "--damping, but the scene does not damp by damping.ratio.",
               "damping.method rayleigh or modified-rayleigh without coefficients of its own",
               "delete method = \"none\" or the coefficients, or leave --damping out");
}

/// @param k  0: of the dam, 1: of the rock
[[noreturn]] void refuse_modulus(const Scene& scene, int k, const std::string& modulus)
{
    throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                  fmt::format("the frequencies ask for a modulus of {} of the {}.", modulus,
                                              k == 0 ? "dam" : "rock"),
                                  fmt::format("{:g} to {:g} GPa",
                                              (k == 0 ? least_modulus_dam : least_modulus_rock) / units::GPa,
                                              largest_modulus / units::GPa),
                                  "check unit, mode and water level of the frequencies"});
}

/// A frequency follows the dam's modulus at most as its square root: where even that leaves the range, no fit begins.
/// @param modulus  of the scene [Pa]  @param ratio  measured frequency over the scene's
void check_reach(const Scene& given, double modulus, double ratio)
{
    const double e = modulus * ratio * ratio;
    if (e < least_modulus_dam) refuse_modulus(given, 0, fmt::format("{:.3g} GPa or less", e / units::GPa));
    if (e > largest_modulus) refuse_modulus(given, 0, fmt::format("{:.3g} GPa or more", e / units::GPa));
}

/// Gauss-Newton steps with the sensitivities of the start, and of the place where they come to rest. @param unknown  1: the dam alone
Eigen::Vector2d fitted(const Fit& fit, const Scene& given, const Eigen::VectorXd& wanted, Eigen::Vector2d x,
                       int unknown, Eigen::VectorXd& at, Eigen::MatrixX2d& j)
{
    constexpr int most_steps = 40, same_sensitivity = 6;
    for (int step = 0; step < most_steps; ++step) {
        if (step % same_sensitivity == same_sensitivity - 1) j = fit.sensitivity(x, at);
        Eigen::Vector2d change = Eigen::Vector2d::Zero();
        change.head(unknown) = j.leftCols(unknown).colPivHouseholderQr().solve(wanted - at);
        if (const double largest = change.cwiseAbs().maxCoeff(); largest > 1.0) change /= largest;
        x += change;
        for (int k = 0; k < unknown; ++k)
            if (const double e = std::exp(x[k]);
                !(e > (k == 0 ? least_modulus_dam : least_modulus_rock) && e < largest_modulus))
                refuse_modulus(given, k, fmt::format("{:.3g} GPa", e / units::GPa));
        at = fit.logs(x);
        if (change.cwiseAbs().maxCoeff() < 1e-6) return x;
    }
    throw NotConverged(Diagnostic{given.file.string(), 0, 0, "the fit to the frequencies does not settle.", "",
                                  "give fewer of them, or others"});
}

/// Covariance of the logarithms of the first `unknown` moduli.
Eigen::MatrixXd covariance(const Eigen::MatrixX2d& j, int unknown, double scatter)
{
    const Eigen::MatrixXd part = j.leftCols(unknown);
    return scatter * scatter * (part.transpose() * part).inverse();
}

bool tells_rock(const Eigen::MatrixX2d& j, double scatter)
{
    if (j.rows() < 2 || j.col(1).isZero()) return false;
    const double deviation = std::sqrt(covariance(j, 2, scatter)(1, 1));
    return std::isfinite(deviation) && deviation < determined;
}

/// Damping ratio of the first resonance of the dam's deflection, everything included: that of the oscillator on a steady background,
/// H (c_0 + i c_1 w - w^2) = n_0 + n_2 w^2, that fits the answers around its peak; zeta = c_1 / (2 sqrt(c_0)) [-]
double resonance_damping(const Scene& scene, const Records& records, double frequency, const StopAsked& stop)
{
    const Ready ready = prepare(scene, Method::finite_elements, records, {.stop = stop});
    const auto answers = [&](double from, double to, int count) {
        ModesOptions options;
        options.transfer = true;
        for (int i = 0; i < count; ++i) options.frequencies.push_back(from + (to - from) * i / (count - 1));
        return compute_modes(ready, options).transfer;
    };
    const auto amplitude = [](const fe2d::TransferPoint& p) { return std::abs(p.deflection); };
    const auto coarse = answers(0.75 * frequency, 1.1 * frequency, 36);
    const double peak = std::max_element(coarse.begin(), coarse.end(), [&](const auto& a, const auto& b) {
                            return amplitude(a) < amplitude(b);
                        })->frequency;
    const double width = std::clamp(scene.damping.ratio, 0.01, 0.05);
    const auto near = answers(peak * (1.0 - width), peak * (1.0 + width), 9);
    // Unknowns c_0, c_1, then real and imaginary parts of n_0 and n_2; w over that of the peak.
    const auto count = static_cast<Eigen::Index>(near.size());
    Eigen::MatrixXcd terms(count, 6);
    Eigen::VectorXcd wanted(count);
    constexpr std::complex<double> i1{0.0, 1.0};
    for (Eigen::Index i = 0; i < count; ++i) {
        const fe2d::TransferPoint& p = near[static_cast<std::size_t>(i)];
        const double w = p.frequency / peak;
        terms.row(i) << p.deflection, i1 * w * p.deflection, -1.0, -i1, -w * w, -i1 * w * w;
        wanted[i] = w * w * p.deflection;
    }
    Eigen::MatrixXd parts(2 * count, 6);
    parts << terms.real(), terms.imag();
    Eigen::VectorXd right(2 * count);
    right << wanted.real(), wanted.imag();
    const Eigen::VectorXd c = parts.colPivHouseholderQr().solve(right);
    return c[0] > 0.0 ? 0.5 * c[1] / std::sqrt(c[0]) : 0.0;
}

/// The ratio of the structure that makes the first resonance's as measured, by secants.
std::optional<FittedDamping> fitted_damping(Scene scene, const Records& records, double measured, double frequency,
                                            const StopAsked& stop, std::vector<std::string>& notes)
{
    constexpr double least = 0.002, most_steps = 8, close = 2e-3;
    const auto total = [&](double ratio) {
        scene.damping.ratio = ratio;
        return resonance_damping(scene, records, frequency, stop);
    };
    double a = 0.5 * measured, of_a = total(a), b = measured, of_b = total(b);
    for (int step = 0; step < most_steps && std::abs(of_b - measured) > close * measured; ++step) {
        const double slope = (of_b - of_a) / (b - a);
        const double next = std::clamp(b + (measured - of_b) / slope, least, 0.99);
        if (next == b) break;
        a = std::exchange(b, next);
        of_a = std::exchange(of_b, total(next));
    }
    if (std::abs(of_b - measured) <= close * measured) return FittedDamping{measured, b, of_b - b};
    notes.push_back(
        fmt::format("waves into rock and water alone take {:.3g} % of the first mode, more than the {:.3g} % measured: "
                    "damping.ratio stays; see reservoir.bottom_reflection and [foundation]",
                    100.0 * (of_b - b), 100.0 * measured));
    return std::nullopt;
}

} // namespace

Calibration calibrate(const Scene& given, const CalibrateOptions& options)
{
    check(given, options);
    const Fit fit(given, options);
    const Eigen::Index count = static_cast<Eigen::Index>(options.measured.size());
    Eigen::VectorXd wanted(count);
    for (Eigen::Index i = 0; i < count; ++i)
        wanted[i] = std::log(options.measured[static_cast<std::size_t>(i)].frequency);
    Eigen::Vector2d start(std::log(*given.dam.young_modulus), 0.0);
    if (given.foundation) {
        if (!given.foundation->material.young_modulus)
            refuse(given.file, "foundation.young_modulus is missing.", "a first guess",
                   "add  young_modulus_GPa = 25  to [foundation]");
        start[1] = std::log(*given.foundation->material.young_modulus);
    }

    // 1. the scene as it is, and how its frequencies follow the moduli
    const Eigen::VectorXd before = fit.logs(start);
    if (count == 1) check_reach(given, *given.dam.young_modulus, std::exp(wanted[0] - before[0]));
    Eigen::MatrixX2d j = fit.sensitivity(start, before);
    Calibration result;

    // 2. the moduli: of the rock too, where the frequencies tell it both before and after; their scatter
    bool rock = tells_rock(j, options.scatter);
    Eigen::VectorXd at;
    Eigen::Vector2d x;
    for (const Eigen::MatrixX2d first = j;;) {
        at = before;
        j = first;
        x = fitted(fit, given, wanted, start, rock ? 2 : 1, at, j);
        j = fit.sensitivity(x, at);
        if (!rock || tells_rock(j, options.scatter)) break;
        rock = false;
    }
    const int unknown = rock ? 2 : 1;
    if (given.foundation && !rock)
        result.notes.push_back(count < 2
                                   ? "the rock keeps its modulus: one frequency tells one modulus"
                                   : "the rock keeps its modulus: the frequencies do not tell it to a factor of two");
    const Eigen::MatrixXd spread = covariance(j, unknown, options.scatter);
    result.scene = given;
    result.scene.dam.young_modulus = std::exp(x[0]);
    if (rock) result.scene.foundation->material.young_modulus = std::exp(x[1]);
    for (int k = 0; k < unknown; ++k)
        result.moduli.push_back({k == 0 ? "dam.young_modulus_GPa" : "foundation.young_modulus_GPa", std::exp(start[k]),
                                 std::exp(x[k]), std::sqrt(spread(k, k))});
    if (rock)
        result.rank_correlation =
            6.0 / std::numbers::pi * std::asin(0.5 * spread(0, 1) / std::sqrt(spread(0, 0) * spread(1, 1)));
    for (Eigen::Index i = 0; i < count; ++i)
        result.frequencies.push_back(
            {options.measured[static_cast<std::size_t>(i)], std::exp(before[i]), std::exp(at[i]), j(i, 0), j(i, 1)});
    result.misfit = (wanted - at).norm() / std::sqrt(static_cast<double>(count));
    if (result.misfit > 2.0 * options.scatter)
        result.notes.push_back(
            fmt::format("the calibrated dam misses the frequencies by {:.2g} %, their scatter is {:.2g} %: "
                        "section, water level, rock or the modes named are not those measured",
                        100.0 * result.misfit, 100.0 * options.scatter));

    // 3. damping
    if (options.damping) {
        Scene scene = result.scene;
        if (scene.reservoir) scene.reservoir->model = fit.ready().scene.reservoir->model;
        const double first = result.frequencies.front().after;
        result.damping = fitted_damping(scene, fit.ready().pairs, *options.damping, first, options.stop, result.notes);
        if (result.damping) result.scene.damping.ratio = result.damping->ratio;
    }
    return result;
}

} // namespace damslip
