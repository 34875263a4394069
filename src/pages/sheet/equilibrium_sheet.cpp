#include "core/units.hpp"
#include "pages/sheet/workbook.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/loads/added_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::pages {

namespace {

using sliding::Equilibrium;
using sliding::Load;
using sliding::LoadKind;

/// A load on the block: forces and the moments of both about the heel, counter-clockwise.
struct LoadCells {
    LoadKind kind;
    Formula fx, moment_x, fy, moment_y;
};

/// What a worksheet takes from the scene, as references to its cells.
struct Given {
    Formula gravity, concrete, water, reservoir, tailwater, k_h, k_v, friction, cohesion, residual_friction, residual_cohesion,
        toe_x, toe_y;
};

/// The load combination that a state belongs to: "usual, cracked" is of "usual".
Combination combination_of(const Scene& scene, const Equilibrium& e)
{
    for (const Combination& c : scene.combinations)
        if (e.name == c.name || e.name == c.name + ", cracked") return c;
    return {};
}

Formula product(const Formula& f0, const Formula& f1, const Formula& g0, const Formula& g1)
{
    return (2.0 * (f0 * g0 + f1 * g1) + f0 * g1 + f1 * g0) / 6.0;
}

class EquilibriumSheet {
public:
    EquilibriumSheet(Workbook& book, const Scene& scene, const Equilibrium& e)
        : book_(book), scene_(scene), e_(e), combination_(combination_of(scene, e)), given_(inputs())
    {
    }

    void write()
    {
        loads();
        uplift();
        base();
        factors();
        if (e_.k_h == 0.0 && e_.k_v == 0.0 && scene_.anchors.empty()) yield();
    }

private:
    Given inputs()
    {
        book_.begin(e_.name);
        book_.title(fmt::format("{}: load combination {}, crack rule {}", scene_.title, e_.name, sliding::word(e_.crack_rule)));
        book_.note("x downstream, y up, from the heel; per metre of dam; moments about the heel, counter-clockwise. Blue: given.");
        book_.title("Given");
        const Point toe_point = toe(scene_.section);
        return {book_.put("gravity g", scene_.gravity, "m/s2"),
                book_.put("density of the concrete", scene_.dam.density, "kg/m3"),
                book_.put("unit weight of water", water_unit_weight(scene_), "N/m3"),
                book_.put("reservoir above the heel", e_.reservoir_level.value_or(0.0), "m"),
                book_.put("tailwater above the heel", e_.tailwater_level.value_or(0.0), "m"),
                book_.put("seismic coefficient k_h", e_.k_h, "-", "of 9.80665 m/s2, drives downstream"),
                book_.put("seismic coefficient k_v", e_.k_v, "-", "positive up"),
                book_.put("friction", e_.friction, "-"),
                book_.put("cohesion", e_.cohesion, "Pa"),
                book_.put("residual friction", e_.residual_friction, "-"),
                book_.put("residual cohesion", e_.residual_cohesion, "Pa"),
                book_.put("toe x", toe_point.x, "m"),
                book_.put("toe y", toe_point.y + 0.0, "m")};
    }

    /// Area, and first moments over it, by the corners of the outline; given where the section has a thickness.
    void section()
    {
        book_.title("Section");
        if (!scene_.section.thickness.empty()) {
            const Point centre = centroid(scene_.section);
            area_ = book_.put("area of concrete A", area(scene_.section), "m2", "share of the outline by section.thickness");
            centre_x_ = book_.put("centroid x", centre.x, "m");
            centre_y_ = book_.put("centroid y", centre.y, "m");
            return;
        }
        book_.head({"corner", "x [m]", "y [m]"});
        const Polyline& polygon = scene_.section.polygon;
        std::vector<std::vector<Formula>> corners;
        for (const Point p : polygon) {
            const bool is_toe = corners.size() == 1; // given above
            corners.push_back(book_.row(fmt::format("{}", corners.size() + 1),
                                        {is_toe ? given_.toe_x : Formula(p.x + 0.0), is_toe ? given_.toe_y : Formula(p.y + 0.0)}));
        }
        corners.push_back(corners.front()); // which closes the outline
        std::vector<Formula> cross, moment_x, moment_y;
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            const auto &a = corners[i], &b = corners[i + 1];
            cross.push_back(a[0] * b[1] - b[0] * a[1]);
            moment_x.push_back(cross.back() * (a[0] + b[0]));
            moment_y.push_back(cross.back() * (a[1] + b[1]));
        }
        corners_ = std::move(corners);
        area_ = book_.put("area A", sum(cross) / 2.0, "m2", "half the sum of the cross products");
        centre_x_ = book_.put("centroid x", sum(moment_x) / (6.0 * area_), "m");
        centre_y_ = book_.put("centroid y", sum(moment_y) / (6.0 * area_), "m");
    }

