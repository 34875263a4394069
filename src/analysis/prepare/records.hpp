#pragma once

#include "records/record.hpp"
#include "scene/effect_plan.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <vector>

namespace damslip {

/// One record pair of a scene as read, with what its files are; or a sequence of them.
struct RecordPair {
    RecordFiles files; ///< of a sequence: those of its first record, with a name of its own
    Record horizontal; ///< of a sequence: that of its first record
    std::optional<Record> vertical;
    std::vector<RecordPair> parts = {}; ///< of a sequence, in their order; else empty
};

/// How many motions the scene's records make: its sequence is one, each record that it does not name another.
std::size_t motion_count(const Scene& scene);

/// Reads the scene's records, its sequence first; verticals only where the plan has vertical motion.
std::vector<RecordPair> read_records(const Scene& scene, const EffectPlan& plan);

/// What the headers of the files say against their use: a vertical component taken as horizontal, a horizontal one as vertical.
std::vector<std::string> component_remarks(const RecordPair& pair);

/// Where factors on records follow motion.scale_to_pga: the PGA that they make of it.
std::vector<std::string> scaled_peak_remarks(const Scene& scene);

/// The polarities that are run of each record: the one that is asked for, else motion.polarity, else +1 and -1. Everywhere
/// in the program a polarity is the sign on the horizontal component as filed.
std::vector<int> polarities_of(const Scene& scene, std::optional<int> asked = {});
/// "both polarities", "polarity -1 alone"
std::string polarity_words(const std::vector<int>& polarities);

/// One motion of a scene by name.
struct MotionName {
    std::string record;
    int polarity = 1;  ///< -1: the record's horizontal component is flipped
    bool both = false; ///< the other polarity is run, too

    std::string label() const;  ///< the record, with its polarity where both are run: "El Centro NS, polarity -1"
    std::string suffix() const; ///< of file names: "_+1", "_-1"; empty where one polarity is run
};

/// The motions of a scene in the order in which all commands run them: each record with each of polarities_of().
std::vector<MotionName> motion_names(const Scene& scene, const std::vector<RecordPair>& records,
                                     std::optional<int> asked = {});

/// Both components on one grid, scaled as scene and record say; of a sequence all its records on one grid, and
/// motion.scale_to_pga is the largest peak of them. The factors motion.scale and, of a record alone, its own follow that peak.
/// @param scale  on top of them
/// @param polarity  the sign on the horizontal component as filed, one of polarities_of()
GroundMotion ground_motion(const Scene& scene, const RecordPair& pair, double scale = 1.0, int polarity = 1);

/// Largest size of some samples; 0 of none.
double peak_of(std::span<const double> samples);

} // namespace damslip
