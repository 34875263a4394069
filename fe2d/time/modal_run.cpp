#include "fe2d/time/modal_run.hpp"

#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/time/integrate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::fe2d {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

Vector2d amplitudes(const GroundState& ground)
{
    return {ground.accel_h, -ground.accel_v};
}

/// The modes kept, and what rows of the history take from them.
struct ModalBasis {
    MatrixXd shape;                ///< Φ, n x N
    MatrixXd participation;        ///< Γ, N x 2
    MatrixXd residual;             ///< w, n x 2 [s^2]
    VectorXd omega;                ///< [rad/s]
    MatrixXd damping;              ///< ΦᵀCΦ [1/s]
    MatrixXd crest, inertia, drag; ///< rows of Φ at the crest; M_dam r and a_M M_s r times Φ; 2 x N
    MatrixXd late; ///< -(K⁻¹ - ΦΩ⁻²Φᵀ) C Φ at the crest, 2 x N: modes left out follow the damping of those kept [s]
    VectorXd still;      ///< Φᵀ R_static
    Vector2d mass_share; ///< effective mass kept [-]
};

/// Static responses, made once for any number of modes.
struct Flexibility {
    MatrixXd rigid; ///< K⁻¹ M r_x, K⁻¹ M r_y, n x 2 [s^2]
    MatrixXd crest; ///< K⁻¹ of unit forces at the crest, n x 2 [m^2/N]
};

ModalBasis basis_of(const TiedProblem& problem, const NaturalModes& modes, const Flexibility& flexible)
{
    const LinearSystem& system = problem.structure.system;
    const Index n = system.size(), count = modes.frequency.size();
    ModalBasis basis;
    basis.shape = modes.shape.topRows(n);
    basis.omega = 2.0 * std::numbers::pi * modes.frequency;
    basis.participation = modes.participation.transpose();
    basis.mass_share = modes.effective_share.rowwise().sum();
    const VectorXd flexibility = basis.omega.cwiseAbs2().cwiseInverse();
    basis.residual = flexible.rigid - basis.shape * (flexibility.asDiagonal() * basis.participation);
    basis.damping = basis.shape.transpose() * (system.damping * basis.shape);
    basis.damping = (0.5 * (basis.damping + basis.damping.transpose())).eval();
    basis.crest.resize(2, count);
    basis.crest << basis.shape.row(problem.crest_x), basis.shape.row(problem.crest_y);
    basis.inertia.resize(2, count);
    basis.inertia << problem.mass_x.transpose() * basis.shape, problem.mass_y.transpose() * basis.shape;
    basis.drag.resize(2, count);
    basis.drag << problem.damped_x.transpose() * basis.shape, problem.damped_y.transpose() * basis.shape;
    const MatrixXd damped = system.damping * basis.shape;
    basis.late = basis.crest * flexibility.asDiagonal() * basis.damping - flexible.crest.transpose() * damped;
    basis.still = basis.shape.transpose() * problem.load.still;
    return basis;
}

/// Largest |φ_iᵀCφ_j| over the root of the diagonal ones.
double coupling_of(const MatrixXd& damping)
{
    const VectorXd root = damping.diagonal().cwiseMax(0.0).cwiseSqrt();
    double largest = 0.0;
    for (Index i = 0; i < damping.rows(); ++i)
        for (Index j = 0; j < i; ++j)
            if (root[i] * root[j] > 0.0) largest = std::max(largest, std::abs(damping(i, j)) / (root[i] * root[j]));
    return largest < 1e-9 ? 0.0 : largest;
}

/// Oscillators of the highest mode kept under the two amplitudes: how far they depart from following the ground statically.
class HighestMode {
public:
    HighestMode(double omega, double damping, double dt)
        : recurrence_(VectorXd::Constant(2, omega), Vector2d::Constant(damping).asDiagonal(), MatrixXd::Identity(2, 2),
                      dt)
    {
    }
    void step(const Vector2d& before, const Vector2d& after)
    {
        recurrence_.step(q_, rate_, before, after);
        const Vector2d static_part = recurrence_.omega().cwiseAbs2().cwiseProduct(q_);
        departure = departure.cwiseMax((static_part - after).cwiseAbs());
        acceleration = acceleration.cwiseMax(recurrence_.acceleration(q_, rate_, after).cwiseAbs());
    }
    Vector2d departure = Vector2d::Zero();    ///< largest |ω²q - a| [m/s^2]
    Vector2d acceleration = Vector2d::Zero(); ///< largest |q̈| [m/s^2]

private:
    ModalRecurrence recurrence_;
    VectorXd q_ = VectorXd::Zero(2), rate_ = VectorXd::Zero(2);
};

