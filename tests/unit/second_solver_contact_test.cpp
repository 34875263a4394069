// Static contact beside a second solver. What ccx would print are the displacements of our own static state, read back by the elements of
// calculix_reader.hpp; resultants are statics by hand. So the deck's forces, weights and surfaces have to be those of the scene, and
// what is put wrong on purpose has to come out as the difference.
#include "fe2d/run/earthquake_run.hpp"
#include "second_solver_scene.hpp"

namespace damslip::calculix_tests {

namespace {

constexpr double gravity_accel = 9.81, water_density = 1000.0;

/// Displacements of the dam's nodes at the end of each static stage [m].
std::vector<Eigen::VectorXd> states_of(const Ready& ready, const Watch& watch)
{
    const fe2d::EarthquakeRun run(ready.scene, ready.run_options(watch));
    const fe2d::ContactStructure& structure = run.structure();
    const fe2d::Model& model = run.model();
    fe2d::StaticContact statics(structure);
    fe2d::Strength strength(ready.scene.contact, structure.plane());
    fe2d::ContactMemory memory(structure.pairs());
    std::vector<Eigen::VectorXd> states;
    for (std::size_t s = 0; s < run.stages().names.size(); ++s) {
        const fe2d::SplitLoad load = structure.split(run.stages().loads[s]);
        const fe2d::StageResult stage =
            fe2d::solve_stage(statics, structure, run.stages().names[s], load, strength, memory);
        EXPECT_EQ(stage.status, fe2d::StageStatus::ok) << text_of(stage.notes());
        const fe2d::StaticState state = statics.displacements(load, memory);
        const Eigen::VectorXd all =
            fe2d::nodal_values(model.dofs, structure.assemble(state.dam, state.rock, run.stages().loads[s]));
        states.push_back(all.head(2 * model.mesh.dam_node_count));
    }
    return states;
}

/// As ccx prints one stage. @param normal, shear  of the contact on the dam, up and upstream [N/m]
std::string printed_stage(int number, const Eigen::VectorXd& u, double normal, double shear)
{
    std::string dat = fmt::format("\n displacements (vx,vy,vz) for set NDAM and time {:15.7E}\n\n", 1.0 * number);
    for (Eigen::Index n = 0; n < u.size() / 2; ++n)
        dat += fmt::format("{:10d}{:15.6E}{:15.6E}{:15.6E}\n", n + 1, u[2 * n], u[2 * n + 1], 0.0);
    return dat + fmt::format("\n statistics for slave set SDAM, master set SROCK and time {:15.7E}\n\n"
                             "   total surface force (fx,fy,fz) and moment about the origin (mx,my,mz)\n\n"
                             "{:15.6E}{:15.6E}{:15.6E}{:15.6E}{:15.6E}{:15.6E}\n",
                             1.0 * number, -shear, normal, 0.0, 0.0, 0.0, 0.0);
}

/// Weight, thrust and uplift by hand [N/m]; a rectangle, full uplift at the heel, none at the toe.
struct ByHand {
    double weight, thrust, uplift;
    explicit ByHand(const BlockScene& scene, bool lifted)
        : weight(20.0 * scene.base * 2400.0 * gravity_accel), thrust(0.5 * water_density * gravity_accel * 15.0 * 15.0),
          uplift(lifted ? 0.5 * water_density * gravity_accel * 15.0 * scene.base : 0.0)
    {
    }
};

/// What the deck's elements say of a state: forces that the base has to put on the dam.
struct BaseOfDeck {
    std::vector<int> nodes;              ///< heel to toe
    Eigen::VectorXd normal, shear, area; ///< up, and upstream [N/m]; [m]
    double elsewhere = 0.0;              ///< largest force that is left on other nodes [N/m]

