#pragma once

#include "analysis/fe/mesh_error.hpp"
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "sliding/block/slide.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// What a finite-element run of one record gives, and what may be said of it.
namespace damslip {

/// The earthquake of one record, one polarity, with sliding, opening and rocking at the base.
struct ContactRun : MotionName {
    fe2d::RunResult fe;                        ///< of the whole dam, or of few modes of it (RunResult::modes)
    std::optional<sliding::SlideResult> rigid; ///< none where the block slides statically
    std::optional<fe2d::RunResult> exact;      ///< with rigid sticking, where that of `fe` gives way
    MeshError mesh;
    bool leaves_out = false; ///< something that the scene asks for (not_honoured()): no PASS rests on the slip
    std::string unsettled_cracks = {}; ///< "crack 2, crack 3": traced ones whose path still moved; empty: none
    std::optional<double> tensile_strength = {}; ///< dam.tensile_strength, against which `fe.cracks` is held [Pa]
};

/// What is known of the numerical error of a slip [m]; NaN: nothing.
struct SlipError {
    double step = std::numeric_limits<double>::quiet_NaN(); ///< with what reduced runs leave out, of their modes
    double mesh = std::numeric_limits<double>::quiet_NaN();
    double total =
        std::numeric_limits<double>::quiet_NaN(); ///< step and mesh; step alone where no mesh part is asked for
                                                  ///< or can be had; NaN where a part that was asked for failed
    bool modes = false; ///< `step` holds what reduced runs leave out, too
    std::string parts() const; ///< "step and mesh", "modes, step only", "step, mesh not known", "no error estimate"
};
SlipError slip_error(const ContactRun& run);
SlipError lift_error(const ContactRun& run, std::size_t lift);

/// Splitting strengths of mass concrete of 10 to 30 MPa, 0.32 f_c^(2/3) with both in MPa (Raphael 1984, ACI Journal 81, 158)
/// [Pa]: without dam.tensile_strength the concrete is said to crack above the largest.
inline constexpr double usual_tensile_strength[] = {1.5e6, 3e6};
/// Would the concrete crack where the model has no joint, or a tied lift slip or part?
bool would_crack(const ContactRun& run);
/// The run with the largest tension away from joints. @returns null: no run was watched
const ContactRun* most_tensioned(const std::vector<ContactRun>& runs);

/// Does its status have a slip?
bool has_slip(const ContactRun& run);

/// Has every run an answer, one that fails included?
bool all_answered(const std::vector<ContactRun>& runs);
/// "EC8, polarity -1 self-excited, slid at least 409 mm": the runs without an answer; empty where all have one.
std::string unanswered_words(const std::vector<ContactRun>& runs);

/// How far a dam that goes on by itself had come when the run ended [m]; none for all others.
std::optional<double> slid_at_least(Status status, double slip);

/// Why parts of the errors are not known, each reason once.
std::vector<std::string> error_notes(const std::vector<ContactRun>& runs);

/// Does what follows the earthquake fall, by its resultants?
bool falls_after(const ContactRun& run);
/// Did the solver find no answer for the state after the earthquake?
bool open_after(const ContactRun& run);

/// Verdict of a run: the worst of its base, of every lift joint and of the state after the earthquake. PASS and FAIL come from
/// judge(), with the total error of each slip. @param allowable  slip [m]; none: no criterion
Verdict verdict_of(const ContactRun& run, const std::optional<double>& allowable);
/// Of all runs: FAIL if one fails, none if one has no verdict, undecided if one is, else PASS.
Verdict verdict_of(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);

/// Whether `a` comes before `b`: the smaller slip; runs without slip before all others, dams that fall or run away after them.
bool milder(const ContactRun& a, const ContactRun& b);
/// The run that no other is worse than; of equals the first. @param runs  not empty
const ContactRun& worst_of(const std::vector<ContactRun>& runs);

/// By the statuses of the runs, and of the states after the earthquake.
int exit_code_of(const std::vector<ContactRun>& runs);

/// What a contact run of a scene condenses, holds and costs. Sizes are those of the run; seconds are measured on a
/// second of strong shaking on this machine, so they differ from call to call.
struct ContactCost {
    struct Part {
        std::string name; ///< "dam at rest, inside eliminated"
        std::int64_t unknowns = 0;
        std::string made; ///< how often
        std::size_t bytes = 0;
    };
    struct OfRecord {
        std::string record;
        std::int64_t steps = 0;    ///< whole ones
        double pass_seconds = 0.0; ///< of one pass with them
    };
    std::vector<Part> parts;           ///< rock, dam at rest, dam in motion, contact problem
    std::int64_t contact_unknowns = 0; ///< what each part becomes
    std::vector<OfRecord> records;     ///< empty: a file is not there, or seconds_per_step is none
    double set_up_seconds = 0.0;
    std::optional<double> seconds_per_step; ///< none: the dam does not stand before the earthquake

    std::size_t set_up_factorisations() const { return parts.size() - 2; } ///< all but dam in motion, contact problem
};

/// @param ready  for finite elements; its records are estimated
ContactCost contact_cost(const Ready& ready);

} // namespace damslip
