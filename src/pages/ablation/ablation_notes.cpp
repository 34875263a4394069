#include "pages/ablation/ablation_tables.hpp"

#include "analysis/prepare/contact_law.hpp"
#include "analysis/prepare/records.hpp"
#include "core/units.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// "dt/8"
std::string step_word(int halvings)
{
    return halvings == 0 ? "dt" : fmt::format("dt/{}", 1 << halvings);
}

std::string step_note(const AblationStep& step)
{
    return fmt::format(
        "time step: {} = {:.4g} s in all runs, {}; ± step is what it leaves open, from the same runs with {} and first "
        "order; that of a change is of the difference itself.",
        step_word(step.halvings), step.largest_dt,
        step.missed
            ? "the smallest there is: time.slip_tolerance asks for a smaller one with all effects (tolerance missed)"
        : step.chosen ? "what time.slip_tolerance asks for with all effects, but dt/8 at least"
                      : "as time.substeps says",
        step_word(step.other));
}

std::optional<std::string> interaction_note(const Ablations& in)
{
    if (!in.plan.simplest || in.records.empty()) return std::nullopt;
    std::string text = "effects act on each other, so the changes do not add up: ";
    bool any = false;
    for (std::size_t r = 0; r < in.records.size(); ++r) {
        const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, r);
        const std::optional<double> sum = sum_of_changes(in.plan, rows), all = rows.back().slip.change;
        if (!sum || !all) continue;
        text += fmt::format("{}{}: sum {:+.4g} mm, all removed at once {:+.4g} mm", any ? "; " : "",
                            in.records[r].files.name, *sum / units::mm, *all / units::mm);
        any = true;
    }
    return any ? text + "." : "effects act on each other, so the changes do not add up.";
}

} // namespace

std::vector<std::string> ablation_notes(const Ablations& in)
{
    std::vector<std::string> notes;
    if (const auto note = base_note(in.plan.full); note && in.plan.method == Method::finite_elements)
        notes.push_back(*note + ".");
    for (std::string& note : note_texts(in.plan.full.notes)) notes.push_back(std::move(note));
    notes.push_back("every run with " + polarity_words({polarities_of(in.plan.full).front()}));
    if (!in.water.empty()) notes.push_back(in.water + " in all runs");
    if (in.runs.step) notes.push_back(step_note(*in.runs.step));
    if (in.plan.method == Method::rigid_block)
        notes.push_back(
            in.plan.full.sliding.scheme == SlidingScheme::exact
                ? "rigid block: events are located exactly, so no step error; the crest moves with the base."
                : "rigid block, SLAMMER's scheme: its step error is not estimated; the crest moves with "
                  "the base.");
    else
        notes.push_back("crest: largest horizontal distance of its upstream end from where it stood over the base "
                        "before the earthquake, so deformation and rocking without the slip; contact runs keep no "
                        "crest acceleration.");
    for (std::size_t r = 0; r < in.records.size(); ++r)
        if (const RecordOutcome& full = in.runs.scenes.front().records[r]; !full.slip)
            notes.push_back(fmt::format("{}: with all effects {}, so there is no slip that a removal could change. {}",
                                        in.records[r].files.name, word(full.status), full.message));
    if (const StatusCount unanswered = unanswered_runs(in.runs); !unanswered.empty())
        notes.push_back("runs without an answer: " + unanswered.words() + ".");
    if (in.records.empty())
        notes.push_back("no record is given: no slip. Name one with --record or [[motion.record]].");
    if (auto note = interaction_note(in)) notes.push_back(std::move(*note));
    return notes;
}

} // namespace damslip::pages
