#include "analysis/prepare/ready.hpp"

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "fe2d/time/modal_run.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/measure/measures.hpp"
#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip {

std::optional<Diagnostic> why_not_reducible(const Scene& scene)
{
    const auto not_with = [&scene](const std::string& what, const char* expected, const std::string& otherwise) {
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "A reduced run cannot take " + what + ".",
                          expected,
                          "run without --reduced, or " + otherwise};
    };
    if (scene.seam_body)
        return not_with(fmt::format("--plane \"{}\"", scene.seam_body->name),
                        "the base as the plane, the modes are those of a dam of one piece", "leave --plane out");
    if (scene.contact.sliding == JointPath::finite)
        return not_with("contact.sliding = \"finite\"",
                        "contact.sliding = \"small\", the modes are those of one place on the rock",
                        "write  sliding = \"small\"  in [contact]");
    if (scene.mesh.rock_contact_size)
        return not_with("mesh.rock_contact_size_m", "facing nodes on both sides of the plane",
                        "delete rock_contact_size_m");
    if (scene.time.scheme == TimeScheme::modal || scene.time.scheme == TimeScheme::central_difference)
        return not_with(fmt::format("time.scheme = \"{}\"",
                                    scene.time.scheme == TimeScheme::modal ? "modal" : "central-difference"),
                        "scheme = \"auto\", \"hht\" or \"newmark\": a reduced run has its modes anyway, and steps them "
                        "implicitly",
                        "delete scheme in [time]");
    if (rock_is_boxed(scene))
        return not_with(
            fmt::format("foundation.boundary = \"{}\"", rock_edges_are_viscous(scene) ? "viscous" : "fixed"),
            "boundary = \"absorbing\", rock that is reduced to the base as the dam is, or massless rock",
            "write  boundary = \"absorbing\"  in [foundation]");
    if (scene.time.stepping == Stepping::adaptive)
        return not_with("time.stepping = \"adaptive\"",
                        "stepping = \"uniform\", sub-steps of a reduced run are all alike",
                        "delete stepping in [time]");
    if (!scene.motion.sequence.empty() && scene.uplift && scene.uplift->water.after == WaterAfter::full)
        return not_with("motion.sequence with uplift.after = \"full\"",
                        "after = \"unchanged\": a reduced run has no static state between two records",
                        "delete  after  in [uplift]");
    if (scene.contact.restitution > 0.0)
        return not_with(fmt::format("contact.restitution = {:g}", scene.contact.restitution),
                        "restitution = 0, impacts of a reduced run come to rest", "delete restitution");
    if (!scene.lift_joints.empty())
        return not_with(fmt::format("{} [[lift_joint]]", scene.lift_joints.size()),
                        "no [[lift_joint]], the modes are those of a dam of one piece", "delete the [[lift_joint]]");
    if (scene.contact.normal == NormalContact::exponential)
        return not_with("contact.normal = \"exponential\"",
                        "contact.normal = \"hard\", the reduced base has no springs across it",
                        "write  normal = \"hard\"  in [contact]");
    if (scene.uplift && scene.uplift->water.opening == OpeningWater::reynolds &&
        scene.uplift->water.wet_end == WetEndPressure::with_waves)
        return not_with("uplift.wet_end = \"with-waves\"", "the static head at the wet end, a reduced run has no pressure there",
                        "delete wet_end in [uplift]");
    return std::nullopt;
}

void check_reducible(const Scene& scene)
{
    if (const auto why_not = why_not_reducible(scene)) throw UsageError(*why_not);
}

void set_corrector(const Scene& scene, fe2d::RunOptions& options)
{
    const bool corrects = scene.motion.sequence.empty() && scene.time.stepping == Stepping::automatic && !scene.time.substeps && !with_exact_contact(scene) &&
                          scene.tied_lifts.empty() && scene.dam.crack != BodyCrack::traced && first_joint_law(scene).empty() &&
                          !why_not_reducible(scene);
    options.corrector = corrects ? fe2d::corrected_run : decltype(options.corrector)();
}

namespace {

constexpr double elements_per_wave = 8.0;
constexpr double share_of_record = 0.95;

/// Longest edge of the rock's elements [m].
double longest_edge(const fe2d::Mesh& mesh)
{
    double longest = 0.0;
    for (const fe2d::Element& element : mesh.elements) {
        if (element.region == fe2d::Region::dam) continue;
        const auto corner = fe2d::corners(mesh, element);
        for (int i = 0; i < element.size(); ++i) {
            const Point a = corner[static_cast<std::size_t>(i)],
                        b = corner[static_cast<std::size_t>((i + 1) % element.size())];
            longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
        }
    }
    return longest;
}

} // namespace

