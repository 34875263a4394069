#pragma once

#include <Eigen/Core>

namespace damslip::fe2d {

/// Tangential penalty of constant stiffness in front of Coulomb's law: a sticking pair gives way by -λ_t / (k A), the
/// slip is what goes beyond it. The same contact problem with V' = V (I + C V)⁻¹ = (W + C)⁻¹, so the penalty's error is
/// what a run with and a run without it differ by. At k = 2e8 N/m³ (about a slip tolerance of 0.005 with 0.5 m
/// elements) it puts a spring near the first frequency under the dam; from 1e11 on it changes the slip by less than 1 %.
class ElasticStick {
public:
    ElasticStick() = default;
    /// @param stiffness   V; replaced by V'
    /// @param compliance  1/(k A) of each pair [m²/N]
    ElasticStick(Eigen::MatrixXd& stiffness, const Eigen::VectorXd& compliance);

    bool active() const { return compliance_.size() > 0; }
    /// λ⁰ of the rigid stick problem into that of V'; `elastic` is the elastic part of the tangential gaps at which λ⁰
    /// holds them, m values [m].
    void soften(Eigen::VectorXd& stuck_force, const Eigen::VectorXd& elastic) const;
    /// Elastic part of the tangential gaps, -C λ_t, m values [m].
    Eigen::VectorXd give(const Eigen::VectorXd& force) const;

private:
    Eigen::VectorXd compliance_; ///< m values
    Eigen::MatrixXd soften_;     ///< (I + V C)⁻¹
    Eigen::MatrixXd tangential_; ///< V' of the tangential gaps, 2m x m
};

} // namespace damslip::fe2d
