// Seconds of an FE run, part by part: 20 s record of 0.01 s steps, exact contact, everything included.
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/modal_run.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <vector>

namespace {

using namespace damslip;

/// Processor time of this program: what one core needs, whoever else uses the machine.
double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void run_case(const char* name, double contact_size, double dam_size, double growth, double friction, int halvings)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, contact_size);
    scene.mesh.size = dam_size;
    scene.mesh.growth = growth;
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = halvings;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double start = processor_seconds();
    const fe2d::EarthquakeRun run(scene, options);
    const double ready = processor_seconds();
    const fe2d::RunResult result = run.run(motion);
    const double end = processor_seconds();
    const auto& c = result.counts;
    std::printf("%-22s %6d %6d %5d %5.2f %6d | %8.3f %8.3f %8.3f %8.3f | %6.1f us %5.2f %3d %4d | %9.2f mm\n", name,
                run.model().dofs.count, static_cast<int>(run.structure().dam_unknowns()),
                static_cast<int>(run.structure().plane().pairs()), friction, c.steps, ready - start, end - ready,
                c.contact_seconds, end - start, 1e6 * (end - ready) / c.steps,
                static_cast<double>(c.contact_iterations) / c.steps, c.largest_iterations, c.unresolved,
                1e3 * result.slip);
}

/// The reduced run beside the full one of the same steps, mesh and damping modes included in both.
void reduced_case(const char* name, double contact_size, double dam_size, double growth, double friction, int modes)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, contact_size);
    scene.mesh.size = dam_size;
    scene.mesh.growth = growth;
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 0;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double start = processor_seconds();
    const fe2d::EarthquakeRun run(scene, options);
    const double ready = processor_seconds();
    const double slip = run.run(motion).slip;
    const double full = processor_seconds();
    const fe2d::ReducedRun reduced(run, scene, options, modes);
    const double reduced_ready = processor_seconds();
    const fe2d::RunResult result = reduced.run(motion);
    const double end = processor_seconds();
    const double all_full = full - start, all_reduced = ready - start + end - full;
    std::printf("%-22s %6d %5.2f %5d %6d | %8.3f %8.3f %8.3f %8.3f | %8.3f %5.2f | %9.2f mm %8.4f %% %8.4f %%\n", name,
                run.model().dofs.count, friction, result.modes, result.counts.steps, ready - start,
                reduced_ready - full, end - reduced_ready, all_reduced, all_full, all_full / all_reduced,
                1e3 * result.slip, 100.0 * std::abs(result.slip / slip - 1.0),
                100.0 * result.truncation_error / std::abs(slip));
}

/// The default: steps chosen so that the slip is within 1 % of its limit, beside steps of dt/8 and dt/32.
void default_case(double friction)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 0.5);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double start = processor_seconds();
    const fe2d::RunResult chosen = fe2d::EarthquakeRun(scene, options).run(motion);
    const double end = processor_seconds();
    const auto with = [&](int halvings) {
        scene.time.substeps = halvings;
        return fe2d::EarthquakeRun(scene, options).run(motion).slip;
    };
    const double eighth = with(3), finest = with(5);
    std::printf("%-22s %5.2f | %8.3f | dt/%-3d %9.2f mm %8.4f %% | %8.4f %% %8.4f %%\n", "7000 unknowns", friction,
                end - start, 1 << chosen.halvings, 1e3 * chosen.slip, 100.0 * chosen.slip_error / chosen.slip,
                100.0 * std::abs(chosen.slip / eighth - 1.0), 100.0 * std::abs(chosen.slip / finest - 1.0));
}

/// Frictions of one motion in lockstep, beside the same runs one by one.
void lockstep_case(int batch)
{
    Scene scene = [] {
        Scene s = fe2d::test::sliding_dam(0.77, 1.0, 0.5);
        s.mesh.size = 2.0;
        s.mesh.growth = 1.3;
        return s;
    }();
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 0;
    const GroundMotion motion = fe2d::test::sines(1.0);
    std::vector<Contact> contacts;
    for (int i = 0; i < batch; ++i) {
        contacts.emplace_back();
        contacts.back().friction = 0.66 + 0.34 * i / std::max(1, batch - 1);
    }
    const fe2d::EarthquakeRun run(scene, options);
    run.run(motion, contacts.back()); // factorises
    const double start = processor_seconds();
    for (const Contact& contact : contacts) run.run(motion, contact);
    const double single = processor_seconds();
    run.run_all(motion, contacts);
    const double together = processor_seconds();
    std::printf("%-22s %6d | %8.3f %8.3f %5.2f | %d\n", "7000 unknowns", batch, single - start, together - single,
                (single - start) / (together - single), run.factorisations());
}