std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion)
{
    std::vector<std::string> warnings;
    if (!rock_is_boxed(scene)) return warnings;
    const fe2d::ElasticWaves c =
        fe2d::elastic_waves(fe2d::elastic_material(scene.foundation->material, scene, "foundation"));
    if (!rock_edges_are_viscous(scene)) {
        const double depth = scene.foundation->depth;
        warnings.push_back(fmt::format(
            "foundation.boundary = \"fixed\": the record moves the edges of the rock box, whose waves do not leave: it "
            "resonates at {:.3g} Hz (shear, c_s/4H) and {:.3g} Hz (compression, c_p/4H) and above; \"viscous\" lets "
            "them go",
            0.25 * c.s / depth, 0.25 * c.p / depth));
    }
    const double base = base_length(scene.section);
    if (rock_edges_are_viscous(scene) && scene.foundation->depth < 4.0 * base)
        warnings.push_back(
            fmt::format("the rock box is {:.3g} base lengths deep: dashpots below it lack the stiffness of deeper rock "
                        "for waves longer than the box; 4 or more, {:.3g} m, move the slip by few per cent",
                        scene.foundation->depth / base, 4.0 * base));
    const double size = longest_edge(mesh);
    const auto check = [&](const std::vector<double>& accel, double speed, const char* which) {
        if (accel.empty()) return;
        const double frequency = records::frequency_below(accel, motion.dt, share_of_record);
        const double elements = frequency > 0.0 ? speed / (frequency * size) : elements_per_wave;
        if (elements < elements_per_wave)
            warnings.push_back(fmt::format("rock elements of up to {:.3g} m: {:.2g} to a {} wave of {:.3g} Hz, below "
                                           "which {:.0f} % of the record's "
                                           "energy lies; {:.0f} are wanted: mesh.rock_size_m of {:.3g} m or less",
                                           size, elements, which, frequency, 100.0 * share_of_record, elements_per_wave,
                                           size * elements / elements_per_wave));
    };
    check(motion.accel_h, c.s, "shear");
    check(motion.accel_v, c.p, "compression");
    return warnings;
}

namespace {

/// Excess pore pressure at the nodes of the model, from the seepage on its own mesh [Pa].
Eigen::VectorXd pore_pressure_on(const Scene& scene, const fe2d::Model& model)
{
    const fe2d::SeepageResult seepage = fe2d::solve_seepage_on(model.mesh, scene, scene_uplift_state(scene));
    check_seepage(scene, seepage);
    return fe2d::excess_pore_pressure(seepage.field.head, seepage.unit_weight);
}

} // namespace

bool has_water_in_rock(const Scene& scene)
{
    return scene.stages.pore_pressure != PorePressure::none && scene.foundation.has_value();
}

Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::pore_pressure_loads(model.mesh, model.dofs, pore_pressure_on(scene, model),
                                     scene.stages.pore_pressure);
}

Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::water_in_rock(model.mesh, model.dofs, pore_pressure_on(scene, model), scene.stages.pore_pressure);
}

