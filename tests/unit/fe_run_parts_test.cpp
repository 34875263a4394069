// Parts of the staged run: factor with the interface last, condensed rock, products, resultants.
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/run/contact_structure.hpp"
#include "fe2d/run/node_products.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/condensation.hpp"
#include "fe2d/time/structure_system.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Model parts_model()
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, 9.0);
    scene.mesh.size = 12.0;
    scene.foundation->width = 150.0;
    scene.foundation->depth = 60.0;
    ModelOptions options;
    options.base = Base::separate;
    options.added_mass = fe2d::test::options_of(scene).added_mass;
    return build_model(scene, options);
}

VectorXd uneven(Index n)
{
    VectorXd v(n);
    for (Index i = 0; i < n; ++i) v[i] = std::sin(1.7 * static_cast<double>(i) + 0.3);
    return v;
}

// A x = b with A = a M + K in two passes, against a dense solution; round-off times the condition (about 1e5).
TEST(FeRunParts, factor_with_the_interface_last_solves_the_body)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    ASSERT_TRUE(structure.regular());
    const SparseMatrix a = 4e4 * structure.mass() + structure.stiffness();
    const Index n = a.rows(), inner = structure.inner_unknowns(), rest = n - inner;
    const InterfaceFactor factor(a, structure.order().inner);
    ASSERT_TRUE(factor.regular());
    const MatrixXd dense(a);
    const MatrixXd schur = dense.bottomRightCorner(rest, rest) -
                           dense.bottomLeftCorner(rest, inner) *
                               dense.topLeftCorner(inner, inner).ldlt().solve(dense.topRightCorner(inner, rest));
    EXPECT_LT((factor.schur() - schur).norm(), 1e-12 * schur.norm());

    const VectorXd b = uneven(n), x = dense.ldlt().solve(b);
    VectorXd y = b;
    factor.forward(y);
    const VectorXd u_c = schur.ldlt().solve(VectorXd(y.tail(rest)));
    EXPECT_NEAR(factor.inner_product(y, y) + u_c.dot(y.tail(rest)), b.dot(x), 1e-10 * std::abs(b.dot(x)));
    y.tail(rest) = u_c;
    factor.backward(y);
    EXPECT_LT((y - x).norm(), 1e-10 * x.norm());
}

/// Some unknowns stand alone, as where a node is held.
SparseMatrix with_held(const SparseMatrix& matrix, const std::vector<Index>& held)
{
    SparseMatrix result = matrix;
    const auto is_held = [&](Index k) { return std::find(held.begin(), held.end(), k) != held.end(); };
    result.prune([&](Index i, Index j, double) { return i == j || (!is_held(i) && !is_held(j)); });
    return result;
}

/// Each number of L and D, without any tolerance; what is left of the rest against dense algebra.
void expect_bits_of_eigen(const SparseMatrix& matrix, int eliminated, VectorLevel level)
{
    const NodeLdlt f = node_ldlt(matrix, eliminated, level);
    ASSERT_TRUE(f.exists);
    const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> eigen(matrix);
    const Index columns = 2 * eliminated, rest = matrix.cols() - columns;
    EXPECT_TRUE(f.diagonal == VectorXd(eigen.vectorD()).head(columns));
    MatrixXd lower = MatrixXd::Identity(matrix.rows(), columns);
    for (int j = 0; j < eliminated; ++j) {
        lower(2 * j + 1, 2 * j) = f.inside[j];
        for (int k = f.begin[j]; k < f.begin[j + 1]; ++k)
            lower.block<2, 2>(2 * f.row[k], 2 * j) = Eigen::Map<const Eigen::Matrix2d>(f.block[k].v);
    }
    EXPECT_TRUE(lower == MatrixXd(SparseMatrix(eigen.matrixL())).leftCols(columns));
    if (rest == 0) return;
    const MatrixXd dense = matrix, schur = f.schur(matrix),
                   exact = dense.bottomRightCorner(rest, rest) -
                           dense.bottomLeftCorner(rest, columns) *
                               dense.topLeftCorner(columns, columns).ldlt().solve(dense.topRightCorner(columns, rest));
    EXPECT_LT((schur - exact).norm(), 1e-12 * exact.norm());
    EXPECT_TRUE(schur == schur.transpose());
}

