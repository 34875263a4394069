#include "verification/cases/modules.hpp"

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/run/stages.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/run/strength.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "scene/joint_bond.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using fe2d::BondLaw;
using fe2d::BondStrength;
using fe2d::ContactMemory;
using fe2d::ContactSolution;
using std::numbers::pi;

Bond bond_of(double tensile_strength, double tension_energy, double shear_energy)
{
    Bond bond;
    bond.tensile_strength = tensile_strength;
    bond.tension_energy = tension_energy;
    bond.shear_energy = shear_energy;
    return bond;
}

constexpr double usual_first_damage = 1e-3; // κ₀

fe2d::JointLaws laws_of(std::vector<BondStrength> pairs, double first_damage = usual_first_damage)
{
    fe2d::JointLaws laws;
    laws.add(std::make_unique<BondLaw>(std::move(pairs), first_damage));
    return laws;
}

std::shared_ptr<const MatrixXd> shared(MatrixXd stiffness)
{
    return std::make_shared<const MatrixXd>(std::move(stiffness));
}

/// A bar above one bonded pair, its far end pulled away: the contact problem of one pair, solved step by step.
class PulledBar {
public:
    PulledBar(double stiffness, const BondStrength& bond)
        : stiffness_(stiffness), solver_(shared(stiffness * MatrixXd::Identity(2, 2)), {}), memory_(1)
    {
        memory_.laws = laws_of({bond});
    }
    /// @param pull  of the bar's far end, away and along [m] @returns forces that the bond carries, away and along [N/m]
    Vector2d pull(double away, double along = 0.0)
    {
        VectorXd stuck(2);
        stuck << -stiffness_ * away, stiffness_ * (memory_.slip[0] - along);
        ContactSolution solution{memory_.states, {}, {}};
        const auto report = memory_.laws.solve(solver_, stuck, {0.0, memory_.opening, memory_.slip, memory_.states},
                                               fe2d::uniform_law(1, 0.0), solution);
        if (!report.resolved()) return Vector2d::Constant(std::nan(""));
        memory_.laws.end();
        memory_.states = solution.states;
        memory_.opening[0] = solution.displacement[0];
        memory_.slip[0] += solution.displacement[1];
        return -solution.force;
    }
    const BondLaw& bond() const { return *memory_.laws.find<BondLaw>(); }
    void set_in_motion() { memory_.laws.find<BondLaw>()->set_motion(true); }

private:
    double stiffness_;
    fe2d::JointLawSolver solver_;
    ContactMemory memory_;
};

/// (JOINTS 8.1) Bar of stiffness k = EA/L in series with a bond in mode I.
std::vector<Check> pulled_bar()
{
    const double area = 0.5, f_t = 1.5e6, energy = 150.0, strength = f_t * area, width = 2 * energy / f_t;
    const BondStrength bond = fe2d::bond_strength(area, 0.0, 0.0, bond_of(f_t, energy, 1.0));
    std::vector<Check> checks;
    const double stiff = 4.0 * strength / width; // no snap-back
    PulledBar bar(stiff, bond);
    const double at_peak = strength / stiff;
    checks.push_back({"force just before the peak", "N/m", strength * (1 - 1e-6), bar.pull(at_peak * (1 - 1e-6))[0],
                      1e-8, Measure::relative});
    for (const double share : {0.3, 0.6, 0.9}) {
        const double away = at_peak + share * (width - at_peak);
        const double strain = (stiff * away - strength) / (stiff * width - strength);
        checks.push_back({"force, " + std::to_string(share).substr(0, 3) + " of the way down", "N/m",
                          strength * (1 - strain), bar.pull(away)[0], 1e-8, Measure::relative});
    }
    checks.push_back({"force of a broken bond over the peak", "-", 0.0, bar.pull(1.1 * width)[0] / strength, 1e-12,
                      Measure::absolute});
    checks.push_back(
        {"work of fracture", "J/m", energy * area, bar.bond().energy().bond_fracture, 1e-8, Measure::relative});
    for (const double ratio : {0.9, 1.1}) { // of L to E w_I/f_t
        PulledBar other(strength / width / ratio, bond);
        const double peak = width * ratio;
        other.pull(peak * (1 + 1e-3));
        checks.push_back(
            {ratio < 1 ? "damage just after the peak, L = 0.9 E w/f" : "damage just after the peak, L = 1.1 E w/f", "-",
             ratio < 1 ? 1e-3 * ratio / (1 - ratio) : 1.0, other.bond().damage()[0], ratio < 1 ? 1e-6 : 1e-12,
             Measure::relative});
    }
    return checks;
}

/// Where the bar's far end is when the bond has opened or slipped by ε of w, for the first time, in its direction: the bar
/// stretches by what the bond should carry. A bond that carries anything else goes elsewhere.
double far_end(double strain, double direction, double width, double strength, double stiffness)
{
    return direction * (strain * width + std::max(0.0, 1.0 - strain) * strength / stiffness);
}

