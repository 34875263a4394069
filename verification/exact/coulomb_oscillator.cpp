#include "verification/exact/coulomb_oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::exact {

double CoulombOscillator::amplitude() const
{
    const double r = drive / frequency, v = 1.0 / (1.0 - r * r), angle = std::numbers::pi / r;
    const double u = std::sin(angle) / (r * (1.0 + std::cos(angle)));
    return std::sqrt(v * v - friction * friction * u * u);
}

CoulombMotion::CoulombMotion(const CoulombOscillator& oscillator, double duration)
    : o_(oscillator), response_(1.0 / (1.0 - std::pow(oscillator.drive / oscillator.frequency, 2))), duration_(duration)
{
    pieces_.push_back(next(0.0, 0.0));
    for (double t = end_of(pieces_.back()); t < duration; t = end_of(pieces_.back()))
        pieces_.push_back(next(t, displacement(pieces_.back(), t)));
}

double CoulombMotion::displacement(const Piece& p, double t) const
{
    if (p.direction == 0.0) return p.offset;
    const double phase = o_.frequency * (t - p.start);
    return response_ * std::cos(o_.drive * t) + p.offset + p.cosine * std::cos(phase) + p.sine * std::sin(phase);
}

double CoulombMotion::velocity(const Piece& p, double t) const
{
    if (p.direction == 0.0) return 0.0;
    const double phase = o_.frequency * (t - p.start);
    return -response_ * o_.drive * std::sin(o_.drive * t) +
           o_.frequency * (p.sine * std::cos(phase) - p.cosine * std::sin(phase));
}

/// The piece that begins at rest at u.
CoulombMotion::Piece CoulombMotion::next(double t, double u) const
{
    const double net = std::cos(o_.drive * t) - u;
    const bool breaks_away = !pieces_.empty() && pieces_.back().direction == 0.0;
    if (!breaks_away && std::abs(net) <= o_.friction) return {t, 0.0, u, 0.0, 0.0};
    const double direction = net > 0.0 ? 1.0 : -1.0, offset = -direction * o_.friction;
    return {t, direction, offset, u - offset - response_ * std::cos(o_.drive * t),
            response_ * o_.drive * std::sin(o_.drive * t) / o_.frequency};
}

/// First zero of the velocity, or of what is left of the friction; looked for in steps of 1/1000 of the shorter period.
double CoulombMotion::end_of(const Piece& piece) const
{
    const auto left = [&](double t) {
        return piece.direction == 0.0 ? o_.friction - std::abs(std::cos(o_.drive * t) - piece.offset)
                                      : piece.direction * velocity(piece, t);
    };
    const double step = 2.0 * std::numbers::pi / std::max(o_.frequency, o_.drive) / 1000.0;
    double before = piece.start, after = before + step;
    while (left(after) > 0.0 && after < duration_) {
        before = after;
        after += step;
    }
    for (int k = 0; k < 100 && before < after; ++k) {
        const double middle = 0.5 * (before + after);
        (left(middle) > 0.0 ? before : after) = middle;
    }
    return after;
}

const CoulombMotion::Piece& CoulombMotion::piece_at(double t) const
{
    const auto later =
        std::upper_bound(pieces_.begin() + 1, pieces_.end(), t, [](double at, const Piece& p) { return at < p.start; });
    return *(later - 1);
}

double CoulombMotion::displacement(double t) const
{
    return displacement(piece_at(t), t);
}

double CoulombMotion::velocity(double t) const
{
    return velocity(piece_at(t), t);
}

int CoulombMotion::stops(double from, double to) const
{
    return static_cast<int>(std::count_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) {
        return p.direction == 0.0 && p.start >= from && p.start < to;
    }));
}

double CoulombMotion::largest(double from, double to) const
{
    double result = 0.0;
    for (const Piece& p : pieces_)
        if (p.start >= from && p.start <= to) result = std::max(result, std::abs(displacement(p, p.start)));
    return result;
}

} // namespace damslip::exact