/// Seconds of one run, the best of three set-ups with a run each; the machine may be busy.
struct Measured {
    double set_up = 1e9, run = 1e9;
    int dam_unknowns = 0, water_unknowns = 0, moving_unknowns = 0;
    fe2d::RunResult result;
};

Measured measure(Scene scene, const GroundMotion& motion, const std::filesystem::path& cache = {})
{
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    options.rock_cache = cache;
    scene.time.substeps = 0;
    Measured best;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const double start = processor_seconds();
        const fe2d::EarthquakeRun run(scene, options);
        const double ready = processor_seconds();
        best.result = run.run(motion);
        const double end = processor_seconds();
        best.set_up = std::min(best.set_up, ready - start);
        best.run = std::min(best.run, end - ready);
        best.dam_unknowns = 2 * run.model().mesh.dam_node_count;
        best.moving_unknowns = static_cast<int>(run.in_motion().dam_unknowns());
        best.water_unknowns = static_cast<int>(run.structure().dam_unknowns()) - best.dam_unknowns;
    }
    return best;
}

/// Acoustic water beside added mass. @param rows  elements over the depth
void water_case(double friction, double rows)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 0.5);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const Measured mass = measure(scene, motion);
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->mesh_size = scene.reservoir->level / rows;
    const Measured water = measure(scene, motion);
    std::printf("%-22s %5.2f %5.0f %6d %6d | %8.3f %8.3f | %8.3f %8.3f | %5.2f %5.2f | %9.2f mm %9.2f mm\n",
                "7000 unknowns", friction, rows, mass.dam_unknowns, water.water_unknowns, mass.set_up, mass.run,
                water.set_up, water.run, water.run / mass.run, (water.set_up + water.run) / (mass.set_up + mass.run),
                1e3 * mass.result.slip, 1e3 * water.result.slip);
}

/// Rock with mass beside massless rock. Radiating rock twice: made anew, and found in the cache.
void rock_case(double friction, double rock_size)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 0.5);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    scene.mesh.rock_size = rock_size;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const Measured massless = measure(scene, motion);
    scene.foundation->material.density = 2650.0;
    scene.foundation->mass = RockMass::with_mass;
    const std::filesystem::path cache = std::filesystem::temp_directory_path() / "damslip-fe-bench";
    std::filesystem::remove_all(cache);
    struct Row {
        RockBoundary boundary;
        const char* name;
        std::filesystem::path cache;
    };
    for (const Row& row : {Row{RockBoundary::fixed, "fixed", {}}, Row{RockBoundary::viscous, "viscous", {}},
                           Row{RockBoundary::absorbing, "cold", {}}, Row{RockBoundary::absorbing, "warm", cache}}) {
        scene.foundation->boundary = row.boundary;
        const Measured mass = measure(scene, motion, row.cache);
        std::printf(
            "%-22s %5.2f %5.1f %8s %6d %6d | %8.3f %8.3f | %8.3f %8.3f | %5.2f %5.2f | %5.2f | %9.2f mm %9.2f mm\n",
            "7000 unknowns", friction, rock_size, row.name, massless.moving_unknowns, mass.moving_unknowns,
            massless.set_up, massless.run, mass.set_up, mass.run, mass.run / massless.run,
            (mass.set_up + mass.run) / (massless.set_up + massless.run),
            static_cast<double>(mass.result.bytes) / static_cast<double>(massless.result.bytes),
            1e3 * massless.result.slip, 1e3 * mass.result.slip);
    }
    std::filesystem::remove_all(cache);
}

void rock_table()
{
    std::printf("\nrock with mass beside massless rock, steps of 0.01 s\n%-22s %5s %5s %8s %6s %6s | %8s %8s | %8s %8s "
                "| %5s %5s | %5s "
                "| %12s %12s\n",
                "case", "mu", "rock", "edges", "moving", "moving", "set-up", "run", "set-up", "run", "ratio", "all",
                "bytes", "massless", "with mass");
    for (const double size : {12.5, 6.0}) rock_case(0.77, size);
}

