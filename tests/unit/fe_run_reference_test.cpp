// The condensed run against two slower ways to the same equations: nothing condensed, rock and dam in one system.
#include "verification/cases/fe_run_scenes.hpp"

#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/time/linear_integrator.hpp"

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double force_unit = 1e10; ///< of λ in the monolithic matrix: entries of like size

/// All unknowns of dam and rock, contact by multipliers.
struct Whole {
    const Model& model;
    LinearSystem system;
    SparseMatrix interface; ///< B: gaps on the plane (normal, then tangential) of all unknowns
    Index pairs;

    Whole(const Model& m, const Plane& plane, const RunDamping& damping) : model(m), pairs(plane.pairs())
    {
        const ContactPlane& contact = m.mesh.contact;
        std::vector<Eigen::Triplet<double>> entries;
        for (Index i = 0; i < pairs; ++i)
            for (const int c : {0, 1}) {
                const auto k = static_cast<std::size_t>(i);
                const int dam = m.dofs(contact.dam_nodes[k], c), rock = m.dofs(contact.rock_nodes[k], c);
                entries.emplace_back(i, dam, plane.normal[c]);
                entries.emplace_back(i, rock, -plane.normal[c]);
                entries.emplace_back(pairs + i, dam, plane.tangent[c]);
                entries.emplace_back(pairs + i, rock, -plane.tangent[c]);
            }
        interface.resize(2 * pairs, m.dofs.count);
        interface.setFromTriplets(entries.begin(), entries.end());
        system.mass = m.moving_mass();
        system.stiffness = m.stiffness;
        system.damping = damping.constants.mass * m.mass + damping.constants.stiffness * system.stiffness;
        if (damping.mass != MassDamping::deformation_only) return;
        VectorXd translation = VectorXd::Zero(m.dofs.count);
        for (int node = 0; node < m.mesh.dam_node_count; ++node)
            for (const int c : {0, 1}) translation[m.dofs(node, c)] = plane.tangent[c];
        const VectorXd weights = interface.bottomRows(pairs).transpose() * plane.weights();
        system.damping_low_rank = deformation_only_correction(damping.constants.mass, m.mass, translation, weights);
    }
};

/// One set of states solved with everything in one sparse matrix, states by the plainest rules.
class Monolithic {
public:
    Monolithic(const Whole& whole, const StepConstants& c) : whole_(whole), weight_(1.0 + c.scheme.alpha)
    {
        step_matrix_ = c.a0 * whole.system.mass + weight_ * c.a1 * whole.system.damping;
        step_matrix_ += weight_ * whole.system.stiffness;
    }

    /// @returns Δu; λ and states are updated
    VectorXd solve(const VectorXd& free, const VectorXd& opening, double friction, ContactStates& states,
                   VectorXd& lambda)
    {
        const Index m = whole_.pairs;
        VectorXd held = VectorXd::Zero(2 * m);
        held.head(m) = -opening;
        for (int iteration = 0; iteration < 30; ++iteration) {
            const VectorXd step = with_states(step_matrix_ * free, held, friction, states, lambda);
            if (!update(states, lambda, whole_.interface * step, opening, friction)) return step;
        }
        ADD_FAILURE() << "the reference did not settle";
        return free;
    }

    /// Velocities that impulses on the held gaps take away: the gaps' rates become zero there.
    /// @param rate  of all gaps
    VectorXd landing(const VectorXd& rate, double friction, const ContactStates& states)
    {
        VectorXd impulse;
        return with_states(VectorXd::Zero(step_matrix_.rows()), -rate, friction, states, impulse);
    }