/// Energies of the modes on top of those of the static state.
class ModalLedger {
public:
    ModalLedger(const ModalBasis& basis, double static_strain) : basis_(basis)
    {
        energy_.strain = start_.strain = static_strain;
        scale_ = energy_.scale();
    }
    struct Instant {
        VectorXd q, rate, acceleration, load; ///< load: Γ a
    };
    void step(const Instant& a, const Instant& b, double dt);
    const Energy& energy() const { return energy_; }
    double imbalance() const { return energy_.imbalance(start_); }
    double scale() const { return scale_; }

private:
    const ModalBasis& basis_;
    Energy start_, energy_;
    double scale_ = 0.0;
};

/// ∫ pᵀq̇ dt = [pᵀq] - (Δp/Δt)ᵀ ∫ q dt with Ω² ∫ q dt = ∫ p dt - Δq̇ - C Δq from the equation of motion: exact.
void ModalLedger::step(const Instant& a, const Instant& b, double dt)
{
    const VectorXd squares = basis_.omega.cwiseAbs2();
    const VectorXd integral =
        (0.5 * dt * (a.load + b.load) - (b.rate - a.rate) - basis_.damping * (b.q - a.q)).cwiseQuotient(squares);
    energy_.external +=
        b.load.dot(b.q) - a.load.dot(a.q) - (b.load - a.load).dot(integral) / dt + basis_.still.dot(b.q - a.q);
    const VectorXd drag_a = basis_.damping * a.rate, drag_b = basis_.damping * b.rate;
    energy_.damping += 0.5 * dt * (a.rate.dot(drag_a) + b.rate.dot(drag_b)) +
                       dt * dt / 6.0 * (a.acceleration.dot(drag_a) - b.acceleration.dot(drag_b));
    energy_.kinetic = 0.5 * b.rate.squaredNorm();
    energy_.strain = start_.strain + basis_.still.dot(b.q) + 0.5 * squares.dot(b.q.cwiseAbs2());
    scale_ = std::max(scale_, energy_.scale());
}

class ModalRun {
public:
    ModalRun(TiedProblem& problem, const ModalBasis& basis, double dt, int keep_every)
        : problem_(problem), basis_(basis), dt_(dt), keep_every_(keep_every),
          steps_(step_count(problem.ground, problem.options, dt)),
          recurrence_(basis.omega, basis.damping, basis.participation, dt)
    {
    }
    History go();

private:
    HistoryRow row(double time, const GroundState& ground, const ModalLedger::Instant& now,
                   const ModalLedger& ledger) const;
    void estimate(const HighestMode& highest, History& history) const;

    TiedProblem& problem_;
    const ModalBasis& basis_;
    double dt_;
    int keep_every_;
    std::int64_t steps_;
    ModalRecurrence recurrence_;
};

HistoryRow ModalRun::row(double time, const GroundState& ground, const ModalLedger::Instant& now,
                         const ModalLedger& ledger) const
{
    const Vector2d a = amplitudes(ground);
    const Index x = problem_.crest_x, y = problem_.crest_y;
    TiedSums sums;
    sums.crest =
        Vector2d(problem_.start[x] + basis_.residual.row(x).dot(a), problem_.start[y] + basis_.residual.row(y).dot(a)) +
        basis_.crest * now.q + basis_.late * now.rate;
    sums.crest_accel = basis_.crest * now.acceleration;
    sums.inertia = basis_.inertia * now.acceleration;
    sums.damping = basis_.drag * now.rate;
    HistoryRow row = problem_.row(time, ground, sums);
    row.energy = ledger.energy();
    row.imbalance = ledger.imbalance();
    return row;
}

