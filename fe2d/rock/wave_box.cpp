#include "fe2d/rock/wave_box.hpp"

#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/model/model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

namespace {

using Lines = std::vector<int>;

/// Sizes of one input [m].
struct Sizes {
    double half_width, depth, half_inner, inner_depth;
    double inside;  ///< largest element inside
    double outside; ///< in the sponge
    double first;   ///< next to the interface
    double growth;

    explicit Sizes(const WaveBoxInput& input)
    {
        const WaveBoxShape& s = input.shape;
        const double b = input.base,
                     wave = 2.0 * std::numbers::pi * elastic_waves(input.rock).s / input.highest_frequency;
        half_width = 0.5 * s.width * b;
        depth = s.depth * b;
        half_inner = 0.5 * s.inner_width * b;
        inner_depth = s.inner_depth * b;
        const auto of_base = input.surface.begin() + input.floor;
        first = (input.surface.back().x - of_base->x) / static_cast<double>(input.surface.end() - of_base - 1);
        inside = std::max(first, wave / s.per_wave);
        outside = std::max(inside, std::min((half_width - half_inner) / s.per_sponge, s.sponge_wave * wave));
        growth = s.growth;
    }
};

/// Positions from `from` to `inner` and on to `to`, growing with the distance from the first.
std::vector<double> graded(double from, double inner, double to, const Sizes& s)
{
    if (inner <= from) inner = from;
    std::vector<double> positions{from};
    double size = s.first;
    if (inner > from) {
        const Grading near{s.first, s.growth, s.inside};
        positions = graded_positions({from, inner}, near);
        size = near.size_at(inner - from);
    }
    const std::vector<double> far = graded_positions({inner, to}, {size, s.growth, std::max(size, s.outside)});
    positions.insert(positions.end(), far.begin() + 1, far.end());
    return positions;
}

/// Those of `lines` that are needed where elements may be `size` long: first and last stay, neighbours come no further
/// apart than that.
Lines thinned(const Lines& lines, const std::vector<double>& position, double size)
{
    Lines kept{lines.front()};
    for (std::size_t i = 1; i + 1 < lines.size(); ++i)
        if (std::abs(position[static_cast<std::size_t>(lines[i + 1])] -
                     position[static_cast<std::size_t>(kept.back())]) > size)
            kept.push_back(lines[i]);
    kept.push_back(lines.back());
    return kept;
}

struct Carrier {
    int node;
    double share;
};

/// Lines, elements and who carries the hanging nodes. Node of column i and row j: i * rows + j.
class Grid {
public:
    explicit Grid(const WaveBoxInput& input) : sizes_(input), middle_(input.middle)
    {
        place_lines(input);
        thin_out();
        hang();
    }

    int rows() const { return static_cast<int>(depth_.size()); }
    int columns() const { return static_cast<int>(x_.size()); }
    int node(int column, int row) const { return column * rows() + row; }
    int first_interface_column() const { return first_interface_; }
    Point at(int node) const
    {
        const int i = node / rows(), j = node % rows();
        const double top = surface_[static_cast<std::size_t>(i)], d = depth_[static_cast<std::size_t>(j)];
        return {x_[static_cast<std::size_t>(i)], top - d * (1.0 + (top - level_) / depth_.back())};
    }
    const std::vector<std::array<int, 4>>& elements() const { return elements_; } ///< counter-clockwise from lower left
    const std::vector<Carrier>& carriers(int node) const { return carriers_[static_cast<std::size_t>(node)]; }
    const Sizes& sizes() const { return sizes_; }

    /// 0 inside, 1 at the edges.
    double sponge_share(Point p) const
    {
        const double across = (std::abs(p.x - middle_) - sizes_.half_inner) / (sizes_.half_width - sizes_.half_inner);
        const double down = (level_ - p.y - sizes_.inner_depth) / (sizes_.depth - sizes_.inner_depth);
        return std::clamp(std::max(across, down), 0.0, 1.0);
    }

private:
    void place_lines(const WaveBoxInput& input)
    {
        const std::vector<Point>& s = input.surface;
        const double left = s.front().x, right = s.back().x;
        for (const double d : graded(0.0, std::max(0.0, sizes_.half_inner - (middle_ - left)),
                                     sizes_.half_width - (middle_ - left), sizes_))
            if (d > 0.0) {
                x_.insert(x_.begin(), left - d);
                surface_.insert(surface_.begin(), s.front().y);
            }
        first_interface_ = columns_();
        for (const Point& p : s) {
            x_.push_back(p.x);
            surface_.push_back(p.y);
        }
        last_interface_ = columns_() - 1;
        for (const double d : graded(0.0, std::max(0.0, sizes_.half_inner - (right - middle_)),
                                     sizes_.half_width - (right - middle_), sizes_))
            if (d > 0.0) {
                x_.push_back(right + d);
                surface_.push_back(s.back().y);
            }
        level_ = 0.5 * (s.front().y + s.back().y);
        depth_ = graded(0.0, sizes_.inner_depth, sizes_.depth, sizes_);
    }
    int columns_() const { return static_cast<int>(x_.size()); }

