#include "analysis/spectrum/spectrum_level.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/measure/measures.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace damslip {

namespace {

constexpr int spectrum_modes = 20;  ///< of a dam without acoustic water
constexpr int spectrum_levels = 11; ///< of the forces over the height

/// Forces above a plane: along it downstream, across it up, and their moment about its middle, counter-clockwise.
struct Resultant {
    double along = 0.0, across = 0.0, moment = 0.0; ///< [N/m], [N/m], [N m/m]
};

/// A plane that carries what stands above it.
struct Plane {
    Point middle, t, n;  ///< t downstream, n up
    double length = 0.0; ///< [m]
    double level = 0.0;  ///< of its middle [m]
    double share = 1.0;  ///< of the width that is concrete [-]
};

Plane base_plane(const Section& section)
{
    const Point a = heel(section), b = toe(section);
    const double length = base_length(section);
    const Point t{(b.x - a.x) / length, (b.y - a.y) / length};
    return {{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, t, {-t.y, t.x}, length, 0.5 * (a.y + b.y), base_share(section)};
}

/// The base, and horizontal sections above it to the crest.
std::vector<Plane> planes_of(const Section& section)
{
    std::vector<Plane> planes{base_plane(section)};
    const double from = std::max(heel(section).y, toe(section).y), to = crest_level(section);
    const Polyline face = upstream_face(section);
    for (int i = 1; i < spectrum_levels; ++i) {
        const double y = from + (to - from) * i / spectrum_levels;
        double x = face.front().x;
        for (std::size_t k = 0; k + 1 < face.size(); ++k)
            if (face[k].y <= y && y <= face[k + 1].y && face[k + 1].y > face[k].y)
                x = face[k].x + (y - face[k].y) / (face[k + 1].y - face[k].y) * (face[k + 1].x - face[k].x);
        const double width = width_at_level(section, y);
        planes.push_back({{x + 0.5 * width, y}, {1.0, 0.0}, {0.0, 1.0}, width, y, share_above(section, y)});
    }
    return planes;
}

/// Of nodal forces above a plane; all of them for the base, which is below all that has mass.
Resultant above(const Plane& plane, bool base, const std::vector<Unknown>& unknowns, const Eigen::VectorXd& force)
{
    Resultant sum;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const Unknown& u = unknowns[i];
        if (!base && u.at.y <= plane.level) continue;
        const double f = force[static_cast<Eigen::Index>(i)];
        const Point direction = u.component == 0 ? Point{1.0, 0.0} : Point{0.0, 1.0};
        const Point arm{u.at.x - plane.middle.x, u.at.y - plane.middle.y};
        sum.along += f * (direction.x * plane.t.x + direction.y * plane.t.y);
        sum.across += f * (direction.x * plane.n.x + direction.y * plane.n.y);
        sum.moment += f * (arm.x * direction.y - arm.y * direction.x);
    }
    return sum;
}

/// Resultants of every mode on every plane, and last those of what the modes leave, per m/s^2.
struct UnitResponses {
    std::vector<Plane> planes;
    std::vector<std::vector<Resultant>> of_mode; ///< [mode][plane]; the last is the residual
    Eigen::VectorXd crest;                       ///< [m per m/s^2]; none of the residual, which is stiff
};

UnitResponses unit_responses(const ModesResult& modes, const ModalForces& forces, ModalDirection direction)
{
    UnitResponses u;
    u.planes = planes_of(modes.scene.section);
    const std::vector<Unknown> unknowns = unknowns_of(modes.model);
    const int axis = direction == ModalDirection::horizontal ? 0 : 1;
    const Point d = axis == 0 ? Point{1.0, 0.0} : Point{0.0, 1.0};
    const auto add = [&](const Eigen::VectorXd& force, double mass) {
        std::vector<Resultant>& list = u.of_mode.emplace_back();
        for (std::size_t k = 0; k < u.planes.size(); ++k) list.push_back(above(u.planes[k], k == 0, unknowns, force));
        if (modes.model.mesh.has_rock()) return;
        // Mass at fixed nodes (a dam without rock) is in no unknown: it acts in the base itself.
        double fixed = mass;
        for (std::size_t i = 0; i < unknowns.size(); ++i)
            if (unknowns[i].component == axis) fixed -= force[static_cast<Eigen::Index>(i)];
        const Plane& base = u.planes.front();
        list.front().along += fixed * (d.x * base.t.x + d.y * base.t.y);
        list.front().across += fixed * (d.x * base.n.x + d.y * base.n.y);
    };
    for (Eigen::Index i = 0; i < forces.force.cols(); ++i) add(forces.force.col(i), forces.effective_mass[i]);
    add(forces.residual, forces.residual_mass);
    const int dof = modes.model.dofs(modes.model.mesh.crest.back(), 0);
    u.crest = Eigen::VectorXd::Zero(forces.force.cols() + 1);
    if (dof != fe2d::no_dof) u.crest.head(forces.force.cols()) = forces.displacement.row(dof).transpose();
    return u;
}

/// Peaks of modes, and how they combine: those of the modes by their correlation, the residual with none.
struct Combining {
    Eigen::VectorXd scale; ///< S_a of each mode, then PGA [m/s^2]
    Eigen::MatrixXd srss, cqc;

