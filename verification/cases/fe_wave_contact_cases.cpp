#include "verification/cases/modules.hpp"

#include "fe2d/element/elastic.hpp"
#include "fe2d/run/dynamic_contact.hpp"
#include "verification/exact/column_on_base.hpp"
#include "verification/exact/reference_scene.hpp"
#include "verification/exact/time_schemes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using fe2d::DynamicContact;

/// Scalar wave equation for each displacement: shear stress G u_x,y and normal stress E u_y,y only.
fe2d::ElementMatrix uncoupled(const fe2d::Corners& corners, int size)
{
    const fe2d::ElementMatrix scalar = fe2d::scalar_gradient_matrix(corners, size, 1.0);
    fe2d::ElementMatrix matrix = fe2d::ElementMatrix::Zero(2 * size, 2 * size);
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) matrix(2 * i, 2 * j) = matrix(2 * i + 1, 2 * j + 1) = scalar(i, j);
    return matrix;
}

/// One column of square elements, height 1, density 1, wave speed 1.
class Column {
public:
    enum class Motion { vertical, shear };
    Column(int elements, Motion motion) : elements_(elements)
    {
        const double h = element();
        scene_ = exact::bare_scene({{0, 0}, {h, 0}, {h, 1.0}, {0, 1.0}}, 1.0);
        scene_.dam.young_modulus = 1.0;
        scene_.dam.poisson_ratio = 0.0;
        scene_.mesh.size = scene_.mesh.contact_size = h;
        fe2d::ModelOptions options;
        options.base = fe2d::Base::separate;
        model_ = fe2d::build_model(scene_, options);
        if (motion == Motion::shear)
            model_.stiffness =
                fe2d::assemble(model_.mesh, model_.dofs,
                               [](const fe2d::Element& e, const fe2d::Corners& c) { return uncoupled(c, e.size()); });
        structure_.emplace(model_);
    }
    const fe2d::ContactStructure& structure() const { return *structure_; }
    double element() const { return 1.0 / elements_; }
    /// Standing on the base under its weight.
    DynamicContact at_rest(double gravity, const fe2d::Scheme& scheme) const
    {
        const fe2d::Region dam[] = {fe2d::Region::dam};
        const fe2d::SplitLoad load =
            structure_->split(fe2d::gravity_load(model_.mesh, model_.dofs, model_.materials, gravity, dam));
        fe2d::StaticContact statics(*structure_);
        fe2d::ContactMemory memory(structure_->plane().pairs());
        statics.solve(load, fe2d::uniform_law(structure_->plane().pairs(), 0.0), memory);
        return DynamicContact(*structure_, {}, scheme, load, statics.displacements(load, memory), memory);
    }

private:
    int elements_;
    Scene scene_;
    fe2d::Model model_;
    std::optional<fe2d::ContactStructure> structure_;
};

/// Width of a front that was sharp after the way L through the mesh.
///
/// Linear elements with consistent mass raise the frequency of a wave of number k by (kh)^2/24, the scheme lowers it by
/// e (omega dt)^2 (Newmark: e = 1/12), so omega = ck (1 - delta k^2), delta = h^2 (1/24 - e C^2), C = c dt/h. A step
/// H(-x) becomes f = integral of Ai from x/l on, l = (3 |delta| L)^(1/3) (Whitham 1974, section 13.6), with the
/// oscillation behind the front (delta < 0) or before it.
double front_width(const Column& column, double courant, const fe2d::Scheme& scheme, double way)
{
    constexpr double omega_dt = 0.05; // the next term is (omega dt)^2 smaller
    const double elongation =
        exact::numerical_vibration({scheme.alpha, scheme.gamma, scheme.beta}, 0.0, omega_dt).period_ratio - 1.0;
    const double e = elongation / (omega_dt * omega_dt), h = column.element();
    return std::cbrt(3.0 * h * h * std::abs(1.0 / 24.0 - e * courant * courant) * way);
}

/// The integral of the front less the step has its largest value at the step itself, -Ai'(0), and vanishes far off: what
/// a sharp front passes on is right but for jump x width x this share while the front passes.
constexpr double front_area = 0.2588194;

struct WaveRun {
    double front_width; ///< after the way to the last event [m]
    double final_error; ///< of slip or of the speed after the impact
    std::vector<Check> checks;
};

