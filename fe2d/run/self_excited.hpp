#pragma once

#include "fe2d/run/slide_watch.hpp"
#include "scene/scene.hpp"

#include <string>

/// What is said of a dam that goes on sliding by itself.
namespace damslip::fe2d {

/// How far it walked, why, and the command that runs the scene on rock that radiates. @param slip  so far [m]
std::string self_excited_sentence(const Scene& scene, double slip, const RunOutFigures& figures);

/// The warning for RunOutFigures::walked(). @param slip  at the end [m]
std::string walked_sentence(double slip, const RunOutFigures& figures);

} // namespace damslip::fe2d