namespace {

PressureProfile uplift_of(const Scene& scene, const UpliftState& state, const sliding::SeepageProfile& seepage)
{
    return scene.uplift ? sliding::uplift_profile(scene, state, {}, seepage) : PressureProfile();
}

/// Uplift with cracks from heel and toe: that of the heel's crack, with the tailwater's full head in the toe's.
fe2d::CrackedUplift cracked_uplift(const Scene& scene, const UpliftState& state, std::shared_ptr<SeepageSource> seepage)
{
    return [scene, state, seepage](double heel_crack, double toe_crack) {
        const sliding::SeepageProfile source = seepage->profile_of(scene);
        const auto with = [&](sliding::Side side, double length) {
            return sliding::uplift_profile(scene, state, {side, length}, source);
        };
        if (!(toe_crack > 0.0)) return with(sliding::Side::heel, heel_crack);
        const PressureProfile of_toe = with(sliding::Side::toe, toe_crack);
        if (!(heel_crack > 0.0)) return of_toe;
        const PressureProfile of_heel = with(sliding::Side::heel, heel_crack);
        const double length = base_length(scene.section), from = std::max(heel_crack, length - toe_crack);
        if (from >= length) return of_heel;
        PressureProfile both;
        both.points = part(of_heel, 0.0, from);
        for (const ProfilePoint& point : part(of_toe, from, length)) both.points.push_back(point);
        return both;
    };
}

/// That of the post-seismic combination (sliding::after_earthquake()), in which a crack takes water where uplift.crack lets it; with
/// uplift.after = "full" in every case, and the drains then work where it has not reached them.
fe2d::CrackedUplift uplift_after(const Scene& scene, const std::shared_ptr<SeepageSource>& seepage,
                                 bool drains_lost = false)
{
    if (!scene.uplift) return {};
    const Combination after = sliding::after_earthquake(scene);
    const bool full = scene.uplift->water.after == WaterAfter::full;
    UpliftState water = scene_uplift_state(scene);
    water.drains = full || after.drains_effective ? DrainState::effective : DrainState::ineffective;
    if (drains_lost) water.drains = DrainState::ineffective;
    water.curtain = !full && after.curtain_intact ? CurtainState::intact : CurtainState::damaged;
    fe2d::CrackedUplift cracked = cracked_uplift(scene, water, seepage);
    if (full || after.crack.value_or(scene.uplift->crack) != CrackRule::none) return cracked;
    return [cracked](double, double) { return cracked(0.0, 0.0); };
}

fe2d::RayleighConstants damping_by_record(const Scene& scene, const fe2d::ModelOptions& options,
                                          const GroundMotion& motion)
{
    const fe2d::Model model = fe2d::build_model(with_massless_rock(scene), options);
    const bool acoustic = scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic;
    return acoustic ? fe2d::damping_of(scene, model, fe2d::build_fluid(scene), motion).constants
                    : fe2d::damping_of(scene, model, motion).constants;
}

/// Files of records that were read elsewhere, or made, so that the plan knows their components.
std::vector<RecordFiles> files_of(const std::vector<RecordPair>& records)
{
    std::vector<RecordFiles> files;
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            for (const RecordFiles& part : files_of(pair.parts))
                if (std::none_of(files.begin(), files.end(), [&](const RecordFiles& f) { return f.name == part.name; }))
                    files.push_back(part);
            continue;
        }
        files.push_back(pair.files);
        if (pair.vertical && !pair.files.vertical) files.back().vertical = pair.vertical->source.file;
    }
    return files;
}

/// Beside what else is said of the scene, once.
void add_note(Scene& scene, Diagnostic note)
{
    if (std::none_of(scene.notes.begin(), scene.notes.end(),
                     [&](const Diagnostic& n) { return n.problem == note.problem; }))
        scene.notes.push_back(std::move(note));
}

void note_not_honoured(Scene& scene, Methods set)
{
    for (Diagnostic& note : not_honoured(scene, set)) add_note(scene, std::move(note));
}

/// Records that are not what their use says.
void note_records(Scene& scene, const std::vector<RecordPair>& records)
{
    for (const RecordPair& pair : records)
        for (std::string& remark : component_remarks(pair)) add_note(scene, {"", 0, 0, std::move(remark), "", ""});
    if (records.empty()) return;
    for (std::string& remark : scaled_peak_remarks(scene)) add_note(scene, {"", 0, 0, std::move(remark), "", ""});
}

} // namespace

GroundMotion Ready::motion(const RecordPair& pair, double scale, int polarity) const
{
    GroundMotion motion = ground_motion(scene, pair, scale, polarity);
    return plan.on(Effect::vertical_motion) ? motion : horizontal_only(std::move(motion));
}

std::vector<GroundMotion> Ready::motions(const RecordPair& pair, std::optional<int> asked) const
{
    std::vector<GroundMotion> motions;
    for (const int polarity : polarities_of(scene, asked)) motions.push_back(motion(pair, 1.0, polarity));
    return motions;
}

RigidModel Ready::rigid_model(std::optional<CrackRule> crack) const
{
    return make_rigid_model(scene, seepage->profile_of(scene), crack, crack ? nullptr : statics.get());
}

std::vector<sliding::Equilibrium> Ready::combinations() const
{
    if (scene.seam_body) return {}; // they are of the base
    sliding::PeakGround peak;
    for (const RecordPair& pair : records()) {
        const GroundMotion shaking = motion(pair);
        peak.a_h = std::max(peak.a_h, peak_of(shaking.accel_h));
        peak.a_v = std::max(peak.a_v, peak_of(shaking.accel_v));
    }
    return sliding::evaluate_combinations(scene, peak, seepage->profile_of(scene));
}

double Ready::wave_frequency() const
{
    constexpr double least = 25.0, share = 0.99;
    double highest = least;
    for (const RecordPair& pair : records()) {
        const GroundMotion shaking = motion(pair);
        for (const std::vector<double>* accel : {&shaking.accel_h, &shaking.accel_v})
            if (!accel->empty()) highest = std::max(highest, records::frequency_below(*accel, shaking.dt, share));
    }
    return highest;
}

