#pragma once

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "fe2d/run/interface_factor.hpp"
#include "fe2d/run/node_products.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <optional>
#include <vector>

namespace damslip::fe2d {

/// A large matrix of which few rows are not empty: a product visits these alone.
class FewRows {
public:
    FewRows() = default; ///< empty
    explicit FewRows(const SparseMatrix& matrix);

    /// y -= A x; each row's sum runs by ascending columns.
    void subtract_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

private:
    std::vector<int> row_, begin_, column_; ///< entries of row_[k]: begin_[k] ... begin_[k+1]-1
    std::vector<double> value_;
};

/// Trace of the rock's displacements on the dam's contact nodes when the dam has slid along the plane: the segment-to-
/// segment (mortar) projection of the two sides with dual shape functions on the dam (Wohlmuth 2000), so that the
/// contact force of a dam node stays its own unknown:
///
///     P_ij = (1/A_i) ∫ ψ_i N_j dx,   ∫ ψ_i N_k^dam dx = δ_ik A_i
///
/// gap g = u_dam - P u_rock, forces on the rock -P^T λ. Rows sum to one and P x_rock = x_dam + s, so force and moment
/// resultants pass exactly whatever the meshes and the slip; P depends smoothly on s, also where a node passes another.
/// With equal meshes and s = 0 it is the identity.
class Pairing {
public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// @param dam   places of the dam's nodes along the plane, increasing [m]
    /// @param rock  places of the rock's nodes, increasing [m]
    Pairing(std::vector<double> dam, std::vector<double> rock);

    /// How far the dam may slide so that all of it still faces rock [m].
    double reach_upstream() const { return rock_.front() - dam_.front(); } ///< <= 0
    double reach_downstream() const { return rock_.back() - dam_.back(); } ///< >= 0
    bool reaches(double slip) const;
    double smallest_element() const; ///< of both sides [m]

    /// @param slip  of the dam, positive downstream, within reach [m]
    Matrix weights(double slip) const; ///< P, m x n [-]

private:
    std::vector<double> dam_, rock_;
};

/// Loads of the two sides of the base [N/m]; those on the rock are condensed onto its contact nodes (constant in time).
struct SplitLoad {
    Eigen::VectorXd dam;   ///< on the dam's unknowns, in its node order
    Eigen::VectorXd rock;  ///< condensed on its contact nodes, plane; empty for a rigid base
    Eigen::VectorXd joint; ///< by the water in the joint on the rock opposite each pair, 2m: goes along with a dam
                           ///< that slides far; empty: none, or part of `rock`
};

/// What becomes of the rock.
enum class RockBody {
    condensed, ///< a massless body of its own, reduced exactly to its contact nodes
    moving     ///< with mass, a block of the structure below the base, as the dam is above it: all of its unknowns stay
};

/// Dam and rock as bodies that only contact joins: everything linear and independent of the step size. Lift joints cut
/// the dam into blocks.
///
/// The massless rock is condensed exactly onto its contact nodes (CondensedBody gives the reasons and the conditions);
/// its damping is b_K K_c. Rock with mass (RockBody::moving) stands among the dam's unknowns, fixed ones alone with a
/// stiffness and no load; for the rest of this header it is then part of "the dam", has_rock() is false, and statics are
/// another structure's. Without a foundation the base is rigid.
class ContactStructure {
public:
    /// @param model  built with Base::separate; kept by reference
    /// @param range  finite: sliding changes the rock a dam node faces (Pairing)
    /// @param water  moves with the dam, kept by reference; its unknowns stand among the dam's inner ones. Null: none
    explicit ContactStructure(const Model& model, JointPath range = JointPath::small, const WaterBody* water = nullptr,
                              RockBody rock = RockBody::condensed);