/// (JOINTS 8.2, 8.3) Straight paths in both modes, and unloading.
std::vector<Check> mixed_paths()
{
    const double area = 2.0, G1 = 150.0, G2 = 1500.0;
    const BondStrength bond = fe2d::bond_strength(area, 0.0, 1e6, bond_of(1.5e6, G1, G2));
    const double stiffness = 4.0 * bond.tension / bond.opening; // neither mode snaps back
    std::vector<Check> checks;
    const auto pull_to = [&](PulledBar& bar, double strain, double across, double along) {
        return bar.pull(far_end(strain, across, bond.opening, bond.tension, stiffness),
                        far_end(strain, along, bond.slip, bond.shear, stiffness));
    };
    for (const double degrees : {0.0, 25.0, 60.0, 89.0}) {
        const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
        const std::string at = " at " + std::to_string(static_cast<int>(degrees)) + " degrees";
        PulledBar bar(stiffness, bond);
        pull_to(bar, 0.2, c, s);
        const Vector2d half_way = pull_to(bar, 0.55, c, s);
        pull_to(bar, 1.2, c, s);
        checks.push_back({"force, 0.55 of the way," + at, "N/m", 0.45 * std::hypot(bond.tension * c, bond.shear * s),
                          half_way.norm(), 1e-8, Measure::relative});
        checks.push_back({"work of fracture" + at, "J/m", area * (G1 * c * c + G2 * s * s),
                          bar.bond().energy().bond_fracture, 1e-8, Measure::relative});
    }
    for (const bool along : {false, true}) {
        PulledBar bar(stiffness, bond);
        const double kappa = 0.4, G = (along ? G2 : G1) * area;
        pull_to(bar, kappa, along ? 0.0 : 1.0, along ? 1.0 : 0.0);
        checks.push_back({along ? "stored at damage, shear" : "stored at damage, tension", "J/m",
                          G * kappa * (1 - kappa), bar.bond().energy().stored, 1e-8, Measure::relative});
        bar.pull(0.0, 0.0);
        checks.push_back(
            {"dissipated when unloaded", "J/m", G * kappa, bar.bond().energy().bond_fracture, 1e-8, Measure::relative});
        checks.push_back(
            {"stored when unloaded, over it", "-", 0.0, bar.bond().energy().stored / G, 1e-12, Measure::absolute});
    }
    return checks;
}

/// Exponential softening that ends where a thousandth of the strength is left: f (e^(-w/v) - e^(-N))/(1 - e^(-N)), N = ln 1000, with
/// v so that the work is G.
struct ExponentialBond {
    double strength = 0.0, energy = 0.0; ///< f A [N/m], G A [J/m]
    double n = std::log(1000.0), end = 1e-3;

    double length() const { return energy / strength * (1.0 - end) / (1.0 - end * (1.0 + n)); } ///< v [m]
    double width() const { return n * length(); }
    double force(double w) const { return strength * (std::exp(-w / length()) - end) / (1.0 - end); }
    /// Of the bond that is pulled open from 0 to w [J/m].
    double work(double w) const
    {
        return strength * (length() * (1.0 - std::exp(-w / length())) - end * w) / (1.0 - end);
    }
};

/// (CRACKS 3.4) Exponential softening and the rate factor of one pair.
std::vector<Check> exponential_bar()
{
    const double area = 0.5, f_t = 1.5e6, energy = 150.0, rate = 1.2;
    Bond law = bond_of(f_t, energy, 1.0);
    law.softening = BondSoftening::exponential;
    law.dynamic_increase = rate;
    const BondStrength bond = fe2d::bond_strength(area, 0.0, 0.0, law);
    const ExponentialBond exact{f_t * area, energy * area};
    const double unit = energy / f_t, stiff = 4.0 * exact.strength / unit; // no snap-back
    const auto open = [&](PulledBar& bar, double w, double force) { return bar.pull(w + force / stiff)[0]; };
    std::vector<Check> checks;
    PulledBar bar(stiff, bond);
    checks.push_back({"force just before the peak", "N/m", exact.strength * (1 - 1e-6),
                      bar.pull(exact.strength / stiff * (1 - 1e-6))[0], 1e-8, Measure::relative});
    for (const double share : {0.25, 1.0, 3.0}) {
        const double w = share * unit, force = open(bar, w, exact.force(w));
        const std::string at = ", opening of " + std::to_string(share).substr(0, 4) + " G/f";
        checks.push_back({"force" + at, "N/m", exact.force(w), force, 1e-7, Measure::relative});
        checks.push_back({"force over f" + at + ": exp(-w f/G)", "-", std::exp(-share), force / exact.strength, 2.5e-3,
                          Measure::absolute});
    }
    const double w = 3.0 * unit, force = exact.force(w), stored = 0.5 * force * w;
    checks.push_back({"stored at 3 G/f", "J/m", stored, bar.bond().energy().stored, 1e-7, Measure::relative});
    checks.push_back({"spent at 3 G/f", "J/m", exact.work(w) - stored, bar.bond().energy().bond_fracture, 1e-8,
                      Measure::relative});
    checks.push_back({"force when half closed: to the origin", "N/m", 0.5 * force, open(bar, 0.5 * w, 0.5 * force), 1e-7,
                      Measure::relative});
    bar.set_in_motion();
    checks.push_back({"the same, damaged at rest and now in motion", "N/m", 0.5 * force, open(bar, 0.5 * w, 0.5 * force),
                      1e-7, Measure::relative});
    checks.push_back({"force further on, in motion", "N/m", rate * exact.force(1.5 * w),
                      open(bar, 1.5 * w, rate * exact.force(1.5 * w)), 1e-7, Measure::relative});
    for (const bool moving : {false, true}) {
        PulledBar other(stiff * (moving ? rate : 1.0), bond);
        if (moving) other.set_in_motion();
        const double factor = moving ? rate : 1.0;
        const int steps = 700;
        double done = 0.0, before = factor * exact.strength; // rigid up to the strength
        for (int k = 1; k <= steps; ++k) {
            const double to = exact.width() * k / steps, from = exact.width() * (k - 1) / steps;
            const double now = other.pull(to + exact.force(to) / stiff)[0];
            done += 0.5 * (now + before) * (to - from);
            before = now;
        }
        const std::string with = moving ? ", in motion" : "";
        checks.push_back({"work of fracture" + with, "J/m", factor * energy * area, other.bond().energy().bond_fracture,
                          1e-8, Measure::relative});
        checks.push_back({"work of the force, summed up" + with, "J/m", factor * energy * area, done, 1e-4,
                          Measure::relative});
    }
    return checks;
}