fe2d::ModelOptions Ready::model_options() const
{
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    return options;
}

/// Under the base, before and after the earthquake.
void Ready::add_uplift(fe2d::RunOptions& options) const
{
    options.uplift = uplift_of(scene, scene_uplift_state(scene), seepage->profile_of(scene));
    options.uplift_after = uplift_after(scene, seepage);
    if (scene.uplift && scene.uplift->water.follows()) {
        options.cracked_uplift = cracked_uplift(scene, scene_uplift_state(scene), seepage);
        if (scene.uplift->water.after == WaterAfter::full) options.cracked_uplift_after = options.uplift_after;
    }
    if (drains_shear_off(scene)) {
        UpliftState water = scene_uplift_state(scene);
        water.drains = DrainState::ineffective;
        // A dam that yields has slipped a little before it slides.
        options.drain_loss = fe2d::DrainLoss{std::max(*scene.drains->lost_at_slip, options.smallest_slip),
                                             uplift_of(scene, water, seepage->profile_of(scene)),
                                             cracked_uplift(scene, water, seepage),
                                             {},
                                             uplift_after(scene, seepage, true)};
        water.curtain = CurtainState::damaged;
        if (options.cracked_uplift_after) options.drain_loss->cracked_after = cracked_uplift(scene, water, seepage);
    }
}