    /// The cells of a corner of the outline; its numbers where it is none, or the section is given by its area.
    std::pair<Formula, Formula> cells_of(Point p) const
    {
        for (std::size_t i = 0; i + 1 < corners_.size(); ++i)
            if (scene_.section.polygon[i].x == p.x && scene_.section.polygon[i].y == p.y) return {corners_[i][0], corners_[i][1]};
        return {p.x, p.y};
    }

    /// Water or silt on a face, piece by piece up to its level. @param side  sign of the normal into the dam
    LoadCells on_face(const Load& load, const Polyline& face, double side, const Formula& level, const Formula& unit_weight,
                      const Formula& factor, bool vertical)
    {
        book_.head({load.name, "x1 [m]", "y1 [m]", "x2 [m]", "y2 [m]"});
        std::vector<Formula> fx, mx, fy, my;
        for (std::size_t i = 0; i + 1 < face.size(); ++i) {
            const Point a = face[i], b = face[i + 1];
            if (a.y >= level.value() && b.y >= level.value()) continue;
            const bool cut = std::max(a.y, b.y) > level.value(), rises = b.y > a.y;
            // The end above the surface goes down along the piece to it.
            const auto [xa, ya] = cells_of(a);
            const auto [xb, yb] = cells_of(b);
            const Formula at_level = rises ? xa + (level - ya) / (yb - ya) * (xb - xa) : xb + (level - yb) / (ya - yb) * (xa - xb);
            const Formula ax = cut && !rises ? at_level : xa, ay = cut && !rises ? level : ya;
            const Formula bx = cut && rises ? at_level : xb, by = cut && rises ? level : yb;
            const std::vector<Formula> ends = book_.row(fmt::format("piece {}", i + 1), {ax, ay, bx, by});
            const std::vector<Formula> p = book_.row("  pressures at its ends [N/m2]", {unit_weight * (level - ends[1]),
                                                                                unit_weight * (level - ends[3])});
            const Formula nx = side * (ends[3] - ends[1]), ny = -side * (ends[2] - ends[0]);
            const std::vector<Formula> forces = book_.row(
                "  Fx, its moment, Fy, its moment [N/m, N m/m]",
                {0.5 * (p[0] + p[1]) * nx, 0.0 - product(p[0], p[1], ends[1], ends[3]) * nx, 0.5 * (p[0] + p[1]) * ny,
                 product(p[0], p[1], ends[0], ends[2]) * ny});
            fx.push_back(forces[0]), mx.push_back(forces[1]), fy.push_back(forces[2]), my.push_back(forces[3]);
        }
        const auto total = [&](const std::vector<Formula>& parts) { return factor * sum(parts); };
        return {load.kind, total(fx), total(mx), vertical ? total(fy) : Formula(0.0), vertical ? total(my) : Formula(0.0)};
    }

    /// As the program has it: what has no formula here.
    static LoadCells given_load(const Load& load)
    {
        return {load.kind, load.force.horizontal.x, load.force.horizontal.moment, load.force.vertical.y, load.force.vertical.moment};
    }

