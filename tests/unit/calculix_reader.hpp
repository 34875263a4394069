#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <complex>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Decks of CalculiX read and computed as its manual describes them, by code that shares no line with the program: what CalculiX would
/// print, where it is not at hand. Elements of eight nodes, equations, point masses; natural modes and superposition of modes.
namespace damslip::calculix_tests {

/// A keyword with its options and lines of fields.
struct Card {
    std::string name;
    std::map<std::string, std::string> options;
    std::vector<std::vector<std::string>> lines;
};

inline std::vector<std::string> fields_of(const std::string& line)
{
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) {
        const auto first = field.find_first_not_of(' ');
        fields.push_back(first == std::string::npos ? ""
                                                    : field.substr(first, field.find_last_not_of(' ') + 1 - first));
    }
    return fields;
}

inline std::vector<Card> cards_of(const std::string& deck)
{
    std::vector<Card> cards;
    std::istringstream in(deck);
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("**")) continue;
        std::vector<std::string> fields = fields_of(line);
        if (!line.starts_with("*")) {
            cards.at(cards.size() - 1).lines.push_back(std::move(fields));
            continue;
        }
        Card card;
        card.name = fields.at(0).substr(1);
        for (std::size_t i = 1; i < fields.size(); ++i) {
            const auto at = fields[i].find('=');
            card.options[fields[i].substr(0, at)] = at == std::string::npos ? "" : fields[i].substr(at + 1);
        }
        cards.push_back(std::move(card));
    }
    return cards;
}

struct DeckElement {
    int number = 0;
    std::string set;
    std::array<int, 8> nodes{};
};

/// A force of a step on one node.
struct NodalForce {
    int node = 0, component = 0; ///< component from 0
    double value = 0.0;
};

/// A body force of a step: acceleration of a set.
struct BodyForce {
    std::string set, amplitude;
    Eigen::Vector2d accel = Eigen::Vector2d::Zero();
};

struct DeckStep {
    std::vector<Card> cards;
    std::map<std::string, std::vector<NodalForce>> nodal; ///< by amplitude; "": constant
    std::vector<BodyForce> body;

    const Card& card(const std::string& name) const
    {
        for (const Card& c : cards)
            if (c.name == name) return c;
        throw std::out_of_range("no *" + name);
    }
};

/// What a deck says.
struct Deck {
    std::map<int, Eigen::Vector2d> nodes;
    std::vector<DeckElement> elements;
    std::map<std::string, std::array<double, 3>> materials; ///< by element set: E, nu, rho
    std::vector<std::vector<NodalForce>> equations;         ///< sum of value times displacement is zero
    std::set<std::pair<int, int>> fixed;                    ///< node, component
    std::map<int, double> masses;                           ///< by node
    std::map<std::string, std::vector<int>> node_sets;
    std::map<std::string, std::vector<std::pair<int, int>>> surfaces; ///< element, side from 1
    std::map<std::string, std::vector<std::pair<double, double>>> amplitudes;
    std::map<std::string, Card> contact; ///< cards of the contact
    std::vector<DeckStep> steps;

