#include "analysis/screen/planes.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/screen/screening.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace damslip {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// What a combination changes of water and strength, as far as lifts and seams can follow it.
bool changes_planes(const Scene& scene, const Combination& c)
{
    const auto other = [](const std::optional<double>& level, const auto& water) {
        return level && *level != water->level;
    };
    return other(c.reservoir_level, scene.reservoir) || other(c.tailwater_level, scene.tailwater) || !c.drains_effective ||
           c.friction_divisor != 1.0 || c.cohesion_divisor != 1.0;
}

void divide(Contact& strength, const Combination& c)
{
    strength.friction /= c.friction_divisor;
    if (strength.residual_friction) *strength.residual_friction /= c.friction_divisor;
    for (Point& p : strength.friction_table) p.y /= c.friction_divisor;
    strength.cohesion /= c.cohesion_divisor;
}

Scene in_combination(Scene scene, const Combination& c)
{
    if (c.reservoir_level) scene.reservoir->level = *c.reservoir_level; // levels are of water that the scene has (check_water.cpp)
    if (c.tailwater_level) scene.tailwater->level = *c.tailwater_level;
    if (!c.drains_effective) {
        if (scene.drains) scene.drains->efficiency = 0.0;
        if (scene.lifts) scene.lifts->drains_efficiency = 0.0;
    }
    if (scene.lifts) divide(scene.lifts->strength, c);
    for (LiftJoint& joint : scene.lift_joints) divide(joint.strength, c);
    for (Seam& seam : scene.seams) {
        divide(seam.strength, c);
        seam.interface.friction /= c.friction_divisor;
        seam.interface.cohesion /= c.cohesion_divisor;
        if (!seam.wedge) continue;
        seam.wedge->friction /= c.friction_divisor;
        seam.wedge->cohesion /= c.cohesion_divisor;
    }
    return scene;
}

/// A state that factors are asked for, and the scene in it where that differs.
struct FoundState {
    PlaneState state;
    std::optional<Scene> own = {};
};

/// The combinations before the earthquake's end: of the rows with and without crack the least factor of the base.
std::vector<FoundState> states_of(const Scene& scene, const std::vector<sliding::Equilibrium>& combinations)
{
    std::vector<FoundState> states;
    for (const sliding::Equilibrium& e : combinations) {
        if (e.kind == CombinationKind::post_seismic) continue;
        const std::string name = e.name.substr(0, e.name.rfind(", cracked"));
        auto found = std::find_if(states.begin(), states.end(), [&](const FoundState& s) { return s.state.ground.name == name; });
        if (found == states.end()) {
            const sliding::GroundState ground{name, e.k_h * units::standard_gravity, e.k_v * units::standard_gravity};
            found = states.insert(states.end(), FoundState{PlaneState{ground, {}, {}}});
            for (const Combination& c : scene.combinations)
                if (c.name == name && changes_planes(scene, c)) found->own = in_combination(scene, c);
        }
        PlaneState& state = found->state;
        if (std::isfinite(e.sliding_factor)) state.of_base = std::min(state.of_base.value_or(infinite), e.sliding_factor);
        for (const sliding::Check& check : e.checks)
            if (check.quantity.starts_with("sliding, peak") && check.required)
                state.required = std::max(state.required.value_or(0.0), *check.required);
    }
    return states;
}

/// The first combination without an earthquake at the scene's own water and strength, those with others, and the one with the largest k_h.
std::vector<FoundState> plane_states(const Scene& scene, const std::vector<sliding::Equilibrium>& combinations)
{
    const auto moves = [](const FoundState& s) { return s.state.ground.a_h != 0.0 || s.state.ground.a_v != 0.0; };
    std::vector<FoundState> all = states_of(scene, combinations), states;
    const auto still = std::find_if(all.begin(), all.end(), [&](const FoundState& s) { return !s.own && !moves(s); });
    const auto shaken = std::max_element(all.begin(), all.end(), [](const FoundState& a, const FoundState& b) {
        return a.state.ground.a_h < b.state.ground.a_h;
    });
    states.push_back(still != all.end() ? *still : FoundState{PlaneState{{"static"}, {}, {}}});
    for (auto s = all.begin(); s != all.end(); ++s)
        if (s->own && s != shaken) states.push_back(*s);
    if (shaken != all.end() && (shaken->state.ground.a_h > 0.0 || shaken->own)) states.push_back(*shaken);
    return states;
}

