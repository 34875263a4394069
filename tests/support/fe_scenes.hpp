#pragma once

#include "scene/scene.hpp"

/// Small scenes the finite-element tests share.
namespace damslip::fe2d::test {

/// The section of the reference dam: height 62.5 m, base 45 m, crest 12 m, rigid base, empty reservoir.
inline Scene reference_dam()
{
    Scene scene;
    scene.file = "test.toml";
    scene.section.polygon = {{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    scene.dam = {2500.0, 25e9, 0.17};
    return scene;
}

/// The same on 300 m x 100 m of massless rock with the grout curtain.
inline Scene reference_dam_on_rock()
{
    Scene scene = reference_dam();
    scene.foundation =
        Foundation{.material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 300.0, .depth = 100.0};
    scene.curtain = Curtain{.distance = 7.0, .depth = 30.0, .thickness = 1.0, .young_modulus = 27e9};
    return scene;
}

} // namespace damslip::fe2d::test
