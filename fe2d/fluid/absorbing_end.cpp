#include "fe2d/fluid/absorbing_end.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// One matrix of the depth column by its entries (i, j, value), i and j counted over the column's nodes.
struct ColumnMatrices {
    Triplets flow;      ///< M₁ = ∫NN/ρ dy
    Triplets mass;      ///< Q_y
    Triplets damping;   ///< A_y
    Triplets stiffness; ///< L_y
};

ColumnMatrices column_matrices(const EndColumn& column, const FluidOptions& water)
{
    ColumnMatrices m;
    for (std::size_t e = 0; e + 1 < column.y.size(); ++e) {
        const double h = column.y[e] - column.y[e + 1];
        for (const std::size_t i : {e, e + 1})
            for (const std::size_t j : {e, e + 1}) {
                const double product = h * (i == j ? 1.0 / 3.0 : 1.0 / 6.0);
                m.flow.emplace_back(i, j, product / water.density);
                m.mass.emplace_back(i, j, product / water.bulk_modulus);
                m.stiffness.emplace_back(i, j, (i == j ? 1.0 : -1.0) / (h * water.density));
            }
    }
    const auto bottom = static_cast<Index>(column.y.size()) - 1;
    if (column.bottom_admittance != 0.0) m.damping.emplace_back(bottom, bottom, column.bottom_admittance);
    if (column.surface_mass != 0.0) m.mass.emplace_back(0, 0, column.surface_mass);
    return m;
}

/// Builds the layers one behind the other.
class Layers {
public:
    Layers(const EndColumn& column, const FluidOptions& water, Index first)
        : column_(column), water_(water), matrices_(column_matrices(column, water)), near_(column.place), next_(first)
    {
    }

    /// A layer of real length.
    void add_decay(double length)
    {
        step();
        differences(matrices_.flow, 1.0 / length, end_.entries.stiffness);
        sums(matrices_.mass, 0.25 * length, end_.entries.mass);
        sums(matrices_.damping, 0.25 * length, end_.entries.damping);
        sums(matrices_.stiffness, 0.25 * length, end_.entries.stiffness);
        load(0.5 * length, end_.acceleration_load);
    }

    /// A layer of the length 2c/(s cos θ); its momenta come later, all together.
    void add_cosine(double cosine)
    {
        const double beta = water_.sound_speed() / (2.0 * cosine);
        step();
        differences(matrices_.flow, 0.25 / beta, end_.entries.damping);
        sums(matrices_.mass, beta, end_.entries.damping);
        sums(matrices_.damping, beta, end_.entries.stiffness);
        load(2.0 * beta, end_.velocity_load);
        momenta_.push_back({beta, near_, far_});
    }

    AbsorbingEnd finish()
    {
        for (const Momentum& layer : momenta_) add_momenta(layer);
        return std::move(end_);
    }

private:
    struct Momentum {
        double beta;
        std::vector<Index> near, far;
    };

    /// New unknowns behind the last layer; those at p = 0 stay so.
    void step()
    {
        if (!far_.empty()) near_ = far_;
        far_ = near_;
        for (Index& unknown : far_)
            if (unknown >= 0) {
                unknown = next_++;
                ++end_.pressures;
            }
    }

    static void put(Triplets& entries, Index row, Index column, double value)
    {
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, value);
    }

    void pairs(const Triplets& matrix, double factor, double mixed, Triplets& entries) const
    {
        for (const auto& entry : matrix)
            for (const auto* side : {&near_, &far_})
                for (const auto* other : {&near_, &far_})
                    put(entries, (*side)[static_cast<std::size_t>(entry.row())],
                        (*other)[static_cast<std::size_t>(entry.col())],
                        factor * (side == other ? 1.0 : mixed) * entry.value());
    }
    void sums(const Triplets& matrix, double factor, Triplets& entries) const { pairs(matrix, factor, 1.0, entries); }
    void differences(const Triplets& matrix, double factor, Triplets& entries) const
    {
        pairs(matrix, factor, -1.0, entries);
    }

    void load(double factor, Triplets& entries) const
    {
        if (column_.bottom_load == 0.0) return;
        put(entries, near_.back(), 0, factor * column_.bottom_load);
        put(entries, far_.back(), 0, factor * column_.bottom_load);
    }

    void add_momenta(const Momentum& layer)
    {
        for (std::size_t e = 0; e + 1 < column_.y.size(); ++e) {
            const double h = column_.y[e] - column_.y[e + 1];
            const Index w = next_++;
            ++end_.momenta;
            end_.entries.damping.emplace_back(w, w, -water_.density * h / layer.beta);
            for (const auto* side : {&layer.near, &layer.far})
                for (const auto& [node, sign] : {std::pair{e, 1.0}, std::pair{e + 1, -1.0}}) {
                    put(end_.entries.stiffness, w, (*side)[node], sign);
                    put(end_.entries.stiffness, (*side)[node], w, sign);
                }
        }
    }

    const EndColumn& column_;
    const FluidOptions& water_;
    ColumnMatrices matrices_;
    std::vector<Index> near_, far_;
    Index next_;
    std::vector<Momentum> momenta_;
    AbsorbingEnd end_;
};

} // namespace

AbsorbingEnd absorbing_end(const EndColumn& column, const FluidOptions& water, Index first)
{
    assert(column.y.size() > 1 && column.y.size() == column.place.size());
    const double depth = column.y.front() - column.y.back();
    Layers layers(column, water, first);
    for (const double decay : water.layers.decays) layers.add_decay(2.0 * depth / decay);
    for (const double cosine : water.layers.cosines) layers.add_cosine(cosine);
    return layers.finish();
}

} // namespace damslip::fe2d