    explicit Deck(const std::string& text)
    {
        std::map<std::string, std::array<double, 3>> of_name;
        std::map<std::string, int> mass_node;
        std::string material;
        bool in_step = false;
        for (const Card& card : cards_of(text)) {
            if (card.name == "STEP") {
                in_step = true;
                steps.emplace_back();
            } else if (card.name == "END STEP") {
                in_step = false;
            }
            if (in_step) {
                take(steps.back(), card);
            } else if (card.name == "NODE") {
                for (const auto& l : card.lines) nodes[std::stoi(l.at(0))] = {std::stod(l.at(1)), std::stod(l.at(2))};
            } else if (card.name == "ELEMENT" && card.options.at("TYPE") == "MASS") {
                mass_node[card.options.at("ELSET")] = std::stoi(card.lines.at(0).at(1));
            } else if (card.name == "ELEMENT") {
                if (card.options.at("TYPE") != "CPE8") throw std::domain_error("elements of other kinds");
                for (const auto& l : card.lines) {
                    DeckElement e{std::stoi(l.at(0)), card.options.at("ELSET"), {}};
                    for (std::size_t i = 0; i < 8; ++i) e.nodes[i] = std::stoi(l.at(i + 1));
                    elements.push_back(e);
                }
            } else if (card.name == "MASS") {
                masses[mass_node.at(card.options.at("ELSET"))] = std::stod(card.lines.at(0).at(0));
            } else if (card.name == "EQUATION") {
                std::vector<std::string> all;
                for (std::size_t i = 1; i < card.lines.size(); ++i)
                    all.insert(all.end(), card.lines[i].begin(), card.lines[i].end());
                std::vector<NodalForce> terms;
                for (std::size_t i = 0; i < all.size(); i += 3)
                    terms.push_back({std::stoi(all.at(i)), std::stoi(all.at(i + 1)) - 1, std::stod(all.at(i + 2))});
                if (std::ssize(terms) != std::stoi(card.lines.at(0).at(0))) throw std::domain_error("number of terms");
                equations.push_back(std::move(terms));
            } else if (card.name == "MATERIAL") {
                material = card.options.at("NAME");
            } else if (card.name == "ELASTIC") {
                of_name[material] = {std::stod(card.lines.at(0).at(0)), std::stod(card.lines.at(0).at(1)), 0.0};
            } else if (card.name == "DENSITY") {
                of_name[material][2] = std::stod(card.lines.at(0).at(0));
            } else if (card.name == "SOLID SECTION") {
                materials[card.options.at("ELSET")] = of_name.at(card.options.at("MATERIAL"));
            } else if (card.name == "BOUNDARY") {
                for (const auto& l : card.lines)
                    for (int c = std::stoi(l.at(1)); c <= std::stoi(l.at(2)); ++c)
                        fixed.insert({std::stoi(l.at(0)), c - 1});
            } else if (card.name == "NSET") {
                for (const auto& l : card.lines) node_sets[card.options.at("NSET")].push_back(std::stoi(l.at(0)));
            } else if (card.name == "SURFACE") {
                for (const auto& l : card.lines)
                    surfaces[card.options.at("NAME")].emplace_back(std::stoi(l.at(0)), std::stoi(l.at(1).substr(1)));
            } else if (card.name == "AMPLITUDE") {
                for (const auto& l : card.lines)
                    amplitudes[card.options.at("NAME")].emplace_back(std::stod(l.at(0)), std::stod(l.at(1)));
            } else {
                contact[card.name] = card;
            }
        }
    }

    /// Places of the corners of an element's side, from 1.
    std::pair<Eigen::Vector2d, Eigen::Vector2d> side(int element, int number) const
    {
        const auto e =
            std::find_if(elements.begin(), elements.end(), [&](const DeckElement& x) { return x.number == element; });
        return {nodes.at(e->nodes[static_cast<std::size_t>(number - 1)]),
                nodes.at(e->nodes[static_cast<std::size_t>(number % 4)])};
    }

private:
    static void take(DeckStep& step, const Card& card)
    {
        step.cards.push_back(card);
        const auto at = card.options.find("AMPLITUDE");
        const std::string amplitude = at == card.options.end() ? "" : at->second;
        for (const auto& l : card.lines) {
            if (card.name == "CLOAD")
                step.nodal[amplitude].push_back({std::stoi(l.at(0)), std::stoi(l.at(1)) - 1, std::stod(l.at(2))});
            if (card.name == "DLOAD" && l.at(1) == "GRAV")
                step.body.push_back(
                    {l.at(0), amplitude, std::stod(l.at(2)) * Eigen::Vector2d(std::stod(l.at(3)), std::stod(l.at(4)))});
        }
    }
};

/// Stiffness and mass of one element of eight nodes, plane strain of 1 m, three by three Gauss points; the integrals of its shapes.
struct ElementMatrices {
    Eigen::Matrix<double, 16, 16> stiffness = Eigen::Matrix<double, 16, 16>::Zero(), mass = stiffness;
    Eigen::Matrix<double, 8, 1> shape_mass = Eigen::Matrix<double, 8, 1>::Zero(); ///< integral of rho N_i
};