/// Largest share of `load` that pairs with these bonds carry on a body of stiffness V.
double largest_load(const MatrixXd& stiffness, const VectorXd& load, std::vector<BondStrength> pairs, double step,
                    double first_damage = usual_first_damage)
{
    const Index m = static_cast<Index>(pairs.size());
    fe2d::JointLawSolver solver(shared(stiffness), {});
    ContactMemory memory(m);
    memory.laws = laws_of(std::move(pairs), first_damage);
    VectorXd at_rest = VectorXd::Zero(2 * m);
    if (load.head(m).isZero()) at_rest.head(m).setOnes(); // something to press, without friction
    return fe2d::follow_damage(solver, at_rest, at_rest + load, fe2d::uniform_law(m, 0.0), memory, step).largest_load;
}

/// Stiffness of a beam's nodes across, its rotations free (Hermite's cubic elements).
MatrixXd beam(const VectorXd& lengths, double rigidity)
{
    const Index n = lengths.size() + 1;
    MatrixXd k = MatrixXd::Zero(2 * n, 2 * n); // deflections, then rotations
    for (Index e = 0; e + 1 < n; ++e) {
        const double l = lengths[e], f = rigidity / (l * l * l);
        const Index at[4] = {e, n + e, e + 1, n + e + 1};
        const double own[4][4] = {{12, 6 * l, -12, 6 * l},
                                  {6 * l, 4 * l * l, -6 * l, 2 * l * l},
                                  {-12, -6 * l, 12, -6 * l},
                                  {6 * l, 2 * l * l, -6 * l, 4 * l * l}};
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) k(at[i], at[j]) += f * own[i][j];
    }
    const MatrixXd turned = k.bottomRightCorner(n, n).partialPivLu().solve(k.bottomLeftCorner(n, n));
    const MatrixXd across = k.topLeftCorner(n, n) - k.topRightCorner(n, n) * turned;
    return 0.5 * (across + across.transpose());
}

/// (JOINTS 8.4) A cantilever glued to a rigid base but for its first part a, pulled off at its free end.
std::vector<Check> peeled_arm()
{
    std::vector<Check> checks;
    const double energy = 1.0, rigidity = 1.0, f_t = 500.0;
    for (const double arm : {10.0, 20.0}) {
        const Index cells = 40;
        VectorXd lengths = VectorXd::Constant(cells + 1, 0.01);
        lengths[0] = arm;
        const Index m = cells + 2;
        MatrixXd stiffness = MatrixXd::Zero(2 * m, 2 * m);
        stiffness.topLeftCorner(m, m) = beam(lengths, rigidity);
        stiffness.bottomRightCorner(m, m) = 1e6 * MatrixXd::Identity(m, m);
        std::vector<BondStrength> pairs(static_cast<std::size_t>(m));
        for (Index i = 1; i < m; ++i)
            pairs[static_cast<std::size_t>(i)] =
                fe2d::bond_strength(i == 1 || i + 1 == m ? 0.005 : 0.01, 0.0, 0.0, bond_of(f_t, energy, energy));
        const double exact = std::sqrt(2 * rigidity * energy) / arm;
        VectorXd load = VectorXd::Zero(2 * m);
        load[0] = -3.0 * exact;
        checks.push_back({"pull at which it peels, a = " + std::to_string(static_cast<int>(arm)), "N/m", exact,
                          3.0 * exact * largest_load(stiffness, load, pairs, 0.05), 0.03, Measure::relative});
    }
    return checks;
}

/// A structure seen from its pairs, with one load t.
struct LoadedStructure {
    MatrixXd stiffness;      ///< V
    VectorXd unit;           ///< λ of shut pairs under t = 1, 2m [-]
    double compliance = 0.0; ///< displacement q of the load under t = 1, pairs shut [m per N/m]
    double control = 0.0;    ///< C_c, see pull_open() [m per N/m]
};

/// What its load does while it opens: by Betti q = C t - λ₁ᵀx, so the strain energy is (C t² + xᵀV x)/2.
struct PulledOpen {
    double largest = 0.0;  ///< t [N/m]
    double spent = 0.0;    ///< work of the load less the strain energy [J/m]
    double fracture = 0.0; ///< of the law, with what it stores [J/m]
    double last = 0.0;     ///< t at the end [N/m]
    double broken = 0.0;   ///< [m]
};