void ModalRun::estimate(const HighestMode& highest, History& history) const
{
    ModalTruncation& t = history.modal;
    t.modes = static_cast<int>(basis_.omega.size());
    t.highest_frequency = basis_.omega.maxCoeff() / (2.0 * std::numbers::pi);
    t.mass_share = basis_.mass_share;
    t.damping_coupling = coupling_of(basis_.damping);
    const Eigen::RowVector2d crest = basis_.crest.row(0) * basis_.participation;
    const Eigen::RowVector2d shear = basis_.inertia.row(0) * basis_.participation;
    const Eigen::RowVector2d rigid_crest(1.0, 0.0),
        rigid_shear(problem_.mass_x.dot(problem_.rigid_x()), problem_.mass_x.dot(problem_.rigid_y()));
    t.crest_x_error = basis_.residual.row(problem_.crest_x).cwiseAbs().dot(highest.departure);
    t.crest_accel_x_error = (rigid_crest - crest).cwiseAbs().dot(highest.acceleration);
    t.base_shear_error = (rigid_shear - shear).cwiseAbs().dot(highest.acceleration);
}

History ModalRun::go()
{
    History history;
    history.method = fmt::format("{} modes", basis_.omega.size());
    history.unknowns = basis_.omega.size();
    HistoryWriter writer(history, problem_.options, dt_, steps_, keep_every_);
    const Index count = basis_.omega.size(), top = count - 1;
    HighestMode highest(basis_.omega[top], basis_.damping(top, top), dt_);
    GroundState ground = problem_.ground.at(0.0);
    ModalLedger::Instant before{
        VectorXd::Zero(count), VectorXd::Zero(count), {}, basis_.participation * amplitudes(ground)},
        after;
    before.acceleration = before.load;
    ModalLedger ledger(basis_, 0.5 * problem_.start.dot(problem_.structure.system.stiffness * problem_.start));
    writer.enter(row(0.0, ground, before, ledger), 0);
    for (std::int64_t n = 1; n <= steps_; ++n) {
        const double time = dt_ * static_cast<double>(n);
        const Vector2d a0 = amplitudes(ground);
        ground = problem_.ground.at(time);
        const Vector2d a1 = amplitudes(ground);
        after.q = before.q;
        after.rate = before.rate;
        recurrence_.step(after.q, after.rate, a0, a1);
        after.acceleration = recurrence_.acceleration(after.q, after.rate, a1);
        after.load = basis_.participation * a1;
        ledger.step(before, after, dt_);
        highest.step(a0, a1);
        if (!std::isfinite(ledger.imbalance())) {
            history.status = TiedRunStatus::diverged;
            history.ending = {NoteKind::not_finite, {n, time}};
            break;
        }
        std::swap(before, after);
        writer.enter(row(time, ground, before, ledger), n);
        if (writer.stopped(n, time)) break;
    }
    writer.finish(ledger.scale());
    estimate(highest, history);
    VectorXd end = problem_.start + basis_.shape * before.q + basis_.residual * amplitudes(ground);
    if (recurrence_.coupled())
        end += basis_.shape * (basis_.damping * before.rate).cwiseQuotient(basis_.omega.cwiseAbs2()) -
               problem_.static_response(problem_.structure.system.damping * (basis_.shape * before.rate));
    history.displacement = problem_.all_displacements(end);
    return history;
}

[[noreturn]] void refuse_modal(const std::string& obstacle)
{
    Diagnostic diagnostic;
    diagnostic.problem = "time.scheme = \"modal\" with " + obstacle + ".";
    diagnostic.expected = "a linear model with Rayleigh damping";
    diagnostic.fix = "use  scheme = \"hht\"  in [time]";
    throw InputError(std::move(diagnostic));
}

bool accurate(const History& history, const ModalOptions& modal)
{
    const ModalTruncation& t = history.modal;
    return t.crest_x_error <= modal.crest_tolerance * history.peak_crest_x &&
           t.crest_accel_x_error <= modal.force_tolerance * history.peak_crest_accel_x &&
           t.base_shear_error <= modal.force_tolerance * std::abs(history.peak_base_shear);
}