inline ElementMatrices matrices_of(const std::array<Eigen::Vector2d, 8>& at, const std::array<double, 3>& material)
{
    const auto [E, nu, rho] = material;
    Eigen::Matrix3d D;
    D << 1 - nu, nu, 0, nu, 1 - nu, 0, 0, 0, 0.5 - nu;
    D *= E / ((1 + nu) * (1 - 2 * nu));
    constexpr std::array<double, 8> xi{-1, 1, 1, -1, 0, 1, 0, -1}, eta{-1, -1, 1, 1, -1, 0, 1, 0};
    const double g = std::sqrt(0.6);
    ElementMatrices m;
    for (const auto& [r, wr] : {std::pair{-g, 5.0 / 9}, {0.0, 8.0 / 9}, {g, 5.0 / 9}})
        for (const auto& [s, ws] : {std::pair{-g, 5.0 / 9}, {0.0, 8.0 / 9}, {g, 5.0 / 9}}) {
            Eigen::Matrix<double, 8, 1> N;
            Eigen::Matrix<double, 8, 2> dN;
            for (std::size_t i = 0; i < 8; ++i) {
                const double a = xi[i], b = eta[i], p = 1 + a * r, q = 1 + b * s;
                const auto k = static_cast<Eigen::Index>(i);
                if (i < 4) {
                    N[k] = p * q * (a * r + b * s - 1) / 4;
                    dN(k, 0) = a * q * (2 * a * r + b * s) / 4;
                    dN(k, 1) = b * p * (a * r + 2 * b * s) / 4;
                } else if (a == 0) {
                    N[k] = (1 - r * r) * q / 2;
                    dN(k, 0) = -r * q;
                    dN(k, 1) = b * (1 - r * r) / 2;
                } else {
                    N[k] = (1 - s * s) * p / 2;
                    dN(k, 0) = a * (1 - s * s) / 2;
                    dN(k, 1) = -s * p;
                }
            }
            Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
            for (int i = 0; i < 8; ++i) J += dN.row(i).transpose() * at[static_cast<std::size_t>(i)].transpose();
            const Eigen::Matrix<double, 8, 2> slope = dN * J.inverse().transpose();
            Eigen::Matrix<double, 3, 16> B = Eigen::Matrix<double, 3, 16>::Zero();
            Eigen::Matrix<double, 2, 16> shapes = Eigen::Matrix<double, 2, 16>::Zero();
            for (int i = 0; i < 8; ++i) {
                B(0, 2 * i) = B(2, 2 * i + 1) = slope(i, 0);
                B(1, 2 * i + 1) = B(2, 2 * i) = slope(i, 1);
                shapes(0, 2 * i) = shapes(1, 2 * i + 1) = N[i];
            }
            const double w = wr * ws * J.determinant();
            m.stiffness += w * B.transpose() * D * B;
            m.mass += w * rho * shapes.transpose() * shapes;
            m.shape_mass += w * rho * N;
        }
    return m;
}

/// A deck assembled.
class DeckModel {
public:
    using Sparse = Eigen::SparseMatrix<double>;

    /// @param only  sets of elements; empty: all
    explicit DeckModel(const Deck& deck, const std::set<std::string>& only = {}) : deck_(deck)
    {
        for (const auto& [number, at] : deck.nodes) row_.try_emplace(number, static_cast<int>(2 * row_.size()));
        const auto size = static_cast<Eigen::Index>(2 * row_.size());
        std::vector<Eigen::Triplet<double>> k, m;
        for (const DeckElement& e : deck.elements) {
            if (!only.empty() && !only.contains(e.set)) continue;
            std::array<Eigen::Vector2d, 8> at;
            std::array<int, 16> rows{};
            for (std::size_t i = 0; i < 8; ++i) {
                at[i] = deck.nodes.at(e.nodes[i]);
                rows[2 * i] = row(e.nodes[i], 0);
                rows[2 * i + 1] = row(e.nodes[i], 1);
            }
            const ElementMatrices own = matrices_of(at, deck.materials.at(e.set));
            for (int i = 0; i < 16; ++i)
                for (int j = 0; j < 16; ++j) {
                    const int a = rows[static_cast<std::size_t>(i)], b = rows[static_cast<std::size_t>(j)];
                    k.emplace_back(a, b, own.stiffness(i, j));
                    m.emplace_back(a, b, own.mass(i, j));
                }
            Eigen::VectorXd& share = shape_mass_.try_emplace(e.set, Eigen::VectorXd::Zero(size)).first->second;
            for (int i = 0; i < 16; ++i) share[rows[static_cast<std::size_t>(i)]] += own.shape_mass[i / 2];
        }
        for (const auto& [node, own] : deck.masses)
            for (const int c : {0, 1}) m.emplace_back(row(node, c), row(node, c), own);
        stiffness = Sparse(size, size);
        mass = stiffness;
        stiffness.setFromTriplets(k.begin(), k.end());
        mass.setFromTriplets(m.begin(), m.end());
        bind(size);
    }

    int row(int node, int component) const { return row_.at(node) + component; }

