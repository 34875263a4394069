#include "verification/exact/reference_scene.hpp"

#include <algorithm>

namespace damslip::exact {

namespace {

Uplift uplift_model(ReferenceUplift kind, double scale)
{
    Uplift uplift;
    switch (kind) {
    case ReferenceUplift::none:
        uplift.model = UpliftModel::none;
        break;
    case ReferenceUplift::linear:
        uplift.model = UpliftModel::linear;
        break;
    case ReferenceUplift::printed_curtain:
        uplift.model = UpliftModel::curtain;
        break;
    case ReferenceUplift::points:
        uplift.model = UpliftModel::points;
        uplift.points = {{0, 1},     {2, .957},  {4, .944},  {6, .938},  {7, .938}, {7, .315},
                         {10, .314}, {20, .289}, {30, .233}, {40, .137}, {45, 0}};
        for (Point& p : uplift.points) p.x *= scale;
        break;
    }
    return uplift;
}

Polyline reference_polygon(double scale)
{
    Polyline polygon{{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    for (Point& p : polygon) p = {scale * p.x, scale * p.y};
    return polygon;
}

} // namespace

Scene reference_scene(ReferenceUplift uplift, double friction, double scale)
{
    Scene scene = bare_scene(reference_polygon(scale), 2500.0);
    scene.title = "reference dam";
    scene.contact.friction = friction;
    Reservoir reservoir;
    reservoir.level = scale * 62.5;
    reservoir.length = scale * 150.0;
    scene.reservoir = reservoir;
    scene.added_mass.formula = AddedMassFormula::westergaard_simplified;
    Curtain curtain;
    curtain.distance = scale * 7.0;
    curtain.depth = scale * 30.0;
    curtain.thickness = scale;
    scene.curtain = curtain;
    scene.uplift = uplift_model(uplift, scale);
    return scene;
}

Scene elastic_reference_scene(double scale)
{
    Scene scene;
    scene.section.polygon = reference_polygon(scale);
    scene.dam = {2500.0, 25e9, 0.17};
    scene.foundation = Foundation{
        .material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 300.0 * scale, .depth = 100.0 * scale};
    scene.curtain = Curtain{.distance = 7.0 * scale, .depth = 30.0 * scale, .thickness = scale, .young_modulus = 27e9};
    scene.reservoir = Reservoir{.level = 62.5 * scale};
    return scene;
}

Scene seam_scene()
{
    constexpr double degree = std::numbers::pi / 180.0;
    Scene scene = reference_scene(ReferenceUplift::none, 0.77);
    scene.added_mass.formula = AddedMassFormula::westergaard;
    scene.foundation.emplace().material.density = 2650.0;
    scene.drains.emplace();
    scene.drains->distance = 6.0;
    scene.drains->efficiency = 0.8;
    Seam seam;
    seam.name = "D";
    seam.depth = 8.0;
    seam.strength.friction = 0.7;
    seam.exit = SeamExit::wedge;
    seam.uplift = UpliftModel::drains;
    seam.wedge.emplace().friction = std::tan(40.0 * degree);
    seam.wedge->angles = {25.0 * degree};
    scene.seams = {seam};
    return scene;
}

Scene bare_scene(Polyline polygon, double density)
{
    Scene scene;
    scene.section.polygon = std::move(polygon);
    scene.dam.density = density;
    scene.contact.friction = 0.7;
    return scene;
}

Polyline triangle(double base, double height)
{
    return {{0.0, 0.0}, {base, 0.0}, {0.0, height}};
}

Polyline mirrored(const Polyline& polygon)
{
    const Point toe = polygon.at(1);
    Polyline out;
    // Heel <- toe, toe <- heel, then the remaining vertices the other way round: still counter-clockwise.
    out.push_back({0.0, 0.0});
    out.push_back({toe.x - polygon[0].x, polygon[0].y - toe.y});
    for (std::size_t i = polygon.size() - 1; i >= 2; --i) out.push_back({toe.x - polygon[i].x, polygon[i].y - toe.y});
    return out;
}

} // namespace damslip::exact