TEST(FeRunParts, factor_by_nodes_has_the_bits_of_the_factor_by_unknowns)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    const SparseMatrix dam = 4e4 * structure.mass() + structure.stiffness(), held = with_held(dam, {3, 10, 11, 40});
    SparseMatrix odd = dam; // one entry of a block is missing
    const Index row = dam.innerIndexPtr()[dam.outerIndexPtr()[8] - 1];
    ASSERT_GT(row, 7);
    odd.prune([&](Index i, Index j, double) { return !((i == row && j == 7) || (i == 7 && j == row)); });
    EXPECT_TRUE(in_node_blocks(dam));
    EXPECT_TRUE(in_node_blocks(held));
    EXPECT_FALSE(in_node_blocks(odd));
    const int nodes = static_cast<int>(dam.rows()) / 2;
    for (const SparseMatrix& matrix : {dam, held, odd})
        for (const int eliminated : {nodes, nodes - 6, nodes / 2})
            for (const VectorLevel level : {VectorLevel::sse2, vector_level()})
                expect_bits_of_eigen(matrix, eliminated, level);
}

TEST(FeRunParts, factor_by_nodes_refuses_a_zero_pivot)
{
    SparseMatrix matrix(4, 4);
    matrix = MatrixXd::Ones(4, 4).sparseView();
    ASSERT_TRUE(in_node_blocks(matrix));
    EXPECT_FALSE(node_ldlt(matrix, 2).exists);
    matrix = MatrixXd(MatrixXd::Ones(4, 4) + MatrixXd::Identity(4, 4)).sparseView();
    EXPECT_TRUE(node_ldlt(matrix, 2).exists);
}

// By four numbers at a time as by two, and as Eigen does it of two columns or more.
TEST(FeRunParts, transposed_products_have_the_bits_of_the_expression)
{
    for (const Index columns : {2, 3, 7, 15, 24})
        for (const Index rows : {2, 46, 120}) {
            const MatrixXd matrix = uneven(rows * columns).reshaped(rows, columns);
            const VectorXd x = uneven(rows).reverse(), y = uneven(columns);
            VectorXd expected = y;
            expected.noalias() += matrix.transpose() * x;
            const TransposedProduct product(matrix);
            for (const VectorLevel level : {VectorLevel::sse2, vector_level()}) {
                VectorXd result = y;
                product.add(x, result, level);
                EXPECT_TRUE(result == expected) << rows << " x " << columns;
            }
        }
}

// Of one half of the matrix: the product to round-off, the same bits by four numbers at a time as by one.
TEST(FeRunParts, symmetric_products_of_one_half)
{
    for (const Index rows : {1, 3, 4, 6, 28, 61, 152}) {
        const MatrixXd any = uneven(rows * rows).reshaped(rows, rows), matrix = any + any.transpose();
        const VectorXd x = uneven(rows).reverse(), y = uneven(rows);
        const SymmetricProduct product(matrix);
        VectorXd room, by_one = y, result = y;
        product.add(x, by_one, room, VectorLevel::sse2);
        product.add(x, result, room);
        EXPECT_TRUE(result == by_one) << rows;
        const VectorXd terms = y.cwiseAbs() + matrix.cwiseAbs() * x.cwiseAbs();
        EXPECT_LE(((result - (y + matrix * x)).cwiseAbs().array() / terms.array()).maxCoeff(), 1e-14) << rows;
    }
}

TEST(FeRunParts, columns_are_taken_off_one_after_the_other)
{
    const MatrixXd matrix = uneven(61 * 30).reshaped(61, 30);
    VectorXd x = uneven(30);
    for (const Index zero : {0, 4, 5, 6, 11, 17, 29}) x[zero] = 0.0;
    VectorXd expected = uneven(61);
    for (Index j = 0; j < 30; ++j)
        if (x[j] != 0.0) expected -= x[j] * matrix.col(j);
    for (const VectorLevel level : {VectorLevel::sse2, vector_level()}) {
        VectorXd result = uneven(61);
        subtract_columns(matrix, x, result, level);
        EXPECT_TRUE(result == expected);
    }
}

// The floating dam: its inner part is regular, the Schur complement has exactly the three rigid motions as null space.
TEST(FeRunParts, the_floating_dam_keeps_its_rigid_motions)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    const MatrixXd& s = structure.static_factor().schur();
    const auto& nodes = model.mesh.contact.dam_nodes;
    VectorXd x = VectorXd::Zero(s.rows()), y = x, turn = x;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Point p = model.mesh.nodes[nodes[i]];
        x[2 * static_cast<Index>(i)] = y[2 * static_cast<Index>(i) + 1] = 1.0;
        turn[2 * static_cast<Index>(i)] = -p.y;
        turn[2 * static_cast<Index>(i) + 1] = p.x;
    }
    for (const VectorXd& r : {x, y, turn}) EXPECT_LT((s * r).norm(), 1e-11 * s.norm() * r.norm());
}