    int factorisations = 0;

private:
    /// A x - w Bᵀλ = right, B x = `held` on held gaps, λ of the law on the others; all in one matrix.
    VectorXd with_states(const VectorXd& right, const VectorXd& held, double friction, const ContactStates& states,
                         VectorXd& lambda)
    {
        const Index n = right.size(), m = whole_.pairs;
        std::vector<Eigen::Triplet<double>> entries;
        const auto add = [&](const SparseMatrix& a, Index row, Index column, double factor) {
            for (Index j = 0; j < a.outerSize(); ++j)
                for (SparseMatrix::InnerIterator it(a, j); it; ++it)
                    entries.emplace_back(row + it.row(), column + it.col(), factor * it.value());
        };
        add(step_matrix_, 0, 0, 1.0);
        add(SparseMatrix(whole_.interface.transpose()), 0, n, -weight_ * force_unit);
        VectorXd all_right(n + 2 * m);
        all_right << right, VectorXd::Zero(2 * m);
        const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = whole_.interface;
        const auto hold = [&](Index k) {
            for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, k); it; ++it)
                entries.emplace_back(n + k, it.col(), force_unit * it.value());
            all_right[n + k] = force_unit * held[k];
        };
        for (Index i = 0; i < m; ++i) {
            const ContactState state = states[static_cast<std::size_t>(i)];
            if (state == ContactState::open)
                entries.emplace_back(n + i, n + i, force_unit);
            else
                hold(i);
            if (state == ContactState::stick) {
                hold(m + i);
                continue;
            }
            entries.emplace_back(n + m + i, n + m + i, force_unit);
            if (is_slip(state))
                entries.emplace_back(n + m + i, n + i,
                                     force_unit * (state == ContactState::slip_downstream ? friction : -friction));
        }
        SparseMatrix all(n + 2 * m, n + 2 * m);
        all.setFromTriplets(entries.begin(), entries.end());
        Eigen::SparseLU<SparseMatrix> lu(all);
        VectorXd x = lu.solve(all_right);
        x += lu.solve(all_right - all * x);
        ++factorisations;
        lambda = force_unit * x.tail(2 * m);
        return x.head(n);
    }

    bool update(ContactStates& states, const VectorXd& lambda, const VectorXd& gap, const VectorXd& opening,
                double friction) const
    {
        const Index m = whole_.pairs;
        const double force_slack = 1e-9 * lambda.cwiseAbs().maxCoeff(), length_slack = 1e-15;
        bool changed = false;
        for (Index i = 0; i < m; ++i) {
            ContactState& state = states[static_cast<std::size_t>(i)];
            const ContactState old = state;
            const double slip = gap[m + i], shear = lambda[m + i];
            const auto slipping = [](bool down) {
                return down ? ContactState::slip_downstream : ContactState::slip_upstream;
            };
            if (old == ContactState::open) {
                const double depth = -(opening[i] + gap[i]);
                if (depth > length_slack)
                    state = std::abs(slip) > friction * depth ? slipping(slip > 0.0) : ContactState::stick;
            } else if (lambda[i] < -force_slack) {
                state = ContactState::open;
            } else if (old == ContactState::stick) {
                if (std::abs(shear) > friction * lambda[i] + force_slack) state = slipping(shear < 0.0);
            } else if ((old == ContactState::slip_downstream ? -slip : slip) > length_slack) {
                state = ContactState::stick;
            }
            changed |= state != old;
        }
        return changed;
    }

    const Whole& whole_;
    double weight_;
    SparseMatrix step_matrix_;
};

/// Does some gap come to be held: shut, or stuck?
bool newly_holds(const ContactStates& before, const ContactStates& now)
{
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i] == ContactState::open && now[i] != ContactState::open) return true;
        if (before[i] != ContactState::stick && now[i] == ContactState::stick) return true;
    }
    return false;
}

/// A coarse dam on a small piece of rock, ready to be run both ways.
struct Setting {
    Scene scene;
    std::unique_ptr<Model> model;
    std::unique_ptr<ContactStructure> structure;
    RunDamping damping;
    SplitLoad load;
    VectorXd whole_load;
    ContactMemory memory;
    StaticState start;

    explicit Setting(MassDamping mass) : scene(fe2d::test::sliding_dam(0.68, 1.0, 6.0)), memory(0)
    {
        scene.mesh.size = 9.0;
        scene.foundation->width = 150.0;
        scene.foundation->depth = 60.0;
        const RunOptions options = fe2d::test::options_of(scene);
        ModelOptions model_options;
        model_options.base = Base::separate;
        model_options.added_mass = options.added_mass;
        model = std::make_unique<Model>(build_model(scene, model_options));
        structure = std::make_unique<ContactStructure>(*model);
        damping = {{1.9, 0.0006}, mass};
        const LoadStages stages = load_stages(scene, *model, options.uplift);
        whole_load = stages.last();
        load = structure->split(whole_load);
        StaticContact statics(*structure);
        Strength strength(scene.contact, structure->plane());
        memory = ContactMemory(structure->plane().pairs());
        for (std::size_t k = 0; k < stages.loads.size(); ++k)
            EXPECT_EQ(
                solve_stage(statics, *structure, stages.names[k], structure->split(stages.loads[k]), strength, memory)
                    .status,
                StageStatus::ok);
        start = statics.displacements(load, memory);
    }
};

