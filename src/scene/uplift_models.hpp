#pragma once

#include "scene/scene.hpp"
#include "scene/word_rows.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace damslip {

/// One corner of a pressure profile.
struct ProfilePoint {
    double distance = 0.0; ///< along the base from the heel [m]
    double pressure = 0.0; ///< water pressure [Pa]
    friend bool operator==(const ProfilePoint&, const ProfilePoint&) = default;
};

/// Water pressure under the base, piecewise linear from heel to toe; a repeated distance is a jump. In a lift joint the same
/// from its upstream end.
struct PressureProfile {
    std::vector<ProfilePoint>
        points; ///< distances ascending, first 0, last the base length; empty: no pressure anywhere
    bool empty() const { return points.empty(); }
};

/// Resultant of a profile: normal to the base, lifts the dam.
struct UpliftResultant {
    double force = 0.0;             ///< U = integral of p ds [N/m]
    double moment_about_heel = 0.0; ///< integral of p s ds [N m/m], counter-clockwise, whatever the base inclination
};

/// Exact integrals.
UpliftResultant resultant(const PressureProfile& profile);

/// Pressure at a distance from the heel [Pa]; at a jump the value on the heel's side; 0 outside the profile.
double pressure_at(const PressureProfile& profile, double distance);

/// The part of the profile beyond `from` and up to `to`, both ends included as points; a jump at `from` is left out,
/// one at `to` too.
std::vector<ProfilePoint> part(const PressureProfile& profile, double from, double to);

/// The table of uplift models: one row for each word of uplift.model.

/// The base as an uplift model sees it.
struct WetBase {
    double length = 0.0;        ///< along the base from heel to toe [m]
    double heel_pressure = 0.0; ///< [Pa]
    double toe_pressure = 0.0;  ///< [Pa]
};

struct UpliftRow {
    std::string word;                      ///< as in a scene file: "curtain"
    std::string meaning;                   ///< in brackets after the word, for the documents: "printed 2/3 rule"
    std::string needs;                     ///< what the scene must have for it: "a [curtain] with its distance_m"
    bool (*there)(const Scene&) = nullptr; ///< it has; null: nothing is needed
    /// Under the uncracked base, from 0 to its length. A crack puts the full head of its own end in its place as far as it goes. null: the profile
    /// is a matter of sliding/uplift, as with the models that have a rule of their own for cracks.
    PressureProfile (*profile)(const Scene&, const WetBase&) = nullptr;
    bool by_drains = false;                ///< linear where a load combination takes the drains as ineffective
    std::optional<UpliftModel> named = {}; ///< the enumerator, for models the program asks for by name
};

/// All rows; the place of a row is the value of its UpliftModel.
std::span<const UpliftRow> uplift_rows();

/// As written in a scene file: "curtain".
const char* word(UpliftModel model);
const UpliftRow& uplift_row(UpliftModel model);

} // namespace damslip
