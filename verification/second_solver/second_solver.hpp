#pragma once

#include "analysis/prepare/ready.hpp"
#include "core/parallel.hpp"

#include <string>
#include <string_view>
#include <vector>

/// The model of a scene computed by CalculiX, another program, and its results beside ours.
namespace damslip {

enum class SecondAnalysis {
    modes,         ///< natural frequencies on a tied base
    tied,          ///< the first record on a tied base: displacement of the crest
    static_contact ///< gravity, water and uplift on a base that opens and slides
};

/// The input deck of ccx. @param modes  modes to find, or to superpose
/// @throws InputError for what CalculiX has no counterpart for: acoustic water, radiating rock, elements other than q8,
///         lift joints, cohesion, mass-proportional damping beside added mass
std::string calculix_deck(const Ready& ready, SecondAnalysis analysis, int modes, const Watch& watch);

/// One number by both programs.
struct SecondResult {
    std::string what, unit;
    double ours = 0.0, theirs = 0.0;
    double difference = 0.0; ///< over the size that the row names [-]
    double allowed = 0.0;    ///< [-]

    bool within() const { return difference <= allowed; }
};

/// Our results beside those that ccx has printed for calculix_deck().
/// @param dat  text of its .dat file @param file  its name, for messages
/// @throws InputError where the file does not hold them
std::vector<SecondResult> beside_calculix(const Ready& ready, SecondAnalysis analysis, int modes, std::string_view dat,
                                          const std::string& file, Watch& watch);

} // namespace damslip
