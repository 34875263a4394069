#include "verification/second_solver/second_solver.hpp"

#include "analysis/fe/tied_runs.hpp"
#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/run/strength.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/water.hpp"
#include "verification/second_solver/deck.hpp"
#include "verification/second_solver/read_dat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

// What the second solver may differ by, fixed before anything was compared (issue 22): modes by what its printed digits
// and its eigenvalue solver leave; the crest by what the time step leaves; contact by what its springs leave.
constexpr double modes_allowed = 1e-4, crest_allowed = 5e-3, resultant_allowed = 1e-3, traction_allowed = 2e-2;

/// Stiffness of the springs of its contact over Young's modulus of the dam and 1 m: they give a hundredth of what 1 m of
/// dam does; stiffer ones cost CalculiX many iterations.
constexpr double springs_over_dam = 1e2;

/// What the seven digits of a printed time leave of it [-], below 1 s [s].
constexpr double printed_time = 1e-6;

/// Of the normal force: a shear force that is less is told as a part of this, as that of an empty dam is nothing but round-off.
constexpr double least_shear = 0.1;

[[noreturn]] void refuse(const Ready& ready, std::string problem, std::string expected, std::string fix)
{
    throw InputError(
        Diagnostic{ready.scene.file.string(), 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

void check(const Ready& ready, SecondAnalysis analysis)
{
    const Scene& scene = ready.scene;
    if (is_acoustic(scene))
        refuse(ready, "reservoir.model = \"acoustic\" in a deck for CalculiX.",
               "added mass or none: its acoustic elements do not couple with the motion of a dam",
               "write  model = \"added-mass\"  in [reservoir]");
    if (scene.foundation && scene.foundation->mass != RockMass::massless)
        refuse(ready, "rock that has mass in a deck for CalculiX.", "massless rock, or none (a rigid base)",
               "write  mass = \"massless\"  in [foundation], or add  --rock massless");
    if (scene.mesh.element != ElementKind::q8)
        refuse(ready, "a deck for CalculiX of elements that it does not have.",
               "mesh.element = \"q8\": quadratic quadrilaterals, which both programs integrate alike",
               "write  element = \"q8\"  in [mesh]");
    if (!scene.section.thickness.empty())
        refuse(ready, "section.thickness in a deck for CalculiX.", "a solid section", "delete thickness");
    if (analysis != SecondAnalysis::static_contact) return;
    if (!scene.foundation)
        refuse(ready, "a static contact deck of a dam without rock.", "a dam on rock", "add [foundation]");
    if (!scene.lift_joints.empty() || scene.contact.cohesion != 0.0 || !scene.anchors.empty())
        refuse(ready, "lift joints, cohesion or anchors in a static contact deck.", "friction on the base alone",
               "leave them out of the scene that is compared");
    if (scene.contact.enforcement != ContactEnforcement::exact || scene.contact.normal != NormalContact::hard)
        refuse(ready, "a contact law that gives way in a static contact deck.",
               "contact.enforcement = \"exact\", normal = \"hard\"", "delete enforcement and normal in [contact]");
}

void check_elements(const Ready& ready, const fe2d::Model& model)
{
    const std::string missing = fe2d::not_for_calculix(model);
    if (!missing.empty())
        refuse(ready, "the mesh has " + missing + ", which CalculiX has no counterpart for.", "quadratic elements",
               "write  element = \"q8\"  in [mesh], and smaller elements");
}

fe2d::CalculixModel given_model(const Ready& ready, const fe2d::Model& model)
{
    check_elements(ready, model);
    fe2d::CalculixModel given{model, {}, ready.scene.title};
    const auto law = ready.model_options().added_mass;
    if (ready.scene.reservoir && law)
        given.water = fe2d::added_mass_points(model.mesh, model.mesh.upstream_face, law, ready.scene.reservoir->level);
    return given;
}

const RecordPair& first_record(const Ready& ready)
{
    if (ready.records().empty())
        refuse(ready, "a tied deck of a scene without a record.", "a [[motion.record]]",
               "add one, or write  --record FILE");
    return ready.records().front();
}

std::string tied_deck(const Ready& ready, int modes)
{
    const fe2d::Model model = fe2d::build_model(ready.scene, ready.model_options());
    const GroundMotion motion = ready.motion(first_record(ready), 1.0, polarities_of(ready.scene).front());
    const fe2d::DampingChoice damping = fe2d::damping_of(ready.scene, model, motion);
    const fe2d::CalculixModel given = given_model(ready, model);
    if (damping.constants.mass != 0.0 && (!given.water.empty() || damping.mass == MassDamping::total))
        refuse(ready,
               fmt::format("mass-proportional damping a_M = {:g} 1/s {}.", damping.constants.mass,
                           given.water.empty() ? "of the total velocity" : "beside added mass"),
               "a_M = 0: CalculiX would damp the water's mass, too, and the motion relative to the ground alone",
               "write  mass_coefficient_1_s = 0  and  stiffness_coefficient_s  in [damping]");
    return fe2d::calculix_tied_deck(given, {motion, damping.constants, modes, 0.0});
}

std::string contact_deck(const Ready& ready, const Watch& watch)
{
    const fe2d::EarthquakeRun run(ready.scene, ready.run_options(watch));
    const fe2d::Model& model = run.model();
    if (!model.mesh.contact.matching)
        refuse(ready, "mesh.rock_contact_size_m in a static contact deck.",
               "nodes of dam and rock that face each other", "delete rock_contact_size_m");
    fe2d::CalculixModel given = given_model(ready, model);
    given.water.clear(); // nothing moves
    fe2d::CalculixContact contact;
    contact.gravity = ready.scene.gravity;
    contact.friction = ready.scene.contact.friction;
    contact.normal_stiffness = contact.stick_stiffness = springs_over_dam * model.materials.dam.young_modulus;
    const Eigen::VectorXd weight = fe2d::static_loads(ready.scene, model).gravity.front().force;
    for (std::size_t s = 0; s < run.stages().names.size(); ++s)
        contact.stages.push_back({run.stages().names[s], run.stages().loads[s] - weight});
    return fe2d::calculix_contact_deck(given, contact);
}

/// @param least  size below which the difference is not told as a part of theirs, but of this
SecondResult relative(std::string what, std::string unit, double ours, double theirs, double allowed,
                      double least = 0.0)
{
    return {std::move(what), std::move(unit), ours, theirs, std::abs(ours - theirs) / std::max(std::abs(theirs), least),
            allowed};
}

std::vector<SecondResult> modes_beside(const Ready& ready, int count, const std::vector<double>& theirs,
                                       const std::string& file)
{
    if (std::ssize(theirs) < count)
        throw InputError(Diagnostic{file, 0, 0,
                                    fmt::format("{} modes in the file, {} asked for.", theirs.size(), count),
                                    "the modes of the deck", fmt::format("add  --modes {}", theirs.size())});
    const fe2d::NaturalModes ours = fe2d::natural_modes(fe2d::build_model(ready.scene, ready.model_options()), count);
    std::vector<SecondResult> results;
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(ours.frequency.size(), std::ssize(theirs)); ++i)
        results.push_back(relative(fmt::format("frequency, mode {}", i + 1), "Hz", ours.frequency[i],
                                   theirs[static_cast<std::size_t>(i)], modes_allowed));
    return results;
}

/// Largest difference of both histories over the largest displacement, and the peaks themselves.
std::vector<SecondResult> crest_beside(const Ready& ready, const std::vector<CrestSample>& theirs,
                                       const std::string& file, Watch& watch)
{
    const GroundMotion motion = ready.motion(first_record(ready), 1.0, polarities_of(ready.scene).front());
    const double end = motion.dt * static_cast<double>(motion.accel_h.size() - 1);
    if (theirs.back().time < end * (1.0 - 1e-6))
        throw InputError(Diagnostic{
            file, 0, 0, fmt::format("the file ends at {:g} s, the record at {:g} s.", theirs.back().time, end),
            "the whole record", "write the deck anew and run ccx to its end"});
    FeOptions options;
    options.polarity = polarities_of(ready.scene).front();
    TiedRuns runs(ready, options, watch);
    const std::vector<TiedRun> all = runs.run();
    const fe2d::History& ours = all.front().history;
    if (ours.status != fe2d::TiedRunStatus::complete)
        throw NotConverged(
            Diagnostic{ready.scene.file.string(), 0, 0, text_of(ours.ending), "a complete run", "see its status"});
    const double start = ours.rows.front().crest_x;
    double largest = 0.0, apart = 0.0, their_peak = 0.0;
    std::size_t next = 0;
    const auto off = [&](std::size_t row, double time) { return std::abs(ours.rows[row].time - time); };
    for (const CrestSample& sample : theirs) {
        while (next + 1 < ours.rows.size() && off(next + 1, sample.time) <= off(next, sample.time)) ++next;
        if (off(next, sample.time) > printed_time * std::max(1.0, sample.time))
            throw InputError(Diagnostic{
                file, 0, 0, fmt::format("the file has the crest at {:g} s, which is no step of our run.", sample.time),
                "the steps of the record", "write the deck anew and run ccx to its end"});
        const double x = ours.rows[next].crest_x - start;
        largest = std::max(largest, std::abs(x));
        their_peak = std::max(their_peak, std::abs(sample.x));
        apart = std::max(apart, std::abs(x - sample.x));
    }
    return {
        relative("largest displacement of the crest", "m", largest, their_peak, crest_allowed),
        {"largest difference of both histories, over their peak", "m", apart, 0.0, apart / their_peak, crest_allowed}};
}

/// What the contact has to put on the base's nodes of the dam for these displacements, plane vector [N/m].
Eigen::VectorXd base_forces(const fe2d::EarthquakeRun& run, const Eigen::VectorXd& load, const StageOutput& theirs)
{
    const fe2d::Model& model = run.model();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(model.dofs.count);
    for (int node = 0; node < model.mesh.dam_node_count; ++node)
        for (const int c : {0, 1})
            if (const int dof = model.dofs(node, c); dof != fe2d::no_dof)
                u[dof] = theirs.displacement[static_cast<std::size_t>(2 * node + c)];
    const Eigen::VectorXd left = model.stiffness * u - load;
    const auto& nodes = model.mesh.contact.dam_nodes;
    Eigen::VectorXd force(2 * std::ssize(nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const int c : {0, 1}) force[static_cast<Eigen::Index>(2 * i) + c] = left[model.dofs(nodes[i], c)];
    return run.structure().plane().to_plane(force);
}

/// Tractions of the pairs in L2 over the base without one element at heel and toe: their means, and the difference over
/// the size. @param ours, theirs  nodal forces [N/m]
SecondResult relative(std::string what, std::string unit, const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs,
                      const fe2d::Plane& plane)
{
    double difference = 0.0, our_size = 0.0, their_size = 0.0, length = 0.0;
    for (Eigen::Index i = 2; i + 2 < plane.pairs(); ++i) {
        difference += (ours[i] - theirs[i]) * (ours[i] - theirs[i]) / plane.area[i];
        our_size += ours[i] * ours[i] / plane.area[i];
        their_size += theirs[i] * theirs[i] / plane.area[i];
        length += plane.area[i];
    }
    return {std::move(what),
            std::move(unit),
            std::sqrt(our_size / length),
            std::sqrt(their_size / length),
            std::sqrt(difference / their_size),
            traction_allowed};
}

/// Length of the base that carries nothing: pairs with less than a thousandth of the mean normal force [m]; what springs and
/// the digits of a file leave of nothing is less than that. @param normal  nodal forces [N/m]
double open_length(const Eigen::VectorXd& normal, const fe2d::Plane& plane)
{
    constexpr double nothing = 1e-3;
    const double mean = normal.sum() / plane.area.sum();
    double open = 0.0;
    for (Eigen::Index i = 0; i < plane.pairs(); ++i)
        if (normal[i] < nothing * mean * plane.area[i]) open += plane.area[i];
    return open;
}

/// The length open, over the base; allowed: the part of one pair. @returns nothing where both are shut
std::vector<SecondResult> opening_beside(const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs,
                                         const fe2d::Plane& plane)
{
    const double our_length = open_length(ours, plane), their_length = open_length(theirs, plane);
    if (our_length == 0.0 && their_length == 0.0) return {};
    const double base = plane.area.sum();
    return {{"open length of the base, difference over the base", "m", our_length, their_length,
             std::abs(our_length - their_length) / base, plane.area.maxCoeff() / base}};
}

std::vector<SecondResult> stages_beside(const Ready& ready, const CalculixOutput& dat, const std::string& file,
                                        const Watch& watch)
{
    const fe2d::EarthquakeRun run(ready.scene, ready.run_options(watch));
    const fe2d::Plane& plane = run.structure().plane();
    const std::vector<StageOutput> theirs = dat.stages();
    const fe2d::LoadStages& stages = run.stages();
    const auto nodes = static_cast<std::size_t>(2 * run.model().mesh.dam_node_count);
    if (theirs.size() != stages.names.size() || theirs.back().displacement.size() != nodes)
        throw InputError(
            Diagnostic{file, 0, 0,
                       fmt::format("{} stages of {} nodes in the file, {} of {} in the scene.", theirs.size(),
                                   theirs.back().displacement.size() / 2, stages.names.size(), nodes / 2),
                       "all stages of the deck of this scene", "write the deck anew and run ccx to its end"});
    fe2d::StaticContact statics(run.structure());
    fe2d::Strength strength(ready.scene.contact, plane);
    fe2d::ContactMemory memory(plane.pairs());
    const Eigen::Index m = plane.pairs();
    for (const fe2d::StageResult& stage : run.statics(statics, strength, memory))
        if (stage.status != fe2d::StageStatus::ok)
            throw NotConverged(Diagnostic{ready.scene.file.string(), 0, 0, text_of(stage.notes()),
                                          "a dam that stands under its loads",
                                          "raise contact.friction or lower the water"});
    const Eigen::VectorXd force = base_forces(run, stages.last(), theirs.back());
    const StageOutput& last = theirs.back();
    const double normal = memory.force.head(m).sum(), shear = -memory.force.tail(m).sum();
    std::vector<SecondResult> results{
        relative("normal force on the base", "N/m", normal, last.normal_force, resultant_allowed),
        relative("shear force on the base", "N/m", shear, last.shear_force, resultant_allowed, least_shear * normal),
        relative("normal tractions, difference in L2", "Pa", memory.force.head(m), force.head(m), plane),
        relative("shear tractions, difference in L2", "Pa", -memory.force.tail(m), -force.tail(m), plane)};
    for (SecondResult& opening : opening_beside(memory.force.head(m), force.head(m), plane))
        results.push_back(std::move(opening));
    return results;
}

} // namespace

std::string calculix_deck(const Ready& ready, SecondAnalysis analysis, int modes, const Watch& watch)
{
    check(ready, analysis);
    if (analysis == SecondAnalysis::tied) return tied_deck(ready, modes);
    if (analysis == SecondAnalysis::static_contact) return contact_deck(ready, watch);
    const fe2d::Model model = fe2d::build_model(ready.scene, ready.model_options());
    return fe2d::calculix_modes_deck(given_model(ready, model), modes);
}

std::vector<SecondResult> beside_calculix(const Ready& ready, SecondAnalysis analysis, int modes, std::string_view dat,
                                          const std::string& file, Watch& watch)
{
    check(ready, analysis);
    const CalculixOutput theirs(dat, file);
    if (analysis == SecondAnalysis::modes) return modes_beside(ready, modes, theirs.frequencies(), file);
    if (analysis == SecondAnalysis::static_contact) return stages_beside(ready, theirs, file, watch);
    return crest_beside(ready, theirs.crest(), file, watch);
}

} // namespace damslip