    bool regular() const { return regular_; } ///< false: the rock is not held, or the dam's interior is loose
    const Model& model() const { return model_; }
    const ContactPlanes& planes() const { return planes_; }
    const Plane& plane() const { return planes_.base(); }                    ///< between dam and rock
    Eigen::Index pairs() const { return planes_.pairs(); }                   ///< m, of all planes
    Eigen::Index interface() const { return order_.nodes() - order_.inner; } ///< the dam's nodes above the planes
    const std::vector<Tie>& ties() const { return ties_; }      ///< ContactPlanes::ties() in the structure's order
    const ContactPlanes::Matrix& gaps() const { return gaps_; } ///< that displacements of the dam give, 2m x dam_unknowns()
    /// The dam's displacements without the translation of each of its blocks (that of one node on the plane below it):
    /// elastic forces do not feel it; taken off, metres of slip cost no digits of them.
    void take_off_translations(const Eigen::VectorXd& u, Eigen::VectorXd& deformation) const;
    const NodeOrder& order() const { return order_; }
    /// Of the dam in its node order, and of the water with CoupledSystem's signs; mass with added mass.
    const SparseMatrix& stiffness() const { return stiffness_; }
    const SparseMatrix& mass() const { return mass_; }
    const WaterBody* water() const { return water_; } ///< null: none
    /// Coupling and damping of the water, and the dashpots on the rock's edges, in the same order.
    const SparseMatrix& gyration() const { return gyration_; }
    bool gyrates() const { return gyration_.nonZeros() > 0; }
    const SparseMatrix& edge_damping() const { return edge_damping_; } ///< these dashpots alone
    bool rock_moves() const { return rock_moves_; }                    ///< RockBody::moving
    /// Ground loads on the water, in the same order (WaterBody).
    const Eigen::VectorXd& velocity_x() const { return velocity_x_; }
    const Eigen::VectorXd& velocity_y() const { return velocity_y_; }
    const Eigen::VectorXd& displacement_y() const { return displacement_y_; }
    void clear_water(Eigen::VectorXd& vector) const;       ///< zeros on the water's unknowns; nothing without water
    SparseMatrix of_dam(const SparseMatrix& matrix) const; ///< without rows and columns of the water
    /// M_dam: the mass of the dam alone, without added mass, water and rock. Rayleigh's damping a_M M_dam is the dam's.
    SparseMatrix dam_mass() const;
    /// Makes M x, a product of mass(), M_dam x.
    void leave_dam_mass(Eigen::VectorXd& product, const Eigen::VectorXd& x) const;
    const Eigen::VectorXd& inertia_x() const { return inertia_x_; }
    const Eigen::VectorXd& inertia_y() const { return inertia_y_; }
    const Eigen::VectorXd& dam_inertia_x() const { return dam_inertia_x_; } ///< M_dam r, horizontal ...
    const Eigen::VectorXd& dam_inertia_y() const { return dam_inertia_y_; } ///< ... and vertical
    /// Pressures on a floor that is the rock's (FluidModel::floor), by their places in the order; empty: none. Their nodes are the
    /// last floor_nodes() of the inner ones.
    const std::vector<Eigen::Index>& floor() const { return floor_; }
    int floor_nodes() const { return floor_nodes_; }
    bool has_rock() const { return rock_factor_.has_value(); }
    /// With finite sliding over rock: the rock's contact nodes are the whole line of the plane, past heel and toe.
    bool slides_far() const { return slides_far_; }
    bool matching() const { return has_rock() && !pairing_; } ///< each dam node stays opposite one of the rock's
    const Pairing& pairing() const { return *pairing_; }      ///< where not matching()
    /// P of a dam that has slid: what the rock's contact nodes give to the gaps of all pairs, g = D q - P r, 2m x 2n.
    Pairing::Matrix trace(double slip) const;
    Eigen::Index rock_nodes() const { return rock_count_; }                       ///< on the plane, n; 0: rigid base
    const Eigen::MatrixXd& rock_stiffness() const { return rock_stiffness_; }     ///< K_c on the plane, 2n
    const Eigen::MatrixXd& rock_flexibility() const { return rock_flexibility_; } ///< K_c⁻¹
    const InterfaceFactor& static_factor() const { return *static_factor_; }      ///< of the dam's K, floating