double percent(double part, double whole)
{
    return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

void note(History& history)
{
    const ModalTruncation& t = history.modal;
    const std::int64_t modes = t.modes;
    const double x = 100.0 * t.mass_share.x(), y = 100.0 * t.mass_share.y();
    history.notes.push_back(
        t.damping_coupling > 0.0
            ? Note{NoteKind::modes_coupled, {modes, t.highest_frequency, x, y, t.damping_coupling}}
            : Note{NoteKind::modes_exact, {modes, t.highest_frequency, x, y}});
    history.notes.push_back({NoteKind::modes_left_out,
                             {percent(t.crest_x_error, history.peak_crest_x),
                              percent(t.crest_accel_x_error, history.peak_crest_accel_x),
                              percent(t.base_shear_error, std::abs(history.peak_base_shear))}});
}

} // namespace

std::string modal_obstacle(const TiedRunOptions& options)
{
    if (options.water)
        return "acoustic water: it radiates and is not damped like the dam, so real modes do not separate the "
               "equations";
    if (options.moving_base) return "rock that lets waves out: real modes do not separate the equations";
    if (options.damping.mass == MassDamping::total && options.damping.constants.mass != 0.0)
        return "mass damping of the total velocity: its load, a_M times the ground's velocity, is not linear between "
               "samples";
    return {};
}

History integrate_modal(const Model& model, const GroundMotion& motion, const TiedRunOptions& options,
                        const ModalOptions& modal)
{
    if (const std::string obstacle = modal_obstacle(options); !obstacle.empty()) refuse_modal(obstacle);
    const int parts = options.dt ? 1 : modal_parts;
    const double dt = step_of(motion, options) / parts;
    TiedProblem problem(model, motion, options);
    if (problem.other_damping() > 1e-9)
        refuse_modal(
            "damping that is neither mass- nor stiffness-proportional: real modes do not separate the equations");
    History history;
    const auto failed = [&history](Note note) {
        history.status = TiedRunStatus::solver_failed;
        history.ending = std::move(note);
        return std::move(history);
    };
    if (!problem.prepare()) return failed(problem.structure.solver.note());
    MatrixXd loads = MatrixXd::Zero(problem.load.mass_x.size(), 4);
    loads.leftCols(2) << problem.load.mass_x, problem.load.mass_y;
    loads(problem.crest_x, 2) = loads(problem.crest_y, 3) = 1.0;
    const MatrixXd responses = problem.static_response(loads);
    const Flexibility flexible{responses.leftCols(2), responses.rightCols(2)};
    if (!problem.structure.solver.ok()) return failed(problem.structure.solver.note());
    for (int count = modal.modes.value_or(modal.first);; count = std::min(2 * count, modal.most)) {
        const NaturalModes modes = natural_modes(model, count, options.solver);
        if (modes.frequency.size() == 0) return failed({NoteKind::no_mode_found, {text_of(modes.solver.note())}});
        const ModalBasis basis = basis_of(problem, modes, flexible);
        history = ModalRun(problem, basis, dt, options.keep_every * parts).go();
        const bool all = modes.frequency.size() < count;
        if (modal.modes || all || count >= modal.most || history.status != TiedRunStatus::complete ||
            accurate(history, modal))
            break;
    }
    history.factorisations = 1;
    note(history);
    return history;
}

namespace {

/// exp(A) by scaling to a norm below 1/4, Taylor's series of 14 terms ((1/4)^15/15! < 1e-21) and squaring.
MatrixXd exponential(const MatrixXd& matrix)
{
    const double norm = matrix.cwiseAbs().rowwise().sum().maxCoeff();
    const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(norm, 1e-300) / 0.25))));
    const MatrixXd small = matrix / std::pow(2.0, squarings);
    MatrixXd sum = MatrixXd::Identity(matrix.rows(), matrix.cols()), term = sum;
    for (int k = 1; k <= 14; ++k) {
        term = (term * small / k).eval();
        sum += term;
    }
    for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
    return sum;
}

bool has_off_diagonal(const MatrixXd& matrix)
{
    const MatrixXd diagonal = matrix.diagonal().asDiagonal();
    return (matrix - diagonal).cwiseAbs().maxCoeff() > 1e-12 * matrix.cwiseAbs().maxCoeff();
}

} // namespace

ModalRecurrence::ModalRecurrence(const VectorXd& omega, const MatrixXd& damping, const MatrixXd& loads, double dt)
    : omega_(omega), damping_(damping), loads_(loads), coupled_(has_off_diagonal(damping))
{
    assert(dt > 0.0 && omega.minCoeff() > 0.0 && damping.rows() == omega.size());
    // The closed formula is for oscillating modes; overdamped ones go by the exponential.
    if ((damping_.diagonal().array() >= 2.0 * omega_.array()).any()) coupled_ = true;
    if (coupled_)
        make_coupled(dt);
    else
        make_diagonal(dt);
}

