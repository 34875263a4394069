// What is not written or compared for CalculiX, each with the scene's or the result file's name, what would do, and a fix that does.
#include "verifier_answer.hpp"
#include "second_solver_scene.hpp"

#include <functional>

namespace damslip::calculix_tests {

namespace {

constexpr SecondAnalysis of_modes = SecondAnalysis::modes, of_tied = SecondAnalysis::tied,
                         of_contact = SecondAnalysis::static_contact;

class SecondSolverRefusals : public SecondSolver {
protected:
    /// The only thing that is wrong.
    template <class Call>
    static Diagnostic refused(const Call& call)
    {
        try {
            call();
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().size(), 1u);
            return error.diagnostics().front();
        } catch (const NotConverged& error) {
            return error.diagnostic();
        }
        ADD_FAILURE() << "not refused";
        return {};
    }
    Diagnostic refused_deck(const BlockScene& scene, SecondAnalysis analysis)
    {
        const Ready at = ready(scene);
        const Diagnostic d = refused([&] { deck(at, analysis); });
        EXPECT_EQ(d.file, (folder / "block.toml").string());
        return d;
    }
};

struct Refusal {
    const char* name;
    std::function<void(BlockScene&)> change;
    std::vector<SecondAnalysis> of;
    std::string problem, expected, fix;
};

// Every kind of scene that has no counterpart, by its own message.
TEST_F(SecondSolverRefusals, ScenesWithoutACounterpart)
{
    const std::vector<Refusal> all{
        {"acoustic water",
         [](BlockScene& s) { s.water = "[reservoir]\nlevel_m = 15\nmodel = \"acoustic\"\n"; },
         {of_modes, of_tied, of_contact},
         "reservoir.model = \"acoustic\"",
         "added mass or none",
         "model = \"added-mass\""},
        {"rock with mass",
         [](BlockScene& s) { s.rock.replace(s.rock.find("\"massless\""), 10, "\"with-mass\"\ndensity_kg_m3 = 2600"); },
         {of_modes, of_tied, of_contact},
         "rock that has mass",
         "massless rock, or none",
         "mass = \"massless\""},
        {"linear elements",
         [](BlockScene& s) { s.mesh = "[mesh]\nelement = \"q4\"\nsize_m = 5\n"; },
         {of_modes, of_tied, of_contact},
         "elements that it does not have",
         "mesh.element = \"q8\"",
         "element = \"q8\""},
        {"rigid base",
         [](BlockScene& s) { s.rock = ""; },
         {of_contact},
         "a dam without rock",
         "a dam on rock",
         "add [foundation]"},
        {"lift joint",
         [](BlockScene& s) { s.motion = "[[lift_joint]]\nelevation_m = 10\nfriction = 1\n" + s.motion; },
         {of_contact},
         "lift joints, cohesion or anchors",
         "friction on the base alone",
         "leave them out"},
        {"cohesion",
         [](BlockScene& s) { s.contact += "cohesion_kPa = 100\n"; },
         {of_contact},
         "lift joints, cohesion or anchors",
         "friction on the base alone",
         "leave them out"},
        {"anchor",
         [](BlockScene& s) {
             s.motion =
                 "[[anchor]]\ndistance_m = 4\nfree_length_m = 10\narea_m2_m = 0.001\nyield_strength_MPa = 1500\n" +
                 s.motion;
         },
         {of_contact},
         "lift joints, cohesion or anchors",
         "friction on the base alone",
         "leave them out"},
        {"penalty",
         [](BlockScene& s) { s.contact += "enforcement = \"penalty\"\ntangential_stiffness_GN_m3 = 10\n"; },
         {of_contact},
         "a contact law that gives way",
         "contact.enforcement = \"exact\", normal = \"hard\"",
         "delete enforcement and normal"},
        {"soft normal",
         [](BlockScene& s) { s.contact += "normal = \"exponential\"\n"; },
         {of_contact},
         "a contact law that gives way",
         "contact.enforcement = \"exact\", normal = \"hard\"",
         "delete enforcement and normal"},
        {"other nodes",
         [](BlockScene& s) { s.mesh += "rock_contact_size_m = 3\n"; },
         {of_contact},
         "mesh.rock_contact_size_m",
         "nodes of dam and rock that face each other",
         "delete rock_contact_size_m"},
        {"no record",
         [](BlockScene& s) { s.motion = ""; },
         {of_tied},
         "a scene without a record",
         "[[motion.record]]",
         "--record FILE"},
        {"a_M beside water",
         [](BlockScene& s) { s.damping = "[damping]\nmass_coefficient_1_s = 0.5\nstiffness_coefficient_s = 0.003\n"; },
         {of_tied},
         "mass-proportional damping a_M = 0.5 1/s beside added mass",
         "a_M = 0",
         "mass_coefficient_1_s = 0"},
        {"a_M of the total velocity",
         [](BlockScene& s) {
             s.water = "";
             s.damping = "[damping]\nmass_coefficient_1_s = 0.5\nstiffness_coefficient_s = 0.003\nmass = \"total\"\n";
         },
         {of_tied},
         "a_M = 0.5 1/s of the total velocity",
         "a_M = 0",
         "mass_coefficient_1_s = 0"}};
    for (const Refusal& one : all) {
        BlockScene scene;
        one.change(scene);
        for (const SecondAnalysis analysis : {of_modes, of_tied, of_contact}) {
            SCOPED_TRACE(one.name + fmt::format(", analysis {}", static_cast<int>(analysis)));
            if (std::find(one.of.begin(), one.of.end(), analysis) == one.of.end()) {
                const Ready at = ready(scene);
                EXPECT_NO_THROW(deck(at, analysis));
                continue;
            }
            const Diagnostic d = refused_deck(scene, analysis);
            EXPECT_NE(d.problem.find(one.problem), std::string::npos) << d.problem;
            EXPECT_NE(d.expected.find(one.expected), std::string::npos) << d.expected;
            EXPECT_NE(d.fix.find(one.fix), std::string::npos) << d.fix;
        }
    }
}

// The same scene is refused when its results are read, before the file is.
TEST_F(SecondSolverRefusals, ResultsOfSuchAScene)
{
    BlockScene scene;
    scene.mesh = "[mesh]\nelement = \"q4\"\nsize_m = 5\n";
    const Ready at = ready(scene);
    EXPECT_NE(refused([&] { beside(at, of_modes, 4, "nothing"); }).problem.find("elements that it does not have"),
              std::string::npos);
}

TEST_F(SecondSolverRefusals, AFileOfTooFewModes)
{
    const Ready at = ready({});
    const Diagnostic d = refused([&] { beside(at, of_modes, 4, printed_modes({5.0, 11.0})); });
    EXPECT_EQ(d.text().substr(0, 9), "block.dat");
    EXPECT_EQ(d.problem, "2 modes in the file, 4 asked for.");
    EXPECT_EQ(d.fix, "add  --modes 2");
    EXPECT_EQ(beside(at, of_modes, 2, printed_modes({5.0, 11.0})).size(), 2u); // the fix does
}

TEST_F(SecondSolverRefusals, ARunThatWasCut)
{
    const Ready at = ready({});
    const Diagnostic d = refused([&] { beside(at, of_tied, 4, printed_crest(std::vector<double>(61, 1e-3), 0.01)); });
    EXPECT_EQ(d.file, "block.dat");
    EXPECT_EQ(d.problem, "the file ends at 0.6 s, the record at 1.2 s.");
    EXPECT_EQ(d.fix, "write the deck anew and run ccx to its end");
}

// Our steps are 1 ms.
TEST_F(SecondSolverRefusals, ARunOfOtherSteps)
{
    const Ready at = ready({});
    const Diagnostic d =
        refused([&] { beside(at, of_tied, 4, printed_crest(std::vector<double>(300, 1e-3), 0.0125)); });
    EXPECT_EQ(d.file, "block.dat");
    EXPECT_EQ(d.problem, "the file has the crest at 0.0125 s, which is no step of our run.");
    EXPECT_EQ(d.expected, "the steps of the record");
}

TEST_F(SecondSolverRefusals, StagesOfAnotherScene)
{
    const Ready at = ready({});
    const auto stage = [](int number, int nodes) {
        std::string dat = fmt::format(" displacements (vx,vy,vz) for set NDAM and time {:15.7E}\n\n", 1.0 * number);
        for (int n = 1; n <= nodes; ++n) dat += fmt::format("{:10d}  0.0  0.0  0.0\n", n);
        return dat + "\n   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n\n  0.0 1.0 0.0 0.0 "
                     "0.0 0.0\n";
    };
    // Gravity, water, and an uplift of nothing.
    const auto dam = Deck(deck(at, of_contact)).node_sets.at("Ndam").size();
    const Diagnostic few = refused([&] { beside(at, of_contact, 1, stage(1, static_cast<int>(dam))); });
    EXPECT_EQ(few.problem, fmt::format("1 stages of {0} nodes in the file, 3 of {0} in the scene.", dam));
    const Diagnostic other = refused([&] { beside(at, of_contact, 1, stage(1, 3) + stage(2, 3)); });
    EXPECT_EQ(other.problem, fmt::format("2 stages of 3 nodes in the file, 3 of {} in the scene.", dam));
    EXPECT_EQ(other.file, "block.dat");
    EXPECT_EQ(other.expected, "all stages of the deck of this scene");
}

// T/N = 1103.6/7063 = 0.156: a base of 0.1 does not hold, whatever CalculiX says of it.
TEST_F(SecondSolverRefusals, ADamThatDoesNotStand)
{
    BlockScene scene;
    scene.contact = "[contact]\nfriction = 0.1\n";
    const Ready at = ready(scene);
    const auto dam = Deck(deck(at, of_contact)).node_sets.at("Ndam").size();
    std::string dat;
    for (const int number : {1, 2, 3}) {
        dat += fmt::format(" displacements (vx,vy,vz) for set NDAM and time {:15.7E}\n\n", 1.0 * number);
        for (std::size_t n = 1; n <= dam; ++n) dat += fmt::format("{:10d}  0.0  0.0  0.0\n", n);
        dat +=
            "\n   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n\n  0.0 1.0 0.0 0.0 0.0 0.0\n";
    }
    const Diagnostic d = refused([&] { beside(at, of_contact, 1, dat); });
    EXPECT_NE(d.problem.find("0.156"), std::string::npos) << d.problem;
    EXPECT_EQ(d.expected, "a dam that stands under its loads");
    EXPECT_EQ(d.fix, "raise contact.friction or lower the water");
}

// Of the command: exit code 2 and flags that do; 3 for a file that holds nothing.
TEST_F(SecondSolverRefusals, TheCommandAsksForWhatIsMissing)
{
    const std::string scene = (folder / "block.toml").string(), dat = (folder / "block.dat").string();
    write_file(scene, BlockScene{}.text());
    write_file(dat, "nothing");
    const ProgramAnswer aimless = verifier_answer({"mesh", scene, "--to", "calculix"});
    EXPECT_EQ(aimless.code, 2);
    EXPECT_NE(aimless.talk.find("--to calculix without --out and without --results."), std::string::npos)
        << aimless.talk;
    EXPECT_NE(aimless.talk.find("add  --out FILE.inp , or  --results FILE.dat"), std::string::npos) << aimless.talk;
    const ProgramAnswer gmsh = answer_of({"mesh", scene, "--results", dat});
    EXPECT_EQ(gmsh.code, 2);
    EXPECT_NE(gmsh.talk.find("--results without --to calculix."), std::string::npos) << gmsh.talk;
    for (const auto& [analysis, missing] : {std::pair{"modes", "eigenvalues"},
                                            {"tied", "displacements of the crest"},
                                            {"static-contact", "static stages"}}) {
        const ProgramAnswer empty =
            verifier_answer({"mesh", scene, "--to", "calculix", "--analysis", analysis, "--results", dat});
        EXPECT_EQ(empty.code, 3) << analysis;
        EXPECT_NE(empty.talk.find(dat + ": error: no " + missing + " in the file."), std::string::npos) << empty.talk;
    }
}

} // namespace

} // namespace damslip::calculix_tests
