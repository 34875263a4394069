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

/// The rows of a combination, with and without crack, at the scene's own water levels.
struct FoundState {
    std::string name;
    double k_h = 0.0, k_v = 0.0;
    std::optional<double> required, factor;
};

std::vector<FoundState> states_of(const Scene& scene, const std::vector<sliding::Equilibrium>& combinations)
{
    const auto level = [](const auto& water) { return water ? std::optional(water->level) : std::nullopt; };
    std::vector<FoundState> states;
    for (const sliding::Equilibrium& e : combinations) {
        const bool own_water = e.reservoir_level == level(scene.reservoir) && e.tailwater_level == level(scene.tailwater);
        if (!own_water || e.kind == CombinationKind::post_seismic) continue;
        const std::string name = e.name.substr(0, e.name.rfind(", cracked"));
        auto state = std::find_if(states.begin(), states.end(), [&](const FoundState& s) { return s.name == name; });
        if (state == states.end()) state = states.insert(states.end(), {name, e.k_h, e.k_v, {}, {}});
        if (std::isfinite(e.sliding_factor)) state->factor = std::min(state->factor.value_or(infinite), e.sliding_factor);
        for (const sliding::Check& check : e.checks)
            if (check.quantity.starts_with("sliding, peak") && check.required)
                state->required = std::max(state->required.value_or(0.0), *check.required);
    }
    return states;
}

/// The first combination without an earthquake, and the one with the largest k_h.
std::vector<PlaneState> plane_states(const Scene& scene, const std::vector<sliding::Equilibrium>& combinations)
{
    const std::vector<FoundState> all = states_of(scene, combinations);
    const FoundState* still = nullptr;
    const FoundState* shaken = nullptr;
    for (const FoundState& s : all) {
        if (s.k_h == 0.0 && s.k_v == 0.0 && !still) still = &s;
        if (s.k_h > 0.0 && (!shaken || s.k_h > shaken->k_h)) shaken = &s;
    }
    const auto state = [](const FoundState& s) {
        return PlaneState{{s.name, s.k_h * units::standard_gravity, s.k_v * units::standard_gravity}, s.required, s.factor};
    };
    std::vector<PlaneState> states{still ? state(*still) : PlaneState{{"static"}, {}, {}}};
    if (shaken) states.push_back(state(*shaken));
    return states;
}

/// Of the scene's load combinations those that say more of a state than k_h and k_v, which lifts and seams do not follow.
std::vector<std::string> of_base_alone(const Scene& scene)
{
    const auto more = [&](const Combination& c) {
        const double factors[]{c.weight_factor, c.water_factor, c.uplift_factor, c.silt_factor, c.ice_factor, c.friction_divisor,
                               c.cohesion_divisor};
        const auto other = [](const std::optional<double>& level, const auto& water) {
            return level && (!water || *level != water->level);
        };
        return !c.drains_effective || !c.curtain_intact || c.residual_strength || c.gates_open || c.friction || c.cohesion ||
               !c.k_profile.empty() || other(c.reservoir_level, scene.reservoir) || other(c.tailwater_level, scene.tailwater) ||
               std::any_of(std::begin(factors), std::end(factors), [](double factor) { return factor != 1.0; });
    };
    std::vector<std::string> names;
    for (const Combination& c : scene.combinations)
        if (c.kind != CombinationKind::post_seismic && more(c)) names.push_back(fmt::format("\"{}\"", c.name));
    return names;
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
    const auto here = std::find_if(plane.trials.begin(), plane.trials.end(),
                                   [&](const sliding::WedgeTrial& trial) { return trial.angle == plane.factors[k].angle; });
    if (here == plane.trials.end()) return false;
    return (here != plane.trials.begin() && !stands(std::prev(here)->statuses[k])) ||
           (std::next(here) != plane.trials.end() && !stands(std::next(here)->statuses[k]));
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
    planes.states = plane_states(scene, combinations);
    if (!scene.seams.empty() && std::any_of(scene.anchors.begin(), scene.anchors.end(), [](const Anchor& a) { return a.joint.empty(); }))
        planes.warnings.push_back("anchors through the base do not count on seams: how far they reach down is not known.");
    if (std::any_of(scene.anchors.begin(), scene.anchors.end(), [](const Anchor& a) { return !a.joint.empty() && a.limit_force == AnchorForceRule::yield; }))
        planes.warnings.push_back("factors and yield accelerations of lifts count the prestress of anchors alone; what stretches a bar counts in the slip.");
    if (const std::vector<std::string> names = of_base_alone(scene); !names.empty())
        planes.warnings.push_back(fmt::format(
            "load combinations {}: their own water, drains, factors and strengths are of the base alone; lifts and seams are "
            "judged with k_h, k_v and the loads and strengths of the scene.",
            fmt::join(names, ", ")));
    std::vector<sliding::GroundState> grounds;
    for (const PlaneState& state : planes.states) grounds.push_back(state.ground);

    PlaneRow of_base{.kind = PlaneKind::base, .name = base_plane};
    for (const PlaneState& state : planes.states) of_base.factors.push_back(state.of_base);
    of_base.yield = base.downstream.law.constant;
    of_base.slip_factor = base.downstream.factor;
    of_base.slips = std::move(slips);
    of_base.stands = base.state == sliding::StaticState::at_rest;

    std::vector<sliding::SkippingMotion> motions;
    for (const RecordPair& pair : ready.records()) motions.emplace_back(ground_motion(scene, pair));
    const std::optional<LiftModes> modes = lifts_vibrate(scene) ? std::optional(lift_modes(scene)) : std::nullopt;
    if (modes) planes.lifts = sliding::lift_planes(scene, grounds, lift_amplification(*modes, motions, scene.damping.ratio));
    else if (scene.lifts) planes.lifts = sliding::lift_planes(scene, grounds);
    planes.seams.resize(scene.seams.size());
    parallel_for(scene.seams.size(), jobs,
                 [&](std::size_t i) { planes.seams[i] = sliding::seam_plane(scene, scene.seams[i], grounds); });
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