/// Laws of the joint beside the same steps and mesh without them: c, f_t = c/2 with G_II 1500 and G_I 150 J/m², and water that
/// follows the opening. Bonds of weak joints break all at once, those of strong ones pair by pair.
void joint_laws_table()
{
    std::printf("\nlaws of the joint beside the same run without, steps of dt/4\n%-22s %5s %5s | %8s %8s | %5s | %5s "
                "%5s | %12s\n",
                "law", "mu", "pairs", "without", "with", "ratio", "iter", "unr.", "slip");
    const GroundMotion motion = fe2d::test::sines(3.0, 8.0);
    const auto run_of = [&](const Scene& scene, double& seconds) {
        const fe2d::EarthquakeRun run(scene, fe2d::test::options_of(scene));
        seconds = 1e9;
        fe2d::RunResult result;
        for (int repeat = 0; repeat < 2; ++repeat) {
            const double start = processor_seconds();
            result = run.run(motion);
            seconds = std::min(seconds, processor_seconds() - start);
        }
        return result;
    };
    for (const double contact_size : {0.75, 0.1875}) {
        Scene scene = fe2d::test::sliding_dam(0.77, 1.0, contact_size);
        scene.mesh.size = 2.0;
        scene.mesh.growth = 1.3;
        scene.time.substeps = 2;
        double without = 0.0, with = 0.0;
        const auto pairs = static_cast<int>(run_of(scene, without).pair_area.size());
        const auto row = [&](const char* law, const Scene& changed) {
            const fe2d::RunResult r = run_of(changed, with);
            std::printf("%-22s %5.2f %5d | %8.3f %8.3f | %5.2f | %5.2f %5d | %9.2f mm\n", law, 0.77, pairs, without,
                        with, with / without, static_cast<double>(r.counts.contact_iterations) / r.counts.steps,
                        r.counts.unresolved, 1e3 * r.slip);
        };
        for (const auto& [name, cohesion] :
             {std::pair{"bond 0.6 MPa", 0.6e6}, {"bond 2 MPa", 2e6}, {"bond 5 MPa", 5e6}}) {
            Scene bonded = scene;
            bonded.contact.cohesion = cohesion;
            bonded.contact.bond.tensile_strength = 0.5 * cohesion;
            bonded.contact.bond.tension_energy = 150.0;
            bonded.contact.bond.shear_energy = 1500.0;
            row(name, bonded);
        }
        Scene wet = scene;
        wet.uplift->water.opening = OpeningWater::reynolds;
        row("water, reynolds", wet);
    }
}

/// Strong shaking for a quarter of the time, a tenth of it after that.
GroundMotion with_coda()
{
    GroundMotion motion = fe2d::test::sines(1.0, 40.0);
    const std::size_t quiet = motion.accel_h.size() / 4;
    for (std::vector<double>* a : {&motion.accel_h, &motion.accel_v})
        for (std::size_t i = quiet; i < a->size(); ++i) (*a)[i] *= 0.1;
    motion.name = "sines and coda";
    return motion;
}

/// Sub-steps all alike beside adaptive ones: steps of the last pass, time of all passes, and what both err by.
void stepping_case(const GroundMotion& motion, double friction)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 0.5);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 6;
    const double exact = fe2d::EarthquakeRun(scene, options).run(motion).slip;
    scene.time.substeps.reset();
    for (int level = 1; level <= 4; ++level) {
        options.largest_halvings = level;
        scene.time.slip_tolerance = 1e-12; // never satisfied: all passes up to the level
        for (const Stepping stepping : {Stepping::uniform, Stepping::adaptive}) {
            scene.time.stepping = stepping;
            const fe2d::EarthquakeRun run(scene, options);
            const double start = processor_seconds();
            const fe2d::RunResult r = run.run(motion);
            const double seconds = processor_seconds() - start;
            if (stepping == Stepping::uniform)
                std::printf("%-22s %5.2f   dt/%-3d", motion.name.c_str(), friction, 1 << level);
            std::printf(" | %7d %8.3f %9.2f mm %8.4f %%", r.counts.steps, seconds, 1e3 * r.slip,
                        100.0 * std::abs(r.slip / exact - 1.0));
        }
        std::printf("\n");
    }
}

