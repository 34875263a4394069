#include "verification/cases/modules.hpp"

#include "fe2d/run/explicit_contact.hpp"
#include "fe2d/run/ground_input.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/small_dam.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Worst violation of the law by solve_pair() over many pairs, in the units of their impulses.
std::vector<Check> pair_law()
{
    std::mt19937 random(7);
    const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0; };
    double worst = 0.0;
    int states[5] = {0, 0, 0, 0, 0};
    for (int k = 0; k < 20000; ++k) {
        // Coupled without cohesion, or cohesive without coupling: a cohesive shear that lifts its own pair has no solution.
        const bool coupled = k % 2 == 0;
        const fe2d::ExplicitPair w{1.0 + 0.5 * uniform(), coupled ? 0.3 * uniform() : 0.0, 1.0 + 0.5 * uniform()};
        const double fn = uniform(), ft = uniform(), target = 0.2 * (uniform() - 1.0), mu = 0.6 + 0.5 * uniform(),
                     c = coupled ? 0.0 : std::max(0.0, 0.2 * uniform());
        const fe2d::ExplicitImpulse p = fe2d::solve_pair(w, fn, ft, target, mu, c, JointOpening::allowed);
        const double vn = fn + w.nn * p.normal + w.nt * p.tangential - target;
        const double vt = ft + w.nt * p.normal + w.tt * p.tangential;
        ++states[static_cast<int>(p.state)];
        worst = std::max({worst, -p.normal, -vn, std::abs(p.normal * vn)});
        if (p.state == fe2d::ContactState::open) {
            worst = std::max(worst, std::abs(p.tangential));
            continue;
        }
        const double strength = c + mu * p.normal;
        worst = std::max(worst, std::abs(p.tangential) - strength);
        if (p.state == fe2d::ContactState::stick)
            worst = std::max(worst, std::abs(vt));
        else // slips against the full strength
            worst = std::max({worst, std::abs(std::abs(p.tangential) - strength), p.tangential * vt});
    }
    std::vector<Check> checks{{"largest violation of unilateral contact and Coulomb's law, 20 000 pairs",
                               "of the impulse", 1e-13, worst, 0.0, Measure::upper_bound}};
    for (const auto& [state, name] : {std::pair{fe2d::ContactState::stick, "stick"},
                                      {fe2d::ContactState::slip_downstream, "slip downstream"},
                                      {fe2d::ContactState::slip_upstream, "slip upstream"},
                                      {fe2d::ContactState::open, "are open"}})
        checks.push_back({fmt::format("pairs that {}", name), "-", 500.0,
                          static_cast<double>(states[static_cast<int>(state)]), 0.0, Measure::lower_bound});
    return checks;
}

/// The small dam of the Moreau cases on a rigid base, its mass lumped for both schemes.
struct LumpedDam {
    explicit LumpedDam(double stiffness_damping) : scene(small_dam_scene(SmallDamBase::rigid))
    {
        fe2d::ModelOptions options;
        options.base = fe2d::Base::separate;
        options.mass = fe2d::MassKind::lumped;
        model = fe2d::build_model(scene, options);
        structure.emplace(model);
        damping.constants = {0.8, stiffness_damping};
        load = structure->split(fe2d::load_stages(scene, model, {}).last());
        fe2d::StaticContact statics(*structure);
        memory = fe2d::ContactMemory(structure->pairs());
        statics.solve(load, law(), memory);
        start = statics.displacements(load, memory);
    }
    fe2d::ContactLaw law() const { return fe2d::uniform_law(structure->pairs(), scene.contact.friction); }
    double mean(const VectorXd& slip) const { return structure->planes().mean(0, slip - memory.slip); }

    Scene scene;
    fe2d::Model model;
    std::optional<fe2d::ContactStructure> structure;
    fe2d::RunDamping damping;
    fe2d::SplitLoad load;
    fe2d::ContactMemory memory;
    fe2d::StaticState start;
};

constexpr double lumped_dt = 0.01; ///< [s]

struct SlipRun {
    std::vector<double> slip;            ///< at the record's steps [m]
    double imbalance = 0.0;              ///< of the largest energy
    double friction = 0.0, normal = 0.0; ///< energies at the end [J/m]
};

SlipRun explicit_slips(const LumpedDam& dam, const GroundMotion& motion, int parts)
{
    const fe2d::GroundInput ground(motion, MassDamping::relative, 0.0);
    auto operators = std::make_shared<const fe2d::ExplicitOperators>(*dam.structure, dam.damping);
    fe2d::ExplicitContact run(operators, dam.load, dam.start, dam.memory);
    SlipRun result;
    std::vector<fe2d::GroundAcceleration> ahead(static_cast<std::size_t>(parts));
    double imbalance = 0.0;
    for (std::size_t n = 0; n + 1 < motion.accel_h.size(); ++n) {
        for (int k = 0; k < parts; ++k)
            ahead[static_cast<std::size_t>(k)] = ground.at(lumped_dt * (static_cast<double>(n) + (k + 1.0) / parts));
        run.advance(lumped_dt / parts, ahead, dam.law());
        result.slip.push_back(dam.mean(run.state().contact.slip));
        imbalance = std::max(imbalance, std::abs(run.energy_imbalance()));
    }
    result.imbalance = imbalance / run.energy_scale();
    result.friction = run.energy().friction;
    result.normal = run.energy().contact_normal;
    return result;
}