// Two ways to condense the rock: Schur complement in the factor here, column solutions in CondensedBody.
TEST(FeRunParts, condensed_rock_agrees_with_the_condensed_body)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    const Index first = 2 * model.mesh.dam_node_count, n = model.dofs.count - first;
    const SparseMatrix rock = model.stiffness.bottomRightCorner(n, n);
    std::vector<Index> kept;
    for (const int node : model.mesh.contact.rock_nodes)
        for (const int c : {0, 1}) kept.push_back(model.dofs(node, c) - first);
    const CondensedBody body(rock, kept);
    const MatrixXd expected = structure.plane().to_plane(body.stiffness());
    EXPECT_LT((structure.rock_stiffness() - expected).norm(), 1e-12 * expected.norm());

    VectorXd load = VectorXd::Zero(model.dofs.count);
    load.tail(n) = uneven(n);
    const VectorXd on_plane = structure.split(load).rock;
    const VectorXd expected_load = structure.plane().to_plane(body.condense_load(load.tail(n)));
    EXPECT_LT((on_plane - expected_load).norm(), 1e-11 * expected_load.norm());
    const VectorXd u = uneven(on_plane.size());
    const VectorXd all = structure.assemble(VectorXd::Zero(first), u, load);
    const VectorXd recovered = body.recover(structure.plane().to_interface(u), load.tail(n));
    EXPECT_LT((all.tail(n) - recovered).norm(), 1e-11 * recovered.norm());
}

// The dam on the condensed rock against Lanczos on a model built tied: two ways to the same eigenvalues, 1e-13 each of 1/ω².
TEST(FeRunParts, frequencies_of_the_bonded_dam_are_those_of_a_model_built_tied)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, 9.0);
    scene.mesh.size = 6.0;
    ModelOptions options;
    options.added_mass = fe2d::test::options_of(scene).added_mass;
    for (const bool rock : {true, false}) {
        if (!rock) scene.foundation.reset();
        options.base = Base::separate;
        const Model apart = build_model(scene, options);
        const auto found = tied_frequencies(ContactStructure(apart), 5);
        ASSERT_TRUE(found);
        options.base = Base::tied;
        const NaturalModes natural = natural_modes(build_model(scene, options), 5);
        for (Index i = 0; i < 5; ++i)
            EXPECT_NEAR((*found)[i] / (2.0 * std::numbers::pi * natural.frequency[i]), 1.0, 1e-11) << i;
    }
}

// The same beside acoustic water: frequencies and effective masses of the pencil with condensed rock, 1e-12 each of 1/ω².
TEST(FeRunParts, modes_of_bonded_dam_and_water_are_those_of_a_model_built_tied)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, 9.0);
    scene.mesh.size = 6.0;
    scene.reservoir->model = ReservoirModel::acoustic;
    const FluidModel water = build_fluid(scene);
    const Model apart = build_model(scene, {.base = Base::separate}), tied = build_model(scene, {.base = Base::tied});
    const auto pencil = tied_pencil(ContactStructure(apart), water);
    ASSERT_TRUE(pencil);
    EXPECT_LT(pencil->stiffness.rows(), tied.stiffness.rows());
    const CoupledModes found = coupled_modes(*pencil, 6), expected = coupled_modes(coupled_pencil(tied, water), 6);
    ASSERT_EQ(found.status, CoupledModesStatus::ok);
    EXPECT_NEAR(found.total_mass.x() / expected.total_mass.x(), 1.0, 1e-12);
    for (Index i = 0; i < 6; ++i) {
        EXPECT_NEAR(found.frequency[i] / expected.frequency[i], 1.0, 1e-10) << i;
        EXPECT_NEAR(found.effective_share(0, i), expected.effective_share(0, i), 1e-8) << i;
    }
    scene.foundation.reset();
    const Model rigid = build_model(scene, {.base = Base::separate});
    EXPECT_FALSE(tied_pencil(ContactStructure(rigid), water));
}

