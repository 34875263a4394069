#include "fe2d/run/run_watches.hpp"

#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/model/model.hpp"
#include "scene/joint_bond.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace damslip::fe2d {

namespace {

constexpr double unloaded_below = 0.05;  ///< of the static N' [-]
constexpr double indicator_time = 1.0;   ///< before each row of the history [s]
constexpr std::size_t usual_steps = 256; ///< twice those of that time, where steps are not short
constexpr std::size_t windows = 3;       ///< that have to go on alike
constexpr double ratchet_share = 0.1;     ///< of the slip [-]
constexpr int ratchet_lift_offs = 3;
constexpr double smallest_change = 1e-9; ///< of times [s]; of work: lifts of the dam by a nanometre are none [m]

} // namespace

double slide_window(double first_frequency)
{
    return first_frequency > 0.0 ? 5.0 / first_frequency : 1.0;
}

bool RunOutFigures::ratchets() const
{
    return std::abs(slip_at_rest) > ratchet_share * std::abs(slip_shaking + slip_at_rest) && lift_offs > ratchet_lift_offs;
}

SlideWatch::SlideWatch(const SlideLimits& limits, std::function<double()> window)
    : limits_(limits), find_window_(std::move(window))
{
    second_.reserve(usual_steps);
}

double SlideWatch::window_end() const
{
    return edges_.front().time + static_cast<double>(edges_.size()) * window_;
}

void SlideWatch::add(const SlideInstant& now)
{
    Tally next{now};
    if (!second_.empty()) {
        const Tally& last = second_.back();
        next.lift_offs = last.lift_offs + (now.open && !last.open);
        const bool unloaded = now.normal_force < unloaded_below * limits_.static_normal_force;
        next.unloaded = last.unloaded + (unloaded ? now.time - last.time : 0.0);
        if (!edges_.empty() && next.lift_offs > last.lift_offs) {
            if (last.lift_offs == lift_offs_shaking_) first_lift_off_ = now.time;
            last_lift_off_ = now.time;
        }
    }
    second_.push_back(next);
    while (second_.size() - oldest_ > 2 && second_[oldest_ + 1].time <= now.time - indicator_time + smallest_change)
        ++oldest_;
    if (2 * oldest_ > second_.size()) { // it stays within the store it has
        second_.erase(second_.begin(), second_.begin() + static_cast<std::ptrdiff_t>(oldest_));
        oldest_ = 0;
    }
    if (now.time < limits_.record_end - smallest_change) return;
    if (edges_.empty()) {
        edges_.push_back(next);
        lift_offs_shaking_ = next.lift_offs;
        return;
    }
    if (window_ == 0.0) window_ = find_window_();
    if (now.time < window_end() - smallest_change) return;
    edges_.push_back(next);
    self_excited_ = goes_on();
}

void SlideWatch::next_record(double record_end)
{
    limits_.record_end = record_end;
    edges_.clear();
}

double SlideWatch::chi(const Tally& from, const Tally& to) const
{
    const double friction = to.friction - from.friction;
    if (friction <= smallest_change * limits_.static_normal_force) return std::numeric_limits<double>::quiet_NaN();
    return (to.thrust_work - from.thrust_work) / friction;
}

bool SlideWatch::goes_on() const
{
    if (edges_.size() <= windows || !(edges_.back().sliding_factor > 1.0)) return false;
    const Tally *first = &edges_.back() - windows, *last = &edges_.back();
    double before = 0.0;
    for (const Tally* edge = first; edge != last; ++edge) {
        const double power = (edge[1].thrust_work - edge->thrust_work) / (edge[1].time - edge->time);
        if (!(power > 0.0) || power < (1.0 - limits_.rate_change) * before) return false;
        before = power;
    }
    const double work = last->thrust_work - first->thrust_work, friction = last->friction - first->friction;
    if (work <= smallest_change * limits_.static_normal_force) return false; // no thrust: nothing pays
    return work >= friction || work - friction - (last->other_losses - first->other_losses) >= 0.0;
}

void SlideWatch::add_row(SlideHistory& history) const
{
    const Tally &from = second_[oldest_], &now = second_.back();
    const double time = now.time - from.time;
    const auto share = [&](double change) { return time > 0.0 ? change / time : 0.0; };
    history.thrust_over_friction.push_back(chi(from, now));
    history.lift_offs.push_back(now.lift_offs);
    history.unloaded_share.push_back(share(now.unloaded - from.unloaded));
    history.rate.push_back(share(now.slip - from.slip));
}

