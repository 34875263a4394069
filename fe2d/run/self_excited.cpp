#include "fe2d/run/self_excited.hpp"

#include "scene/rock_mass.hpp"

#include <fmt/format.h>

#include <cmath>

namespace damslip::fe2d {

namespace {

/// Sentences with the change of the scene that lets waves leave.
std::string remedy(const Scene& scene)
{
    const std::string then = fmt::format(", then  damslip fe {}  with the options of this run", scene.file.string());
    if (!scene.foundation) return "give [foundation] so that the rock radiates" + then;
    if (!rock_has_mass(scene))
        return fmt::format("let the rock radiate: delete  mass = \"massless\"  in [foundation], or run  damslip fe {} "
                           "--rock radiating  with the options of this run",
                           scene.file.string());
    if (scene.foundation->boundary == RockBoundary::fixed)
        return "let waves leave the rock: delete  boundary = \"fixed\"  in [foundation]" + then;
    return "the rock radiates already: see whether smaller elements and steps still give it (docs/fe-contact.md, A dam "
           "that goes on sliding)";
}

std::string hops(const RunOutFigures& figures)
{
    if (figures.hops == 0) return "";
    const std::string often = figures.hops > 1 ? fmt::format(", {:.3g} a second", figures.hop_frequency) : "";
    return fmt::format(", {} {} with the whole base open{}", figures.hops, figures.hops == 1 ? "lift-off" : "lift-offs",
                       often);
}

} // namespace

std::string self_excited_sentence(const Scene& scene, double slip, const RunOutFigures& f)
{
    const std::string more = std::isfinite(f.thrust_over_friction)
                                 ? fmt::format("does {:.3g} times the work that friction takes", f.thrust_over_friction)
                                 : "meets no friction";
    return fmt::format(
        "Self-excited, slid at least {:.4g} mm: with the ground at rest it goes on at {:.3g} mm/s although it "
        "would stand, FS {:.3g}; it slips while little presses on the base, so the static thrust {} and pays "
        "for the vibration{}. No slip can be given: {}.",
        1e3 * std::abs(slip), 1e3 * std::abs(f.rate), f.sliding_factor, more, hops(f), remedy(scene));
}

std::string walked_sentence(double slip, const RunOutFigures& f)
{
    return fmt::format("{:.3g} mm of the slip of {:.4g} mm came after the record, with the ground at rest{}: it may be "
                       "the model that goes on sliding (docs/fe-contact.md, A dam that goes on sliding).",
                       1e3 * std::abs(f.slip_at_rest), 1e3 * std::abs(slip), hops(f));
}

} // namespace damslip::fe2d