    /// @param acceleration  S_a(T), PGA at 0
    Combining(const ModalForces& forces, const std::function<double(double)>& acceleration, double ratio)
    {
        const Eigen::Index n = forces.frequency.size();
        scale.resize(n + 1);
        for (Eigen::Index i = 0; i < n; ++i) scale[i] = acceleration(1.0 / forces.frequency[i]);
        scale[n] = acceleration(0.0);
        srss = Eigen::MatrixXd::Identity(n + 1, n + 1);
        cqc = srss;
        cqc.topLeftCorner(n, n) = fe2d::modal_correlations(forces.frequency, ratio, fe2d::ModalRule::cqc);
    }
    double peak(const Eigen::VectorXd& v) const { return fe2d::combined_peak(v, cqc); }
};

template <class Value>
Eigen::VectorXd modal_values(const UnitResponses& unit, const Combining& combining, std::size_t plane, Value value)
{
    Eigen::VectorXd v(combining.scale.size());
    for (Eigen::Index i = 0; i < v.size(); ++i)
        v[i] = combining.scale[i] * value(unit.of_mode[static_cast<std::size_t>(i)][plane]);
    return v;
}

/// Vertical stress of the beam at an end of a plane, compression positive. @param end  -1: heel, upstream; +1: toe
double edge_stress(const Resultant& r, const Plane& plane, double end)
{
    const double length = plane.length;
    return (-r.across / length - end * 6.0 * r.moment / (length * length)) / plane.share;
}

LevelForce level_force(const UnitResponses& unit, const Combining& combining, std::size_t k)
{
    LevelForce out;
    const double length = unit.planes[k].length;
    out.level = unit.planes[k].level;
    out.shear = combining.peak(modal_values(unit, combining, k, [](const Resultant& r) { return r.along; }));
    out.moment = combining.peak(modal_values(unit, combining, k, [](const Resultant& r) { return r.moment; }));
    if (length > 0.0)
        for (const double end : {-1.0, 1.0})
            out.stress = std::max(out.stress, combining.peak(modal_values(unit, combining, k, [&](const Resultant& r) {
                return edge_stress(r, unit.planes[k], end);
            })));
    return out;
}

/// Stabilising and overturning moments of the static loads and the uplift about the toe, each part on its own [N m/m].
struct ToeMoments {
    double stabilising = 0.0, overturning = 0.0;
};

ToeMoments toe_moments(const sliding::Equilibrium& e, Point pivot)
{
    ToeMoments sum;
    const auto add = [&](const sliding::Force& f) {
        const double m = sliding::moment_about(f, pivot);
        (m > 0.0 ? sum.stabilising : sum.overturning) += std::abs(m);
    };
    for (const sliding::Load& load : e.loads) {
        add(load.force.horizontal);
        add(load.force.vertical);
    }
    const double u = e.base.uplift.force;
    add({u * e.frame.n.x, u * e.frame.n.y, e.base.uplift.moment_about_heel});
    return sum;
}

double ratio_of(double resists, double drives)
{
    return drives > 0.0 ? resists / drives : std::numeric_limits<double>::infinity();
}

/// The scene's own levels, without earthquake and without a crack.
sliding::Equilibrium static_equilibrium(const Ready& ready)
{
    Combination usual;
    usual.name = "static";
    usual.ice = true; // where there is any, as in the slips
    usual.crack = CrackRule::none;
    sliding::EquilibriumOptions options;
    options.seepage = ready.seepage->profile_of(ready.scene);
    return sliding::evaluate(ready.scene, usual, {}, options);
}

/// Each mode's share of the force on the base. @param force  which part of it
std::vector<ModeShare> mode_shares(const UnitResponses& unit, const ModalForces& forces, const Combining& combining,
                                   double Resultant::*force)
{
    std::vector<ModeShare> shares;
    for (Eigen::Index i = 0; i < forces.frequency.size(); ++i)
        shares.push_back({forces.frequency[i], forces.effective_mass[i], combining.scale[i],
                          combining.scale[i] * (unit.of_mode[static_cast<std::size_t>(i)].front().*force)});
    return shares;
}

/// What moves a joint, of one component of the earthquake: mean squares of T and N', and of what both share.
struct SlidingMoments {
    double tt = 0.0, tn = 0.0, nn = 0.0; ///< T downstream, N' compression [N^2/m^2]

