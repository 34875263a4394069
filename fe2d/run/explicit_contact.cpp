#include "fe2d/run/explicit_contact.hpp"

#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/central_difference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int steps_between_products = 256; ///< of K u

} // namespace

ExplicitContact::ExplicitContact(std::shared_ptr<const ExplicitOperators> operators, SplitLoad load,
                                 const StaticState& start, const ContactMemory& memory)
    : operators_(std::move(operators)), load_(std::move(load)),
      largest_slips_(operators_->structure().planes(), memory.slip)
{
    const Index n = operators_->structure().dam_unknowns(), m = operators_->structure().pairs();
    state_.u = start.dam;
    state_.v = state_.a = VectorXd::Zero(n);
    state_.contact = memory;
    normal_force_ = memory.force.head(operators_->structure().plane().pairs()).sum();
    VectorXd deformation;
    operators_->structure().take_off_translations(state_.u, deformation);
    product_ = operators_->stiffness * deformation;
    rate_product_ = VectorXd::Zero(n);
    impulse_ = impulses_ = VectorXd::Zero(2 * m);
    energy_.strain = energy_start_.strain = 0.5 * deformation.dot(product_);
    counts_.factorisations = 0;
}

void ExplicitContact::advance(double dt, std::span<const GroundAcceleration> ground, const ContactLaw& law)
{
    impulses_.setZero();
    for (const GroundAcceleration& g : ground) step(dt, g, law);
    state_.contact.force = impulses_ / (dt * static_cast<double>(ground.size()));
}

void ExplicitContact::step(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    const ExplicitOperators& op = *operators_;
    const ContactStructure& structure = op.structure();
    const GroundAcceleration& g = state_.ground;
    loads_ = load_.dam + g.h * structure.inertia_x() - g.v * structure.inertia_y();
    if (g.drag_h != 0.0 || g.drag_v != 0.0)
        loads_ += g.drag_h * structure.dam_inertia_x() - g.drag_v * structure.dam_inertia_y();
    damping_force_.setZero(loads_.size());
    op.add_damping(state_.v, rate_product_, damping_force_);

    const VectorXd v_before = state_.v;
    state_.a.noalias() = op.inverse * (loads_ - product_ - damping_force_); // without contact, for the moment
    state_.v += dt * state_.a;
    contact(dt, law);
    state_.v.noalias() += op.pull * impulse_;
    state_.a = (state_.v - v_before) / dt;
    state_.u += dt * state_.v;
    add_energy(dt, v_before);

    rate_product_.noalias() = op.stiffness.transpose() * state_.v;
    if (++since_product_ == steps_between_products) {
        since_product_ = 0;
        VectorXd deformation;
        structure.take_off_translations(state_.u, deformation);
        product_.noalias() = op.stiffness.transpose() * deformation;
    } else {
        product_ += dt * rate_product_;
    }
    impulses_ += impulse_;
    state_.time += dt;
    state_.ground = ground;
    ++counts_.steps;
    largest_slips_.look(state_.contact.slip);
}

/// Impulses from the rates without them, and what becomes of the gaps.
void ExplicitContact::contact(double dt, const ContactLaw& law)
{
    const ExplicitOperators& op = *operators_;
    ContactMemory& memory = state_.contact;
    const Index m = op.structure().pairs();
    const VectorXd rates = op.gaps * state_.v;
    bool landed = false;
    for (Index i = 0; i < m; ++i) {
        const ExplicitPair& pair = op.pairs[static_cast<std::size_t>(i)];
        ContactState& state = memory.states[static_cast<std::size_t>(i)];
        const ExplicitImpulse p = solve_pair(pair, rates[i], rates[m + i], -memory.opening[i] / dt, law.friction[i],
                                             law.cohesion[i] * dt, law.separation);
        impulse_[i] = p.normal;
        impulse_[m + i] = p.tangential;
        landed = landed || (state == ContactState::open && p.state != ContactState::open);
        state = p.state;
        if (p.state == ContactState::open)
            memory.opening[i] += dt * rates[i];
        else
            memory.opening[i] = 0.0;
        if (p.state != ContactState::stick)
            memory.slip[i] += dt * (rates[m + i] + pair.nt * p.normal + pair.tt * p.tangential);
    }
    counts_.landings += landed;
}