/// The load follows t = (Δ + λ₁ᵀx)/C_c, Δ from one value to the next: what softens is seen with V + λ₁λ₁ᵀ/C_c, so with a small C_c the
/// crack grows steadily and the load falls behind its peak. A step that has more than one answer is made in halves.
PulledOpen pull_open(const LoadedStructure& of, std::vector<BondStrength> pairs, double first, double last, int steps)
{
    const Index m = static_cast<Index>(pairs.size());
    fe2d::JointLawSolver solver(shared(of.stiffness + of.unit * of.unit.transpose() / of.control), {});
    ContactMemory memory(m);
    memory.laws = laws_of(std::move(pairs));
    PulledOpen result;
    double work = 0.0, displacement = 0.0, delta = 0.0;
    for (double step = first; delta < last;) {
        const VectorXd stuck = of.unit * ((delta + step) / of.control) + solver.stiffness()->rightCols(m) * memory.slip;
        ContactSolution solution{memory.states, {}, {}};
        fe2d::JointLaws laws = memory.laws;
        const auto report = laws.solve(solver, stuck, {1.0, memory.opening, memory.slip, memory.states},
                                       fe2d::uniform_law(m, 0.0), solution);
        if (!report.resolved()) {
            step *= 0.5;
            if (step < 1e-5 * last) return {};
            continue;
        }
        delta += step;
        step = std::min(std::max(1e-12 * last, last - delta), (last - first) / steps);
        laws.end();
        memory.laws = std::move(laws);
        memory.states = solution.states;
        memory.opening = solution.displacement.head(m);
        memory.slip += solution.displacement.tail(m);
        VectorXd x(2 * m);
        x << memory.opening, memory.slip;
        const double load = (delta + of.unit.dot(x)) / of.control, now = of.compliance * load - of.unit.dot(x);
        work += 0.5 * (load + result.last) * (now - displacement);
        displacement = now;
        result.last = load;
        result.largest = std::max(result.largest, load);
        result.spent = work - 0.5 * (of.compliance * load * load + x.dot(of.stiffness * x));
    }
    const BondLaw& bond = *memory.laws.find<BondLaw>();
    result.fracture = bond.energy().bond_fracture + bond.energy().stored;
    result.broken = bond.lengths(0, m).broken;
    return result;
}

/// A column b wide, notched by 0.3 b at half its height and bent by a couple at its top.
PulledOpen bent_column(double width, double element, const Bond& bond)
{
    const double notch = 0.3 * width, height = 3.0 * width;
    Scene scene;
    scene.section.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    scene.dam = {2400.0, 25e9, 0.2};
    scene.mesh.size = 0.1 * width;
    scene.mesh.contact_size = 0.1 * width;
    LiftJoint lift;
    lift.name = "notch";
    lift.elevation = 0.5 * height;
    lift.strength.bond = bond; // asks for elements of this length
    lift.strength.bond.tensile_strength = std::sqrt(*joint_modulus(scene, false) * *bond.tension_energy / (4.0 * element));
    scene.lift_joints = {lift};
    scene.forces = {{"left", {0.0, height}, 0.0, 1.0 / width}, {"right", {width, height}, 0.0, -1.0 / width}}; // a couple of 1
    const fe2d::EarthquakeRun run(scene, {});
    const fe2d::ContactStructure& structure = run.structure();
    fe2d::StaticContact statics(structure);
    const fe2d::SplitLoad load = structure.split(run.stages().last() - run.stages().loads.front());
    const Index m = structure.pairs();
    LoadedStructure column{*statics.linear().stiffness(), statics.linear().shut_force(load), 0.0, 0.0};
    column.compliance = load.dam.dot(statics.linear().displacements(load, VectorXd::Zero(2 * m)).dam);
    column.control = 0.02 * column.compliance;
    const fe2d::Plane& plane = structure.planes()[1];
    std::vector<BondStrength> pairs(static_cast<std::size_t>(m));
    for (Index i = 0; i < m; ++i) {
        const Index k = i - structure.planes().first(1);
        if (k < 0)
            pairs[static_cast<std::size_t>(i)] = fe2d::bond_strength(1.0, 0.0, 1e12, bond_of(1e12, 1e12, 1e12)); // the base holds
        else if (const double beyond = plane.distance[k] - plane.distance[0] - notch; beyond > -1e-9 * width)
            pairs[static_cast<std::size_t>(i)] = fe2d::bond_strength((beyond < 1e-9 * width ? 0.5 : 1.0) * plane.area[k], 0.0,
                                                                     3.0 * bond.tensile_strength, bond);
    }
    const double unit = width * width * std::sqrt(*joint_modulus(scene, false) * *bond.tension_energy / width);
    return pull_open(column, pairs, 0.01 * unit * column.control, 3.0 * unit * column.control, 100); // to about 0.8 of the peak
}