    std::size_t rock_bytes() const; ///< of its factor and the two dense matrices; 0 for a rigid base

    Eigen::Index dam_unknowns() const { return mass_.rows(); } ///< and the water's
    Eigen::Index inner_unknowns() const { return 2 * order_.inner; }
    /// The dam's part of a vector on all unknowns of the model, in its node order.
    Eigen::VectorXd to_order(const Eigen::VectorXd& all) const;
    /// The same with the rock's part; and back. @param all  RockBody::moving; on all unknowns of the model
    Eigen::VectorXd with_rock_to_order(const Eigen::VectorXd& all) const;
    Eigen::VectorXd with_rock_to_model(const Eigen::VectorXd& ordered) const;
    SplitLoad split(const Eigen::VectorXd& load) const; ///< of a load on all unknowns of the model
    /// On the rock when the trace of its displacements on the pairs is `trace`.
    Eigen::VectorXd rock_load(const SplitLoad& load, const Pairing::Matrix& trace) const;
    /// Displacements of all unknowns of the model from those of the dam (in its order) and of the rock's contact nodes
    /// (plane), under a load on the rock's inside.
    Eigen::VectorXd assemble(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock,
                             const Eigen::VectorXd& load) const;

private:
    void condense_rock(const std::vector<int>& contact_nodes);
    void order_water(const SparseMatrix& pattern);
    void find_anchors();
    void find_ties();
    void clear_rock(Eigen::VectorXd& vector) const;

    const Model& model_;
    const WaterBody* water_;
    ContactPlanes planes_;
    std::vector<Tie> ties_;
    ContactPlanes::Matrix gaps_;
    NodeOrder order_, rock_order_;
    std::vector<Eigen::Index>
        anchor_; ///< by node in the dam's order: first unknown of the node that stands for its block
    SparseMatrix stiffness_, mass_, added_mass_, gyration_;
    Eigen::VectorXd inertia_x_, inertia_y_, dam_inertia_x_, dam_inertia_y_, velocity_x_, velocity_y_, displacement_y_;
    std::vector<Eigen::Index> water_nodes_, rock_nodes_; ///< in the dam's order
    std::vector<Eigen::Index> floor_;
    int floor_nodes_ = 0;
    SparseMatrix edge_damping_;
    bool rock_moves_ = false;
    Eigen::Index size_ = 0;                                     ///< unknowns
    Eigen::VectorXd extended(const Eigen::VectorXd& dam) const; ///< zeros for what stands behind it
    std::optional<InterfaceFactor> static_factor_, rock_factor_;
    std::optional<Pairing> pairing_;
    bool slides_far_ = false;
    Eigen::Index rock_count_ = 0;
    Eigen::MatrixXd rock_stiffness_, rock_flexibility_;
    bool regular_ = false;
    FewRows of_added_mass_; ///< of the wet face's nodes alone
};

/// Lowest natural frequencies of the dam bonded to its massless rock, or to a rigid base, ascending [rad/s]: those of
/// natural_modes() of the same structure built tied, from the factor of the dam and the condensed rock that are there already.
///
/// Lanczos on K⁻¹M in the product of M with every vector made orthogonal again; with [r, r²/gap] of Kato and Temple the
/// relative error of 1/ω² is 1e-13 at most.
///
/// @param structure  of one plane, without acoustic water, each dam node opposite one of the rock's, the mass consistent
/// @returns nothing where the structure is another or `count` have not converged: natural_modes() then tells more
std::optional<Eigen::VectorXd> tied_frequencies(const ContactStructure& structure, int count);

/// coupled_pencil() of the same dam tied to its massless rock, with the condensed rock that is there already: dam and water are its only
/// unknowns.
/// @param structure  of one plane on rock, each dam node opposite one of the rock's
/// @returns nothing where the structure is another
std::optional<CoupledPencil> tied_pencil(const ContactStructure& structure, const FluidModel& water);

} // namespace damslip::fe2d