/// Before K u goes on: product_ is K u_n, state_.u is u_{n+1}.
void ExplicitContact::add_energy(double dt, const VectorXd& v_before)
{
    const ExplicitOperators& op = *operators_;
    const Index m = op.structure().pairs();
    const VectorXd mean = 0.5 * (state_.v + v_before), rates = op.gaps * mean;
    energy_.kinetic = 0.5 * state_.v.dot(op.mass * state_.v);
    VectorXd deformation;
    op.structure().take_off_translations(state_.u, deformation);
    energy_.strain = 0.5 * deformation.dot(product_);
    energy_.external += dt * mean.dot(loads_);
    energy_.damping += dt * mean.dot(damping_force_);
    energy_.contact_normal += impulse_.head(m).dot(rates.head(m));
    energy_.friction -= impulse_.tail(m).dot(rates.tail(m));
    energy_scale_ = std::max({energy_scale_, energy_.kinetic, std::abs(energy_.damping), std::abs(energy_.friction),
                              std::abs(energy_.external), std::abs(energy_.contact_normal)});
}

std::size_t ExplicitContact::bytes() const
{
    const auto entries =
        operators_->stiffness.nonZeros() + operators_->mass.nonZeros() + operators_->inverse.nonZeros();
    return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(int)) +
           10 * static_cast<std::size_t>(state_.u.size()) * sizeof(double);
}

/// There is one solution for mu |nt| < nn; only a cohesive shear may lift its own pair where W couples the directions, and then acts
/// with P_n = 0.
ExplicitImpulse solve_pair(const ExplicitPair& w, double free_normal, double free_tangential, double target,
                           double friction, double cohesion, JointOpening separation)
{
    if (separation == JointOpening::allowed && free_normal >= target) return {};
    const double normal = target - free_normal, tangential = -free_tangential;
    const double det = w.nn * w.tt - w.nt * w.nt;
    ExplicitImpulse p;
    p.normal = (w.tt * normal - w.nt * tangential) / det;
    p.tangential = (w.nn * tangential - w.nt * normal) / det;
    if (separation == JointOpening::none && p.normal < 0.0) return {normal / w.nn, 0.0, ContactState::pulled};
    const double strength = cohesion + friction * std::max(p.normal, 0.0);
    p.state = ContactState::stick;
    if (p.normal >= 0.0 && std::abs(p.tangential) <= strength) return p;
    // P_t = -s (c + mu P_n) against a slip of sign s: first the one that sticking would have had to stop, which is right unless W
    // couples the directions strongly.
    const double first = p.tangential < 0.0 ? 1.0 : -1.0;
    for (const double sign : {first, -first}) {
        p.normal = std::max(0.0, (normal + sign * w.nt * cohesion) / (w.nn - sign * friction * w.nt));
        p.tangential = -sign * (cohesion + friction * p.normal);
        p.state = sign > 0.0 ? ContactState::slip_downstream : ContactState::slip_upstream;
        if (sign * (free_tangential + w.nt * p.normal + w.tt * p.tangential) >= 0.0) break;
    }
    return p;
}

namespace {

/// M of one node: (x, y) with a coupling.
Eigen::Matrix2d block_of(const VectorXd& inertia_x, const VectorXd& inertia_y, Index node)
{
    const double coupling = 0.5 * (inertia_y[2 * node] + inertia_x[2 * node + 1]);
    Eigen::Matrix2d block;
    block << inertia_x[2 * node], coupling, coupling, inertia_y[2 * node + 1];
    return block;
}

} // namespace

void ExplicitOperators::make_mass()
{
    const VectorXd &x = structure_.inertia_x(), &y = structure_.inertia_y();
    std::vector<Eigen::Triplet<double>> entries, inverse_entries;
    for (Index node = 0; node < structure_.order().nodes(); ++node) {
        const Eigen::Matrix2d block = block_of(x, y, node), inverted = block.inverse();
        for (Index i = 0; i < 2; ++i)
            for (Index j = 0; j < 2; ++j)
                if (i == j || block(i, j) != 0.0) {
                    entries.emplace_back(2 * node + i, 2 * node + j, block(i, j));
                    inverse_entries.emplace_back(2 * node + i, 2 * node + j, inverted(i, j));
                }
    }
    mass.resize(x.size(), x.size());
    inverse.resize(x.size(), x.size());
    mass.setFromTriplets(entries.begin(), entries.end());
    inverse.setFromTriplets(inverse_entries.begin(), inverse_entries.end());
    damped_ = VectorXd::Zero(x.size());
    for (Index k = 0; k < x.size(); ++k)
        damped_[k] =
            damping_.constants.mass * (k % 2 == 0 ? structure_.dam_inertia_x()[k] : structure_.dam_inertia_y()[k]);
}