fe2d::RunOptions Ready::run_options(const Watch& watch) const
{
    fe2d::RunOptions options;
    options.added_mass = added_mass_law(scene);
    if (scene.seam_body)
        for (const Point& p : scene.seam_body->water) options.uplift.points.push_back({p.x, p.y});
    else
        add_uplift(options);
    if (has_water_in_rock(scene))
        options.water_in_rock = [scene = scene](const fe2d::Model& model) { return water_in_rock(scene, model); };
    if (scene.damping.method == DampingMethod::modified_rayleigh && !records().empty())
        options.damping = damping_by_record(scene, model_options(), motion(records().front()));
    if (rock_radiates(scene)) options.wave_frequency = wave_frequency();
    options.rock_cache = cache_folder();
    set_corrector(scene, options);
    options.stop = watch.stop();
    options.progress = [&watch](const fe2d::RunProgress&) {
        return watch.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    return options;
}

Ready Ready::with(Scene changed) const
{
    Ready other = *this;
    other.scene = std::move(changed);
    other.seepage = std::make_shared<SeepageSource>();
    other.statics.reset();
    return other;
}

Ready prepare(Scene given, Method method, Records records, const PrepareOptions& options)
{
    Ready ready;
    ready.seepage = options.seepage ? options.seepage : std::make_shared<SeepageSource>();
    ready.statics = options.statics;
    if (records) given.motion.records = files_of(*records);
    if (options.joints_of_lifts)
        given = with_joints_of_lifts(std::move(given));
    else if (method == Method::finite_elements && given.dam.crack == BodyCrack::traced) {
        given.dam.crack = BodyCrack::none;
        given.notes.push_back(
            {"", 0, 0, "dam.crack = \"traced\" is left out: the concrete stays whole here. damslip fe follows its cracks.", "", ""});
    }
    if (method == Method::finite_elements) {
        given = with_seam_body(std::move(given));
        check_traced(given);
    }
    ready.pairs = records ? std::move(records) : std::make_shared<const std::vector<RecordPair>>();
    if (options.flexible_modes) ready.flexible_modes = resolve_flexible_modes(given);
    note_not_honoured(given, method == Method::finite_elements
                                 ? methods::fe | methods::reduced
                                 : methods::rigid | methods::flexible | methods::regressions);
    note_records(given, *ready.pairs);
    ready.plan = make_effect_plan(given, method);
    ready.scene = called_for(ready.plan, given);
    if (method == Method::finite_elements) {
        ready.reservoir = resolve_reservoir_model(ready.scene, options.stop);
        if (ready.reservoir) {
            given.reservoir->model = ready.scene.reservoir->model;
            ready.plan = make_effect_plan(given, method); // names what was chosen
        }
        ready.dam_period = resolve_dam_period(ready.scene, options.stop);
    }
    ready.given = std::move(given);
    return ready;
}

Ready prepare(Scene given, Method method, const PrepareOptions& options)
{
    std::string hash = scene_hash(given);
    Records records = load_records(given, method);
    Ready ready = prepare(std::move(given), method, std::move(records), options);
    ready.plan.scene_hash = std::move(hash);
    return ready;
}

Records load_records(const Scene& given, Method method)
{
    const EffectPlan plan = make_effect_plan(given, method);
    return std::make_shared<const std::vector<RecordPair>>(read_records(called_for(plan, given), plan));
}

std::vector<std::string> contact_law_notes(const Scene& scene)
{
    std::vector<std::string> notes;
    if (base_taken_as_dry(scene))
        notes.push_back(
            "The base is taken as dry although there is water on the dam: no answer here counts any uplift.");
    if (scene.contact.normal == NormalContact::exponential)
        notes.push_back("contact.normal = \"exponential\": openings are clearances of the two sides, of the order of "
                        "clearance_at_zero_pressure_m under pressure too, negative where the pressure is above "
                        "pressure_at_zero_clearance; a pair is open where it carries none.");
    else if (scene.contact.separation == JointOpening::none)
        notes.push_back(
            "contact.separation = \"none\": the joint carries tension without shear, so its compressed part carries "
            "more than the resultant. This lowers the slip, and a rigid dam no longer slides as a rigid block.");
    return notes;
}

std::optional<std::string> base_note(const Scene& scene)
{
    switch (rock_kind(scene)) {
    case RockKind::rigid:
        return "rigid base: no radiation damping; an elastic dam may slide on it without end";
    case RockKind::massless:
        return fmt::format(
            "massless rock keeps all waves: slips come out too large, often by half and more;  damslip fe "
            "{} --rock radiating  lets them leave",
            scene.file.empty() ? "SCENE" : scene.file.string());
    case RockKind::boxed:
    case RockKind::radiating:
        break;
    }
    return std::nullopt;
}

namespace {

constexpr const char* auto_key = "time.scheme = \"auto\": ";

/// Rock whose damping no real modes separate; empty: none.
std::string rock_obstacle(const Scene& scene)
{
    if (rock_radiates(scene)) return "rock that lets waves out: real modes do not separate the equations";
    if (rock_edges_are_viscous(scene))
        return "a dashpot on every node of the rock's edges: real modes do not separate the equations";
    return {};
}

} // namespace

TiedScheme tied_scheme(const Scene& scene, const GroundMotion& motion, const fe2d::TiedRunOptions& options)
{
    const TimeOptions& time = scene.time;
    if (time.scheme != TimeScheme::automatic) return {time.scheme, {}};
    if (const std::string obstacle = rock_obstacle(scene); !obstacle.empty())
        return {TimeScheme::hht, fmt::format("{}HHT, since there is {}", auto_key, obstacle)};
    if (const std::string obstacle = fe2d::modal_obstacle(options); !obstacle.empty())
        return {TimeScheme::hht, fmt::format("{}HHT, since there is {}", auto_key, obstacle)};
    const double steps = motion.dt / options.dt.value_or(motion.dt) * static_cast<double>(motion.accel_h.size() - 1);
    if (steps < fe2d::modal_break_even)
        return {TimeScheme::hht,
                fmt::format("{}HHT, since {:.0f} steps cost less than finding modes", auto_key, steps)};
    return {TimeScheme::modal,
            fmt::format("{}superposition of modes, since a bonded base makes the model linear and {:.0f} direct steps "
                        "cost more than its modes",
                        auto_key, steps)};
}

std::string time_scheme_note(const Scene& scene)
{
    switch (scene.time.scheme) {
    case TimeScheme::automatic:
        if (const std::string obstacle = rock_obstacle(scene); !obstacle.empty())
            return fmt::format("{}HHT; {}", auto_key, obstacle);
        return scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic
                   ? "time.scheme = \"auto\": HHT; with acoustic water real modes do not separate the equations"
                   : fmt::format(
                         "time.scheme = \"auto\": HHT where the base slides; superposition of modes on a bonded base "
                         "(fe --base tied) and a motion of {} steps or more",
                         fe2d::modal_break_even);
    case TimeScheme::hht:
        return "time.scheme = \"hht\": implicit, stable at any step";
    case TimeScheme::newmark:
        return "time.scheme = \"newmark\": implicit, no numerical damping of what the step does not resolve at gamma = "
               "0.5";
    case TimeScheme::central_difference:
        return "time.scheme = \"central-difference\": explicit, lumped mass, steps of at most 0.9 of the stability "
               "limit; sliding on "
               "a rigid base only";
    case TimeScheme::modal:
        break;
    }
    return "time.scheme = \"modal\": superposition of modes; for fe --base tied only, a base that slides has none";
}

} // namespace damslip