    SlidingMoments operator+(const SlidingMoments& b) const { return {tt + b.tt, tn + b.tn, nn + b.nn}; }
};

/// One component on its own.
struct ComponentPeaks {
    double shear = 0.0, normal = 0.0, moment = 0.0, heel = 0.0, toe = 0.0, about_toe = 0.0;
    SlidingMoments sliding;
};

ComponentPeaks component_peaks(const UnitResponses& unit, const Combining& combining)
{
    const Plane& plane = unit.planes.front();
    const auto base = [&](auto value) { return modal_values(unit, combining, 0, value); };
    const Eigen::VectorXd along = base([](const Resultant& r) { return r.along; });
    const Eigen::VectorXd down = base([](const Resultant& r) { return -r.across; });
    ComponentPeaks p;
    p.shear = combining.peak(along);
    p.normal = combining.peak(down);
    p.moment = combining.peak(base([](const Resultant& r) { return r.moment; }));
    p.heel = combining.peak(base([&](const Resultant& r) { return edge_stress(r, plane, -1.0); }));
    p.toe = combining.peak(base([&](const Resultant& r) { return edge_stress(r, plane, 1.0); }));
    p.about_toe = combining.peak(base([&](const Resultant& r) { return r.moment - 0.5 * plane.length * r.across; }));
    p.sliding = {p.shear * p.shear, fe2d::combined_product(down, along, combining.cqc), p.normal * p.normal};
    return p;
}

void add_base(const UnitResponses& unit, const Combining& combining, const ComponentPeaks& peaks, double mass,
              double gravity, SpectrumDemand& row)
{
    row.shear = peaks.shear;
    row.shear_srss = fe2d::combined_peak(modal_values(unit, combining, 0, [](const Resultant& r) { return r.along; }),
                                         combining.srss);
    row.moment = peaks.moment;
    if (row.shear > 0.0) row.normal_with_shear = peaks.sliding.tn / row.shear;
    row.heel_stress = peaks.heel;
    row.toe_stress = peaks.toe;
    row.crest = combining.peak(unit.crest.cwiseProduct(combining.scale));
    row.coefficient = row.shear / (mass * gravity);
    for (std::size_t k = 0; k < unit.planes.size(); ++k) row.levels.push_back(level_force(unit, combining, k));
    for (std::size_t k = 0; k < row.levels.size(); ++k)
        row.levels[k].lateral = row.levels[k].shear - (k + 1 < row.levels.size() ? row.levels[k + 1].shear : 0.0);
}

/// The static joint: strength at no earthquake and what drives it.
struct Joint {
    double cohesive = 0.0; ///< c A' and dowels [N/m]
    double friction = 0.0, normal = 0.0, shear = 0.0;

    /// @param dn, dt  of the earthquake [N/m]
    double factor(double dn, double dt) const
    {
        const double drives = shear + dt;
        const double resists = cohesive + friction * std::max(0.0, normal + dn);
        return drives > 0.0 ? resists / drives : std::numeric_limits<double>::infinity();
    }