void ExplicitOperators::make_pairs()
{
    const Index m = structure_.pairs();
    gaps = structure_.gaps();
    pull = inverse * SparseMatrix(gaps.transpose());
    const SparseMatrix delassus = gaps * pull;
    pairs.assign(static_cast<std::size_t>(m), {});
    const double scale = delassus.diagonal().maxCoeff();
    for (Index column = 0; column < 2 * m; ++column)
        for (SparseMatrix::InnerIterator it(delassus, column); it; ++it) {
            ExplicitPair& pair = pairs[static_cast<std::size_t>(column % m)];
            if (it.row() == column)
                (column < m ? pair.nn : pair.tt) = it.value();
            else if (it.row() % m == column % m)
                pair.nt = it.value();
            else if (std::abs(it.value()) > 1e-12 * scale)
                separable_ = false;
        }
}

ExplicitOperators::ExplicitOperators(const ContactStructure& structure, const RunDamping& damping)
    : stiffness(structure.stiffness()), structure_(structure), damping_(damping), slip_damping_(structure, damping)
{
    make_mass();
    make_pairs();
    LinearSystem system;
    system.mass = mass;
    system.stiffness = stiffness;
    highest_frequency_ = fe2d::highest_frequency(system);
    double norm = 1.0;
    if (slip_damping_.active()) { // |r|_M² = κ_kk / a_M; |w|² in the inverse: ωᵀ W_tt ω
        const Index m = structure.pairs();
        for (Index k = 0; k < slip_damping_.drag.cols(); ++k) {
            double inverse_norm = 0.0;
            for (Index i = 0; i < m; ++i)
                inverse_norm +=
                    slip_damping_.weights(i, k) * slip_damping_.weights(i, k) * pairs[static_cast<std::size_t>(i)].tt;
            norm += std::sqrt(slip_damping_.drag(k, k) / damping.constants.mass * inverse_norm);
        }
    }
    damping_bound_ =
        damping.constants.stiffness * highest_frequency_ * highest_frequency_ + damping.constants.mass * norm * norm;
}

double ExplicitOperators::limit() const
{
    return 4.0 / (damping_bound_ +
                  std::sqrt(damping_bound_ * damping_bound_ + 4.0 * highest_frequency_ * highest_frequency_));
}

/// C v = a_M M_dam v - P ωᵀ D_t v - D_tᵀ ω (Pᵀ v - κ ωᵀ D_t v) + b_K K v.
void ExplicitOperators::add_damping(const VectorXd& v, const VectorXd& stiffness_product, VectorXd& force) const
{
    force += damped_.cwiseProduct(v) + damping_.constants.stiffness * stiffness_product;
    if (!slip_damping_.active()) return;
    const Index m = structure_.pairs();
    const VectorXd slip = slip_damping_.weights.transpose() * VectorXd(gaps * v).tail(m);
    const VectorXd mean = slip_damping_.momentum.transpose() * v;
    force -= slip_damping_.momentum * slip;
    VectorXd on_pairs = VectorXd::Zero(2 * m);
    on_pairs.tail(m) = slip_damping_.weights * (mean - slip_damping_.drag * slip);
    force -= gaps.transpose() * on_pairs;
}

/// The passes of an earthquake run by explicit steps (ExplicitContact).

namespace {

/// The work ledger is an identity and closes in an unstable run, too; there ½u_{n+1}ᵀKu_n goes below zero and the kinetic energy
/// beyond all that was put in.
bool has_diverged(const ContactMotion& dynamics, double start_strain)
{
    const Energy& e = dynamics.energy();
    const double given = start_strain + std::abs(e.external) + std::abs(e.contact_normal) + std::abs(e.friction);
    return !std::isfinite(e.kinetic) || e.kinetic > 1e-4 * dynamics.static_normal_force() + 10.0 * given;
}

ExplicitLimit limit_of(const ExplicitOperators& operators)
{
    return {operators.highest_frequency(), operators.limit(), operators.undamped_limit()};
}

} // namespace

