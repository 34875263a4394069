#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/spectrum_input.hpp"
#include "cli/terminal/streams.hpp"
#include "pages/fe/fe_output.hpp"

#include <functional>

namespace damslip::cli {

struct FeArguments {
    RunInputs inputs;
    std::string base =
        "contact";               ///< "contact": the dam slides, opens and rocks on its base; "tied": it is bonded to it
    bool reduced = false;        ///< on few modes of the dam, with an error estimate; contact base only
    std::optional<int> frames;   ///< of a series for ParaView, by record, >= 2; none: no series
    std::optional<int> modes;    ///< elastic modes kept by a reduced run, 1 ... 1000; none: its own choice
    std::filesystem::path out;   ///< folder for summary.json, history_*.csv, fields; empty: none
    std::filesystem::path pdf;   ///< the report on paper; empty: none
    std::optional<int> polarity; ///< -1 flips the horizontal component; none: the scene's, else both are run
    bool spread = false;         ///< run the other rock and the other water, too, on the worst record
    std::filesystem::path state_in, state_out; ///< files of the joints' state; empty: none
    SpectrumArguments spectrum;                ///< peaks by the modes, too
    bool mesh_error = true; ///< one more run on elements of twice the size tells what the mesh leaves open

    bool reports() const { return !out.empty() || !pdf.empty(); }
};

FeOptions fe_options(const FeArguments& arguments);

/// The answer on standard output, and in the folder, if there is one, beside what the runs left there; the report on paper, if asked
/// for. The response spectrum's tables and section stand at the end.
/// @param spectrum  null: not asked for @param page  made where a report is wanted
void put_answer(pages::FeAnswer answer, const FeArguments& arguments, const Scene& scene, const SpectrumLevel* spectrum,
                const pages::FieldSeries& fields, const std::function<pages::Page()>& page, const Streams& streams);

/// Staged finite-element run of every record of the scene, both polarities beside each other. @returns exit_no_answer when a run did not end properly; what was
/// computed is written all the same.
int fe(const FeArguments& arguments, const Streams& streams);

/// `fe`: the dam slides, opens and rocks on its base. Static stages, earthquake with exact Coulomb contact, run-out, static state after
/// it; the rigid block's slip beside it.
int run_contact(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum,
                const Streams& streams);

/// `fe --reduced`: static stages by the full model, earthquake on few modes of the dam; the slip with an estimate of what the reduction
/// changes.
int run_reduced(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum,
                const Streams& streams);

/// `fe --base tied`: static stages and the linear earthquake run of a dam bonded to its base.
int run_tied(const FeArguments& arguments, const Ready& ready, const SpectrumLevel* spectrum, const Streams& streams);

} // namespace damslip::cli