    LoadCells cells_of(const Load& load)
    {
        const Combination& c = combination_;
        const Polyline up = upstream_face(scene_.section), down = downstream_face(scene_.section);
        const Formula a_h = given_.k_h * units::standard_gravity, a_v = given_.k_v * units::standard_gravity;
        switch (load.kind) {
        case LoadKind::weight: {
            const Formula w = c.weight_factor * area_ * given_.concrete * given_.gravity;
            return {load.kind, 0.0, 0.0, 0.0 - w, 0.0 - centre_x_ * w};
        }
        case LoadKind::reservoir:
            if (load.name == "gates")
                return on_face(load, {up.back(), {up.back().x, scene_.gate->top}}, 1.0, given_.reservoir, given_.water,
                               c.water_factor, true);
            if (c.gates_open && !scene_.section.thickness.empty()) return given_load(load); // on the piers alone
            return on_face(load, up, 1.0, given_.reservoir, given_.water, c.water_factor, true);
        case LoadKind::tailwater:
            return on_face(load, down, -1.0, given_.tailwater, given_.water, c.water_factor, true);
        case LoadKind::crest_water:
            return on_face(load, {down.back(), up.back()}, -1.0,
                           scene_.gate && !c.gates_open ? given_.tailwater : max(given_.reservoir, given_.tailwater), given_.water,
                           c.water_factor, true);
        case LoadKind::silt: {
            const Formula level = book_.put("silt above the heel", scene_.silt->level, "m");
            const Formula weight = book_.put("K times submerged unit weight of silt",
                                             scene_.silt->pressure_coefficient * Formula(scene_.silt->submerged_unit_weight), "N/m3");
            return on_face(load, up, 1.0, level, weight, c.silt_factor, false);
        }
        case LoadKind::inertia:
            if (!c.k_profile.empty()) return given_load(load);
            return {load.kind, area_ * given_.concrete * a_h, 0.0 - centre_y_ * area_ * given_.concrete * a_h,
                    0.0 - area_ * given_.concrete * a_v, 0.0 - centre_x_ * area_ * given_.concrete * a_v};
        case LoadKind::hydrodynamic: {
            const sliding::AddedMassIntegral m = sliding::scene_added_mass(scene_, e_.reservoir_level);
            const std::vector<Formula> mass = book_.row("added mass xx, xy, yy [kg/m]", {m.xx, m.xy, m.yy});
            const std::vector<Formula> moment =
                book_.row("  its moments: of the horizontal part per a_x, a_y, of the vertical part [kg]",
                          {m.horizontal_moment.x, m.horizontal_moment.y, m.vertical_moment.x, m.vertical_moment.y});
            return {load.kind, mass[0] * a_h - mass[1] * a_v, moment[0] * a_h - moment[1] * a_v, mass[1] * a_h - mass[2] * a_v,
                    moment[2] * a_h - moment[3] * a_v};
        }
        default:
            return given_load(load); // ice, user forces, anchors: a force at a point
        }
    }