/// 500 steps of strong shaking by the condensed run and by `solve(free increment, opening, states, λ) -> Δu`; compares
/// slips, openings and forces after each step and the energies at the end.
/// @param land  what impulses at the end of a step change of the velocities, (rates of the gaps, states) -> δv; null:
/// none, nor in the condensed run. The ledger of this side knows no impulses, so energies are compared without them.
template <class Solve>
void compare(const Setting& s, const Whole& whole, LinearIntegrator& integrator, const StepOperator& op, Solve solve,
             const std::function<VectorXd(const VectorXd&, const ContactStates&)>& land = {})
{
    const double dt = 0.01;
    ContactOptions options;
    options.landing = land ? Landing::at_rest : Landing::ringing;
    DynamicContact fast(*s.structure, s.damping, integrator.scheme(), s.load, s.start, s.memory, {}, options);
    const ContactLaw law = uniform_law(whole.pairs, s.scene.contact.friction);
    const VectorXd u0 = s.structure->assemble(s.start.dam, s.start.rock, s.whole_load);
    VectorXd lambda = s.memory.force, opening = s.memory.opening, slip = s.memory.slip;
    ContactStates states = s.memory.states;
    State before = integrator.start(u0, VectorXd::Zero(u0.size()), s.whole_load, whole.interface.transpose() * lambda);
    State after;
    EnergyLedger ledger(before);
    const GroundMotion motion = fe2d::test::sines(3.0, 6.0);
    const double force_scale = s.memory.force.cwiseAbs().maxCoeff();
    double worst_slip = 0.0, worst_force = 0.0;
    int sliding = 0, open = 0, landings = 0;
    for (std::size_t k = 1; k <= 500; ++k) {
        const GroundAcceleration ground{motion.accel_h[k], motion.accel_v[k]};
        fast.advance(dt, ground, law);
        const VectorXd load = s.whole_load + ground.h * s.model->inertia_x - ground.v * s.model->inertia_y;
        const FreeStep free = integrator.free_step(op, before, load);
        const VectorXd lambda_before = lambda;
        const ContactStates states_before = states;
        const VectorXd step = solve(free.increment, opening, states, lambda);
        const double weight = 1.0 + integrator.scheme().alpha;
        integrator.finish_step(op, before, load, free,
                               {whole.interface.transpose() * lambda, (step - free.increment) / weight}, after);
        const VectorXd gap = whole.interface * step;
        const VectorXd mean = 0.5 * (lambda + lambda_before);
        ledger.add_step(before, after, op.constants(),
                        {.friction = -mean.tail(whole.pairs).dot(gap.tail(whole.pairs)),
                         .normal = mean.head(whole.pairs).dot(gap.head(whole.pairs))});
        opening += gap.head(whole.pairs);
        slip += gap.tail(whole.pairs);
        if (land && newly_holds(states_before, states)) {
            const VectorXd change = land(whole.interface * after.velocity, states);
            after.velocity += change;
            after.momentum = whole.system.mass * after.velocity;
            after.damping_force = whole.system.damping * after.velocity;
            ++landings;
        }
        std::swap(before, after);
        const ContactMemory& c = fast.state().contact;
        worst_slip =
            std::max({worst_slip, (c.slip - slip).cwiseAbs().maxCoeff(), (c.opening - opening).cwiseAbs().maxCoeff()});
        worst_force = std::max(worst_force, (c.force - lambda).cwiseAbs().maxCoeff());
        sliding += std::all_of(c.states.begin(), c.states.end(),
                               [](ContactState state) { return is_slip(state) || state == ContactState::open; });
        open += std::any_of(c.states.begin(), c.states.end(),
                            [](ContactState state) { return state == ContactState::open; });
    }
    const double total = s.structure->plane().weights().dot(slip - s.memory.slip);
    EXPECT_GT(total, 0.1);   // it did slide,
    EXPECT_GT(sliding, 100); // as a whole,
    EXPECT_GT(open, 100);    // and the heel opened
    EXPECT_LT(worst_slip, 1e-9 * total);
    EXPECT_LT(worst_force, 1e-9 * force_scale);
    EXPECT_LT((s.structure->assemble(fast.state().u, fast.state().rock, s.whole_load) - before.displacement)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9 * total);
    EXPECT_EQ(fast.counts().landings, landings);
    if (land) {
        EXPECT_GT(landings, 50);
        EXPECT_LT(std::abs(fast.energy_imbalance()), 1e-10 * fast.energy_scale());
        return;
    }
    const Energy &a = fast.energy(), &b = ledger.energy();
    const double scale = ledger.largest_scale();
    EXPECT_NEAR(a.kinetic, b.kinetic, 1e-9 * scale);
    EXPECT_NEAR(a.damping, b.damping, 1e-9 * scale);
    EXPECT_NEAR(a.numerical, b.numerical, 1e-9 * scale);
    EXPECT_NEAR(a.friction, b.friction, 1e-9 * scale);
    EXPECT_NEAR(a.external, b.external, 1e-9 * scale);
    EXPECT_NEAR(a.contact_normal, b.contact_normal, 1e-9 * scale);
    EXPECT_LT(std::abs(fast.energy_imbalance()), 1e-10 * scale);
}