/// Kinds of elements on meshes of halved sizes, 10 s in steps of dt/4: unknowns, seconds, slip, and how far it is from Q4
/// of the two finest meshes extrapolated with first order.
void element_table(double friction)
{
    struct Row {
        const char* name;
        ElementKind kind;
        double contact;
    };
    std::vector<Row> rows;
    for (const double contact : {5.0, 2.5, 1.25, 0.625})
        rows.push_back({"Q4 incompatible", ElementKind::q4_incompatible, contact});
    for (const auto& [name, kind] :
         {std::pair{"Q8", ElementKind::q8}, {"Q9", ElementKind::q9}, {"T6", ElementKind::t6}})
        for (const double contact : {5.0, 2.5, 1.25}) rows.push_back({name, kind, contact});
    struct Measure {
        int unknowns = 0;
        double set_up = 1e9, run = 1e9, slip = 0.0;
    };
    std::vector<Measure> measures;
    const GroundMotion motion = fe2d::test::sines(1.0, 10.0);
    for (const Row& row : rows) {
        Scene scene = fe2d::test::sliding_dam(friction, 1.0, row.contact);
        scene.mesh.size = 1.6 * row.contact;
        scene.mesh.element = row.kind;
        fe2d::RunOptions options = fe2d::test::options_of(scene);
        scene.time.substeps = 2;
        Measure best;
        for (int repeat = 0; repeat < (row.contact > 2.0 ? 3 : 1); ++repeat) {
            const double start = processor_seconds();
            const fe2d::EarthquakeRun run(scene, options);
            const double ready = processor_seconds();
            best.slip = run.run(motion).slip;
            best.run = std::min(best.run, processor_seconds() - ready);
            best.set_up = std::min(best.set_up, ready - start);
            best.unknowns = run.model().dofs.count;
        }
        measures.push_back(best);
    }
    const double limit = 2.0 * measures[3].slip - measures[2].slip;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Measure& m = measures[i];
        std::printf("%-22s %5.2f %7.4f %6d | %8.3f %8.3f %8.3f | %9.2f mm %8.3f %%\n", rows[i].name, friction,
                    rows[i].contact, m.unknowns, m.set_up, m.run, m.set_up + m.run, 1e3 * m.slip,
                    100.0 * (m.slip / limit - 1.0));
    }
}

void all_element_tables()
{
    std::printf("\nkinds of elements, steps of dt/4; off: from Q4 of 1.25 and 0.625 m extrapolated\n"
                "%-22s %5s %7s %6s | %8s %8s %8s | %12s %10s\n",
                "element", "mu", "base/m", "dofs", "set-up", "run", "all", "slip", "off");
    for (const double friction : {0.77, 0.70}) element_table(friction);
}

/// A bonded base by every integrator; the error of the crest against all that is left at dt/32.
void tied_case(const char* name, bool rock, double b_k)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, rock ? 0.5 : 2.0);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    if (!rock) {
        scene.foundation.reset();
        scene.curtain.reset();
    }
    fe2d::ModelOptions model_options;
    model_options.added_mass = fe2d::test::options_of(scene).added_mass;
    const fe2d::Model model = fe2d::build_model(scene, model_options);
    const GroundMotion motion = fe2d::test::sines(1.0);
    fe2d::TiedRunOptions options;
    options.damping.constants = {1.9, b_k};
    options.scheme = fe2d::hht(-0.05);
    double direct = 0.0, limit = 0.0;
    const auto row = [&](const char* method, const auto& run) {
        const double start = processor_seconds();
        const fe2d::History history = run();
        const double seconds = processor_seconds() - start;
        if (direct == 0.0) direct = seconds;
        std::printf("%-14s %5d %-18s | %8ld %10.3g s | %8.3f %7.2f | %9.4f mm %8.3f %%\n", name, model.dofs.count,
                    method, static_cast<long>(history.steps), history.time_step, seconds, seconds / direct,
                    1e3 * history.peak_crest_x, 100.0 * (history.peak_crest_x / limit - 1.0));
    };
    const auto implicit = [&](int parts) {
        fe2d::TiedRunOptions sub = options;
        sub.dt = motion.dt / parts;
        return fe2d::integrate(model, motion, sub);
    };
    limit = implicit(32).peak_crest_x;
    row("HHT, dt", [&] { return implicit(1); });
    row("HHT, dt/8", [&] { return implicit(8); });
    row("modes", [&] { return fe2d::integrate_modal(model, motion, options); });
    row("central diff.", [&] { return fe2d::integrate_explicit(model, motion, options); });
}

/// A dam that slides on a rigid base: explicit forward increments beside HHT at its default accuracy.
void explicit_slide_case(double b_k)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, 2.0);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.damping.mass_coefficient = 1.9;
    scene.damping.stiffness_coefficient = b_k;
    const GroundMotion motion = fe2d::test::sines(1.0);
    double direct = 0.0;
    for (const TimeScheme scheme : {TimeScheme::hht, TimeScheme::central_difference}) {
        scene.time.scheme = scheme;
        const double start = processor_seconds();
        const fe2d::RunResult run = fe2d::EarthquakeRun(scene, fe2d::test::options_of(scene)).run(motion);
        const double seconds = processor_seconds() - start;
        if (direct == 0.0) direct = seconds;
        std::printf("%-20s b_K %6.4f s | %8d %10.3g s | %8.3f %7.2f | %9.3f mm, estimate %6.3f %%\n",
                    scheme == TimeScheme::hht ? "HHT" : "central difference", b_k, run.counts.steps, run.dt, seconds,
                    seconds / direct, 1e3 * run.slip, 100.0 * run.slip_error / run.slip);
    }
}