RunOutFigures SlideWatch::figures() const
{
    RunOutFigures figures;
    if (second_.empty()) return figures;
    const Tally& now = second_.back();
    figures.sliding_factor = now.sliding_factor;
    const double last_second = now.time - second_[oldest_].time;
    if (last_second > 0.0) figures.rate = (now.slip - second_[oldest_].slip) / last_second;
    figures.slip_shaking = edges_.empty() ? now.slip : edges_.front().slip;
    if (edges_.empty()) return figures;
    figures.slip_at_rest = now.slip - figures.slip_shaking;
    figures.lift_offs = now.lift_offs - lift_offs_shaking_;
    if (figures.lift_offs > 1) figures.lift_off_frequency = (figures.lift_offs - 1) / (last_lift_off_ - first_lift_off_);
    const Tally& from = self_excited_ ? *(&edges_.back() - windows) : edges_.front();
    figures.thrust_over_friction = chi(from, now);
    figures.energy_kept =
        now.thrust_work - from.thrust_work - (now.friction - from.friction) - (now.other_losses - from.other_losses);
    if (now.time > from.time) figures.unloaded_share = (now.unloaded - from.unloaded) / (now.time - from.time);
    return figures;
}

std::vector<Note> lift_off_notes(const RunOutFigures& figures)
{
    if (figures.lift_offs == 0) return {};
    return {{NoteKind::lift_offs, {std::int64_t{figures.lift_offs}, figures.lift_off_frequency}}};
}

namespace {

/// The change of the scene that lets waves leave.
Note remedy(const Scene& scene)
{
    const std::string file = scene.file.string();
    if (!scene.foundation) return {NoteKind::no_slip_give_rock, {file}};
    if (!rock_has_mass(scene)) return {NoteKind::no_slip_let_radiate, {file}};
    if (scene.foundation->boundary == RockBoundary::fixed) return {NoteKind::no_slip_free_edge, {file}};
    return {NoteKind::no_slip_radiates};
}

} // namespace

std::vector<Note> self_excited_notes(const Scene& scene, double slip, const RunOutFigures& f)
{
    Note all{NoteKind::self_excited_no_friction, {1e3 * std::abs(slip), 1e3 * std::abs(f.rate), f.sliding_factor}};
    if (std::isfinite(f.thrust_over_friction)) {
        all.kind = NoteKind::self_excited;
        all.values.push_back(f.thrust_over_friction);
    }
    std::vector<Note> notes{std::move(all)};
    for (Note& note : lift_off_notes(f)) notes.push_back(std::move(note));
    notes.push_back(remedy(scene));
    return notes;
}

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr std::size_t most_paths = 4;
constexpr double default_strength = 2e6; ///< of mass concrete, for ℓ_ch alone [Pa]
constexpr double default_energy = 200.0; ///< the same [N/m]
constexpr double near_strength = 0.25;   ///< index of a line from which on every step counts
constexpr long line_steps = 4, patch_looks = 16;
constexpr double stress_interval = 0.005; ///< [s]
constexpr double more_than_before = 1.01; ///< of the stress on the faces, so that all patches are looked at

using Columns = std::map<int, std::array<double, 6>>; ///< by the first unknown of a node

Point centre_of(const Mesh& mesh, const Element& element)
{
    Point centre;
    const int size = element.size();
    for (int i = 0; i < size; ++i) {
        centre.x += mesh.nodes[static_cast<std::size_t>(element.nodes[i])].x / size;
        centre.y += mesh.nodes[static_cast<std::size_t>(element.nodes[i])].y / size;
    }
    return centre;
}

double area_of(const Corners& c, int size)
{
    double twice = 0.0;
    for (int i = 0; i < size; ++i) {
        const Point &a = c[static_cast<std::size_t>(i)], &b = c[static_cast<std::size_t>((i + 1) % size)];
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * twice;
}

} // namespace

bool CrackFigures::wakes() const
{
    return cracks() || std::any_of(lifts.begin(), lifts.end(), [](const TiedLift& lift) { return lift.index >= wake_index; });
}