// Sums run in the same order on every level of vector instructions: not a bit differs. On a processor without AVX2 there
// is one level, and nothing to compare.
TEST(FeRunParts, levels_of_vector_instructions_give_the_same_bits)
{
    if (vector_level() == VectorLevel::sse2) return; // one level here: nothing to compare
    const Model model = parts_model();
    const ContactStructure structure(model);
    const InterfaceFactor factor(4e4 * structure.mass() + structure.stiffness(), structure.order().inner);
    ASSERT_TRUE(factor.regular());
    const VectorXd a = uneven(structure.dam_unknowns()), b = a.reverse(), c = a.cwiseAbs2(), d = a - 0.3 * b;
    VectorXd low = a, high = a;
    factor.forward(low, VectorLevel::sse2);
    factor.forward(high, VectorLevel::avx2);
    EXPECT_TRUE(low == high);
    factor.backward(low, VectorLevel::sse2);
    factor.backward(high, VectorLevel::avx2);
    EXPECT_TRUE(low == high);

    const BlockProducts products(structure.stiffness(), structure.mass());
    Products of_low, of_high;
    products.multiply({a, b, c, d}, of_low, VectorLevel::sse2);
    products.multiply({a, b, c, d}, of_high, VectorLevel::avx2);
    EXPECT_TRUE(of_low.stiffness_1 == of_high.stiffness_1 && of_low.stiffness_2 == of_high.stiffness_2);
    EXPECT_TRUE(of_low.mass_1 == of_high.mass_1 && of_low.mass_2 == of_high.mass_2);
    VectorXd k_low, m_low, k_high, m_high;
    products.multiply(a, k_low, m_low, VectorLevel::sse2);
    products.multiply(a, k_high, m_high, VectorLevel::avx2);
    EXPECT_TRUE(k_low == k_high && m_low == m_high);

    for (const Index columns : {Index(7), Index(127), Index(150)}) { // sums by blocks from 128 on
        const MatrixXd matrix = uneven(55 * columns).reshaped(55, columns);
        const VectorXd x = uneven(columns);
        VectorXd y_low = uneven(55), y_high = y_low;
        add_product(matrix, x, y_low, VectorLevel::sse2);
        add_product(matrix, x, y_high, VectorLevel::avx2);
        EXPECT_TRUE(y_low == y_high) << columns;
        EXPECT_LT((y_high - uneven(55) - matrix * x).norm(), 1e-13 * matrix.norm() * x.norm());
    }
}

// Vectors of several runs side by side go through the factor as each of them alone: 7 are 4, 2 and 1.
TEST(FeRunParts, columns_have_the_bits_of_one)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    const InterfaceFactor factor(4e4 * structure.mass() + structure.stiffness(), structure.order().inner);
    std::vector<VectorXd> together, alone;
    for (int batched = 0; batched < 7; ++batched) together.push_back((1.0 + 0.3 * batched) * uneven(structure.dam_unknowns()));
    alone = together;
    std::vector<VectorXd*> batch;
    for (VectorXd& vector : together) batch.push_back(&vector);
    std::vector<double> gathered;
    factor.forward(batch, gathered);
    for (VectorXd& vector : alone) factor.forward(vector);
    EXPECT_TRUE(together == alone);
    factor.backward(batch, gathered);
    for (VectorXd& vector : alone) factor.backward(vector);
    EXPECT_TRUE(together == alone);
}

TEST(FeRunParts, a_product_visits_the_rows_that_are_not_empty)
{
    SparseMatrix matrix(5, 5);
    matrix.insert(1, 0) = 2.0;
    matrix.insert(1, 4) = -3.0;
    matrix.insert(4, 1) = 0.5;
    matrix.makeCompressed();
    VectorXd y = VectorXd::Constant(5, 10.0);
    FewRows(matrix).subtract_product(VectorXd::LinSpaced(5, 1.0, 5.0), y);
    EXPECT_EQ(y, (VectorXd(5) << 10.0, 23.0, 10.0, 10.0, 9.0).finished());
    FewRows().subtract_product(y, y); // empty
    EXPECT_EQ(y[1], 23.0);
}

TEST(FeRunParts, four_products_at_once)
{
    const Model model = parts_model();
    const ContactStructure structure(model);
    BlockProducts products(structure.stiffness(), structure.mass());
    const VectorXd a = uneven(structure.dam_unknowns()), b = a.reverse(), c = a.cwiseAbs2(), d = a - 0.3 * b;
    Products out;
    products.multiply({a, b, c, d}, out);
    EXPECT_LT((out.stiffness_1 - structure.stiffness() * a).norm(), 1e-14 * out.stiffness_1.norm());
    EXPECT_LT((out.stiffness_2 - structure.stiffness() * b).norm(), 1e-14 * out.stiffness_2.norm());
    EXPECT_LT((out.mass_1 - structure.mass() * c).norm(), 1e-14 * out.mass_1.norm());
    EXPECT_LT((out.mass_2 - structure.mass() * d).norm(), 1e-14 * out.mass_2.norm());
}

} // namespace