    /// The least factor on the ellipse of (N', T): the F > 0 at which R - F T is just the peak of F T - mu N',
    /// (R - F T)^2 = F^2 tt - 2 F mu tn + mu^2 nn, R = c A' + mu N'. 0 where mu N' alone may take all of R.
    double least_factor(const SlidingMoments& m) const
    {
        const double r = cohesive + friction * normal;
        const double c = r * r - friction * friction * m.nn;
        if (r <= 0.0 || c <= 0.0) return 0.0;
        const double a = shear * shear - m.tt, b = r * shear - friction * m.tn;
        const double below = b + std::sqrt(std::max(0.0, b * b - a * c));
        return below > 0.0 ? c / below : std::numeric_limits<double>::infinity();
    }
};

constexpr double percent_rule = 0.3; ///< of the other component

/// Sliding factor under shares of both components: the horizontal one's peak shear with the normal force that comes with it,
/// the vertical one's peak normal force, either way, with the shear that comes with it.
double sliding_factor_of(const Joint& joint, const ComponentPeaks& h, double of_h, const ComponentPeaks& v, double of_v)
{
    const double n_h = h.shear > 0.0 ? h.sliding.tn / h.shear : 0.0;
    const double t_v = v.normal > 0.0 ? v.sliding.tn / v.normal : 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (const double way : {-1.0, 1.0})
        least = std::min(least, joint.factor(of_h * n_h + way * of_v * v.normal, of_h * h.shear + way * of_v * t_v));
    return least;
}

/// Rows of both components and of both rules.
std::vector<ComponentDemand> component_demands(const ComponentPeaks& h, const ComponentPeaks& v, const Joint& joint,
                                               const ToeMoments& still, const SpectrumLevel& level)
{
    std::vector<ComponentDemand> rows;
    const auto add = [&](const char* motion, auto combine, double sliding) {
        const auto of = [&](double ComponentPeaks::*peak) { return combine(h.*peak, v.*peak); };
        rows.push_back({motion, of(&ComponentPeaks::shear), of(&ComponentPeaks::normal), of(&ComponentPeaks::moment),
                        level.static_heel - of(&ComponentPeaks::heel), level.static_toe + of(&ComponentPeaks::toe),
                        sliding, ratio_of(still.stabilising, still.overturning + of(&ComponentPeaks::about_toe))});
    };
    add(
        "horizontal", [](double x, double) { return x; }, sliding_factor_of(joint, h, 1.0, v, 0.0));
    add(
        "vertical", [](double, double y) { return y; }, sliding_factor_of(joint, h, 0.0, v, 1.0));
    add(
        "both, SRSS", [](double x, double y) { return std::hypot(x, y); }, joint.least_factor(h.sliding + v.sliding));
    add(
        "both, 100/30", [](double x, double y) { return std::max(x + percent_rule * y, percent_rule * x + y); },
        std::min(sliding_factor_of(joint, h, 1.0, v, percent_rule), sliding_factor_of(joint, h, percent_rule, v, 1.0)));
    return rows;
}

void add_factors(const sliding::Equilibrium& e, const ToeMoments& still, const SpectrumLevel& level, double about_toe,
                 SpectrumDemand& row)
{
    const double normal = std::max(0.0, e.base.effective_normal + row.normal_with_shear);
    row.heel_least = level.static_heel - row.heel_stress;
    row.heel_most = level.static_heel + row.heel_stress;
    row.toe_least = level.static_toe - row.toe_stress;
    row.toe_most = level.static_toe + row.toe_stress;
    row.sliding_factor = ratio_of(e.cohesion * e.cohesive_length + e.friction * normal + e.dowel_force,
                                  std::max(0.0, e.shear + row.shear));
    row.overturning_factor = ratio_of(still.stabilising, still.overturning + about_toe);
}

SpectrumLevel static_part(const sliding::Equilibrium& e)
{
    SpectrumLevel s;
    const double length = e.frame.length, normal = e.base.effective_normal;
    const double x = e.base.resultant_distance / length;
    s.static_shear = e.shear;
    s.static_normal = normal;
    s.static_heel = normal / length * (4.0 - 6.0 * x);
    s.static_toe = normal / length * (6.0 * x - 2.0);
    s.static_sliding = e.sliding_factor;
    s.static_overturning = e.overturning_factor;
    return s;
}

std::vector<std::string> notes_of(const SpectrumLevel& s)
{
    std::vector<std::string> notes;
    for (const SpectrumDemand& row : s.rows)
        if (row.heel_least < 0.0)
            notes.push_back(fmt::format("{}: {:.3g} MPa of tension at the heel: the base opens there, and peaks of a "
                                        "linear dam no longer hold.",
                                        row.record, -row.heel_least / units::MPa));
    if (!s.rows.empty() && s.rows.front().residual_mass > 0.1 * s.total_mass)
        notes.push_back(fmt::format("The modes leave {:.0f} % of the mass; it moves rigidly with the ground.",
                                    100.0 * s.rows.front().residual_mass / s.total_mass));
    return notes;
}

/// S_a of one component of a record.
std::function<double(double)> spectrum_of_samples(const std::vector<double>& samples, double dt, double ratio)
{
    const auto acceleration = [samples, dt, ratio](double period) {
        const std::vector<double> one{period};
        return records::response_spectrum(samples, dt, one, ratio).points.front().pseudo_acceleration;
    };
    return [acceleration, pga = peak_of(samples)](double period) { return period > 0.0 ? acceleration(period) : pga; };
}

/// The vertical component, and both together, of the spectra that have one. @param s  its rows are there
void add_vertical(const ModesResult& modes, const ModalForces& forces, const UnitResponses& unit,
                  const std::vector<LevelSpectrum>& spectra, const sliding::Equilibrium& e, const ToeMoments& still,
                  SpectrumLevel& s)
{
    const ModalForces up = modal_forces(modes, ModalDirection::vertical);
    const UnitResponses unit_up = unit_responses(modes, up, ModalDirection::vertical);
    const Joint joint{e.cohesion * e.cohesive_length + e.dowel_force, e.friction, e.base.effective_normal, e.shear};
    s.vertical_mass = up.total_mass;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const LevelSpectrum& spectrum = spectra[i];
        if (!spectrum.vertical) continue;
        const Combining h(forces, spectrum.acceleration, spectrum.ratio), v(up, spectrum.vertical, spectrum.ratio);
        SpectrumDemand& row = s.rows[i];
        row.vertical_pga = spectrum.vertical(0.0);
        row.vertical_modes = mode_shares(unit_up, up, v, &Resultant::across);
        row.vertical_residual_mass = up.residual_mass;
        row.components = component_demands(component_peaks(unit, h), component_peaks(unit_up, v), joint, still, s);
    }
}

} // namespace