SlipRun implicit_slips(const LumpedDam& dam, const GroundMotion& motion, int parts)
{
    const fe2d::GroundInput ground(motion, MassDamping::relative, 0.0);
    fe2d::DynamicContact run(*dam.structure, dam.damping, fe2d::hht(-0.3), dam.load, dam.start, dam.memory);
    SlipRun result;
    for (std::size_t n = 0; n + 1 < motion.accel_h.size(); ++n) {
        for (int k = 1; k <= parts; ++k)
            run.advance(lumped_dt / parts,
                        ground.at(lumped_dt * (static_cast<double>(n) + static_cast<double>(k) / parts)), dam.law());
        result.slip.push_back(dam.mean(run.state().contact.slip));
    }
    return result;
}

double apart_by(const SlipRun& a, const SlipRun& b)
{
    double largest = 0.0;
    for (std::size_t k = 0; k < a.slip.size(); ++k) largest = std::max(largest, std::abs(a.slip[k] - b.slip[k]));
    return largest;
}

std::vector<Check> explicit_against_implicit()
{
    std::vector<Check> checks;
    for (const double b_k : {1e-3, 4e-3, 8e-3}) {
        const LumpedDam dam(b_k);
        const GroundMotion motion = fe2d::test::sines(4.0, 4.0, 5, lumped_dt);
        const fe2d::ExplicitOperators operators(*dam.structure, dam.damping);
        int parts = 1;
        while (lumped_dt / parts > 0.9 * operators.limit()) parts *= 2;
        const std::string name = fmt::format("b_K = {:g} s: ", b_k);
        const SlipRun runs[4] = {explicit_slips(dam, motion, parts), explicit_slips(dam, motion, 2 * parts),
                                 explicit_slips(dam, motion, 4 * parts), explicit_slips(dam, motion, 8 * parts)};
        const double slip = std::abs(runs[3].slip.back());
        const SlipRun fine = implicit_slips(dam, motion, 128), finer = implicit_slips(dam, motion, 256);
        checks.push_back({name + "the dam slides", "m", 1e-3, slip, 0.0, Measure::lower_bound});
        // Errors left at dt are at most twice what the last halving changed, for orders above 0.58. Nodes with mass that
        // strike a rigid base rebound by a law of the scheme, not of the equations: what that is worth grows with what
        // impacts take (1.3 % of the friction's energy at the weakest damping, 1e-4 of it at the strongest).
        const double impacts = std::abs(runs[3].normal) / std::abs(runs[3].friction) * slip;
        checks.push_back({name + fmt::format("slip history from that of implicit steps, of {:.3g} mm", 1e3 * slip), "m",
                          2.0 * (apart_by(runs[3], runs[2]) + apart_by(finer, fine) + impacts),
                          apart_by(runs[3], finer), 0.0, Measure::upper_bound});
        if (b_k > 2e-3)
            checks.push_back({name + "the same", "of the slip", b_k > 6e-3 ? 0.001 : 0.005,
                              apart_by(runs[3], finer) / slip, 0.0, Measure::upper_bound});
        checks.push_back({name + "order in dt, limit/1 to limit/8", "-", 0.8,
                          0.5 * std::log2(apart_by(runs[0], runs[1]) / apart_by(runs[2], runs[3])), 0.0,
                          Measure::lower_bound});
        checks.push_back({name + "energy imbalance over the largest energy", "-", 1e-11, runs[0].imbalance, 0.0,
                          Measure::upper_bound});
        checks.push_back({name + "friction dissipates", "J/m", 0.0, runs[0].friction, 0.0, Measure::lower_bound});
    }
    return checks;
}

} // namespace

void add_fe_explicit_contact_cases(Registry& registry)
{
    registry.push_back(
        {"fe.contact.explicit-pair", "Impulse and rates of one pair obey unilateral contact and Coulomb's law",
         "The inequalities themselves, on random pairs coupled in both directions", "Round-off", pair_law});
    registry.push_back(
        {"fe.contact.explicit-rigid-base",
         "Slip of a small dam on a rigid base by explicit forward increments and by implicit steps goes to one limit",
         "Carpenter, Taylor & Katona (1991) with closed pairs against DynamicContact, HHT; same lumped mass",
         "what is left at dt is at most twice what the last halving changed, in both schemes; what impacts on the "
         "rigid base are worth is the scheme's, at most twice their share of the friction's energy; round-off of the ledger",
         explicit_against_implicit});
}

} // namespace damslip::verification