/// (CRACKS 4.2) Notched column in bending: K = 6 M/b² √(πa) F(a/b) = √(E'G) (Tada, Paris & Irwin 1985, F within 0.5 %). With linear
/// softening a crack is as if longer by 0.419 ℓ_ch at its largest load (Planas & Elices 1992, Int. J. Fracture 55, 153).
std::vector<Check> notched_column()
{
    std::vector<Check> checks;
    const double width = 10.0, energy = 150.0, modulus = 25e9 / (1.0 - 0.04), characteristic = 1.0; // ℓ_ch [m]
    const auto moment = [&](double a) {
        const double half = 0.5 * pi * a;
        const double shape = std::sqrt(std::tan(half) / half) * (0.923 + 0.199 * std::pow(1.0 - std::sin(half), 4)) / std::cos(half);
        return std::sqrt(modulus * energy) * width * width / (6.0 * std::sqrt(pi * a * width) * shape);
    };
    for (const BondSoftening softening : {BondSoftening::linear, BondSoftening::exponential})
        for (const double cells : {80.0, 160.0, 240.0}) {
            Bond bond = bond_of(std::sqrt(modulus * energy / characteristic), energy, 9.0 * energy);
            bond.softening = softening;
            const PulledOpen open = bent_column(width, width / cells, bond);
            const std::string at = std::string(softening == BondSoftening::linear ? ", linear" : ", exponential") + ", " +
                                   std::to_string(static_cast<int>(cells)) + " cells";
            checks.push_back({"largest moment, at most that of a brittle notch" + at, "N", moment(0.3), open.largest, 0.0,
                              Measure::upper_bound});
            if (softening == BondSoftening::linear)
                checks.push_back({"largest moment" + at, "N", moment(0.3 + 0.419 * characteristic / width), open.largest, 0.01,
                                  Measure::relative});
            checks.push_back({"work of the load, less strain energy, over G times the area" + at, "-", 1.0,
                              open.spent / open.fracture, 1e-3, Measure::relative});
        }
    return checks;
}

/// (JOINTS 8.5) A plate glued along its length to a rigid plane, pulled along at one end (Volkersen 1938).
std::vector<Check> sheared_plate()
{
    std::vector<Check> checks;
    const double c = 1e6, energy = 1000.0, width = 2 * energy / c, rigidity = 30e9 * 1.0; // E' t
    const double l = std::sqrt(rigidity * width / c);
    for (const double share : {0.5, 1.0, 1.5, 4.0}) {
        const double length = share * l;
        const Index m = 41;
        const double h = length / static_cast<double>(m - 1), k = rigidity / h;
        MatrixXd stiffness = MatrixXd::Zero(2 * m, 2 * m);
        stiffness.topLeftCorner(m, m) = 1e3 * k * MatrixXd::Identity(m, m);
        for (Index i = 0; i + 1 < m; ++i) {
            stiffness.block(m + i, m + i, 2, 2) += k * Eigen::Matrix2d::Identity();
            stiffness(m + i, m + i + 1) -= k;
            stiffness(m + i + 1, m + i) -= k;
        }
        std::vector<BondStrength> pairs;
        for (Index i = 0; i < m; ++i)
            pairs.push_back(
                fe2d::bond_strength(i == 0 || i + 1 == m ? 0.5 * h : h, 0.0, c, bond_of(0.0, energy, energy)));
        const double exact = share < pi / 2 ? c * l * std::sin(share) : std::sqrt(2 * rigidity * energy);
        VectorXd load = VectorXd::Zero(2 * m);
        load[2 * m - 1] = -2.0 * exact;
        checks.push_back({"largest pull, L = " + std::to_string(share).substr(0, 3) + " l", "N/m", exact,
                          2.0 * exact * largest_load(stiffness, load, pairs, 0.01), 0.02, Measure::relative});
    }
    return checks;
}

/// A rigid block of mass M on a bond c A that breaks over w, pushed by D = P - R beyond its friction, from rest. The bond
/// begins with the damage κ₀: a spring cA (1 - κ₀)/(κ₀ w) up to s = κ₀ w, then its force falls as cA (1 - s/w):
///     s = (D/k₀)(1 - cos ω₀t),   then   s = A e^{Ωτ} + B e^{-Ωτ} - F w/(cA),   F = D - cA, Ω² = cA/(M w).
struct PushedBlock {
    double mass = 1e6, strength = 2e6, width = 2e-3, friction = 1e6, push = 4e6; ///< M, cA, w, R, P
    double first_damage = usual_first_damage;                                    ///< κ₀
    BondSoftening softening = BondSoftening::linear; ///< exponential: only for SteppedBlock::rate_squared and its work

    double drive() const { return push - friction; }
    double omega() const { return std::sqrt(strength / (mass * width)); }
    double work() const { return 0.5 * strength * width; } ///< of fracture [J/m]
    double spring() const { return strength * (1.0 - first_damage) / (first_damage * width); }
    /// Time at which the bond begins to soften [s].
    double softens() const
    {
        return std::acos(1.0 - first_damage * width * spring() / drive()) / std::sqrt(spring() / mass);
    }
    /// Rate² at a slip up to w: what the push does beyond what the bond takes, over M/2.
    double rate_squared(double slip) const
    {
        const double left = 1.0 - slip / width, spent = work() * (1.0 - first_damage - left * left);
        return 2.0 * (drive() * slip - spent) / mass;
    }
    /// Time at which it has slipped so far, from κ₀ w to w [s].
    double time(double slip) const
    {
        const double from = first_damage * width, beyond = (drive() - strength) * width / strength;
        const double y0 = from + beyond, v0 = std::sqrt(rate_squared(from)) / omega(), y = slip + beyond;
        const double product = (y0 + v0) * (y0 - v0); // 4 A B
        return softens() + std::log((y + std::sqrt(y * y - product)) / (y0 + v0)) / omega();
    }
    /// The same for a bond that is rigid until it softens.
    double ideal_time(double slip) const
    {
        return std::acosh(1.0 + slip / width * strength / (drive() - strength)) / omega();
    }
};