int tied_bench()
{
    std::printf("\nbonded base, 20 s; ratio to HHT at the record's step of 0.01 s; error of the peak crest motion "
                "against dt/32\n");
    tied_case("rigid base", false, 0.0);
    tied_case("rigid base", false, 0.00075);
    tied_case("rock", true, 0.0);
    tied_case("rock", true, 0.00075);
    std::printf("\nsliding on a rigid base, default accuracy of 1 %%; ratio to HHT\n");
    explicit_slide_case(0.0);
    explicit_slide_case(0.00075);
    return 0;
}

} // namespace

int main(int count, char** words)
{
    if (count > 1 && std::string_view(words[1]) == "elements") {
        all_element_tables();
        return 0;
    }
    if (count > 1 && std::string_view(words[1]) == "integrators") return tied_bench(); // these rows alone
    if (count > 1 && std::string_view(words[1]) == "joints") {
        joint_laws_table();
        return 0;
    }
    if (count > 1 && std::string_view(words[1]) == "rock") {
        rock_table();
        return 0;
    }
    std::printf("processor seconds; contact is wall time within the run\n");
    std::printf("%-22s %6s %6s %5s %5s %6s | %8s %8s %8s %8s | %9s %5s %3s %4s | %s\n", "case", "dofs", "dam", "pairs",
                "mu", "steps", "set-up", "run", "contact", "all", "a step", "iter", "max", "unr.", "slip");
    for (const double friction : {1.0, 0.77, 0.70, 0.66}) run_case("7000 unknowns", 0.5, 2.0, 1.3, friction, 0);
    run_case("10000 unknowns", 0.5, 1.5625, 1.15, 0.77, 0);
    run_case("7000, 4 sub-steps", 0.5, 2.0, 1.3, 0.77, 2);
    run_case("default mesh", 0.75, 1.5625, 1.15, 0.77, 0);
    run_case("coarse", 2.5, 4.0, 1.15, 0.77, 0);
    std::printf("\ndefault accuracy, everything included\n%-22s %5s | %8s | %6s %12s %10s | %10s %10s\n", "case", "mu",
                "all", "step", "slip", "estimate", "off dt/8", "off dt/32");
    for (const double friction : {1.0, 0.77, 0.70, 0.66}) default_case(friction);
    std::printf("\nsub-steps: all alike | adaptive; errors against dt/64\n%-22s %5s %8s | %7s %8s %12s %10s | %7s %8s "
                "%12s %10s\n",
                "motion", "mu", "smallest", "steps", "all", "slip", "error", "steps", "all", "slip", "error");
    for (const GroundMotion& motion : {fe2d::test::sines(1.0), with_coda()}) stepping_case(motion, 0.77);
    std::printf("\nfrictions in lockstep\n%-22s %6s | %8s %8s %5s | %s\n", "case", "batch", "singly", "in step",
                "ratio", "factorisations");
    for (const int batch : {2, 4, 6}) lockstep_case(batch);
    std::printf("\nacoustic water beside added mass, steps of 0.01 s; ratio of the runs, and set-up included\n"
                "%-22s %5s %5s %6s %6s | %8s %8s | %8s %8s | %5s %5s | %12s %12s\n",
                "case", "mu", "rows", "dam", "water", "set-up", "run", "set-up", "run", "ratio", "all", "slip, added",
                "acoustic");
    for (const double rows : {16.0, 20.0, 125.0}) water_case(0.77, rows);
    rock_table();
    joint_laws_table();
    std::printf("\nreduced runs\n%-22s %6s %5s %5s %6s | %8s %8s %8s %8s | %8s %5s | %12s %10s %10s\n", "case", "dofs",
                "mu", "modes", "steps", "set-up", "modes", "run", "all", "full", "ratio", "slip", "error", "estimate");
    for (const double friction : {1.0, 0.77, 0.70, 0.66})
        for (const int modes : {fe2d::default_modes, 4 * fe2d::default_modes})
            reduced_case("7000 unknowns", 0.5, 2.0, 1.3, friction, modes);
    all_element_tables();
    return tied_bench();
}