/// Of the scene's load combinations those that say what lifts and seams do not follow.
std::vector<std::string> of_base_alone(const Scene& scene)
{
    const auto more = [](const Combination& c) {
        const double factors[]{c.weight_factor, c.water_factor, c.uplift_factor, c.silt_factor, c.ice_factor};
        return !c.curtain_intact || c.residual_strength || c.gates_open || c.friction || c.cohesion || !c.k_profile.empty() ||
               std::any_of(std::begin(factors), std::end(factors), [](double factor) { return factor != 1.0; });
    };
    std::vector<std::string> names;
    for (const Combination& c : scene.combinations)
        if (c.kind != CombinationKind::post_seismic && more(c)) names.push_back(fmt::format("\"{}\"", c.name));
    return names;
}

/// Adds the factors of a state whose scene differs. @param place  of the state among all @param modes  as of lift_planes()
void add_own_state(const FoundState& found, std::size_t place, std::span<const sliding::LiftAmplification> modes, Planes& planes)
{
    const std::vector<sliding::GroundState> grounds{{"static"}, found.state.ground};
    const auto at = [place](auto& values) { return values.begin() + static_cast<std::ptrdiff_t>(place); };
    if (!planes.lifts.empty()) {
        std::vector<sliding::LiftPlane> lifts = sliding::lift_planes(*found.own, grounds, modes);
        for (std::size_t i = 0; i < lifts.size(); ++i)
            planes.lifts[i].states.insert(at(planes.lifts[i].states), std::move(lifts[i].states.back()));
    }
    for (std::size_t i = 0; i < planes.seams.size(); ++i) {
        const sliding::SeamPlane own = sliding::seam_plane(*found.own, found.own->seams[i], grounds);
        sliding::SeamPlane& seam = planes.seams[i];
        seam.factors.insert(at(seam.factors), own.factors.back());
        for (sliding::WedgeTrial& trial : seam.trials) { // the minima of the searches differ: no factor there, the status next to it
            auto next = std::ranges::lower_bound(own.trials, trial.angle, {}, &sliding::WedgeTrial::angle);
            const bool tried = next != own.trials.end() && next->angle == trial.angle;
            if (next == own.trials.end()) --next;
            trial.factors.insert(at(trial.factors), tried ? next->factors.back() : std::numeric_limits<double>::quiet_NaN());
            trial.statuses.insert(at(trial.statuses), next->statuses.back());
        }
    }
}

