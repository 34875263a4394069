#include "fe2d/run/water_ledger.hpp"

#include <algorithm>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Rows that hold something, of matrices of equal height.
std::vector<Index> filled_rows(std::initializer_list<const SparseMatrix*> matrices)
{
    std::vector<bool> filled(static_cast<std::size_t>((*matrices.begin())->rows()), false);
    for (const SparseMatrix* matrix : matrices)
        for (Index column = 0; column < matrix->outerSize(); ++column)
            for (SparseMatrix::InnerIterator it(*matrix, column); it; ++it)
                if (it.value() != 0.0) filled[static_cast<std::size_t>(it.row())] = true;
    std::vector<Index> rows;
    for (std::size_t i = 0; i < filled.size(); ++i)
        if (filled[i]) rows.push_back(static_cast<Index>(i));
    return rows;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of(const SparseMatrix& matrix, const std::vector<Index>& rows)
{
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = matrix;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_row, rows[i]); it; ++it)
            if (it.value() != 0.0) entries.emplace_back(static_cast<Index>(i), it.col(), it.value());
    Eigen::SparseMatrix<double, Eigen::RowMajor> result(static_cast<Index>(rows.size()), matrix.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

void add_to_rows(const std::vector<Index>& rows, const VectorXd& values, VectorXd& vector)
{
    for (std::size_t i = 0; i < rows.size(); ++i) vector[rows[i]] += values[static_cast<Index>(i)];
}

} // namespace

WaterLedger::WaterLedger(const WaterBody& body, const NodeOrder& order)
    : mesh_(body.water.mesh_unknowns), floor_(body.water.floor), scale_(body.scale)
{
    const FluidModel& water = body.water;
    const double s = body.scale, s2 = s * s;
    const auto moved = [&](Index old) { return 2 * order.new_node[static_cast<std::size_t>(old / 2)] + old % 2; };
    for (const Index old : body.place) place_.push_back(moved(old));
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < mesh_; ++column)
        for (SparseMatrix::InnerIterator it(body.coupling, column); it; ++it)
            entries.emplace_back(column, moved(it.row()), s * it.value());
    SparseMatrix coupling(mesh_, body.size);
    coupling.setFromTriplets(entries.begin(), entries.end());
    face_rows_ = filled_rows({&coupling});
    for (const Index row : floor_)
        if (std::find(face_rows_.begin(), face_rows_.end(), row) == face_rows_.end()) face_rows_.push_back(row);
    coupling_ = rows_of(coupling, face_rows_);
    const SparseMatrix end_mass = s2 * SparseMatrix((water.mass - water.body_mass).topRows(mesh_)),
                       damping = s2 * SparseMatrix(water.damping.topRows(mesh_)),
                       end_stiffness = s2 * SparseMatrix((water.stiffness - water.body_stiffness).topRows(mesh_));
    boundary_rows_ = filled_rows({&end_mass, &damping, &end_stiffness});
    end_mass_ = rows_of(end_mass, boundary_rows_);
    damping_ = rows_of(damping, boundary_rows_);
    end_stiffness_ = rows_of(end_stiffness, boundary_rows_);
    const auto turned = [&](const VectorXd& load) {
        VectorXd result(mesh_);
        for (Index i = 0; i < mesh_; ++i) result[i] = -load[body.place[static_cast<std::size_t>(i)]];
        return result;
    };
    velocity_x_ = turned(body.velocity_x);
    velocity_y_ = turned(body.velocity_y);
    displacement_y_ = turned(body.displacement_y);
}

VectorXd WaterLedger::water_of(const VectorXd& vector) const
{
    VectorXd result(static_cast<Index>(place_.size()));
    for (std::size_t i = 0; i < place_.size(); ++i) result[static_cast<Index>(i)] = vector[place_[i]];
    return result;
}

VectorXd WaterLedger::on(const std::vector<Index>& rows, const VectorXd& mesh) const
{
    VectorXd result(static_cast<Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) result[static_cast<Index>(i)] = mesh[rows[i]];
    return result;
}

VectorXd WaterLedger::on_floor(const VectorXd& mesh) const
{
    return on(floor_, mesh);
}

