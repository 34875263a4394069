#include "sliding/flexible/flexible_mode.hpp"

#include "core/text.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/roots.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_motion.hpp"
#include "sliding/loads/added_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace damslip::sliding {

Oscillator::Oscillator(double omega, double damping, double inertia)
    : stiffness_(omega * omega), damping_(2.0 * damping * omega), decay_(damping * omega / inertia),
      square_(stiffness_ / inertia - decay_ * decay_), free_stiffness_(stiffness_ / inertia)
{
}

ModeState Oscillator::after(const ModeState& now, double p0, double p1, double h) const
{
    // Particular solution, linear in time; the rest is free.
    const double v_p = p1 / stiffness_;
    const double x_p = (p0 - damping_ * v_p) / stiffness_;
    const double x = now.x - x_p, v = now.v - v_p;
    double even = 1.0, odd = h; // cos(d h), sin(d h)/d
    const double d = std::sqrt(std::abs(square_));
    if (d * h > 1e-8) {
        even = square_ > 0.0 ? std::cos(d * h) : std::cosh(d * h);
        odd = (square_ > 0.0 ? std::sin(d * h) : std::sinh(d * h)) / d;
    }
    const double fade = std::exp(-decay_ * h);
    return {x_p + v_p * h + fade * (x * even + (v + decay_ * x) * odd),
            v_p + fade * (v * even - (free_stiffness_ * x + decay_ * v) * odd)};
}

namespace {

/// Integral of y^p over the part of the polygon between two levels, 0 <= low: by Green the integrals of x y^p dy along the
/// edges, closed for straight ones.
double power_moment(const Polyline& polygon, double p, double low, double high)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y == b.y || (a.y <= 0.0 && b.y <= 0.0)) continue;
        const double slope = (b.x - a.x) / (b.y - a.y), x0 = a.x - slope * a.y; // x = x0 + slope y
        const double from = std::clamp(a.y, low, high), to = std::clamp(b.y, low, high);
        sum += x0 * (std::pow(to, p + 1) - std::pow(from, p + 1)) / (p + 1) +
               slope * (std::pow(to, p + 2) - std::pow(from, p + 2)) / (p + 2);
    }
    return sum;
}

/// The same of the concrete of a section.
double power_moment(const Section& section, double p)
{
    double sum = 0.0;
    for (const ShareBand& band : share_bands(section.thickness)) {
        const double low = std::max(0.0, band.from), high = band.to;
        if (!(high > low)) continue;
        sum += band.constant * power_moment(section.polygon, p, low, high);
        if (band.slope != 0.0) sum += band.slope * power_moment(section.polygon, p + 1, low, high);
    }
    return sum;
}

/// Sums of n_x^2 m_n psi^k dS over the wet face, by midpoints in the square root of the depth (the mass begins with a root
/// there): 1e-6.
void add_water(const Scene& scene, double exponent, double height, ModalSums& sums)
{
    if (!has_water(scene) || scene.reservoir->model == ReservoirModel::hydrostatic) return;
    const WaterColumn water{scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus};
    const Polyline face = upstream_face(scene.section);
    constexpr int panels = 4000;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const Point lower = face[i].y <= face[i + 1].y ? face[i] : face[i + 1],
                    upper = face[i].y <= face[i + 1].y ? face[i + 1] : face[i];
        const double top = std::min(upper.y, water.depth), bottom = std::max(lower.y, 0.0);
        if (!(top > bottom)) continue;
        const double lean = (face[i + 1].x - face[i].x) / (face[i + 1].y - face[i].y), phi = std::atan(lean);
        const double along = std::sqrt(1.0 + lean * lean), n_x2 = 1.0 / (along * along);
        const double r0 = std::sqrt(water.depth - top), r1 = std::sqrt(water.depth - bottom);
        for (int k = 0; k < panels; ++k) { // midpoints in r = sqrt(z), dy = 2 r dr
            const double r = r0 + (r1 - r0) * (k + 0.5) / panels, y = water.depth - r * r;
            const double m =
                added_mass_per_area(scene.added_mass, water, r * r, phi) * n_x2 * along * 2.0 * r * (r1 - r0) / panels;
            const double psi = std::pow(std::max(y, 0.0) / height, exponent);
            sums.load += m * psi;
            sums.mass += m * psi * psi;
        }
    }
    sums.total += scene_added_mass(scene, scene.reservoir->level).xx;
}

} // namespace

