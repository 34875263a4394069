#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace damslip {

/// Coulomb's friction of a joint over the slip it has accumulated in both directions, as the scene's Contact gives it: one value,
/// peak and residual value, or a table; constant between two of its points, or linear.
class FrictionOverSlip {
public:
    explicit FrictionOverSlip(const Contact& contact);

    bool constant() const { return constant_; }          ///< neither residual value nor table is given
    double peak() const { return points_.front().y; }    ///< of a joint that has not slipped [-]
    double residual() const { return points_.back().y; } ///< in the end [-]
    double at(double slip) const;                        ///< [-]; at a step its value before it @param slip  >= 0 [m]

    /// The same piece by piece.
    struct Piece {
        double from_slip = 0.0; ///< [m]; two pieces from 0 on: the second holds as soon as the joint moves at all
        double friction = 0.0;  ///< there [-]
        double slope = 0.0;     ///< d mu / d slip up to the next piece [1/m]
    };
    std::vector<Piece> pieces() const;

private:
    std::vector<Point> points_; ///< x = slip [m], ascending from 0, y = mu [-]
    Interpolation path_;
    bool constant_;
};

} // namespace damslip