    void loads()
    {
        section();
        book_.title("Loads, piece by piece");
        std::vector<LoadCells> all;
        for (const Load& load : e_.loads) all.push_back(cells_of(load));
        book_.title("Loads");
        book_.head({"load", "Fx [N/m]", "moment of Fx [N m/m]", "Fy [N/m]", "moment of Fy [N m/m]"});
        std::vector<Formula> fx, mx, fy, my;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::vector<Formula> r = book_.row(e_.loads[i].name, {all[i].fx, all[i].moment_x, all[i].fy, all[i].moment_y});
            loads_.push_back({all[i].kind, r[0], r[1], r[2], r[3]});
            fx.push_back(r[0]), mx.push_back(r[1]), fy.push_back(r[2]), my.push_back(r[3]);
        }
        const std::vector<Formula> total = book_.row("sum", {sum(fx), sum(mx), sum(fy), sum(my)});
        force_x_ = total[0], force_y_ = total[2];
        moment_ = book_.put("moment of all loads about the heel", total[1] + total[3], "N m/m");
    }

    /// A pressure that is the head of the water at an end of the base; else the program's.
    Formula pressure_of(double pressure) const
    {
        const double factor = combination_.uplift_factor * e_.frame.share;
        const Formula heel = factor * given_.water * given_.reservoir,
                      toe_head = factor * given_.water * (given_.tailwater - given_.toe_y);
        const auto same = [&](const Formula& f) { return std::abs(f.value() - pressure) <= 1e-12 * std::abs(pressure); };
        if (pressure == 0.0) return 0.0;
        return same(heel) ? heel : same(toe_head) ? toe_head : Formula(pressure);
    }

    void uplift()
    {
        book_.title("Uplift");
        book_.head({"point", "distance from the heel [m]", "pressure [N/m2]"});
        std::vector<std::vector<Formula>> points;
        for (const ProfilePoint& p : e_.base.profile.points)
            points.push_back(book_.row(fmt::format("{}", points.size() + 1), {p.distance, pressure_of(p.pressure)}));
        std::vector<Formula> forces, moments;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const auto &a = points[i], &b = points[i + 1];
            forces.push_back((b[0] - a[0]) * (a[1] + b[1]) / 2.0);
            moments.push_back((b[0] - a[0]) / 6.0 * (a[1] * (2.0 * a[0] + b[0]) + b[1] * (a[0] + 2.0 * b[0])));
        }
        uplift_ = book_.put("uplift U", sum(forces), "N/m", "trapezoids, normal to the base");
        uplift_moment_ = book_.put("moment of U about the heel", sum(moments), "N m/m");
    }

    void base()
    {
        book_.title("Base");
        length_ = book_.put("length L", sqrt(given_.toe_x * given_.toe_x + given_.toe_y * given_.toe_y), "m");
        cos_ = book_.put("cos of the dip", given_.toe_x / length_, "-");
        sin_ = book_.put("sin of the dip", 0.0 - given_.toe_y / length_, "-", "positive: it dips downstream");
        normal_ = book_.put("N' = -(Fx sin + Fy cos) - U", 0.0 - (force_x_ * sin_ + force_y_ * cos_) - uplift_, "N/m",
                            "effective, compression positive");
        shear_ = book_.put("T = Fx cos - Fy sin", force_x_ * cos_ - force_y_ * sin_, "N/m", "positive downstream");
        distance_ = book_.put("distance of N' from the heel", 0.0 - (moment_ + uplift_moment_) / normal_, "m");
        eccentricity_ = book_.put("eccentricity", distance_ - length_ / 2.0, "m", "positive towards the toe");
        const bool towards_toe = e_.base.compressed_side == sliding::Side::toe;
        crack_ = book_.put("length that carries no pressure", e_.frame.length - e_.base.compressed_length, "m",
                           towards_toe ? "from the heel" : "from the toe");
        compressed_ = book_.put("compressed length", length_ - crack_, "m");
        if (e_.base.status == sliding::CrackStatus::partial && e_.crack_rule != CrackRule::none)
            book_.put("condition of the crack, has to be 0",
                      (compressed_ - 3.0 * (towards_toe ? length_ - distance_ : distance_)) / length_, "-",
                      "a triangle of pressure: its resultant lies in its third");
        bonded_ = book_.put("area that has cohesion", e_.cohesive_length, "m2/m");
        share_ = book_.put("share of the width that is concrete", e_.frame.share, "-");
    }

    void factors()
    {
        const Formula n = max(0.0, normal_);
        const Formula anchor_shear = book_.put("anchors: shear that comes with slip", e_.anchor_shear, "N/m");
        const Formula dowels = book_.put("anchors: dowels", e_.dowel_force, "N/m");
        const Formula both = shear_ + anchor_shear;
        const Formula resisting = both * anchor_shear;
        const Formula driving = book_.put("shear to carry", if_greater(resisting, 0.0, abs(both), abs(shear_)), "N/m");
        const Formula anchors = book_.put("anchors resist", dowels + if_greater(resisting, 0.0, abs(anchor_shear), 0.0), "N/m");
        // About the end that it would tip over.
        const bool downstream = e_.shear >= 0.0;
        const Formula px = downstream ? given_.toe_x : Formula(0.0), py = downstream ? given_.toe_y : Formula(0.0);
        std::vector<Formula> holds, tips, down, water;
        const auto add = [&](const Formula& about_heel, const Formula& fx, const Formula& fy) {
            const Formula m = (downstream ? 1.0 : -1.0) * (about_heel - (px * fy - py * fx));
            holds.push_back(max(0.0, m));
            tips.push_back(max(0.0, 0.0 - m));
        };
        for (const LoadCells& load : loads_) {
            add(load.moment_x, load.fx, 0.0);
            add(load.moment_y, 0.0, load.fy);
            const bool wet = load.kind == LoadKind::reservoir || load.kind == LoadKind::tailwater ||
                             load.kind == LoadKind::crest_water;
            if (wet) water.push_back(0.0 - load.fy);
            if (load.kind == LoadKind::weight || load.kind == LoadKind::inertia || load.kind == LoadKind::point_force ||
                load.kind == LoadKind::anchor)
                down.push_back(0.0 - load.fy);
        }
        add(uplift_moment_, uplift_ * sin_, uplift_ * cos_);
        const Formula mean = normal_ / (compressed_ * share_);
        const bool towards_toe = e_.base.compressed_side == sliding::Side::toe;
        const Formula start = towards_toe ? crack_ : Formula(0.0);
        const Formula lever = (distance_ - start) / compressed_ - 0.5;

        book_.title("Factors and stresses: by the cells above, by the program, their difference");
        book_.head({"quantity", "this sheet", "program", "difference", "unit"});
        book_.compare("N'", normal_, e_.base.effective_normal, "N/m");
        book_.compare("T", shear_, e_.shear, "N/m");
        book_.compare("U", uplift_, e_.base.uplift.force, "N/m");
        const auto factor = [&](const char* name, const Formula& c, const Formula& mu, double of_program) {
            book_.compare(name, (c * bonded_ + mu * n + anchors) / driving, of_program, "-");
        };
        factor("sliding factor", given_.cohesion, given_.friction, e_.sliding_factor);
        factor("sliding factor, friction alone", 0.0, given_.friction, e_.friction_factor);
        factor("sliding factor, residual strength", given_.residual_cohesion, given_.residual_friction, e_.sliding_factor_residual);
        book_.compare("overturning factor", sum(holds) / sum(tips), e_.overturning_factor, "-");
        book_.compare("flotation factor", sum(down) / (uplift_ * cos_ - sum(water)), e_.flotation_factor, "-");
        book_.compare("resultant from the toe", length_ - distance_, e_.resultant_from_toe, "m");
        book_.compare("eccentricity", eccentricity_, e_.eccentricity, "m");
        const bool triangle = e_.base.status == sliding::CrackStatus::partial; // the stress at the tip is 0
        if (!triangle || !towards_toe || e_.heel_stress != 0.0)
            book_.compare("stress at the heel", mean * (1.0 - 6.0 * lever), e_.heel_stress, "Pa");
        if (!triangle || towards_toe || e_.toe_stress != 0.0)
            book_.compare("stress at the toe", mean * (1.0 + 6.0 * lever), e_.toe_stress, "Pa");
        book_.compare("friction at which it just holds", max(0.0, driving - given_.cohesion * bonded_ - anchors) / n,
                      e_.critical_friction, "-");
    }

    /// a_y = (c A' - q F - mu U)/(q A x) of yield_downstream(), q = t + mu n.
    void yield()
    {
        const sliding::AddedMassIntegral m = sliding::scene_added_mass(scene_, e_.reservoir_level);
        book_.title("Yield acceleration, Goldgruber (2015) eq. (4-3)");
        const Formula xx = book_.put("added mass xx", m.xx, "kg/m"), xy = book_.put("added mass xy", m.xy, "kg/m");
        const Formula qx = book_.put("q_x = cos + friction sin", cos_ + given_.friction * sin_, "-");
        const Formula qy = book_.put("q_y = -sin + friction cos", given_.friction * cos_ - sin_, "-");
        const Formula mass = book_.put("q A x", qx * (area_ * given_.concrete + xx) + qy * xy, "kg/m");
        const Formula bond = book_.put("cohesion of the static state", given_.cohesion * bonded_, "N/m");
        book_.head({"quantity", "this sheet", "program", "difference", "unit"});
        book_.compare("a_y, downstream", (bond - qx * force_x_ - qy * force_y_ - given_.friction * uplift_) / mass,
                      e_.yield_acceleration, "m/s2");
    }

    Workbook& book_;
    const Scene& scene_;
    const Equilibrium& e_;
    Combination combination_;
    Given given_;
    std::vector<std::vector<Formula>> corners_; ///< x, y; the first again at the end; empty: a section with a thickness
    std::vector<LoadCells> loads_;
    Formula area_ = 0.0, centre_x_ = 0.0, centre_y_ = 0.0, force_x_ = 0.0, force_y_ = 0.0, moment_ = 0.0, uplift_ = 0.0,
            uplift_moment_ = 0.0, length_ = 0.0, cos_ = 1.0, sin_ = 0.0, normal_ = 0.0, shear_ = 0.0, distance_ = 0.0,
            eccentricity_ = 0.0, crack_ = 0.0, compressed_ = 0.0, bonded_ = 0.0, share_ = 1.0;
};

} // namespace