WaterLedger::Instant WaterLedger::instant(const Motion& motion, const FloorMotion& floor, double velocity_h,
                                          double velocity_v, double displacement_v) const
{
    const auto turned = [&](const VectorXd& product) {
        VectorXd result(mesh_);
        for (Index i = 0; i < mesh_; ++i) result[i] = -product[place_[static_cast<std::size_t>(i)]];
        return result;
    };
    const auto off = [&](const Rows& of_boundary, const VectorXd& water, VectorXd& product) {
        const VectorXd part = of_boundary * water;
        add_to_rows(boundary_rows_, -part, product);
        return part;
    };
    const VectorXd phi = water_of(motion.z), rate = water_of(motion.v), accel = water_of(motion.a);
    Instant now;
    now.phi = phi.head(mesh_);
    now.rate = rate.head(mesh_);
    now.accel = accel.head(mesh_);
    now.face = coupling_ * motion.z;
    now.face_velocity = coupling_ * motion.v;
    if (!floor_.empty()) {
        now.floor = {scale_ * floor.volume, scale_ * floor.rate};
        for (std::size_t k = 0; k < floor_.size(); ++k) {
            const auto row = std::find(face_rows_.begin(), face_rows_.end(), floor_[k]) - face_rows_.begin();
            now.face[row] += now.floor.volume[static_cast<Index>(k)];
            now.face_velocity[row] += now.floor.rate[static_cast<Index>(k)];
        }
    }
    now.load = -velocity_h * velocity_x_ + velocity_v * velocity_y_ + displacement_v * displacement_y_;

    now.flow = turned(motion.stiffness_z);
    const VectorXd lost = damping_ * rate;
    now.force = now.flow - now.load;
    add_to_rows(boundary_rows_, lost, now.force);
    add_to_rows(face_rows_, now.face_velocity, now.force);
    now.mass_rate = turned(motion.mass_v);
    now.mass_accel = turned(motion.mass_a);
    now.boundary = lost + off(end_stiffness_, phi, now.flow);
    off(end_mass_, rate, now.mass_rate);
    now.boundary += off(end_mass_, accel, now.mass_accel);
    return now;
}

void WaterLedger::add(const StepConstants& c, const Instant& before2, const Instant& before, const Instant& now,
                      Energy& energy) const
{
    const double gamma = c.scheme.gamma, half_beta = c.scheme.beta - 0.5 * gamma, dt2 = c.dt * c.dt;
    const VectorXd step = now.phi - before.phi, mass_change = now.mass_accel - before.mass_accel;
    energy.kinetic += flow(now);
    energy.strain += compression(now);
    energy.radiated += 0.5 * on(boundary_rows_, step).dot(before.boundary + now.boundary);
    energy.external += 0.5 * step.dot(before.load + now.load);
    energy.numerical += -(gamma - 0.5) * step.dot(mass_change) +
                        (gamma - 0.5) * half_beta * dt2 * (now.accel - before.accel).dot(mass_change) +
                        0.5 * half_beta * dt2 * (now.accel.dot(now.mass_accel) - before.accel.dot(before.mass_accel));
    energy.numerical += 0.5 * c.scheme.alpha * step.dot(now.force - before2.force);
    if (before.jolt.size() > 0) energy.numerical -= 0.5 * (1.0 + c.scheme.alpha) * step.dot(before.jolt);
    energy.numerical += 0.5 * (on(face_rows_, step).dot(before.face_velocity + now.face_velocity) -
                               (now.face - before.face).dot(on(face_rows_, before.rate) + on(face_rows_, now.rate)));
    if (floor_.empty()) return;
    const VectorXd volume = now.floor.volume - before.floor.volume; // times the scale
    energy.floor += 0.5 * volume.dot(on_floor(before.rate) + on_floor(now.rate));
    energy.numerical -= 0.5 * c.scheme.alpha * volume.dot(on_floor(now.rate) - on_floor(before2.rate));
    if (before.jolt_rate.size() > 0)
        energy.numerical += 0.5 * (1.0 + c.scheme.alpha) * volume.dot(on_floor(before.jolt_rate));
}

} // namespace damslip::fe2d