double mean_velocity(const DynamicContact& dynamics, const VectorXd& inertia)
{
    return dynamics.state().v.dot(inertia) / inertia.sum();
}

/// Thrown by a ground acceleration of three steps while the base is smooth: every point has v_0 exactly then. Friction,
/// on from there, grows within the first step, so it acts from the middle of that step on.
WaveRun throw_column(int elements, double courant, const fe2d::Scheme& scheme, double ratio)
{
    const Column column(elements, Column::Motion::shear);
    const double strength = 0.5, dt = courant * column.element();
    const exact::ThrownColumn exact{1.0, 1.0, strength, ratio * strength};
    DynamicContact dynamics = column.at_rest(1.0, scheme);
    const fe2d::Plane& plane = column.structure().plane();
    const Index m = plane.pairs();
    const VectorXd& inertia = column.structure().inertia_x();
    const fe2d::ContactLaw smooth = fe2d::uniform_law(m, 0.0), rough = fe2d::uniform_law(m, strength);
    for (const double a : {exact.velocity / dt, 0.0, 0.0}) dynamics.advance(dt, {a, 0.0}, smooth);
    const auto slip = [&] { return plane.weights().dot(dynamics.state().contact.slip); };
    const double start = slip(), start_time = dynamics.state().time;
    double momentum_error = 0.0, sliding_error = 0.0, slip_error = 0.0, stress = 0.0;
    int samples = 0;
    for (int n = 1; n * dt < exact.stop_time() + 4.0; ++n) {
        dynamics.advance(dt, {}, rough);
        const double t = dynamics.state().time - start_time - 0.5 * dt;
        slip_error = slip() - start - exact.velocity * 0.5 * dt - exact.slip(t);
        if (n > 1 && t < exact.stop_time() - 0.5) {
            momentum_error =
                std::max(momentum_error, std::abs(mean_velocity(dynamics, inertia) - exact.velocity + strength * t));
            sliding_error = std::max(sliding_error, std::abs(slip_error));
        }
        if (std::abs(t - exact.stop_time() - 1.0) < 0.5) {
            stress -= dynamics.state().contact.force.tail(m).sum() / (strength * column.element());
            ++samples;
        }
    }
    WaveRun run{front_width(column, courant, scheme, exact.stop_time()), std::abs(slip_error), {}};
    const std::string name = fmt::format(", v_0 = {} V, N = {}, alpha = {:.2f}", ratio, elements, scheme.alpha);
    const double unit = exact.friction_velocity * run.front_width;
    run.checks = {{"mean velocity while sliding" + name, "of v_0", 1e-10, momentum_error / exact.velocity, 0.0,
                   Measure::upper_bound},
                  {"largest error of the slip while sliding" + name, "m", 2.0 * front_area * unit + 0.5 * strength * dt,
                   sliding_error, 0.0, Measure::upper_bound},
                  {"slip" + name, "m", exact.final_slip(), exact.final_slip() + slip_error, unit, Measure::absolute},
                  {"shear stress that holds the base" + name, "tau", exact.held_stress(), stress / samples,
                   4.0 * front_area * run.front_width, Measure::absolute}};
    return run;
}