std::optional<double> finite(double x)
{
    return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

/// A plane to slide on, beside its row.
struct Sliding {
    PlaneRow row;
    RigidModel model;
};

Sliding of_lift(sliding::LiftPlane& lift, std::size_t place)
{
    Sliding s{{.kind = PlaneKind::lift, .name = lift.name, .place = place}, plane_model(lift)};
    for (const sliding::LiftState& state : lift.states) s.row.factors.push_back(finite(state.factor));
    s.row.yield = lift.yield_of_ground;
    s.row.amplification = lift.mean_amplification;
    s.row.slip_factor = s.model.downstream.factor * lift.mean_amplification;
    s.row.stands = s.model.state == sliding::StaticState::at_rest;
    return s;
}

Sliding of_seam(sliding::SeamPlane& seam, std::size_t place)
{
    Sliding s{{.kind = PlaneKind::seam, .name = seam.name, .place = place}, plane_model(seam)};
    for (const sliding::SeamFactor& factor : seam.factors) s.row.factors.push_back(finite(factor.factor));
    s.row.angle = seam.angle;
    s.row.angle_factor = seam.factors.back().angle;
    s.row.yield = seam.yield;
    s.row.slip_factor = seam.slip_factor;
    s.row.stands = seam.status == sliding::ChainStatus::stands;
    return s;
}

/// Largest horizontal acceleration of the joint in a motion [m/s^2].
double joint_peak(const sliding::LiftPlane& lift, const RigidModel& model, const sliding::SkippingMotion& motion)
{
    if (!model.tied)
        return lift.joint_amplification * std::max(motion.whole().h_max, -motion.whole().h_min);
    return peak_of(sliding::joint_motions(motion.motion(), *model.tied, 4, 0.0).joint.accel_h);
}

bool stands(sliding::ChainStatus status)
{
    return status == sliding::ChainStatus::stands;
}

/// Does the wedge fall at an angle next to that of the k-th factor?
bool beside_one_that_falls(const sliding::SeamPlane& plane, std::size_t k)
{
    if (!plane.factors[k].angle) return false;
    const double angle = *plane.factors[k].angle;
    const auto next = std::ranges::lower_bound(plane.trials, angle, {}, &sliding::WedgeTrial::angle);
    const auto falls = [k](const sliding::WedgeTrial& trial) { return !stands(trial.statuses[k]); };
    const auto above = next != plane.trials.end() && next->angle == angle ? std::next(next) : next;
    return (next != plane.trials.begin() && falls(*std::prev(next))) || (above != plane.trials.end() && falls(*above));
}

void add_seam_warnings(const Scene& scene, const PlaneRow& row, const sliding::SeamPlane& plane,
                       std::vector<std::string>& warnings)
{
    const auto warn = [&](const std::string& what) {
        warnings.push_back(fmt::format("seam \"{}\": {}", row.name, what));
    };
    const auto seam = std::find_if(scene.seams.begin(), scene.seams.end(), [&](const Seam& s) { return s.name == row.name; });
    if (plane.at_end_of_range)
        warn("the least value of its wedge lies at the end of seam.wedge.search_deg; a wider range may find a lower one.");
    if (plane.wedge_left_out)
        warn(fmt::format("{} its wedge stand (its uplift carries it, or the body would have to pull on it): computed as if nothing "
                         "lay before the body.",
                         std::any_of(plane.trials.begin(), plane.trials.end(), [](const auto& t) { return stands(t.status); })
                             ? "not all angles let"
                             : "no angle lets"));
    for (std::size_t k = 0; k < plane.factors.size(); ++k)
        if (plane.factors[k].without_wedge < plane.factors[k].factor && beside_one_that_falls(plane, k))
            warn(fmt::format("the least factor {:.4g} is that of the last angle at which its wedge stands, {:.3g} degrees; at other "
                             "angles its uplift carries it, or the body would have to pull on it. Without a wedge it is {:.4g}.",
                             plane.factors[k].factor, *plane.factors[k].angle / units::degree, plane.factors[k].without_wedge));
    if (plane.status == sliding::ChainStatus::floats || plane.status == sliding::ChainStatus::opens)
        warn(fmt::format("at its yield a block {}: no PASS rests on it.", sliding::word(plane.status)));
    if (plane.status == sliding::ChainStatus::locked)
        warn("its blocks are locked, no acceleration moves them on this path: the rock breaks another way. Give a path that "
             "rises less steeply, or a [seam.wedge] whose angle is searched.");
    if (plane.angle && seam->interface.model == InterfaceModel::friction && seam->interface.friction > 0.0) {
        const double to_lock = 0.5 * std::numbers::pi - *plane.angle - std::atan(seam->wedge->friction) -
                               std::atan(seam->interface.friction);
        if (to_lock < 10.0 * units::degree)
            warn(fmt::format("its wedge is {:.3g} degrees from the lock; plane wedges with large friction between the blocks "
                             "are too strong, take seam.interface.model = \"smooth\".",
                             to_lock / units::degree));
    }
    const PlaneSlip* worst = row.worst();
    if (worst && scene.planes.geometry == PlaneGeometry::small &&
        reported(worst->slide.status, worst->slide.max_slip).value_or(0.0) > plane.valid_slip)
        warn(fmt::format("it slides {:.3g} m, beyond the {:.3g} m at which the rock that crosses the kink has changed a_y by "
                         "5 %; write  planes.geometry = \"linear\".",
                         worst->slide.max_slip, plane.valid_slip));
    for (std::size_t i = 0; i < plane.resultants.size(); ++i)
        if (plane.resultants[i] < 0.0 || plane.resultants[i] > 1.0)
            warn(fmt::format("the resultant of block {} acts outside its segment: it tips before it slides.", i + 1));
}

/// The bodies of a seam under all motions: whether they press on each other on the way, and the works in the worst run.
void add_work(const Scene& scene, Sliding& s, const std::vector<sliding::SkippingMotion>& motions, Planes& planes)
{
    const sliding::SeamPlane& plane = planes.seams[s.row.place];
    const auto warn = [&](const std::string& what) {
        planes.warnings.push_back(fmt::format("seam \"{}\": {}", s.row.name, what));
    };
    std::optional<SeamWork> worst;
    bool pulls = false, back = false, ahead = false;
    for (const sliding::SkippingMotion& motion : motions)
        for (const int polarity : {1, -1}) {
            if (motion.motion().is_sequence()) return;
            SeamWork work{s.row.name, motion.motion().name, polarity,
                          slide_bodies(scene, s.model, motion.motion(), polarity)};
            pulls = pulls || work.slide.least_pressure < 0.0;
            ahead = ahead || work.slide.partings > 0;
            back = back || (work.slide.slide.max_gap > 0.0 &&
                            plane.wedge_back < std::max(motion.whole().h_max, -motion.whole().h_min));
            if (!worst || work.slide.slide.max_slip > worst->slide.slide.max_slip) worst = std::move(work);
        }
    if (pulls && plane.of_block) return; // it lifts off, which the works do not follow
    if (pulls && scene.planes.wedge == PlaneWedge::held)
        warn("as it slows down the dam would pull on its wedge or a block on its plane: planes.wedge = \"free\" lets the wedge run "
             "ahead.");
    else if (pulls)
        warn("as it slows down its blocks would pull on each other or on their planes, which is not followed.");
    if (ahead) warn("its wedge runs ahead of the dam: it starts sooner or slows down later.");
    if (back) warn("its wedge would slide back into the gap that the dam leaves; that is not followed.");
    if (worst && worst->slide.slide.max_slip > 0.0) planes.works.push_back(std::move(*worst));
}

template <class Value>
std::size_t least(const std::vector<PlaneRow>& rows, Value&& value)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (value(rows[i]) < value(rows[best])) best = i;
    return best;
}