// Nothing condensed, one sparse factorisation for every set of states: an independent path to the same step. The
// systems have condition 1e6 and 500 steps add up their round-off: 1e-9.
TEST(FeRunReference, monolithic_solution_over_500_sliding_steps)
{
    const Setting s(MassDamping::relative);
    const Whole whole(*s.model, s.structure->plane(), s.damping);
    LinearIntegrator integrator(whole.system, hht(-0.05));
    const StepOperator& op = integrator.step_operator(0.01);
    Monolithic reference(whole, op.constants());
    compare(s, whole, integrator, op,
            [&](const VectorXd& free, const VectorXd& opening, ContactStates& states, VectorXd& lambda) {
                return reference.solve(free, opening, s.scene.contact.friction, states, lambda);
            });
}

// The same with contact impulses where gaps come to be held, as runs have them.
TEST(FeRunReference, monolithic_solution_with_landings)
{
    const Setting s(MassDamping::relative);
    const Whole whole(*s.model, s.structure->plane(), s.damping);
    LinearIntegrator integrator(whole.system, hht(-0.05));
    const StepOperator& op = integrator.step_operator(0.01);
    Monolithic reference(whole, op.constants());
    const double friction = s.scene.contact.friction;
    compare(
        s, whole, integrator, op,
        [&](const VectorXd& free, const VectorXd& opening, ContactStates& states, VectorXd& lambda) {
            return reference.solve(free, opening, friction, states, lambda);
        },
        [&](const VectorXd& rate, const ContactStates& states) { return reference.landing(rate, friction, states); });
}

// Damping of the deformation only, by the general low-rank formula on all unknowns; contact with V = W⁻¹ of the whole.
TEST(FeRunReference, deformation_only_damping_by_the_general_formula)
{
    const Setting s(MassDamping::deformation_only);
    const Whole whole(*s.model, s.structure->plane(), s.damping);
    LinearIntegrator integrator(whole.system, hht(-0.05));
    const StepOperator& op = integrator.step_operator(0.01);
    const InterfaceFlexibility flexibility = op.flexibility(whole.interface);
    Eigen::MatrixXd stiffness = flexibility.delassus.inverse();
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    ContactSolver solver(stiffness);
    const ContactLaw law = uniform_law(whole.pairs, s.scene.contact.friction);
    compare(s, whole, integrator, op,
            [&](const VectorXd& free, const VectorXd& opening, ContactStates& states, VectorXd& lambda) -> VectorXd {
                VectorXd gap = whole.interface * free;
                gap.head(whole.pairs) += opening;
                ContactSolution solution{states, {}, {}};
                EXPECT_TRUE(solver.solve(-stiffness * gap, law, solution).resolved());
                states = solution.states;
                lambda = solution.force;
                return free + (1.0 + integrator.scheme().alpha) * (flexibility.response * lambda);
            });
}

} // namespace
