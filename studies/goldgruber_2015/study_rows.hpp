#pragma once

#include "analysis/prepare/records.hpp"
#include "analysis/sweep/sweep_run.hpp"

/// The grid of Goldgruber (2015), chapter 4, and what came out at its points.
namespace damslip::study {

namespace chapter_4 {

inline const std::vector<double> frictions{1.00, 0.84, 0.77, 0.70, 0.66, 0.65}; ///< table 4-2
inline const std::vector<std::string> uplifts{"seepage", "curtain", "linear"};  ///< curtain: printed 2/3
inline const std::vector<std::string> waters{"westergaard-simplified", "westergaard", "acoustic"}; ///< of FE
inline const std::vector<double> sizes{1.0, 2.0};

inline constexpr const char* block_water = "westergaard-simplified"; ///< of the source's rigid block, (3-4)
inline constexpr const char* source_method = "fe-goldgruber-2015";   ///< with the settings of the source
inline constexpr const char* radiating_method =
    "fe-radiating"; ///< rock that radiates, beside the source's massless one
} // namespace chapter_4

/// The one polarity of the study: motion.polarity, else the record as filed.
inline int study_polarity(const Scene& scene)
{
    return polarities_of(scene).front();
}

/// Where in the grid.
struct StudyCase {
    std::string uplift = "seepage", water = "westergaard";
    double size = 1.0, friction = 1.0;
    std::string method = "rigid";
};

/// Rows by their case, of the first record in the study's polarity.
class StudyRows {
public:
    StudyRows(const Grid& grid, const SweepOutcome& outcome) : grid_(grid), outcome_(outcome) {}

    /// Largest slip on the way [mm]; none: slides without an earthquake, or no answer.
    std::optional<double> slip(const StudyCase& at) const;
    /// Slips of all frictions of the study, in their order [mm]; NaN where there is none.
    std::vector<double> slips(StudyCase at) const;
    bool fails_statically(const StudyCase& at) const;
    std::optional<Status> status(const StudyCase& at) const;     ///< none: no such row
    std::string slip_words(const StudyCase& at) const;           ///< "982 mm", or the status in place of a slip
    std::optional<double> step_error(const StudyCase& at) const; ///< [mm]
    const SlipHistory* history(const StudyCase& at) const;       ///< nullptr: none
    double critical_friction(const StudyCase& at) const;         ///< of the rigid block [-]
    double yield_acceleration(const StudyCase& at) const;        ///< [m/s²]
    bool has(const std::string& method) const;

    const Grid& grid() const { return grid_; }
    /// The most accurate FE method there is: "fe", else "fe-whole-steps"; empty: neither.
    std::string accurate() const;

private:
    std::optional<std::size_t> id(const StudyCase& at) const;
    const FinishedRow* row(const StudyCase& at) const;

    const Grid& grid_;
    const SweepOutcome& outcome_;
};

} // namespace damslip::study