CrackLines::CrackLines(const Scene& scene, const ContactStructure& structure, double stiffness_damping,
                       const std::vector<CrackStart>& begun)
    : stiffness_damping_(stiffness_damping)
{
    const Mesh& mesh = structure.model().mesh;
    for (std::size_t k = 0; k < mesh.tied_lifts.size(); ++k) {
        none_yet_.lifts.push_back({scene.tied_lifts[k].name, scene.tied_lifts[k].elevation, 0.0, 0.0, 0.0});
        add_line(scene, structure, scene.tied_lifts[k], mesh.tied_lifts[k].lower_nodes);
    }
    add_patches(scene, structure, begun);
    add_paths(scene, structure);
    if (scene.dam.crack != BodyCrack::traced) return;
    if (paths_.size() < most_paths) none_yet_.strength = *scene.dam.tensile_strength;
}

/// ℓ_ch, at most a tenth of the height [m].
double CrackLines::crack_length(const Scene& scene, const ContactStructure& structure) const
{
    const Model& model = structure.model();
    const double strength = scene.dam.tensile_strength.value_or(default_strength);
    const double nu = model.materials.dam.poisson_ratio;
    const bool traced = scene.dam.crack == BodyCrack::traced;
    double top = 0.0;
    for (const int n : model.mesh.crest) top = std::max(top, model.mesh.nodes[static_cast<std::size_t>(n)].y);
    return std::min(0.1 * top, characteristic_length(model.materials.dam.young_modulus / (1.0 - nu * nu),
                                                     traced ? scene.dam.tension_energy : default_energy, strength));
}

void CrackLines::add_line(const Scene& scene, const ContactStructure& structure, const LiftJoint& lift,
                          const std::vector<int>& nodes)
{
    const Model& model = structure.model();
    const Mesh& mesh = model.mesh;
    const Eigen::Matrix3d d = plane_strain_matrix(model.materials.dam);
    std::map<int, Columns> rows; // by node of the line
    for (const int node : nodes) rows[node];
    for (int e = 0; e < mesh.dam_element_count; ++e) {
        const Element& element = mesh.elements[static_cast<std::size_t>(e)];
        if (element.region != Region::dam) continue;
        const int size = element.size();
        if (std::none_of(element.nodes.begin(), element.nodes.begin() + size, [&](int n) { return rows.count(n); }))
            continue;
        const double share = centre_of(mesh, element).y > lift.elevation ? 0.5 : -0.5;
        const ElementNodes all = element.all();
        const ElementMatrix k =
            elastic_stiffness(corners(mesh, element), size, element.share * d, model.materials.kind, extra_nodes(element));
        for (int i = 0; i < size; ++i) {
            const auto row = rows.find(element.nodes[static_cast<std::size_t>(i)]);
            if (row == rows.end()) continue;
            for (int j = 0; j < all.count; ++j) {
                auto& to = row->second[2 * structure.order().new_node[static_cast<std::size_t>(all[j])]];
                for (const int r : {0, 1})
                    for (const int c : {0, 1})
                        to[static_cast<std::size_t>(2 * r + c)] += share * k(2 * i + r, 2 * j + c);
            }
        }
    }
    LiftPlane line{nodes, nodes, {}, share_above(scene.section, lift.elevation)};
    for (const int n : nodes)
        line.distance.push_back(mesh.nodes[static_cast<std::size_t>(n)].x - mesh.nodes[static_cast<std::size_t>(nodes.front())].x);
    const Plane plane = plane_of(line);
    const PressureProfile water = lift_water_profile(scene, lift, line.distance.back());
    Line made;
    made.friction = FrictionOverSlip(lift.strength).at(0.0);
    made.cohesion = lift.strength.cohesion;
    made.tension = lift.strength.bond.tensile_strength;
    made.bonded = breaks_by_energy(lift.strength);
    made.together = bond_loss(lift.strength) == BondLoss::together;
    made.increase = lift.strength.bond.dynamic_increase;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        PairOfLine pair;
        pair.area = plane.area[static_cast<Index>(i)];
        pair.distance = line.distance[i];
        pair.water = pressure_at(water, pair.distance) * pair.area / plane.share; // the profile is per metre of dam
        pair.force.begin = static_cast<int>(node_.size());
        for (const auto& [node, values] : rows[nodes[i]]) {
            node_.push_back(node);
            block_.push_back({{values[0], values[2]}, {values[1], values[3]}});
        }
        pair.force.end = static_cast<int>(node_.size());
        made.pairs.push_back(pair);
    }
    lines_.push_back(std::move(made));
}