std::size_t largest_slip(const std::vector<PlaneRow>& rows)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const PlaneSlip *a = rows[best].worst(), *b = rows[i].worst();
        if (b && (!a || &worse(a->slide, b->slide) == &b->slide)) best = i;
    }
    return best;
}

} // namespace

const PlaneSlip* PlaneRow::worst() const
{
    const PlaneSlip* found = nullptr;
    for (const PlaneSlip& slip : slips)
        if (!found || &worse(found->slide, slip.slide) == &slip.slide) found = &slip;
    return found;
}

double margin(const PlaneRow& row, const std::vector<PlaneState>& states)
{
    double least = infinite;
    for (std::size_t i = 0; i < row.factors.size(); ++i)
        if (row.factors[i]) least = std::min(least, *row.factors[i] / states[i].required.value_or(1.0));
    return least;
}

const PlaneRow& governing(const Planes& planes, PlaneJudgement by)
{
    return planes.rows[by == PlaneJudgement::factor ? planes.by_factor : planes.by_slip];
}

namespace {

/// FAIL, undecided, PASS, none.
Verdict worse_of(Verdict a, Verdict b)
{
    const auto rank = [](Verdict x) {
        return x == Verdict::fail ? 3 : x == Verdict::undecided ? 2 : x == Verdict::pass ? 1 : 0;
    };
    return rank(b) > rank(a) ? b : a;
}

} // namespace

Verdict judge(const Planes& planes, const Scene& scene)
{
    Verdict verdict = Verdict::none;
    for (const PlaneRow& row : planes.rows)
        if (row.kind != PlaneKind::base) verdict = worse_of(verdict, judge(row, planes, scene));
    return verdict;
}

Verdict judge(const PlaneRow& row, const Planes& planes, const Scene& scene)
{
    Verdict verdict = Verdict::none;
    const auto take = [&verdict](Verdict v) { verdict = worse_of(verdict, v); };
    if (scene.planes.governs == PlaneJudgement::factor) {
        for (std::size_t i = 0; i < row.factors.size(); ++i)
            if (planes.states[i].required && row.factors[i])
                take(*row.factors[i] < *planes.states[i].required ? Verdict::fail : Verdict::pass);
    } else {
        for (const PlaneSlip& slip : row.slips) take(judge(slip.slide, scene.criteria.allowable_slip));
    }
    if (row.yield <= 0.0) return Verdict::fail; // it slides without any earthquake
    return verdict == Verdict::pass && !row.stands ? Verdict::undecided : verdict;
}