void write_equilibrium_sheets(const std::filesystem::path& file, const Ready& ready, const std::vector<Equilibrium>& combinations)
{
    Workbook book(file);
    for (const Equilibrium& e : combinations) EquilibriumSheet(book, ready.scene, e).write();
    book.close();
}

BaseInstant worst_instant(const ContactRun& run, const Contact& strength)
{
    const fe2d::RunHistory& h = run.fe.history;
    const fe2d::PairHistory& by_pair = h.by_pair;
    const auto pairs = static_cast<std::size_t>(by_pair.pairs);
    const double friction = FrictionOverSlip(strength).peak();
    const auto factor = [&](std::size_t row) {
        double bonded = 0.0;
        for (std::size_t i = 0; i < pairs; ++i)
            if (by_pair.pressure[row * pairs + i] > 0.0) bonded += run.fe.pair_area[static_cast<Eigen::Index>(i)];
        const double shear = std::abs(h.shear_force[row]);
        const double resisting = strength.cohesion * bonded + friction * std::max(0.0, h.normal_force[row]);
        return shear > 0.0 ? resisting / shear : std::numeric_limits<double>::infinity();
    };
    constexpr double same = 1e-6; // factors of rows while the whole base slides
    std::size_t worst = 0;
    double least = factor(0);
    for (std::size_t row = 1; row < h.time.size(); ++row) {
        const double f = factor(row);
        const bool as_bad = std::abs(f - least) <= same * least;
        if (f < least && !as_bad)
            worst = row, least = f;
        else if (as_bad && std::abs(h.shear_force[row]) > std::abs(h.shear_force[worst]))
            worst = row;
    }
    BaseInstant out{run.label(), h.time[worst], h.slip[worst], h.normal_force[worst], h.shear_force[worst], h.normal_position[worst],
                    {}, {}, {}, {}};
    for (std::size_t i = 0; i < pairs; ++i) {
        out.distance.push_back(run.fe.pair_distance[static_cast<Eigen::Index>(i)]);
        out.area.push_back(run.fe.pair_area[static_cast<Eigen::Index>(i)]);
        out.pressure.push_back(by_pair.pressure[worst * pairs + i]);
        out.shear.push_back(by_pair.shear[worst * pairs + i]);
    }
    return out;
}