double CrackLines::Line::index(const CrackLines& of, const VectorXd& felt, bool moving, double& distance) const
{
    constexpr double no_end = std::numeric_limits<double>::infinity();
    double largest = 0.0, all_normal = 0.0, all_shear = 0.0, all_bond = 0.0;
    const auto count = [&](double square, const PairOfLine& pair) {
        if (square > largest) largest = square, distance = pair.distance;
    };
    const auto square = [](double force, double strength) {
        const double share = force <= 0.0 ? 0.0 : strength > 0.0 ? force / strength : no_end;
        return share * share;
    };
    const double factor = moving ? increase : 1.0;
    for (const PairOfLine& pair : pairs) {
        Eigen::Vector2d force(0.0, -pair.water);
        for (int k = pair.force.begin; k < pair.force.end; ++k) {
            const Index n = of.node_[static_cast<std::size_t>(k)];
            const Block& block = of.block_[static_cast<std::size_t>(k)];
            force += Eigen::Vector2d::Map(block.x) * felt[n] + Eigen::Vector2d::Map(block.y) * felt[n + 1];
        }
        const double x = force.x(), y = force.y(), shear = std::abs(x), bond = cohesion * pair.area;
        all_normal += y, all_shear += x, all_bond += bond;
        if (bonded) {
            const double over = shear - friction * std::max(0.0, y);
            count(square(-y, factor * tension * pair.area) + square(over, factor * bond), pair);
        } else if (!(y > 0.0)) // nothing holds tension
            count(no_end, pair);
        else if (!together || bond == 0.0)
            count(square(shear, friction * y + bond), pair);
    }
    if (!bonded && together && all_bond > 0.0)
        count(all_normal > 0.0 ? square(std::abs(all_shear), friction * all_normal + all_bond) : no_end, pairs.front());
    return std::sqrt(largest);
}

void CrackLines::add_patches(const Scene& scene, const ContactStructure& structure, const std::vector<CrackStart>& begun)
{
    const Mesh& mesh = structure.model().mesh;
    const double length = crack_length(scene, structure);

    enum : char { inside, face, line };
    std::vector<char> kind(mesh.nodes.size(), inside);
    const auto mark = [&](const std::vector<int>& nodes, char as) {
        for (const int n : nodes) kind[static_cast<std::size_t>(n)] = as;
    };
    for (const auto* chain : {&mesh.upstream_face, &mesh.downstream_face, &mesh.crest}) mark(*chain, face);
    const std::vector<int>& base = mesh.seam ? mesh.seam->base : mesh.contact.dam_nodes;
    mark(base, line);
    std::vector<Polyline> lines;
    for (const std::vector<LiftPlane>* lifts : {&mesh.lifts, &mesh.tied_lifts})
        for (const LiftPlane& lift : *lifts) {
            mark(lift.lower_nodes, line);
            mark(lift.upper_nodes, line);
            Polyline& added = lines.emplace_back();
            for (const int n : lift.lower_nodes) added.push_back(mesh.nodes[static_cast<std::size_t>(n)]);
        }
    const Point heel = mesh.nodes[static_cast<std::size_t>(base.front())],
                toe = mesh.nodes[static_cast<std::size_t>(base.back())];
    const auto near_line = [&](const Point& p) {
        const double level = heel.y + (toe.y - heel.y) * (p.x - heel.x) / (toe.x - heel.x);
        return p.y - level < length ||
               std::any_of(lines.begin(), lines.end(), [&](const Polyline& l) { return std::abs(p.y - height_on(l, p.x)) < length; });
    };

    struct Piece {
        int element = 0;
        Point at;
        double area = 0.0;
        bool face = false;
    };
    std::map<std::pair<long, long>, std::vector<Piece>> grid; // cells of ℓ_ch/2
    const double cell = 0.5 * length;
    const auto cell_of = [cell](const Point& p) {
        return std::pair(std::lround(std::floor(p.x / cell)), std::lround(std::floor(p.y / cell)));
    };
    for (int e = 0; e < mesh.dam_element_count; ++e) {
        const Element& element = mesh.elements[static_cast<std::size_t>(e)];
        if (element.region != Region::dam) continue;
        const int size = element.size();
        const Point at = centre_of(mesh, element);
        const auto has = [&](char what) {
            return std::any_of(element.nodes.begin(), element.nodes.begin() + size,
                               [&](int n) { return kind[static_cast<std::size_t>(n)] == what; });
        };
        if (has(line) || near_line(at)) continue;
        grid[cell_of(at)].push_back({e, at, area_of(corners(mesh, element), size), has(face)});
    }
    std::vector<Patch> inner;
    for (auto& [place, pieces] : grid) // one patch for each cell, about its largest element, one on a face if there is one
    {
        const Piece& middle = *std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
            return std::pair(a.face, a.area) < std::pair(b.face, b.area);
        });
        std::vector<int> members;
        for (long i = place.first - 1; i <= place.first + 1; ++i)
            for (long j = place.second - 1; j <= place.second + 1; ++j)
                if (const auto found = grid.find({i, j}); found != grid.end())
                    for (const Piece& piece : found->second)
                        if (std::hypot(piece.at.x - middle.at.x, piece.at.y - middle.at.y) <= cell)
                            members.push_back(piece.element);
        Patch patch = patch_about(structure, members, middle.at);
        patch.on_face = middle.face;
        patch.seeds = std::none_of(begun.begin(), begun.end(), [&](const CrackStart& crack) {
            return std::hypot(crack.at.x - middle.at.x, crack.at.y - middle.at.y) < crack.reach;
        });
        (patch.on_face ? patches_ : inner).push_back(patch);
    }
    on_face_ = patches_.size();
    patches_.insert(patches_.end(), inner.begin(), inner.end());
}