/// With p(s) = p₀ + (p₁ - p₀) s/Δt the part that follows the load is q_p = A + B s, B = (p₁ - p₀)/(Δt ω²),
/// A = p₀/ω² - 2ζB/ω, and the rest vibrates freely from (q₀ - A, q̇₀ - B).
void ModalRecurrence::make_diagonal(double dt)
{
    const Index n = modes();
    for (Eigen::ArrayXd* values : {&qq_, &qv_, &vq_, &vv_, &q0_, &q1_, &v0_, &v1_}) values->resize(n);
    for (Index k = 0; k < n; ++k) {
        const double w = omega_[k], half = 0.5 * damping_(k, k); // ζω
        const double wd = std::sqrt((w - half) * (w + half));
        const double decay = std::exp(-half * dt), c = std::cos(wd * dt), s = std::sin(wd * dt) / wd;
        const double qq = decay * (c + half * s), qv = decay * s;
        const double vq = -decay * w * w * s, vv = decay * (c - half * s);
        qq_[k] = qq, qv_[k] = qv, vq_[k] = vq, vv_[k] = vv;
        const double b = 1.0 / (dt * w * w), lag = 2.0 * half / (w * w) * b; // B and 2ζB/ω per p₁ - p₀
        // Of p₁ alone: A = -lag, B = b; of p₀ alone: A = 1/ω² + lag, B = -b.
        q1_[k] = -lag + b * dt + qq * lag - qv * b;
        v1_[k] = b + vq * lag - vv * b;
        const double a0 = 1.0 / (w * w) + lag;
        q0_[k] = a0 - b * dt - qq * a0 + qv * b;
        v0_[k] = -b - vq * a0 + vv * b;
    }
}

/// d/dt (x, a, a') = [[A, B, 0], [0, 0, 1], [0, 0, 0]] (x, a, a'), A = [[0, Ω], [-Ω, -C]], B = [[0], [P]], time in steps.
void ModalRecurrence::make_coupled(double dt)
{
    const Index n = modes();
    const Index l = loads_.cols();
    MatrixXd matrix = MatrixXd::Zero(2 * (n + l), 2 * (n + l));
    matrix.block(0, n, n, n) = (dt * omega_).asDiagonal();
    matrix.block(n, 0, n, n) = (-dt * omega_).asDiagonal();
    matrix.block(n, n, n, n) = -dt * damping_;
    matrix.block(n, 2 * n, n, l) = dt * loads_;
    matrix.block(2 * n, 2 * n + l, l, l).setIdentity();
    const MatrixXd all = exponential(matrix);
    transition_ = all.topLeftCorner(2 * n, 2 * n);
    from_after_ = all.block(0, 2 * n + l, 2 * n, l); // of a' = a₁ - a₀
    from_before_ = all.block(0, 2 * n, 2 * n, l) - from_after_;
}

void ModalRecurrence::step(VectorXd& q, VectorXd& rate, const VectorXd& before, const VectorXd& after) const
{
    if (coupled_) {
        const Index n = modes();
        VectorXd x(2 * n);
        x << omega_.cwiseProduct(q), rate;
        x = (transition_ * x + from_before_ * before + from_after_ * after).eval();
        q = x.head(n).cwiseQuotient(omega_);
        rate = x.tail(n);
        return;
    }
    const Eigen::ArrayXd q0 = q.array(), v0 = rate.array(), p0 = (loads_ * before).array(),
                         p1 = (loads_ * after).array();
    q = (qq_ * q0 + qv_ * v0 + q0_ * p0 + q1_ * p1).matrix();
    rate = (vq_ * q0 + vv_ * v0 + v0_ * p0 + v1_ * p1).matrix();
}

VectorXd ModalRecurrence::acceleration(const VectorXd& q, const VectorXd& rate, const VectorXd& amplitudes) const
{
    return loads_ * amplitudes - damping_ * rate - omega_.cwiseAbs2().cwiseProduct(q);
}

} // namespace damslip::fe2d