    /// Forces of a step on all rows, of what has this amplitude.
    Eigen::VectorXd force(const DeckStep& step, const std::string& amplitude) const
    {
        Eigen::VectorXd f = Eigen::VectorXd::Zero(stiffness.rows());
        if (const auto at = step.nodal.find(amplitude); at != step.nodal.end())
            for (const NodalForce& n : at->second) f[row(n.node, n.component)] += n.value;
        for (const BodyForce& b : step.body) {
            if (b.amplitude != amplitude) continue;
            const Eigen::VectorXd& share = shape_mass_.at(b.set);
            for (Eigen::Index i = 0; i < f.size(); ++i) f[i] += share[i] * b.accel[i % 2];
        }
        return f;
    }

    Sparse stiffness, mass; ///< on all rows
    Sparse bound;           ///< rows by free unknowns: what supports and equations leave

private:
    void bind(Eigen::Index size)
    {
        std::map<int, const std::vector<NodalForce>*> dependent;
        for (const auto& e : deck_.equations) dependent[row(e.at(0).node, e.at(0).component)] = &e;
        std::set<int> held;
        for (const auto& [node, c] : deck_.fixed)
            if (c < 2 && row_.contains(node)) held.insert(row(node, c));
        std::map<int, int> column;
        for (int r = 0; r < size; ++r)
            if (!held.contains(r) && !dependent.contains(r)) column.try_emplace(r, static_cast<int>(column.size()));
        std::vector<Eigen::Triplet<double>> t;
        for (const auto& [r, c] : column) t.emplace_back(r, c, 1.0);
        for (const auto& [r, e] : dependent)
            for (std::size_t i = 1; i < e->size(); ++i)
                if (const auto at = column.find(row((*e)[i].node, (*e)[i].component)); at != column.end())
                    t.emplace_back(r, at->second, -(*e)[i].value / (*e)[0].value);
        bound = Sparse(size, static_cast<Eigen::Index>(column.size()));
        bound.setFromTriplets(t.begin(), t.end());
    }

    const Deck& deck_;
    std::map<int, int> row_;
    std::map<std::string, Eigen::VectorXd> shape_mass_;
};

/// Modes of all that has mass; massless unknowns follow statically.
struct DeckModes {
    Eigen::VectorXd omega; ///< [rad/s]
    Eigen::MatrixXd shape; ///< on all rows of the model, of unit modal mass

    explicit DeckModes(const DeckModel& model)
    {
        const Eigen::MatrixXd K = model.bound.transpose() * model.stiffness * model.bound;
        const Eigen::MatrixXd M = model.bound.transpose() * model.mass * model.bound;
        std::vector<Eigen::Index> heavy, light;
        for (Eigen::Index i = 0; i < M.rows(); ++i) (M(i, i) > 0.0 ? heavy : light).push_back(i);
        const Eigen::MatrixXd follow = light.empty() ? Eigen::MatrixXd(0, std::ssize(heavy))
                                                     : Eigen::MatrixXd(-K(light, light).ldlt().solve(K(light, heavy)));
        Eigen::MatrixXd condensed = K(heavy, heavy);
        if (!light.empty()) condensed += K(heavy, light) * follow;
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> found(condensed,
                                                                              Eigen::MatrixXd(M(heavy, heavy)));
        omega = found.eigenvalues().cwiseSqrt();
        Eigen::MatrixXd free(K.rows(), omega.size());
        free(heavy, Eigen::all) = found.eigenvectors();
        if (!light.empty()) free(light, Eigen::all) = follow * found.eigenvectors();
        shape = model.bound * free;
    }
};

/// One mode from rest under a load p(t) that is linear between samples, exactly: values at the samples.
inline std::vector<double> oscillator(double omega, double ratio, const std::vector<double>& p, double dt)
{
    using Complex = std::complex<double>;
    const Complex root = std::sqrt(Complex(ratio * ratio - 1.0, 0.0));
    const Complex first = omega * (-ratio + root), second = omega * (-ratio - root);
    std::vector<double> q{0.0};
    double rate = 0.0;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        const double slope = (p[i + 1] - p[i]) / dt;
        const double rest = p[i] / (omega * omega) - 2.0 * ratio * slope / (omega * omega * omega);
        const double steady = slope / (omega * omega);
        const Complex x = q.back() - rest, v = rate - steady;
        const Complex b = (v - first * x) / (second - first), a = x - b;
        q.push_back((a * std::exp(first * dt) + b * std::exp(second * dt)).real() + rest + steady * dt);
        rate = (a * first * std::exp(first * dt) + b * second * std::exp(second * dt)).real() + steady;
    }
    return q;
}

} // namespace damslip::calculix_tests