/// The block by steps in time (trapezoidal rule).
struct SteppedBlock {
    double late = 0.0;         ///< after the closed solution, at the first step beyond half the width [s]
    double rate_squared = 0.0; ///< at s = w, from the first step beyond it [m²/s²]
    double work = 0.0;         ///< of fracture [J/m]
};
SteppedBlock step_through(const PushedBlock& block, double dt)
{
    const double m = block.mass, pressed = 1e6;
    fe2d::JointLawSolver solver(shared(4 * m / (dt * dt) * MatrixXd::Identity(2, 2)), {});
    ContactMemory memory(1);
    Bond bond = bond_of(0.0, 1.0, block.work());
    bond.softening = block.softening;
    memory.laws = laws_of({fe2d::bond_strength(1.0, 0.0, block.strength, bond)}, block.first_damage);
    const double width = memory.laws.find<BondLaw>()->strength().front().slip;
    SteppedBlock result;
    double rate = 0.0, accel = block.drive() / m;
    for (int step = 1; memory.slip[0] < width; ++step) {
        VectorXd stuck(2);
        stuck << pressed, -block.push - 4 * m / dt * rate - m * accel;
        ContactSolution solution{memory.states, {}, {}};
        const auto report = memory.laws.solve(solver, stuck, {dt, memory.opening, memory.slip, memory.states},
                                              fe2d::uniform_law(1, block.friction / pressed), solution);
        const double slip = solution.displacement[1], before = memory.slip[0];
        if (!report.resolved() || !(slip > 0.0)) return {};
        memory.laws.end();
        memory.states = solution.states;
        accel = 4 / (dt * dt) * slip - 4 / dt * rate - accel;
        rate = 2 * slip / dt - rate;
        memory.slip[0] += slip;
        const double now = memory.slip[0], half = 0.5 * block.width;
        if (before < half && now >= half) result.late = step * dt - block.time(now);
    }
    result.rate_squared = rate * rate - 2.0 * block.drive() / m * (memory.slip[0] - width);
    result.work = memory.laws.energy().bond_fracture;
    return result;
}

/// (JOINTS 8.6) A rigid block under a constant push that its bond and friction do not hold.
std::vector<Check> pushed_block()
{
    const PushedBlock block;
    const double half = 0.5 * block.width, dt = block.softens() / 512.0;
    const SteppedBlock coarse = step_through(block, 4.0 * dt), middle = step_through(block, 2.0 * dt),
                       fine = step_through(block, dt);
    const double extrapolated = (4.0 * fine.late - middle.late) / 3.0, exact = block.rate_squared(block.width);
    const double ideal = 2.0 * (block.drive() * block.width - block.work()) / block.mass;
    std::vector<Check> checks{
        {"time to half the width, extrapolated", "s", block.time(half), block.time(half) + extrapolated, 1e-8,
         Measure::relative},
        {"order in the step", "-", 2.0, std::log2(coarse.late / middle.late), 0.05, Measure::absolute},
        {"order in the step, half as long", "-", 2.0, std::log2(middle.late / fine.late), 0.05, Measure::absolute},
        {"rate^2 at which the bond is gone", "m^2/s^2", exact, fine.rate_squared, 1e-8, Measure::relative},
        {"work of fracture", "J/m", block.work(), fine.work, 1e-8, Measure::relative}};
    // Exponential softening: what the push has done less G and what the first κ₀ 2G/f of the opening are softer than rigid.
    PushedBlock curved;
    curved.softening = BondSoftening::exponential;
    const ExponentialBond law{curved.strength, curved.work()};
    const double first = curved.first_damage * curved.width;
    const double taken = law.energy - law.work(first) + 0.5 * first * law.force(first);
    const SteppedBlock curve = step_through(curved, dt);
    checks.push_back({"rate^2 at which the bond is gone, exponential", "m^2/s^2",
                      2.0 * (curved.drive() * law.width() - taken) / curved.mass, curve.rate_squared, 1e-8, Measure::relative});
    checks.push_back({"work of fracture, exponential", "J/m", law.energy, curve.work, 1e-8, Measure::relative});
    // Of a bond that is rigid at first: rate² by κ₀ cA w/M; the time by what the first κ₀ w take.
    for (const auto& [kappa, steps_before] : {std::pair{1e-3, 512.0}, std::pair{1e-5, 64.0}}) {
        PushedBlock other;
        other.first_damage = kappa;
        const SteppedBlock steps = step_through(other, other.softens() / steps_before);
        const std::string at = kappa == 1e-3 ? ", damage from 1e-3" : ", damage from 1e-5";
        checks.push_back({"rate^2 over that of an ideal bond" + at, "-",
                          1.0 + 2.0 * kappa * block.work() / (ideal * block.mass), steps.rate_squared / ideal, 1e-8,
                          Measure::relative});
        checks.push_back(
            {"time behind that of an ideal bond, over its first" + at, "-", 1.0,
             std::abs(other.ideal_time(half) - other.time(half) - steps.late) / other.ideal_time(kappa * other.width),
             0.0, Measure::upper_bound});
    }
    return checks;
}

