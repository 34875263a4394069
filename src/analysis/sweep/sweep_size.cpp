#include "analysis/sweep/sweep_size.hpp"

namespace damslip {

namespace {

void scale(std::optional<double>& length, double factor)
{
    if (length) *length *= factor;
}

void scale_rock(Scene& scene, double factor)
{
    if (scene.foundation) {
        scene.foundation->width *= factor;
        scene.foundation->depth *= factor;
    }
    if (scene.curtain) {
        scene.curtain->distance *= factor;
        scene.curtain->depth *= factor;
        scene.curtain->thickness *= factor;
    }
    if (scene.drains) {
        scene.drains->distance *= factor;
        scale(scene.drains->depth, factor);
        scale(scene.drains->gallery_level, factor);
    }
    if (scene.uplift)
        for (Point& p : scene.uplift->points) p.x *= factor; // y is a share of the pressure at the heel
}

void scale_water(Scene& scene, double factor)
{
    if (scene.reservoir) {
        scene.reservoir->level *= factor;
        scene.reservoir->length *= factor;
        scale(scene.reservoir->mesh_size, factor);
    }
    if (scene.gate) scene.gate->top *= factor;
    if (scene.tailwater) scene.tailwater->level *= factor;
    if (scene.silt) scene.silt->level *= factor;
    if (scene.ice) scene.ice->level *= factor;
}

} // namespace

Scene sized(Scene scene, double factor)
{
    if (factor == 1.0) return scene;
    for (Point& p : scene.section.polygon) p = {p.x * factor, p.y * factor};
    scale_rock(scene, factor);
    scale_water(scene, factor);
    for (PointForce& force : scene.forces) force.at = {force.at.x * factor, force.at.y * factor};
    for (LiftJoint& joint : scene.lift_joints) joint.elevation *= factor;
    for (Anchor& anchor : scene.anchors) { // forces with the weight, so that the anchored dam stays similar
        anchor.distance *= factor;
        anchor.free_length *= factor;
        anchor.area *= factor * factor;
        anchor.prestress *= factor * factor;
    }
    for (Combination& c : scene.combinations) {
        scale(c.reservoir_level, factor);
        scale(c.tailwater_level, factor);
    }
    scale(scene.mesh.size, factor);
    scale(scene.mesh.contact_size, factor);
    scale(scene.mesh.rock_contact_size, factor);
    scale(scene.mesh.rock_size, factor);
    scene.mesh.file_unit *= factor;
    return scene;
}

} // namespace damslip