/// The mean stress of elements.
CrackLines::Patch CrackLines::patch_about(const ContactStructure& structure, const std::vector<int>& elements, Point at)
{
    const Model& model = structure.model();
    const Mesh& mesh = model.mesh;
    const Eigen::Matrix3d d = plane_strain_matrix(model.materials.dam);
    double area = 0.0;
    for (const int e : elements) {
        const Element& element = mesh.elements[static_cast<std::size_t>(e)];
        area += area_of(corners(mesh, element), element.size());
    }
    Columns columns;
    for (const int e : elements) {
        const Element& element = mesh.elements[static_cast<std::size_t>(e)];
        const ElementNodes all = element.all();
        const Corners c = corners(mesh, element);
        const ExtraNodes extra = extra_nodes(element);
        const double own = area_of(c, element.size());
        ElementVector unit = ElementVector::Zero(2 * all.count);
        for (Index j = 0; j < unit.size(); ++j) {
            unit.setZero();
            unit[j] = own / area;
            const Eigen::Vector3d stress = centre_stress(c, element.size(), d, model.materials.kind, unit, extra);
            const int node = structure.order().new_node[static_cast<std::size_t>(all[static_cast<int>(j) / 2])];
            auto& to = columns[2 * node];
            for (const Index row : {0, 1, 2}) to[static_cast<std::size_t>(2 * row + j % 2)] += stress[row];
        }
    }
    Patch patch{{static_cast<int>(node_.size()), 0}, at, false};
    for (const auto& [node, values] : columns) {
        node_.push_back(node);
        block_.push_back({{values[0], values[2], values[4]}, {values[1], values[3], values[5]}});
    }
    patch.stress.end = static_cast<int>(node_.size());
    return patch;
}

/// About each pair of a traced crack the elements within ℓ_ch/2, on both sides of it.
void CrackLines::add_paths(const Scene& scene, const ContactStructure& structure)
{
    const Mesh& mesh = structure.model().mesh;
    const double radius = 0.5 * crack_length(scene, structure);
    for (std::size_t k = 0; k < scene.lift_joints.size(); ++k) {
        if (scene.lift_joints[k].path.empty()) continue;
        first_pair_.push_back(structure.planes().first(static_cast<Index>(k + 1)));
        std::vector<Patch>& path = paths_.emplace_back();
        std::vector<PathTension>& tensions = none_yet_.paths.emplace_back();
        for (const int n : mesh.lifts[k].lower_nodes) {
            const Point at = mesh.nodes[static_cast<std::size_t>(n)];
            std::vector<int> members;
            std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), 0};
            for (int e = 0; e < mesh.dam_element_count; ++e) {
                const Point centre = centre_of(mesh, mesh.elements[static_cast<std::size_t>(e)]);
                const double away = std::hypot(centre.x - at.x, centre.y - at.y);
                if (away <= radius) members.push_back(e);
                nearest = std::min(nearest, {away, e});
            }
            if (members.empty()) members.push_back(nearest.second);
            path.push_back(patch_about(structure, members, at));
            tensions.push_back({.at = at});
        }
    }
}

