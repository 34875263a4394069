// Decks for CalculiX, and its printed results. That both programs agree is tested by scripts/second-solver.sh.
#include "core/input_error.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe_scenes.hpp"
#include "verification/second_solver/deck.hpp"
#include "verification/second_solver/read_dat.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Scene quadratic_dam()
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.mesh.element = ElementKind::q8;
    scene.mesh.size = scene.mesh.contact_size = 7.5;
    scene.curtain.reset();
    return scene;
}

double water_law(Point p, double angle)
{
    return 1e3 * (70.0 - p.y) * (1.0 + angle);
}

// Both are the same sum over the same quadrature points: round-off. The level cuts an edge, the face is inclined.
TEST(CalculixDeck, PointMassesAreTheAddedMassMatrix)
{
    Scene scene = quadratic_dam();
    const Model model = build_model(scene);
    const double level = 51.3;
    const NodeChain& face = model.mesh.downstream_face; // inclined
    const Eigen::MatrixXd expected = added_mass_matrix(model.mesh, model.dofs, face, water_law, level);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(model.dofs.count, model.dofs.count);
    for (const AddedMassPoint& p : added_mass_points(model.mesh, face, water_law, level)) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(model.dofs.count);
        for (int i = 0; i < 3; ++i)
            for (const int c : {0, 1})
                if (p.nodes[i] >= 0 && model.dofs(p.nodes[i], c) != no_dof)
                    row[model.dofs(p.nodes[i], c)] += p.shape[i] * p.normal[c];
        sum += p.mass * row * row.transpose();
    }
    EXPECT_GT(expected.norm(), 0.0);
    EXPECT_LT((sum - expected).norm(), 1e-13 * expected.norm());
}

// Every element has eight nodes, those without a middle node on the base get one, and an equation for each component.
TEST(CalculixDeck, WritesEveryElementWithEightNodes)
{
    const Model model = build_model(quadratic_dam());
    ASSERT_EQ(not_for_calculix(model), "");
    std::istringstream deck(calculix_modes_deck({model, {}, "dam"}, 4));
    int elements = 0, equations = 0;
    bool inside = false;
    for (std::string line; std::getline(deck, line);) {
        if (line == "*EQUATION") ++equations;
        if (line[0] == '*')
            inside = line.starts_with("*ELEMENT, TYPE=CPE8");
        else if (inside) {
            ++elements;
            EXPECT_EQ(std::count(line.begin(), line.end(), ','), 8) << line;
        }
    }
    EXPECT_EQ(elements, model.mesh.element_count());
    // Tied, the edges of the base are those of the dam; the sliding path beside it is linear, too.
    EXPECT_EQ(equations, 2 * static_cast<int>(model.mesh.contact.rock_line.size() - 1));
}

TEST(CalculixDeck, SaysWhatItHasNoCounterpartFor)
{
    Scene scene = quadratic_dam();
    scene.mesh.element = ElementKind::q4_incompatible;
    EXPECT_NE(not_for_calculix(build_model(scene)).find("linear elements"), std::string::npos);
    scene.mesh.element = ElementKind::q9;
    EXPECT_NE(not_for_calculix(build_model(scene)).find("centre"), std::string::npos);
}

TEST(CalculixOutput, ReadsFrequenciesCrestAndStages)
{
    const CalculixOutput modes("     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE\n\n"
                               "      1   0.3576835E+03   0.1891252E+02   0.3010007E+01   0.0000000E+00\n\n"
                               "     P A R T I C I P A T I O N   F A C T O R S\n      1   0.1 0.2 0.3 0.4\n",
                               "a.dat");
    ASSERT_EQ(modes.frequencies().size(), 1u);
    EXPECT_DOUBLE_EQ(modes.frequencies()[0], 3.010007);
    const CalculixOutput run(" displacements (vx,vy,vz) for set NCREST and time  0.5000000E-02\n\n"
                             "        7  1.5E-03 -2.0E-04  0.0E+00\n",
                             "b.dat");
    ASSERT_EQ(run.crest().size(), 1u);
    EXPECT_DOUBLE_EQ(run.crest()[0].time, 0.005);
    EXPECT_DOUBLE_EQ(run.crest()[0].x, 0.0015);
    // An increment on the way to a stage's end is passed over.
    const std::string block =
        " displacements (vx,vy,vz) for set NDAM and time  {}\n\n        1  1.0E-03 2.0E-03  0.0E+00\n\n"
        "   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n\n"
        "   -2.0E+00  5.0E+00  0.0E+00  0.0E+00  0.0E+00  0.0E+00\n";
    std::string half = block, whole = block;
    half.replace(half.find("{}"), 2, "0.5000000E+00");
    whole.replace(whole.find("{}"), 2, "0.1000000E+01");
    const std::vector<StageOutput> stages = CalculixOutput(half + whole, "c.dat").stages();
    ASSERT_EQ(stages.size(), 1u);
    EXPECT_EQ(stages[0].displacement, (std::vector<double>{0.001, 0.002}));
    EXPECT_DOUBLE_EQ(stages[0].normal_force, 5.0);
    EXPECT_DOUBLE_EQ(stages[0].shear_force, 2.0);
}

TEST(CalculixOutput, RefusesAFileWithoutResults)
{
    EXPECT_THROW(CalculixOutput("nothing", "a.dat").frequencies(), InputError);
    EXPECT_THROW(CalculixOutput("nothing", "a.dat").crest(), InputError);
    EXPECT_THROW(CalculixOutput("nothing", "a.dat").stages(), InputError);
}

} // namespace