    BaseOfDeck(const Deck& deck, const Eigen::VectorXd& u, std::size_t step)
    {
        std::map<int, double> length;
        for (const auto& [element, side] : deck.surfaces.at("Sdam")) {
            const auto e = std::find_if(deck.elements.begin(), deck.elements.end(),
                                        [&](const DeckElement& x) { return x.number == element; });
            const int a = e->nodes[static_cast<std::size_t>(side - 1)],
                      b = e->nodes[static_cast<std::size_t>(side % 4)];
            for (const int n : {a, b}) length[n] += 0.5 * (deck.nodes.at(a) - deck.nodes.at(b)).norm();
        }
        for (const auto& [node, half] : length) nodes.push_back(node);
        std::sort(nodes.begin(), nodes.end(),
                  [&](int a, int b) { return deck.nodes.at(a).x() < deck.nodes.at(b).x(); });
        const DeckModel dam(deck, {"Edam"});
        Eigen::VectorXd full = Eigen::VectorXd::Zero(dam.stiffness.rows());
        const auto& set = deck.node_sets.at("Ndam");
        for (std::size_t n = 0; n < set.size(); ++n)
            for (const int c : {0, 1}) full[dam.row(set[n], c)] = u[static_cast<Eigen::Index>(2 * n) + c];
        for (const auto& e : deck.equations) { // middles of linear edges
            double sum = 0.0;
            for (std::size_t i = 1; i < e.size(); ++i)
                sum -= e[i].value / e[0].value * full[dam.row(e[i].node, e[i].component)];
            full[dam.row(e[0].node, e[0].component)] = sum;
        }
        DeckStep all = deck.steps.at(step);
        all.body = deck.steps.at(0).body; // the weight stays on
        Eigen::VectorXd left = dam.stiffness * full - dam.force(all, "");
        for (const auto& e : deck.equations) {
            const double own = left[dam.row(e[0].node, e[0].component)];
            for (std::size_t i = 1; i < e.size(); ++i)
                left[dam.row(e[i].node, e[i].component)] -= e[i].value / e[0].value * own;
            left[dam.row(e[0].node, e[0].component)] = 0.0;
        }
        normal = shear = area = Eigen::VectorXd(std::ssize(nodes));
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            normal[k] = std::exchange(left[dam.row(nodes[i], 1)], 0.0);
            shear[k] = -std::exchange(left[dam.row(nodes[i], 0)], 0.0);
            area[k] = length.at(nodes[i]);
        }
        for (const int node : set) // forces on the rock's nodes are the rock's
            for (const int c : {0, 1}) elsewhere = std::max(elsewhere, std::abs(left[dam.row(node, c)]));
    }
};

/// Tractions in L2, without two pairs at each end.
double apart(const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs, const Eigen::VectorXd& area)
{
    const auto inner = Eigen::seq(2, area.size() - 3);
    return std::sqrt(((ours - theirs)(inner).array().square() / area(inner).array()).sum() /
                     (theirs(inner).array().square() / area(inner).array()).sum());
}

class SecondSolverContact : public SecondSolver {
protected:
    static BlockScene lifted(double base = 15.0, double friction = 0.8)
    {
        BlockScene scene;
        scene.base = base;
        scene.uplift = "[uplift]\nmodel = \"linear\"\n";
        scene.contact = fmt::format("[contact]\nfriction = {}\n", friction);
        scene.mesh = "[mesh]\nelement = \"q8\"\nsize_m = 5\ncontact_size_m = 1\n";
        scene.motion = "";
        return scene;
    }
};

// The stages of the deck against statics: the weight is a body force of the first, the water's sum is its thrust, the uplift on both
// sides of the joint sums to nothing, and what is on the dam's nodes alone is half a rectangle of pressure.
TEST_F(SecondSolverContact, StagesCarryTheScenesForces)
{
    const BlockScene scene = lifted();
    const Deck deck(this->deck(ready(scene), SecondAnalysis::static_contact));
    const ByHand hand(scene, true);
    ASSERT_EQ(deck.steps.size(), 3u); // gravity, water, uplift
    ASSERT_EQ(deck.steps[0].body.size(), 1u);
    EXPECT_TRUE(deck.steps[1].body.empty());
    const DeckModel dam(deck, {"Edam"});
    const std::set<int> of_dam(deck.node_sets.at("Ndam").begin(), deck.node_sets.at("Ndam").end());
    const auto sum = [&](std::size_t step, bool dam_alone) {
        Eigen::Vector2d total = Eigen::Vector2d::Zero();
        for (const auto& [amplitude, forces] : deck.steps[step].nodal) {
            EXPECT_EQ(amplitude, "");
            for (const NodalForce& f : forces)
                if (!dam_alone || of_dam.contains(f.node)) total[f.component] += f.value;
        }
        return total;
    };
    DeckStep weight;
    weight.body = deck.steps[0].body;
    const Eigen::VectorXd gravity = dam.force(weight, "");
    double down = 0.0;
    for (Eigen::Index i = 1; i < gravity.size(); i += 2) down -= gravity[i];
    EXPECT_NEAR(down, hand.weight, 1e-9 * hand.weight);
    const double scale = 1e-9 * hand.weight;
    EXPECT_LT(sum(0, false).norm(), scale);
    EXPECT_NEAR(sum(1, true).x(), hand.thrust, scale);
    EXPECT_NEAR(sum(1, true).y(), 0.0, scale);
    EXPECT_NEAR(sum(2, true).x(), hand.thrust, scale);
    EXPECT_NEAR(sum(2, true).y(), hand.uplift, scale);
    EXPECT_NEAR((sum(2, false) - sum(1, false)).norm(), 0.0, scale);
}

// Each side of a surface is where it belongs, the dam's cover the base, the rock's that and 1 m beyond; friction and springs of 100 E per metre.
TEST_F(SecondSolverContact, SurfacesAreTheBase)
{
    const Deck deck(this->deck(ready(lifted()), SecondAnalysis::static_contact));
    for (const auto& [name, sign, from, to] : {std::tuple{"Sdam", 1.0, 0.0, 15.0}, {"Srock", -1.0, -1.0, 16.0}}) {
        double length = 0.0, first = 1e9, last = -1e9;
        for (const auto& [element, number] : deck.surfaces.at(name)) {
            const auto [a, b] = deck.side(element, number);
            EXPECT_EQ(a.y(), 0.0) << name;
            EXPECT_EQ(b.y(), 0.0) << name;
            EXPECT_GT(sign * (b.x() - a.x()), 0.0) << name; // anticlockwise: the dam is above, the rock below
            length += std::abs(b.x() - a.x());
            first = std::min({first, a.x(), b.x()});
            last = std::max({last, a.x(), b.x()});
        }
        EXPECT_NEAR(first, from, 1e-9) << name;
        EXPECT_NEAR(last, to, 1e-9) << name;
        EXPECT_NEAR(length, to - from, 1e-9) << name;
    }
    EXPECT_EQ(deck.contact.at("FRICTION").lines.at(0).at(0), "0.8");
    EXPECT_DOUBLE_EQ(std::stod(deck.contact.at("FRICTION").lines.at(0).at(1)), 100 * 20e9);
    EXPECT_DOUBLE_EQ(std::stod(deck.contact.at("SURFACE BEHAVIOR").lines.at(0).at(0)), 100 * 20e9);
    EXPECT_EQ(deck.contact.at("CONTACT PAIR").lines.at(0), (std::vector<std::string>{"Sdam", "Srock"}));
}

// Under the deck's loads our state is in equilibrium by the deck's elements, with the base's resultants of statics.
TEST_F(SecondSolverContact, OurStateIsInEquilibriumByTheDeck)
{
    const BlockScene scene = lifted();
    const Ready at = ready(scene);
    const Deck deck(this->deck(at, SecondAnalysis::static_contact));
    const auto states = states_of(at, watch);
    for (std::size_t s = 0; s < states.size(); ++s) {
        const ByHand hand(scene, s == 2);
        const BaseOfDeck base(deck, states[s], s);
        EXPECT_NEAR(base.normal.sum(), hand.weight - hand.uplift, 1e-7 * hand.weight) << s;
        EXPECT_NEAR(base.shear.sum(), s == 0 ? 0.0 : hand.thrust, 1e-7 * hand.weight) << s;
        EXPECT_LT(base.elsewhere, 1e-7 * hand.weight) << s;
    }
}

// Seven digits of displacements leave some 1e-5 of the tractions. No row on opening: the base is shut.
TEST_F(SecondSolverContact, OurOwnStateIsWithin)
{
    const BlockScene scene = lifted();
    const Ready at = ready(scene);
    const ByHand hand(scene, true);
    const auto states = states_of(at, watch);
    std::string dat;
    for (std::size_t s = 0; s < 3; ++s)
        dat += printed_stage(static_cast<int>(s) + 1, states[s], hand.weight - (s == 2 ? hand.uplift : 0.0),
                             s == 0 ? 0.0 : hand.thrust);
    const auto rows = beside(at, SecondAnalysis::static_contact, 1, dat);
    ASSERT_EQ(rows.size(), 4u);
    for (const SecondResult& row : rows) EXPECT_LT(row.difference, 1e-4) << row.what;
    EXPECT_NEAR(rows[0].ours, hand.weight - hand.uplift, 1e-6 * hand.weight);
    EXPECT_NEAR(rows[1].ours, hand.thrust, 1e-6 * hand.weight);
}

// The state of another friction carries the same resultants with other tractions: rows 1 and 2 within, 3 and 4 apart by the L2
// difference of both states, each by the deck's elements. A normal force put wrong by 0.2 % is outside by as much.
TEST_F(SecondSolverContact, AnotherFrictionIsSeenInTheTractions)
{
    const BlockScene scene = lifted(), slippery = lifted(15.0, 0.25);
    const Ready at = ready(scene);
    const ByHand hand(scene, true);
    const auto ours = states_of(at, watch), theirs = states_of(ready(slippery), watch);
    const double normal = hand.weight - hand.uplift;
    const auto dat = [&](double share) {
        std::string text;
        for (int s = 0; s < 3; ++s)
            text += printed_stage(s + 1, theirs[static_cast<std::size_t>(s)], share * normal, hand.thrust);
        return text;
    };
    const auto rows = beside(at, SecondAnalysis::static_contact, 1, dat(1.0));
    const Deck deck(this->deck(at, SecondAnalysis::static_contact));
    const BaseOfDeck we(deck, ours[2], 2), they(deck, theirs[2], 2);
    EXPECT_TRUE(rows.at(0).within());
    EXPECT_TRUE(rows.at(1).within());
    EXPECT_NEAR(rows.at(2).difference, apart(we.normal, they.normal, we.area), 1e-4);
    EXPECT_NEAR(rows.at(3).difference, apart(we.shear, they.shear, we.area), 1e-4);
    EXPECT_FALSE(rows.at(3).within()) << rows.at(3).difference;
    const auto wrong = beside(at, SecondAnalysis::static_contact, 1, dat(1.002));
    EXPECT_FALSE(wrong.at(0).within());
    EXPECT_NEAR(wrong.at(0).difference, 0.002 / 1.002, 1e-6);
    EXPECT_TRUE(wrong.at(1).within());
}

// A dam of 7 m stands with its heel open. Its own state has the same length open; the state before the uplift, under the loads of the
// last stage, has the length where its pressure is less than the uplift.
TEST_F(SecondSolverContact, OpenLengthIsThatOfThePairsWithoutPressure)
{
    const BlockScene scene = lifted(7.0, 0.9);
    const Ready at = ready(scene);
    const ByHand hand(scene, true);
    const auto states = states_of(at, watch);
    const auto dat = [&](const Eigen::VectorXd& last) {
        const double normal = hand.weight - hand.uplift;
        return printed_stage(1, states[0], normal, hand.thrust) + printed_stage(2, states[1], normal, hand.thrust) +
               printed_stage(3, last, normal, hand.thrust);
    };
    const Deck deck(this->deck(at, SecondAnalysis::static_contact));
    const auto open = [&](const Eigen::VectorXd& u) {
        const BaseOfDeck base(deck, u, 2);
        return (base.normal.array() < 1e-3 * base.normal.sum() / 7.0 * base.area.array()).select(base.area, 0.0).sum();
    };
    const auto same = beside(at, SecondAnalysis::static_contact, 1, dat(states[2]));
    ASSERT_EQ(same.size(), 5u);
    EXPECT_GT(same[4].ours, 2.0);
    EXPECT_DOUBLE_EQ(same[4].ours, open(states[2]));
    EXPECT_EQ(same[4].difference, 0.0);
    EXPECT_DOUBLE_EQ(same[4].allowed, 1.0 / 7.0); // one pair
    const auto other = beside(at, SecondAnalysis::static_contact, 1, dat(states[1]));
    EXPECT_NEAR(other.at(4).theirs, open(states[1]), 1e-9);
    EXPECT_NEAR(other.at(4).difference, std::abs(open(states[1]) - open(states[2])) / 7.0, 1e-9);
}

// An empty dam has no thrust: a shear force that is nothing but round-off and the digits of a file must not be told as a difference.
TEST_F(SecondSolverContact, NoShearForceIsNoDifference)
{
    BlockScene scene = lifted();
    scene.water = scene.uplift = "";
    const Ready at = ready(scene);
    const auto states = states_of(at, watch);
    ASSERT_EQ(states.size(), 1u);
    const ByHand hand(scene, false);
    for (const double shear : {0.0, 1e-7 * hand.weight})
        for (const SecondResult& row :
             beside(at, SecondAnalysis::static_contact, 1, printed_stage(1, states[0], hand.weight, shear)))
            EXPECT_TRUE(row.within()) << row.what << ", " << row.difference;
    const auto wrong =
        beside(at, SecondAnalysis::static_contact, 1, printed_stage(1, states[0], hand.weight, 0.01 * hand.weight));
    EXPECT_FALSE(wrong.at(1).within());
}

} // namespace

} // namespace damslip::calculix_tests