ModalSums power_shape(const Scene& scene, double exponent)
{
    const double height = crest_level(scene.section), density = scene.dam.density;
    ModalSums sums;
    sums.load = density * power_moment(scene.section, exponent) / std::pow(height, exponent);
    sums.mass = density * power_moment(scene.section, 2 * exponent) / std::pow(height, 2 * exponent);
    sums.total = density * area(scene.section);
    add_water(scene, exponent, height, sums);
    return sums;
}

namespace {

using std::numbers::pi;
constexpr int most_iterations = 200;

double radiation_damping(const StrainColumn& column, double velocity)
{
    if (column.base_velocity <= 0.0) return 0.0;
    return std::min(0.2, 0.55016 * std::pow(column.base_velocity / velocity, -0.9904));
}

/// 0.62 (G/G_0)^0.1 of Masing's hysteresis of the hyperbola, and 1 % at no strain. @param ratio  gamma/gamma_r, > 0
double material_damping(double ratio)
{
    const double masing = 1.0 / pi * (4.0 * (ratio - std::log1p(ratio)) * (1.0 + ratio) / (ratio * ratio) - 2.0);
    return 0.62 * std::pow(1.0 + ratio, -0.1) * masing + 0.01;
}

FlexibleBlock mode_of(const StrainColumn& column, double velocity, double damping, double mass_ratio)
{
    return {4.0 * column.height / velocity, std::min(0.5, damping), mass_ratio};
}

/// Largest |x| at the samples and one period after them [m].
double largest_deflection(const FlexibleBlock& block, const GroundMotion& motion)
{
    if (motion.accel_h.empty()) return 0.0;
    const double omega = 2.0 * pi / block.period;
    const Oscillator mode(omega, block.damping_ratio, 1.0);
    ModeState state;
    double largest = 0.0;
    const std::vector<double>& a = motion.accel_h;
    for (std::size_t k = 0; k + 1 < a.size(); ++k) {
        state = mode.after(state, a[k], (a[k + 1] - a[k]) / motion.dt, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    for (double t = 0.0; t < block.period; t += motion.dt) {
        state = mode.after(state, 0.0, 0.0, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    return largest;
}

} // namespace

StrainCompatible strain_compatible(const StrainColumn& column, const GroundMotion& motion, double mass_ratio,
                                   double tolerance)
{
    StrainCompatible now;
    now.velocity = column.velocity;
    double material = column.damping;
    now.block = mode_of(column, now.velocity, material + radiation_damping(column, now.velocity), mass_ratio);
    const auto strain = [&] { return 0.65 * 1.57 * 4.0 / pi * largest_deflection(now.block, motion) / column.height; };
    if (column.reference_strain <= 0.0) {
        now.strain = strain();
        return now;
    }
    now.settled = false;
    while (!now.settled && now.iterations < most_iterations) {
        ++now.iterations;
        now.strain = strain();
        const double ratio = std::max(1e-9, now.strain / column.reference_strain);
        double velocity = column.velocity / std::sqrt(1.0 + ratio), damping = material_damping(ratio);
        now.settled = std::abs(1.0 - velocity * velocity / (now.velocity * now.velocity)) <= tolerance &&
                      std::abs(1.0 - damping / material) <= tolerance;
        if (!now.settled && now.iterations > most_iterations / 4) { // it goes to and fro between two peaks: half steps
            velocity = 0.5 * (velocity + now.velocity);
            damping = 0.5 * (damping + material);
        }
        now.velocity = velocity;
        material = damping;
        now.block = mode_of(column, velocity, material + radiation_damping(column, velocity), mass_ratio);
    }
    return now;
}

/// A rigid block under the average acceleration k of a mass whose vibration does not know of the slip, and its advance.
/// Used by slide_decoupled().
///
/// Between two samples k = a_h + Gamma r is a line and a free vibration r = -x''. The block takes it in pieces, in each as
/// the line with k's own mean and first moment: integrated once and twice that line is k's closed form, so the rate and
/// the path at the end of a piece without an event are exact, however long the piece. Where something may start, stop or
/// change the piece is halved until k differs from the line by 1e-6 of its size at most.
class DecoupledMotion {
public:
    /// @param stages  kept by the caller for as long as this lives
    DecoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlideOptions& options);

    /// Ground acceleration linear from a_h.now, a_v.now at `start` to the ends at start + dt.
    void cross(double start, double dt, const Line& a_h, const Line& a_v);

    /// True when the block rests and what is left of the vibration cannot move it on quiet ground.
    bool at_rest_for_good() const;
    double average_acceleration(double a_h) const; ///< k now [m/s^2]
    double peak_acceleration() const { return peak_acceleration_; }
    const SlipMotion& block() const { return block_; }

private:
    /// A part of a sample interval.
    struct Piece {
        double start = 0.0, length = 0.0;
        Line a_h, a_v;
        ModeState begin, end; ///< of the mode
        int halvings = 0;
    };
    /// What a piece's k is like.
    struct Course {
        Line k;           ///< at its ends
        double vibration; ///< bound of |r| [m/s^2]
        double bend;      ///< bound of the distance of k from its chord [m/s^2]
    };

    Course course_of(const Piece& piece) const;
    Line line_of(const Piece& piece, const Course& course) const;
    bool halve_again(const Piece& piece, const Course& course) const;
    bool rests_through(const Piece& piece, const Course& course) const;
    bool may_stop_unseen(const Piece& piece, const Course& course, const Line& line, double lowest_rate) const;
    void take(const Piece& piece);
    void take_halves(const Piece& piece);
    void look_for_peak(const Piece& piece);
    std::pair<Piece, Piece> halves_of(const Piece& piece) const;
    double vibration(const ModeState& state, double a_h, double a_h_rate) const;

    FlexibleBlock flexible_;
    double omega_;
    Oscillator mode_;
    SlipMotion block_, before_;  ///< before_: at the start of the piece being taken
    double factor_ = 1.0;        ///< largest slip acceleration per excess ground acceleration [-]
    double yield_per_a_v_ = 0.0; ///< largest change of the yield with a_v [-]

    ModeState state_;
    double peak_acceleration_ = 0.0;
};

namespace {

constexpr double straight = 1e-6;   ///< of |k|: so little bent a piece is a line, events included
constexpr int most_halvings = 24;   ///< where k itself is nothing
constexpr double peak_found = 1e-9; ///< of the peak: so little can still be above it

} // namespace

DecoupledMotion::DecoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlideOptions& options)
    : flexible_(flexible), omega_(2.0 * std::numbers::pi / flexible.period), mode_(omega_, flexible.damping_ratio, 1.0),
      block_(stages, options), before_(block_)
{
    for (const SlipStage& stage : stages)
        for (const Yield& yield : {yield_downstream(stage.block), yield_upstream(stage.block)}) {
            factor_ = std::max(factor_, yield.factor);
            yield_per_a_v_ = std::max(yield_per_a_v_, std::abs(yield.law.per_a_v));
        }
}

double DecoupledMotion::average_acceleration(double a_h) const
{
    return (1.0 - flexible_.mass_ratio) * a_h + flexible_.mass_ratio * mode_.restoring(state_);
}

/// Bound of |r| from now on, while the ground acceleration stays on its line: r'' + 2 zeta omega r' + omega^2 r = 0, so
/// r^2 + (r'/omega)^2 does not grow.
double DecoupledMotion::vibration(const ModeState& state, double a_h, double a_h_rate) const
{
    const double r = mode_.restoring(state) - a_h;
    const double r_rate = omega_ * omega_ * state.v - 2.0 * flexible_.damping_ratio * omega_ * r - a_h_rate;
    return std::hypot(r, r_rate / omega_);
}

DecoupledMotion::Course DecoupledMotion::course_of(const Piece& p) const
{
    const double gamma = flexible_.mass_ratio, turn = omega_ * p.length;
    Course c;
    c.k = {(1.0 - gamma) * p.a_h.now + gamma * mode_.restoring(p.begin),
           (1.0 - gamma) * p.a_h.end + gamma * mode_.restoring(p.end)};
    c.vibration = vibration(p.begin, p.a_h.now, (p.a_h.end - p.a_h.now) / p.length);
    // |r''| <= omega^2 (1 + 2 zeta) |r| of the bound: a chord is off by h^2/8 of it, and never by more than 2 |r|.
    c.bend = gamma * c.vibration * std::min((1.0 + 2.0 * flexible_.damping_ratio) * turn * turn / 8.0, 2.0);
    return c;
}

/// The line whose integral and double integral over the piece are those of k = a_h - Gamma x''.
Line DecoupledMotion::line_of(const Piece& p, const Course& c) const
{
    const double h = p.length, gamma = flexible_.mass_ratio;
    const double mean = 0.5 * (p.a_h.now + p.a_h.end) - gamma * (p.end.v - p.begin.v) / h;
    // First moment about the middle: Gamma (x1 - x0 - h (v0 + v1)/2) besides that of a_h. In very short pieces the
    // difference is round-off, and the chord's rise the same but for (omega h)^2/10.
    double rise = c.k.end - c.k.now;
    if (omega_ * h > 1e-3)
        rise = p.a_h.end - p.a_h.now + 12.0 * gamma * (p.end.x - p.begin.x - 0.5 * h * (p.begin.v + p.end.v)) / (h * h);
    return {mean - 0.5 * rise, mean + 0.5 * rise};
}

bool DecoupledMotion::halve_again(const Piece& p, const Course& c) const
{
    return p.halvings < most_halvings && c.bend > straight * std::max(std::abs(c.k.now), std::abs(c.k.end));
}

bool DecoupledMotion::rests_through(const Piece& p, const Course& c) const
{
    const auto [k_min, k_max] = std::minmax(c.k.now, c.k.end);
    const auto [v_min, v_max] = std::minmax(p.a_v.now, p.a_v.end);
    return block_.stays_at_rest(k_min - c.bend, k_max + c.bend, v_min, v_max);
}

/// Could the rate of a moving block touch zero within a piece in which the line saw no stop? Under the line it lies above
/// its lower end less h^2/8 of its largest bow; under k it is off by what r and its line can bring apart.
bool DecoupledMotion::may_stop_unseen(const Piece& p, const Course& c, const Line& line, double lowest_rate) const
{
    const double bow = std::abs(line.end - line.now) + yield_per_a_v_ * std::abs(p.a_v.end - p.a_v.now);
    const double apart = std::min(c.bend * p.length, 8.0 * flexible_.mass_ratio * c.vibration / omega_);
    return lowest_rate < factor_ * (0.125 * p.length * bow + apart);
}

void DecoupledMotion::cross(double start, double dt, const Line& a_h, const Line& a_v)
{
    const double slope = (a_h.end - a_h.now) / dt;
    const Piece whole{start, dt, a_h, a_v, state_, mode_.after(state_, a_h.now, slope, dt), 0};
    take(whole);
    look_for_peak(whole);
    state_ = whole.end;
}

void DecoupledMotion::take(const Piece& p)
{
    const Course c = course_of(p);
    if (block_.unresolved() || rests_through(p, c)) return;
    const Line line = line_of(p, c);
    if (!halve_again(p, c)) {
        block_.cross(p.start, p.length, line, p.a_v);
        return;
    }
    if (block_.on_base() && may_stop_unseen(p, c, line, block_.rate())) { // at rest too
        take_halves(p);
        return;
    }
    before_ = block_;
    block_.cross(p.start, p.length, line, p.a_v);
    const bool eventful = block_.changes() != before_.changes();
    const bool faster_between = block_.peak_rate() > std::max({before_.peak_rate(), before_.rate(), block_.rate()});
    if (eventful || faster_between || (block_.moving() && may_stop_unseen(p, c, line, block_.rate()))) {
        block_ = before_;
        take_halves(p);
    }
}

std::pair<DecoupledMotion::Piece, DecoupledMotion::Piece> DecoupledMotion::halves_of(const Piece& p) const
{
    const double h = 0.5 * p.length, slope = (p.a_h.end - p.a_h.now) / p.length;
    const double a_h = p.a_h.at(0.5), a_v = p.a_v.at(0.5);
    const ModeState middle = mode_.after(p.begin, p.a_h.now, slope, h);
    return {{p.start, h, {p.a_h.now, a_h}, {p.a_v.now, a_v}, p.begin, middle, p.halvings + 1},
            {p.start + h, h, {a_h, p.a_h.end}, {a_v, p.a_v.end}, middle, p.end, p.halvings + 1}};
}

void DecoupledMotion::take_halves(const Piece& p)
{
    const auto [first, second] = halves_of(p);
    take(first);
    take(second);
}

/// Branch and bound: only pieces that can exceed the peak so far are looked into.
void DecoupledMotion::look_for_peak(const Piece& p)
{
    const Course c = course_of(p);
    const double at_ends = std::max(std::abs(c.k.now), std::abs(c.k.end));
    peak_acceleration_ = std::max(peak_acceleration_, at_ends);
    if (p.halvings == most_halvings || at_ends + c.bend <= (1.0 + peak_found) * peak_acceleration_) return;
    const auto [first, second] = halves_of(p);
    look_for_peak(first);
    look_for_peak(second);
}

bool DecoupledMotion::at_rest_for_good() const
{
    const double k = flexible_.mass_ratio * vibration(state_, 0.0, 0.0);
    return block_.at_rest() && block_.stays_at_rest(-k, k, 0.0, 0.0);
}

FlexibleSlide slide_decoupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                              const SlideOptions& options)
{
    check_flexible(flexible, stages);
    check_motion(motion);
    const bool vertical = !motion.accel_v.empty();
    const double dt = motion.dt, longest = options.sliding.run_out_max;
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };

