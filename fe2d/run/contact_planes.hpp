#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "fe2d/run/node_products.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// One contact plane as m pairs of nodes. Plane vectors have length 2m: normal components (along the upward normal),
/// then tangential ones (downstream); interface vectors of a body are (x, y) by node.
///
/// The path of a seam is one plane of several straight segments, each with its own directions; `normal` and `tangent` are then
/// those of the first, on which the dam stands, and its mean slip counts. An upright interface has "below" upstream of it.
struct Plane {
    Eigen::Vector2d normal{0.0, 1.0};  ///< up, out of the rock
    Eigen::Vector2d tangent{1.0, 0.0}; ///< downstream
    std::vector<Eigen::Index> segments;   ///< first pair of each segment; empty: one
    std::vector<Eigen::Vector2d> turned;  ///< tangents of the segments
    std::vector<Eigen::Vector2d> along;   ///< tangents of the pairs of a bent lift; empty: straight
    bool upright = false;                 ///< an interface: no weight rests on it
    Eigen::VectorXd distance;          ///< of the pairs from the heel along the plane [m]
    Eigen::VectorXd area; ///< of the base that belongs to a pair, length times share [m^2/m]
    double share = 1.0;   ///< of the width that is concrete [-]

    Eigen::Index pairs() const { return area.size(); }
    double length() const { return area.sum() / share; }
    /// What is above rests on all of it, in one direction.
    bool bears_alone() const { return !upright && segments.size() < 2; }
    Eigen::Index main_pairs() const { return segments.size() < 2 ? pairs() : segments[1]; } ///< of the first segment
    Eigen::VectorXd weights() const; ///< area weights of the main pairs, sum 1 [-]
    std::size_t segment_of(Eigen::Index pair) const;
    Eigen::Vector2d tangent_of(Eigen::Index pair) const
    {
        if (!along.empty()) return along[static_cast<std::size_t>(pair)];
        return segments.empty() ? tangent : turned[segment_of(pair)];
    }
    Eigen::Vector2d normal_of(Eigen::Index pair) const
    {
        if (segments.empty() && along.empty()) return normal;
        const Eigen::Vector2d t = tangent_of(pair);
        return {-t[1], t[0]};
    }

    // Of any number of nodes on the plane: the pairs, or the rock's whole line.
    Eigen::VectorXd to_plane(const Eigen::VectorXd& interface) const;
    Eigen::VectorXd to_interface(const Eigen::VectorXd& plane) const;
    Eigen::MatrixXd to_plane(const Eigen::MatrixXd& interface) const; ///< Q A Qᵀ
};

Plane plane_of(const Mesh& mesh);      ///< between dam and rock
Plane plane_of(const LiftPlane& lift); ///< horizontal, between two blocks of the dam; or upright, between two of rock

/// What is below the base.
enum class BelowBase {
    apart, ///< a rigid base, or rock that is a body of its own: the dam alone gives gaps
    block ///< rock as one more block of the structure, its nodes opposite the dam's: the base is a joint like the others
};

/// All contact planes of a structure: the base, then the lift joints from bottom to top. Their m pairs are numbered
/// through; vectors over all pairs have length 2m: normal components, then tangential ones (downstream).
///
/// The dam's nodes above the planes are its interface: those of the base, then of each lift joint. Vectors q over them are
/// (x, y) by node: the displacement of a node of the base, the one of a node of a joint (with BelowBase::block of the base too)
/// less that of the node below it, its tie. What the dam gives to the gaps is D q; D turns to the planes' axes, D⁻¹ = Dᵀ.
class ContactPlanes {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    explicit ContactPlanes(const Mesh& mesh, BelowBase below = BelowBase::apart);

    Eigen::Index count() const { return static_cast<Eigen::Index>(planes_.size()); } ///< K >= 1
    Eigen::Index pairs() const { return area_.size(); }                              ///< m, of all planes
    const Plane& operator[](Eigen::Index plane) const { return planes_[static_cast<std::size_t>(plane)]; }
    const Plane& base() const { return planes_.front(); }
    Eigen::Index first(Eigen::Index plane) const { return first_[static_cast<std::size_t>(plane)]; } ///< pair

    const Eigen::VectorXd& area() const { return area_; }       ///< of all pairs [m]
    const Eigen::MatrixXd& weights() const { return weights_; } ///< m x K: area weights of each plane [-]
    /// Mean slip of a plane [m]. @param slip  of all pairs
    double mean(Eigen::Index plane, const Eigen::VectorXd& slip) const { return weights_.col(plane).dot(slip); }

    /// By node of the dam: is it in a block above the plane?
    const std::vector<char>& above(Eigen::Index plane) const { return above_[static_cast<std::size_t>(plane)]; }

    const std::vector<int>& nodes() const { return nodes_; } ///< the dam's, in interface order
    const std::vector<Tie>& ties() const { return ties_; }   ///< of the interface's nodes that have a node below them
    const Matrix& gaps() const { return gaps_; }             ///< D, 2m x 2m

private:
    std::vector<Plane> planes_;
    std::vector<Eigen::Index> first_;
    Eigen::VectorXd area_;
    Eigen::MatrixXd weights_;
    std::vector<std::vector<char>> above_;
    std::vector<int> nodes_;
    std::vector<Tie> ties_;
    Matrix gaps_;
};

/// Rigid translations of the dam's unknowns, in mesh order, one column by plane: everything above it goes along it by 1.
Eigen::MatrixXd sliding_motions(const ContactPlanes& planes);

} // namespace damslip::fe2d