    /// Columns end downwards in a middle zone, rows sideways in the two others.
    void thin_out()
    {
        const auto width = [&](int interval) {
            return x_[static_cast<std::size_t>(interval + 1)] - x_[static_cast<std::size_t>(interval)];
        };
        left_ = first_interface_;
        while (left_ > 0 && width(left_ - 1) < 0.5 * sizes_.inside) --left_;
        right_ = last_interface_;
        while (right_ + 1 < columns() && width(right_) < 0.5 * sizes_.inside) ++right_;
        Lines all;
        for (int i = left_; i <= right_; ++i) all.push_back(i);
        for (int j = 0; j + 1 < rows(); ++j) {
            const double height = depth_[static_cast<std::size_t>(j + 1)] - depth_[static_cast<std::size_t>(j)];
            if (j > 0) all = thinned(all, x_, height); // nodes of the interface hang from none, however close they are
            of_band_.push_back(all);
        }
        all.clear();
        for (int j = 0; j < rows(); ++j) all.push_back(j);
        of_interval_.assign(static_cast<std::size_t>(columns() - 1), {});
        Lines here = all;
        for (int i = right_; i + 1 < columns(); ++i)
            of_interval_[static_cast<std::size_t>(i)] = here = i == right_ ? all : thinned(here, depth_, width(i));
        here = all;
        for (int i = left_ - 1; i >= 0; --i)
            of_interval_[static_cast<std::size_t>(i)] = here = i == left_ - 1 ? all : thinned(here, depth_, width(i));
        for (int j = 0; j + 1 < rows(); ++j) {
            const Lines& c = of_band_[static_cast<std::size_t>(j)];
            for (std::size_t k = 0; k + 1 < c.size(); ++k)
                elements_.push_back({node(c[k], j + 1), node(c[k + 1], j + 1), node(c[k + 1], j), node(c[k], j)});
        }
        for (int i = 0; i + 1 < columns(); ++i) {
            const Lines& r = of_interval_[static_cast<std::size_t>(i)];
            for (std::size_t k = 0; k + 1 < r.size(); ++k)
                elements_.push_back({node(i, r[k + 1]), node(i + 1, r[k + 1]), node(i + 1, r[k]), node(i, r[k])});
        }
    }

    /// The nodes of `some` stand for those of `all` on one line.
    template <class NodeOf>
    void carry(const Lines& all, const Lines& some, const std::vector<double>& position, NodeOf node_of)
    {
        std::size_t k = 0;
        for (const int line : all) {
            while (some[k] < line) ++k;
            std::vector<Carrier>& c = carriers_[static_cast<std::size_t>(node_of(line))];
            if (some[k] == line) {
                c = {{node_of(line), 1.0}};
                continue;
            }
            const auto at = [&](int l) { return position[static_cast<std::size_t>(l)]; };
            const double share = (at(line) - at(some[k - 1])) / (at(some[k]) - at(some[k - 1]));
            c = {{node_of(some[k - 1]), 1.0 - share}, {node_of(some[k]), share}};
        }
    }

    void hang()
    {
        carriers_.resize(static_cast<std::size_t>(rows() * columns()));
        for (int j = 0; j < rows(); ++j) {
            const std::size_t above = static_cast<std::size_t>(std::max(0, j - 1)),
                              below = static_cast<std::size_t>(std::min(j, rows() - 2));
            carry(of_band_[above], of_band_[below], x_, [&](int i) { return node(i, j); });
        }
        const auto side = [&](int column, int inner, int outer) {
            carry(of_interval_[static_cast<std::size_t>(inner)], of_interval_[static_cast<std::size_t>(outer)], depth_,
                  [&](int j) { return node(column, j); });
        };
        for (int i = right_ + 1; i < columns(); ++i) side(i, i - 1, std::min(i, columns() - 2));
        for (int i = left_ - 1; i >= 0; --i) side(i, i, std::max(0, i - 1));
    }

    Sizes sizes_;
    double middle_, level_ = 0.0;
    std::vector<double> x_, surface_, depth_;      ///< columns, the surface there, rows below it
    int first_interface_ = 0, last_interface_ = 0; ///< columns
    int left_ = 0, right_ = 0;                     ///< columns that bound the middle zone
    std::vector<Lines> of_band_;                   ///< columns of the elements between two rows, middle zone
    std::vector<Lines> of_interval_;               ///< rows of the elements between two columns, outside it
    std::vector<std::array<int, 4>> elements_;
    std::vector<std::vector<Carrier>> carriers_; ///< empty: no such node
};

/// Sums element matrices onto the unknowns of the nodes that carry.
class Sum {
public:
    Sum(const Grid& grid, const std::vector<int>& number) : grid_(grid), number_(number)
    {
        entries_.reserve(64 * grid.elements().size());
    }