void write_base_sheets(const std::filesystem::path& file, const Contact& strength, const std::vector<BaseInstant>& instants)
{
    Workbook book(file);
    for (const BaseInstant& at : instants) {
        book.begin(at.label);
        book.title(fmt::format("{}: forces on the base at {:.4g} s, where it is nearest to sliding", at.label, at.time));
        book.note("Per metre of dam; effective pressure, compression positive; shear on the dam, positive where it resists downstream slip.");
        book.title("Given");
        const Formula friction = book.put("friction", FrictionOverSlip(strength).peak(), "-"),
                      cohesion = book.put("cohesion", strength.cohesion, "Pa");
        book.put("slip so far, mean over the base", at.slip, "m");
        book.title("Contact node pairs");
        book.head({"pair", "from the heel [m]", "length [m]", "pressure [Pa]", "shear [Pa]"});
        book.head({"", "N [N/m]", "T [N/m]", "moment of N [N m/m]", "pressed length [m]"});
        std::vector<Formula> normal, shear, moment, bonded;
        for (std::size_t i = 0; i < at.distance.size(); ++i) {
            const Formula d = at.distance[i], length = at.area[i], p = at.pressure[i], t = at.shear[i];
            std::vector<Formula> cells{d, length, p, t};
            const std::vector<Formula> in = book.row(fmt::format("{}", i + 1), cells);
            const std::vector<Formula> out =
                book.row("", {in[2] * in[1], in[3] * in[1], in[0] * in[2] * in[1], if_greater(in[2], 0.0, in[1], 0.0)});
            normal.push_back(out[0]), shear.push_back(out[1]), moment.push_back(out[2]), bonded.push_back(out[3]);
        }
        book.title("Sums: by the cells above, by the program, their difference");
        const Formula n = book.put("N'", sum(normal), "N/m"), t = book.put("T", sum(shear), "N/m");
        book.put("sliding factor with the peak strength", (cohesion * sum(bonded) + friction * max(0.0, n)) / abs(t), "-",
                 "of this sheet alone: (c A' + mu N')/|T|, A' the length under pressure");
        book.head({"quantity", "this sheet", "program", "difference", "unit"});
        book.compare("N'", n, at.normal_force, "N/m");
        book.compare("T", t, at.shear_force, "N/m");
        book.compare("N' from the heel", sum(moment) / n, at.position, "m");
    }
    book.close();
}

} // namespace damslip::pages