LevelSpectrum spectrum_of(const std::string& name, const GroundMotion& motion, double ratio)
{
    LevelSpectrum spectrum{name, ratio, spectrum_of_samples(motion.accel_h, motion.dt, ratio)};
    if (!motion.accel_v.empty()) spectrum.vertical = spectrum_of_samples(motion.accel_v, motion.dt, ratio);
    return spectrum;
}

namespace {

/// The spectra of a scene's records at the scene's damping, 5 % where it damps not at all.
std::vector<LevelSpectrum> record_spectra(const Ready& ready)
{
    const double ratio = ready.scene.damping.ratio > 0.0 ? ready.scene.damping.ratio : 0.05;
    std::vector<LevelSpectrum> spectra;
    for (const RecordPair& pair : ready.records())
        spectra.push_back(spectrum_of(pair.files.name, ready.motion(pair), ratio));
    return spectra;
}

} // namespace

SpectrumLevel spectrum_level(const Ready& ready, const std::vector<LevelSpectrum>& given)
{
    const std::vector<LevelSpectrum> spectra = given.empty() ? record_spectra(ready) : given;
    const ModesResult modes = compute_modes(ready, {spectrum_modes, false, false});
    const ModalForces forces = modal_forces(modes);
    const UnitResponses unit = unit_responses(modes, forces, ModalDirection::horizontal);
    const sliding::Equilibrium e = static_equilibrium(ready);
    const ToeMoments still = toe_moments(e, toe(ready.scene.section));

    SpectrumLevel s = static_part(e);
    s.total_mass = forces.total_mass;
    s.ratio = spectra.empty() ? ready.scene.damping.ratio : spectra.front().ratio;
    s.water = is_acoustic(ready.scene)            ? "acoustic water"
              : modes.model.added_mass.nonZeros() ? "added mass"
                                                  : "no water that moves";
    for (const LevelSpectrum& spectrum : spectra) {
        const Combining combining(forces, spectrum.acceleration, spectrum.ratio);
        SpectrumDemand row;
        row.record = spectrum.name;
        row.pga = spectrum.acceleration(0.0);
        row.modes = mode_shares(unit, forces, combining, &Resultant::along);
        row.residual_mass = forces.residual_mass;
        const ComponentPeaks peaks = component_peaks(unit, combining);
        add_base(unit, combining, peaks, s.total_mass, ready.scene.gravity, row);
        add_factors(e, still, s, peaks.about_toe, row);
        s.rows.push_back(std::move(row));
    }
    const bool vertical =
        std::any_of(spectra.begin(), spectra.end(), [](const LevelSpectrum& g) { return !!g.vertical; });
    if (vertical) add_vertical(modes, forces, unit, spectra, e, still, s);
    s.notes = notes_of(s);
    return s;
}

ModalForces modal_forces(const ModesResult& m, ModalDirection direction)
{
    if (!m.complete()) refuse_modes(m.scene, "the modes were not all found.");
    return modal_forces(m.scene, m.model, m.modes, m.coupled ? &*m.coupled : nullptr, m.water ? &*m.water : nullptr, direction);
}

} // namespace damslip