Planes find_planes(const Ready& ready, const std::vector<sliding::Equilibrium>& combinations, const RigidModel& base,
                   std::vector<PlaneSlip> slips, int jobs)
{
    Planes planes;
    Scene scene = ready.scene;
    restore_lift_joints(scene, ready.given);
    if (!scene.lifts && scene.seams.empty()) return planes;
    const std::vector<FoundState> found = plane_states(scene, combinations);
    for (const FoundState& f : found) planes.states.push_back(f.state);
    if (!scene.seams.empty() && std::any_of(scene.anchors.begin(), scene.anchors.end(), [](const Anchor& a) { return a.joint.empty(); }))
        planes.warnings.push_back("anchors through the base do not count on seams: how far they reach down is not known.");
    if (std::any_of(scene.anchors.begin(), scene.anchors.end(),
                    [](const Anchor& a) { return !a.joint.empty() && a.limit_force == AnchorForceRule::yield; }))
        planes.warnings.push_back("factors and yield accelerations of lifts count the prestress of anchors alone; what stretches a bar "
                                  "counts in the slip.");
    if (const std::vector<std::string> names = of_base_alone(scene); !names.empty())
        planes.warnings.push_back(fmt::format(
            "load combinations {}: load factors, ruptured curtain, residual strength, open gates, friction, cohesion and k_profile "
            "of their own are of the base alone.",
            fmt::join(names, ", ")));
    std::vector<sliding::GroundState> grounds;
    for (const FoundState& f : found)
        if (!f.own) grounds.push_back(f.state.ground);

    PlaneRow of_base{.kind = PlaneKind::base, .name = base_plane};
    for (const PlaneState& state : planes.states) of_base.factors.push_back(state.of_base);
    of_base.yield = base.downstream.law.constant;
    of_base.slip_factor = base.downstream.factor;
    of_base.slips = std::move(slips);
    of_base.stands = base.state == sliding::StaticState::at_rest;

    std::vector<sliding::SkippingMotion> motions;
    for (const RecordPair& pair : ready.records()) motions.emplace_back(ground_motion(scene, pair));
    const std::optional<LiftModes> modes = lifts_vibrate(scene) ? std::optional(lift_modes(scene)) : std::nullopt;
    const std::vector<sliding::LiftAmplification> amplification =
        modes ? lift_amplification(*modes, motions, scene.damping.ratio) : std::vector<sliding::LiftAmplification>();
    if (scene.lifts) planes.lifts = sliding::lift_planes(scene, grounds, amplification);
    planes.seams.resize(scene.seams.size());
    parallel_for(scene.seams.size(), jobs,
                 [&](std::size_t i) { planes.seams[i] = sliding::seam_plane(scene, scene.seams[i], grounds); });
    for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k].own) add_own_state(found[k], k, amplification, planes);
    std::vector<Sliding> all;
    for (std::size_t i = 0; i < planes.lifts.size(); ++i) {
        all.push_back(of_lift(planes.lifts[i], i));
        if (modes) all.back().model.tied = std::make_shared<const sliding::TiedPart>(modes->parts[i]);
    }
    for (std::size_t i = 0; i < planes.seams.size(); ++i) all.push_back(of_seam(planes.seams[i], i));

    parallel_for(all.size(), jobs, [&](std::size_t i) {
        for (const sliding::SkippingMotion& motion : motions) {
            PlaneRow& row = all[i].row;
            if (row.kind == PlaneKind::lift)
                row.joint_peak = std::max(row.joint_peak.value_or(0.0), joint_peak(planes.lifts[row.place], all[i].model, motion));
            for (const int polarity : {1, -1})
                all[i].row.slips.push_back({motion.motion().name, polarity,
                                            slide_model(scene, all[i].model, motion, polarity)});
        }
    });

    for (Sliding& s : all)
        if (s.model.bodies && s.model.state == sliding::StaticState::at_rest) add_work(scene, s, motions, planes);
    planes.rows.push_back(std::move(of_base));
    for (Sliding& s : all) planes.rows.push_back(std::move(s.row));
    planes.by_factor = least(planes.rows, [&](const PlaneRow& row) { return margin(row, planes.states); });
    planes.by_yield = least(planes.rows, [](const PlaneRow& row) { return row.yield; });
    planes.by_slip = largest_slip(planes.rows);
    for (const PlaneRow& row : planes.rows)
        if (row.kind == PlaneKind::seam) add_seam_warnings(scene, row, planes.seams[row.place], planes.warnings);
    return planes;
}

} // namespace damslip
