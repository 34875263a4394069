#include "scene/friction_over_slip.hpp"

namespace damslip {

FrictionOverSlip::FrictionOverSlip(const Contact& contact)
    : points_(contact.friction_table), path_(contact.residual_path),
      constant_(contact.friction_table.empty() && !contact.residual_friction)
{
    if (!points_.empty()) return;
    points_.push_back({0.0, contact.friction});
    if (contact.residual_friction) points_.push_back({contact.residual_slip, *contact.residual_friction});
}

double FrictionOverSlip::at(double slip) const
{
    if (slip <= points_.front().x) return points_.front().y;
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
        const Point &a = points_[k], &b = points_[k + 1];
        if (slip >= b.x) continue;
        return path_ == Interpolation::steps ? a.y : a.y + (slip - a.x) / (b.x - a.x) * (b.y - a.y);
    }
    return points_.back().y;
}

std::vector<FrictionOverSlip::Piece> FrictionOverSlip::pieces() const
{
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        Piece piece{i == 0 ? 0.0 : points_[i].x, points_[i].y, 0.0};
        const bool last = i + 1 == points_.size();
        if (path_ == Interpolation::linear && !last && points_[i + 1].x > points_[i].x)
            piece.slope = (points_[i + 1].y - points_[i].y) / (points_[i + 1].x - points_[i].x);
        pieces.push_back(piece);
    }
    return pieces;
}

} // namespace damslip