/// Lifted and thrown down by ground accelerations of three steps each; every point has -v_0 exactly before the impact.
/// @param lift  speed upwards over v_0: decides where within a step the bar hits [-]
WaveRun drop_bar(int elements, const fe2d::Scheme& scheme, double lift)
{
    const Column column(elements, Column::Motion::vertical);
    const exact::BarImpact exact{1.0, 1.0, 1.0, 1.0};
    const double courant = 1.0, h = column.element(), dt = courant * h;
    DynamicContact dynamics = column.at_rest(1e-12, scheme);
    const Index m = column.structure().plane().pairs();
    const VectorXd& inertia = column.structure().inertia_y();
    const fe2d::ContactLaw law = fe2d::uniform_law(m, 0.0);
    const double a = exact.velocity / dt;
    for (const double up : {-lift * a, 0.0, 0.0, (lift + 1.0) * a, 0.0, 0.0}) dynamics.advance(dt, {0.0, up}, law);
    const double hit = dynamics.state().time + dynamics.state().contact.opening.mean() / exact.velocity;
    double middle = 0.0, last = 0.0;
    while (dynamics.state().time < hit + exact.duration() + 1.0) {
        const double before = dynamics.state().time - hit, velocity = mean_velocity(dynamics, inertia);
        dynamics.advance(dt, {}, law);
        const double t = before + dt, share = (0.5 * exact.duration() - before) / dt;
        if (share >= 0.0 && share < 1.0) middle = velocity + share * (mean_velocity(dynamics, inertia) - velocity);
        if (dynamics.state().contact.force.head(m).sum() > 1e-3 * exact.stress() * h) last = t;
    }
    const double after = mean_velocity(dynamics, inertia);
    WaveRun run{front_width(column, courant, scheme, 2.0), std::abs(after - exact.velocity), {}};
    const std::string name = fmt::format(", N = {}, alpha = {:.2f}, lift {}", elements, scheme.alpha, lift);
    run.checks = {{"impulse of the first H/c" + name, "rho H v_0", 1.0, 1.0 + middle, dt + 0.5 * h, Measure::absolute},
                  {"speed after the impact" + name, "v_0", 1.0, after, run.front_width, Measure::absolute},
                  {"duration of the contact" + name, "2H/c", 1.0, last / exact.duration(),
                   (0.45 * run.front_width + dt) / exact.duration(), Measure::absolute}};
    return run;
}

void append(std::vector<Check>& checks, const std::vector<Check>& more)
{
    checks.insert(checks.end(), more.begin(), more.end());
}

std::vector<Check> thrown_column()
{
    std::vector<Check> checks;
    for (const double ratio : {2.5, 4.5})
        for (const double alpha : {-0.05, -1.0 / 3.0}) {
            const fe2d::Scheme scheme = fe2d::hht(alpha);
            double before = 0.0, order = 0.0;
            for (const int elements : {40, 80, 160}) {
                const WaveRun run = throw_column(elements, 0.5, scheme, ratio);
                append(checks, run.checks);
                order = std::log2(before / run.final_error);
                before = run.final_error;
            }
            checks.push_back({fmt::format("order of the slip in h, v_0 = {} V, alpha = {:.2f}", ratio, alpha), "-",
                              0.55, order, 0.0, Measure::lower_bound});
        }
    return checks;
}

std::vector<Check> bar_impact()
{
    std::vector<Check> checks;
    for (const double lift : {1.0, 1.37}) {
        double before = 0.0, order = 0.0;
        for (const int elements : {40, 80, 160}) {
            const WaveRun run = drop_bar(elements, fe2d::hht(-1.0 / 3.0), lift);
            append(checks, run.checks);
            order = std::log2(before / run.final_error);
            before = run.final_error;
        }
        checks.push_back({fmt::format("order of the speed after it in h, lift {}", lift), "-", 0.55, order, 0.0,
                          Measure::lower_bound});
        append(checks, drop_bar(160, fe2d::hht(-0.05), lift).checks);
    }
    return checks;
}

} // namespace

void add_fe_wave_contact_cases(Registry& registry)
{
    registry.push_back(
        {"fe.contact.thrown-column",
         "An elastic shear column thrown on a frictional base slides in steps of 2H/c and sticks when a wave comes "
         "back.",
         "d'Alembert: v_b = v_0 - (2n + 1) tau/(rho c), slip (2H/c) N (v_0 - N tau/(rho c)) (verification/exact)",
         "mesh and step spread a front to the Airy width l = (3 |delta| L)^(1/3), order 2/3; slip while sliding: "
         "0.2588 l "
         "2V/c (and friction that grows over the first step); at the end, where the base sticks within the last "
         "front: (|2 - p| |xi_0| + 2 x 0.2588) V l/c < V l/c, p V the speed before it, xi_0 the place where it is "
         "zero; "
         "mean velocity: round-off",
         thrown_column});
    registry.push_back(
        {"fe.contact.bar-impact",
         "An elastic bar that falls on a rigid base leaves it after 2H/c with the opposite speed.",
         "d'Alembert: stress rho c v_0 for 2H/c, impulse 2 rho H v_0 (verification/exact)",
         "impulse at H/c: the step of the impact and the mass h/2 of the node that hits; speed after it: contact ends "
         "within the returning front, (0.45 + 2 x 0.2588) l/H < l/H of v_0, order 2/3; peaks of the contact force are "
         "of the mesh and the scheme, not checked",
         bar_impact});
}

} // namespace damslip::verification