    void add(std::span<const int> nodes, const ElementMatrix& matrix)
    {
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t b = 0; b < nodes.size(); ++b)
                for (const Carrier& p : grid_.carriers(nodes[a]))
                    for (const Carrier& q : grid_.carriers(nodes[b]))
                        for (int c = 0; c < 2; ++c)
                            for (int d = 0; d < 2; ++d) {
                                const double value =
                                    p.share * q.share *
                                    matrix(2 * static_cast<Eigen::Index>(a) + c, 2 * static_cast<Eigen::Index>(b) + d);
                                if (value != 0.0)
                                    entries_.emplace_back(2 * number_[static_cast<std::size_t>(p.node)] + c,
                                                          2 * number_[static_cast<std::size_t>(q.node)] + d, value);
                            }
    }
    void add(int node, int component, double value)
    {
        const int unknown = 2 * number_[static_cast<std::size_t>(node)] + component;
        entries_.emplace_back(unknown, unknown, value);
    }
    /// Symmetric to the last bit.
    SparseMatrix matrix(int count) const
    {
        SparseMatrix m(count, count);
        m.setFromTriplets(entries_.begin(), entries_.end());
        const SparseMatrix transposed = m.transpose();
        return 0.5 * (m + transposed);
    }

private:
    const Grid& grid_;
    const std::vector<int>& number_;
    std::vector<Eigen::Triplet<double>> entries_;
};

} // namespace

WaveBox make_wave_box(const WaveBoxInput& input)
{
    assert(input.rock.density > 0.0 && input.base > 0.0 && input.surface.size() >= 2 && input.highest_frequency > 0.0);
    const Grid grid(input);
    const Sizes& sizes = grid.sizes();
    const ElasticWaves c = elastic_waves(input.rock);
    const Eigen::Matrix3d d = plane_strain_matrix(input.rock);

    WaveBox box;
    std::vector<int> number(static_cast<std::size_t>(grid.rows() * grid.columns()), -1);
    for (int node = 0; node < grid.rows() * grid.columns(); ++node)
        if (grid.carriers(node).size() == 1) number[static_cast<std::size_t>(node)] = box.nodes++;
    box.elements = static_cast<int>(grid.elements().size());
    box.thickness = sizes.half_width - sizes.half_inner;

    Sum mass(grid, number), damping(grid, number), stiffness(grid, number);
    const double b0 = input.shape.sponge * box.thickness / c.s;
    for (const std::array<int, 4>& nodes : grid.elements()) {
        Corners corners;
        Point centre;
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = grid.at(nodes[k]);
            centre.x += 0.25 * corners[k].x;
            centre.y += 0.25 * corners[k].y;
        }
        const ElementMatrix k = elastic_stiffness(corners, 4, d, Q4Kind::incompatible);
        stiffness.add(nodes, k);
        mass.add(nodes, elastic_mass(corners, 4, input.rock.density, MassKind::consistent));
        const double share = grid.sponge_share(centre);
        if (share > 0.0) damping.add(nodes, ElementMatrix(b0 * share * share * k));
    }

    const double shear_modulus = input.rock.density * c.s * c.s;
    const double level = 0.5 * (input.surface.front().y + input.surface.back().y);
    const auto edge = [&](int a, int b, int across) {
        const Point p = grid.at(a), q = grid.at(b);
        const double half = 0.5 * std::hypot(q.x - p.x, q.y - p.y);
        for (const int node : {a, b})
            for (const int component : {0, 1}) {
                const Point at = grid.at(node);
                const double distance = std::hypot(at.x - input.middle, at.y - level);
                const bool normal = component == across;
                damping.add(node, component, half * input.rock.density * (normal ? c.p : c.s));
                stiffness.add(node, component, half * shear_modulus / (normal ? distance : 2.0 * distance));
            }
    };
    const int last_column = grid.columns() - 1, last_row = grid.rows() - 1;
    for (const std::array<int, 4>& n : grid.elements()) {
        if (n[0] / grid.rows() == 0) edge(n[3], n[0], 0);
        if (n[1] / grid.rows() == last_column) edge(n[1], n[2], 0);
        if (n[0] % grid.rows() == last_row) edge(n[0], n[1], 1);
    }

    box.mass = mass.matrix(2 * box.nodes);
    box.damping = damping.matrix(2 * box.nodes);
    box.stiffness = stiffness.matrix(2 * box.nodes);
    for (std::size_t k = 0; k < input.surface.size(); ++k)
        for (const int component : {0, 1})
            box.interface.push_back(2 * number[static_cast<std::size_t>(
                                            grid.node(grid.first_interface_column() + static_cast<int>(k), 0))] +
                                    component);
    return box;
}

} // namespace damslip::fe2d