CrackLines::Tension CrackLines::tension_of(const Patch& patch, const VectorXd& u) const
{
    Eigen::Vector2d normal(0.0, 0.0);
    double xy = 0.0;
    for (int k = patch.stress.begin; k < patch.stress.end; ++k) {
        const Index n = node_[static_cast<std::size_t>(k)];
        const Block& block = block_[static_cast<std::size_t>(k)];
        const double a = u[n], b = u[n + 1];
        normal += Eigen::Vector2d::Map(block.x) * a + Eigen::Vector2d::Map(block.y) * b;
        xy += block.x[2] * a + block.y[2] * b;
    }
    const double xx = normal.x(), yy = normal.y();
    // The crack runs along σ₂, a quarter turn from σ₁.
    return {0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy), 0.5 * std::atan2(-2.0 * xy, yy - xx)};
}

void CrackWatch::look_at(const CrackLines::Patch& patch, double time, const VectorXd& u, CrackFigures& figures) const
{
    const CrackLines::Tension now = lines_.tension_of(patch, u);
    if (now.stress <= figures.stress) return;
    figures.stress = now.stress;
    figures.angle = now.angle;
    figures.time = time;
    figures.at = patch.at;
}

bool CrackWatch::take(const CrackLines::Tension& now, double time, PathTension& largest)
{
    if (now.stress <= largest.stress) return false;
    largest.stress = now.stress, largest.angle = now.angle, largest.time = time;
    return true;
}

void CrackWatch::look_at_paths(double time, const VectorXd& u, const VectorXd* damage, CrackFigures& figures)
{
    before_.resize(lines_.paths_.size());
    for (std::size_t k = 0; k < lines_.paths_.size(); ++k) {
        before_[k].resize(lines_.paths_[k].size());
        for (std::size_t i = 0; i < lines_.paths_[k].size(); ++i) {
            PathTension& tension = figures.paths[k][i];
            if (tension.damaged) continue;
            CrackLines::Tension& before = before_[k][i];
            if (damage && (*damage)[lines_.first_pair_[k] + static_cast<Index>(i)] > 0.0) {
                tension.damaged = true;
                tension.stress = before.stress, tension.angle = before.angle, tension.time = time;
                continue;
            }
            before = lines_.tension_of(lines_.paths_[k][i], u);
            take(before, time, tension);
        }
    }
}

void CrackWatch::look(double time, const VectorXd& u, const VectorXd& v, const VectorXd* damage, CrackFigures& figures)
{
    figures.known = true;
    bool felt = false; // felt_ is of this step
    for (std::size_t k = 0; k < lines_.lines_.size(); ++k) {
        if (last_[k] < near_strength && steps_ % line_steps != 0) continue;
        if (!std::exchange(felt, true)) felt_ = u + lines_.stiffness_damping_ * v;
        double distance = 0.0;
        last_[k] = lines_.lines_[k].index(lines_, felt_, time > 0.0, distance);
        TiedLift& lift = figures.lifts[k];
        if (last_[k] <= lift.index) continue;
        lift.index = last_[k];
        lift.time = time;
        lift.distance = distance;
    }
    look_at_paths(time, u, damage, figures);
    // Stresses about every 5 ms, whatever the step; the start and the first steps in any case.
    const long between = time > 0.0 ? std::max(1L, std::lround(stress_interval * static_cast<double>(steps_) / time)) : 1;
    const long looked = steps_ / between;
    if (steps_++ % between != 0) return;
    double on_face = 0.0;
    for (std::size_t k = 0; k < lines_.on_face_; ++k) {
        const CrackLines::Tension now = lines_.tension_of(lines_.patches_[k], u);
        on_face = std::max(on_face, now.stress);
        const CrackLines::Patch& patch = lines_.patches_[k];
        if (patch.seeds && std::abs(std::tan(now.angle)) <= steepest_path && take(now, time, figures.seed)) figures.seed.at = patch.at;
    }
    if (on_face > figures.stress || on_face > more_than_before * on_face_ || looked % patch_looks == 0)
        for (const CrackLines::Patch& patch : lines_.patches_) look_at(patch, time, u, figures);
    on_face_ = std::max(on_face_, on_face);
}

} // namespace damslip::fe2d