    FlexibleSlide result;
    DecoupledMotion mass(stages, flexible, options);
    const auto note = [&](double time, double a_h_now, double a_v_now) {
        if (options.history == HistoryOutput::samples)
            mass.block().add_sample(time, mass.average_acceleration(a_h_now), a_v_now, result.slide.history);
    };
    note(0.0, a_h(0), a_v(0));
    const std::size_t last = motion.accel_h.size() - 1;
    for (std::size_t k = 0; k < last; ++k) {
        mass.cross(static_cast<double>(k) * dt, dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        note(static_cast<double>(k + 1) * dt, a_h(k + 1), a_v(k + 1));
    }
    const double end = static_cast<double>(last) * dt;
    const bool stands = static_state(stages.front().block) == StaticState::at_rest;
    for (double t = 0.0; stands && t < longest && !mass.at_rest_for_good(); t += dt) {
        mass.cross(end + t, std::min(dt, longest - t), {}, {});
        note(end + std::min(t + dt, longest), 0.0, 0.0);
    }
    conclude(mass.block(), stages, options, end, result.slide);
    result.peak_acceleration = mass.peak_acceleration();
    if (result.slide.status == Status::at_rest && !mass.at_rest_for_good()) note_vibration(options, result.slide);
    return result;
}

} // namespace damslip::sliding