/// (JOINTS 8.7) All strength at once: limit load of a plane, and a bond that cannot break.
std::vector<Check> limit_loads()
{
    const fe2d::PlaneLimit plane{2e6, 0.0, 0.7, 10.0};
    const fe2d::PlaneLoad before{10e6, 1e6, 50e6}, load{8e6, 9e6, 50e6};
    const double exact = (2e6 + 0.7 * 10e6 - 1e6) / ((9e6 - 1e6) - 0.7 * (8e6 - 10e6));
    std::vector<Check> checks{
        {"limit load of sliding", "-", exact, fe2d::limit_load(plane, before, load), 1e-12, Measure::relative}};
    const Index m = 21;
    MatrixXd stiffness = 1e9 * MatrixXd::Identity(2 * m, 2 * m);
    std::vector<BondStrength> pairs;
    VectorXd pull = VectorXd::Zero(2 * m);
    for (Index i = 0; i < m; ++i) {
        pairs.push_back(fe2d::bond_strength(0.1, 0.0, 1e6, bond_of(0.0, 1.0, 1e12)));
        for (Index j = 0; j < m; ++j) stiffness(m + i, m + j) = (i == j ? 1e9 : 0.0) - 1e9 / static_cast<double>(m);
        pull[m + i] = -2e5 * (1.0 + 0.5 * std::sin(static_cast<double>(i)));
    }
    const double all = 0.1e6 * static_cast<double>(m) / -pull.tail(m).sum();
    const double usual = largest_load(stiffness, pull, pairs, 0.05) / all;
    const double small = largest_load(stiffness, pull, pairs, 0.05, 1e-5) / all;
    checks.push_back({"largest load over the limit load, tough bond, damage from 1e-3", "-", 1.0 - usual_first_damage,
                      usual, 1e-6, Measure::relative});
    checks.push_back({"the same, damage from 1e-5", "-", 1.0, small, 1e-4, Measure::relative});
    checks.push_back({"the same, at most the limit load", "-", 1.0, small, 0.0, Measure::upper_bound});
    return checks;
}

/// The reference dam on massless rock, bonded; cracks of this bond are as long as many elements.
Scene bonded_dam(double contact_size)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, contact_size);
    scene.contact.cohesion = 0.5e6;
    scene.contact.bond = bond_of(0.25e6, 150.0, 1500.0);
    scene.time.substeps = 1;
    return scene;
}

/// Largest share of four times the water's load that a bonded dam carries, and what all strength at once would.
struct CarriedShare {
    double largest = 0.0, limit = 0.0;
};
CarriedShare carried_share(double contact_size)
{
    const Scene scene = bonded_dam(contact_size);
    const fe2d::EarthquakeRun run(scene, fe2d::test::options_of(scene));
    const fe2d::ContactStructure& structure = run.structure();
    fe2d::StaticContact statics(structure, scene.contact);
    const fe2d::Strength strength(scene.contact, structure.plane());
    ContactMemory memory(structure.pairs());
    memory.laws = joint_laws(scene, scene.contact, structure.planes());
    const VectorXd& weight = run.stages().loads.front();
    const fe2d::SplitLoad before = structure.split(weight),
                          load = structure.split(weight + 4.0 * (run.stages().last() - weight));
    if (!statics.solve(before, strength.law(), memory).resolved()) return {};
    fe2d::PlaneLimit plane{0.0, 0.0, scene.contact.friction, structure.plane().length()};
    for (const BondStrength& pair : memory.laws.find<BondLaw>()->strength()) {
        plane.shear_strength += std::hypot(pair.shear, pair.friction * pair.tension);
        plane.tension_strength += pair.tension;
    }
    const auto on_plane = [&](const fe2d::SplitLoad& of) -> fe2d::PlaneLoad {
        const fe2d::BaseResultant r = base_resultant(structure, of.dam);
        return {r.normal_force, r.shear_force, r.normal_force * r.position};
    };
    const fe2d::StaticPath path = follow_damage(statics.with_laws(), statics.linear().shut_force(before),
                                                statics.linear().shut_force(load), strength.law(), memory);
    return {path.largest_load, limit_load(plane, on_plane(before), on_plane(load))};
}

/// (JOINTS 8.7) The limit of a bonded dam, and its slip in an earthquake, on three meshes.
std::vector<Check> bonded_dam_over_mesh()
{
    const double sizes[] = {3.0, 1.5, 0.75};
    std::vector<CarriedShare> share;
    std::vector<double> slip;
    const GroundMotion motion = fe2d::test::sines(4.0, 6.0);
    for (const double size : sizes) {
        share.push_back(carried_share(size));
        const Scene scene = bonded_dam(size);
        slip.push_back(fe2d::EarthquakeRun(scene, fe2d::test::options_of(scene)).run(motion).slip);
    }
    std::vector<Check> checks;
    for (std::size_t k = 0; k < 2; ++k) {
        const std::string mesh = k == 0 ? ", h" : ", h/2";
        checks.push_back(
            {"largest load, against h/4" + mesh, "-", share.back().largest, share[k].largest, 0.03, Measure::relative});
        checks.push_back({"slip, against h/4" + mesh, "m", slip.back(), slip[k], 0.05, Measure::relative});
    }
    checks.push_back({"largest load, at most the limit load", "-", share.back().limit, share.back().largest, 0.0,
                      Measure::upper_bound});
    return checks;
}