/// @throws InputError for a step above the limit, and for joints that share nodes
std::shared_ptr<const ExplicitOperators> EarthquakeRun::explicit_operators() const
{
    auto operators = std::make_shared<const ExplicitOperators>(*structure_, damping_);
    if (!operators->separable())
        throw InputError(Diagnostic{
            scene_.file.string(), 0, 0, "time.scheme = \"central-difference\" with planes that share nodes.",
            "planes without common nodes: each pair is then a problem of its own", "use  scheme = \"hht\"  in [time]"});
    if (scene_.time.dt) explicit_step(*scene_.time.dt, scene_.time.dt, limit_of(*operators));
    return operators;
}

RunResult EarthquakeRun::shake_explicitly(int halvings, const BatchedRun& batched) const
{
    const Stopwatch clock;
    const GroundMotion& motion = *batched.motion;
    const double row = motion.dt, duration = row * static_cast<double>(motion.accel_h.size() - 1);
    const double step = batched.steps && batched.steps->step
                            ? *batched.steps->step
                            : explicit_step(row, scene_.time.dt, limit_of(*explicit_)) / (1 << halvings);
    const long parts = std::lround(row / step);
    const GroundInput ground(motion, damping_.mass, damping_.constants.mass);
    const auto record_steps = std::lround(duration / row);
    const long all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / row - 1e-9));
    const long rest_steps = static_cast<long>(std::ceil(rest_time() / row - 1e-9));
    ExplicitContact dynamics(explicit_, split(stages_.loads.size() - 1), batched.start, batched.memory);
    Strength strength = batched.strength;
    RunResult result = batched.result;
    result.dt = step;
    result.halvings = halvings;
    result.status = Status::sliding_at_end;
    HistoryRecorder recorder(dynamics, result.history, options_.pair_series, frame_interval(duration));
    const SlideProbe probe(structure_->planes(), batched.result.stages.back(), dynamics.state().contact.slip);
    SlideWatch watch = slide_watch(batched, duration);
    result.cracks = cracks_->none_yet();
    CrackWatch cracks(*cracks_);
    const auto look = [&] {
        watch.add(probe.instant(dynamics, strength.law()));
        cracks.look(dynamics.state().time, dynamics.state().u, dynamics.state().v, nullptr, result.cracks);
    };
    const auto add_row = [&] {
        recorder.add();
        watch.add_row(result.history.slide);
    };
    look();
    add_row();
    std::vector<GroundAcceleration> ahead(static_cast<std::size_t>(strength.constant() ? parts : 1));
    for (long n = 0; n < all_steps && result.status == Status::sliding_at_end; ++n) {
        for (long done = 0; done < parts; done += static_cast<long>(ahead.size())) {
            for (std::size_t k = 0; k < ahead.size(); ++k)
                ahead[k] = ground.at((static_cast<double>(n) + static_cast<double>(done + static_cast<long>(k) + 1) /
                                                                   static_cast<double>(parts)) *
                                     row);
            dynamics.advance(step, ahead, strength.law());
            strength.follow(dynamics.state().contact);
            look();
        }
        add_row();
        if (options_.progress &&
            options_.progress(progress_of(batched, halvings, record_steps, n + 1, row)) == RunAnswer::stop)
            result.status = Status::interrupted;
        else if (options_.ends_when_lifts_wake && result.cracks.wakes())
            result.status = Status::interrupted;
        else if (has_diverged(dynamics, result.history.energy.front().strain))
            result.status = Status::diverged;
        else if (n + 1 >= record_steps + rest_steps && at_rest(result.history, rest_time()))
            result.status = Status::at_rest;
        else if (watch.self_excited())
            result.status = Status::self_excited;
    }
    recorder.finish();
    result.run_out = watch.figures();
    end_run(dynamics, strength, batched, result);
    result.seconds.dynamics += clock.seconds();
    return result;
}

} // namespace damslip::fe2d