/// A dam whose bond is gone at once is released under its static load: it rests where friction alone holds it.
std::vector<Check> released_dam()
{
    std::vector<Check> checks;
    const Scene scene = bonded_dam(3.0);
    const fe2d::EarthquakeRun run(scene, fe2d::test::options_of(scene));
    const fe2d::ContactStructure& structure = run.structure();
    const fe2d::SplitLoad load = structure.split(run.stages().last());
    const fe2d::BaseResultant base = base_resultant(structure, load.dam);
    const double critical = base.shear_force / base.normal_force;
    const fe2d::Relaxation relax =
        fe2d::relaxation_of(structure, {run.damping()}, fe2d::hht(-0.05), nullptr, scene.contact, {}, 0.2);
    for (const double above : {0.97, 1.1}) {
        Contact broken = scene.contact;
        broken.cohesion = 0.0;
        broken.bond = {};
        broken.friction = above * critical;
        Contact bonded = broken;
        bonded.cohesion = 5e6; // holds it without any slip
        fe2d::StaticContact statics(structure, scene.contact);
        ContactMemory memory(structure.pairs());
        if (!statics.solve(load, fe2d::Strength(bonded, structure.plane()).law(), memory).resolved()) return {};
        const fe2d::StaticState start = statics.displacements(load, memory);
        const fe2d::Release release = relax(load, start, fe2d::Strength(broken, structure.plane()).law(), memory);
        checks.push_back({above < 1.0 ? "comes to rest, mu 3 % below T/N'" : "comes to rest, mu 10 % above T/N'", "-",
                          above < 1.0 ? 0.0 : 1.0, release.rests ? 1.0 : 0.0, 0.0, Measure::absolute});
        if (!release.rests) continue;
        ContactMemory settled = memory;
        const bool holds = statics.solve(load, fe2d::Strength(broken, structure.plane()).law(), settled).resolved();
        checks.push_back(
            {"in equilibrium where it rests: slip to the static state over that on the way", "-", 0.0,
             holds ? (settled.slip - memory.slip).cwiseAbs().maxCoeff() / memory.slip.cwiseAbs().maxCoeff() : 1.0, 1e-3,
             Measure::absolute});
        checks.push_back({"loses energy on the way", "-", 1.0, release.lost > 0.0 ? 1.0 : 0.0, 0.0, Measure::absolute});
    }
    return checks;
}

} // namespace

void add_fe_bond_cases(Registry& cases)
{
    const std::string one_pair = "one pair: round-off of the fixed point of the damage, 1e-9";
    cases.push_back({"fe2d.bond.bar",
                     "A bond in series with a bar peaks at f_t A, softens by G_I, and snaps back iff L > E w/f_t.",
                     "closed form, linear softening", one_pair, pulled_bar});
    cases.push_back(
        {"fe2d.bond.exponential",
         "Exponential softening: force and energies at given openings, unloading to the origin, work G A; in motion 1.2 of all.",
         "closed form", one_pair + " times the slope; 1e-4: trapezoids; 2.5e-3: the tail is cut at 1e-3", exponential_bar});
    cases.push_back(
        {"fe2d.bond.mixed",
         "Straight paths in both modes cost G_I cos^2 + G_II sin^2; unloaded bonds give back what they stored.",
         "Camanho & Davila (2002)", one_pair + ", 2 of it in what is stored", mixed_paths});
    cases.push_back({"fe2d.bond.peel", "A cantilever peels off its base at sqrt(2 E I G)/a.", "beam theory, Griffith",
                     "3 %: the process zone at the tip, 0.05 long, counts to the arm", peeled_arm});
    cases.push_back({"fe2d.bond.notch",
                     "A notched column in bending breaks where K = sqrt(E' G), and its couple does the work G A, on three meshes.",
                     "Tada, Paris & Irwin (1985); Planas & Elices (1992)",
                     "1 %: F within 0.5 %, first order in l_ch/b; 1e-3: trapezoids of the couple", notched_column});
    cases.push_back({"fe2d.bond.plate", "A glued plate is pulled off at c l sin(L/l), long ones at sqrt(2 E t G).",
                     "Volkersen (1938), linear softening", "2 %: 40 cells, damage in steps of 1 %", sheared_plate});
    cases.push_back(
        {"fe2d.bond.block",
         "A block pushed off its bond: s = (P-R-cA) w/(cA) (cosh Omega t - 1), after a spring over the first 1e-3 w.",
         "closed form of both parts",
         "1e-8: time by two steps extrapolated (order 2), rate by a step that crosses each kink of the bond's force "
         "once; "
         "0.05: the kink lies elsewhere in each step",
         pushed_block});
    cases.push_back(
        {"fe2d.bond.limit",
         "No plane carries more than all its strength at once; a bond that cannot break carries that.",
         "Radenkovic (1961)",
         "1e-4: the first damage, 1e-5, costs as much of the strength; 1e-6: what the tough bond gives way by",
         limit_loads});
    cases.push_back(
        {"fe2d.bond.dam", "The load that a bonded dam carries and its slip in an earthquake do not depend on the mesh.",
         "the same on finer meshes; Radenkovic (1961)",
         "3 and 5 %: h/4 is not the limit either; no more than all strength at once", bonded_dam_over_mesh});
    cases.push_back(
        {"fe2d.bond.release", "A dam whose bond is gone comes to rest where friction holds it, and only there.",
         "equilibrium of the base", "1e-3: what it still swings when it has not slid for five periods", released_dam});
}

} // namespace damslip::verification
