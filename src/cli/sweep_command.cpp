#include "cli/sweep_command.hpp"

#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_run.hpp"
#include "cli/command.hpp"
#include "cli/input/make_axes.hpp"
#include "cli/terminal/terminal.hpp"
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "pages/report/table_text.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/uplift_models.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>
#include <ostream>
#include <ranges>

namespace damslip::cli {

using namespace pages;

namespace {

/// Flags that do not go together.
void check_flags(const SweepArguments& a, Form form)
{
    if (a.inputs.scene.empty() && a.merge.empty())
        refuse_usage("SCENE is missing.", "a scene file to sweep over, or --merge with parts to put together",
                     "damslip sweep SCENE ... or  damslip sweep --merge FOLDER --out results.csv");
    const bool parts = a.plan || !a.slurm_array.empty();
    if (a.out.empty())
        for (const auto& [flag, given] : {std::pair{"--resume", a.resume},
                                          {"--shard", !a.shard.empty()},
                                          {"--plan", a.plan},
                                          {"--slurm-array", !a.slurm_array.empty()}})
            if (given) refuse_usage(fmt::format("{} without --out.", flag), "both", "add  --out results.csv");
    if (!a.pdf.empty() && (parts || !a.shard.empty()))
        refuse_usage("--pdf with a part or a plan of a sweep.", "a whole sweep, or --merge: parts have no report",
                     "delete --pdf, and add it where the parts are put together");
    if (a.parts && !parts)
        refuse_usage("--parts without --plan or --slurm-array.", "with one of them", "delete --parts");
    if (parts && !a.shard.empty())
        refuse_usage("--shard together with --plan or --slurm-array.", "a part, or the commands of all parts",
                     "delete --shard");
    if (a.out.extension() == ".html" || a.out.extension() == ".sqlite")
        refuse_usage("--out " + a.out.string() + " is the name of the " +
                         (a.out.extension() == ".html" ? "report." : "database."),
                     "a name for the rows; report and database are beside it",
                     "write  --out " + std::filesystem::path(a.out).replace_extension(".csv").string());
    if (a.mean_polarity && (parts || !a.shard.empty() || !a.merge.empty()))
        refuse_usage("--mean-polarity with a part or a plan of a sweep.",
                     "a whole sweep: a part may hold one polarity alone", "delete --mean-polarity");
    if (form == Form::json && (!a.shard.empty() || !a.merge.empty()))
        refuse_usage(fmt::format("{} with --json.", a.shard.empty() ? "--merge" : "--shard"),
                     "parts are put together as a CSV file", "delete --json");
}

constexpr std::size_t largest_report = 300'000; ///< rows
constexpr std::size_t drawn_rows = 50'000;      ///< of a sweep of more rows only some frictions are drawn

/// The report beside the table (results.csv -> results.html), and on paper, as asked for.
void put_pages(const SweepArguments& arguments, const SweepReportInput& in, const Streams& streams)
{
    const std::string html = page_html(sweep_page(in));
    if (!arguments.out.empty()) {
        std::filesystem::path page = arguments.out;
        page.replace_extension(".html");
        write_file(page, html);
        name_report(page, streams);
    }
    if (arguments.pdf.empty()) return;
    print_pdf(html, arguments.pdf);
    name_report(arguments.pdf, streams);
}

bool reports(const SweepArguments& arguments)
{
    return !arguments.out.empty() || !arguments.pdf.empty();
}

/// Rows that go out one by one, into a file or to standard output.
class RowsOut {
public:
    /// @param file  empty: standard output
    RowsOut(const std::filesystem::path& file, const SweepIdentity& identity, const std::vector<Column>& columns,
            const Streams& streams)
        : streams_(streams), waiting_(csv_head(columns, csv_comments(identity)))
    {
        if (!file.empty()) file_.emplace(file);
    }

    void add(const std::vector<Cell>& row)
    {
        constexpr std::size_t written_at_once = 1 << 16;
        lines_.add(row, waiting_);
        if (waiting_.size() >= written_at_once) write();
    }
    void finish()
    {
        write();
        if (file_) file_->finish();
    }

private:
    void write()
    {
        if (file_)
            file_->write(waiting_);
        else
            streams_.out << waiting_;
        waiting_.clear();
    }

    const Streams& streams_;
    std::optional<FileWriter> file_;
    CsvLines lines_;
    std::string waiting_; ///< to be written
};

/// Parts put together; their report is of the rows alone, or with what the scene says when it is named.
int merge(const SweepArguments& arguments, const Streams& streams)
{
    const auto [whole, parts] = merge_parts(arguments.merge, arguments.out.empty() ? "" : store_of(arguments.out));
    const SweepIdentity& identity = whole->identity();
    const Grid grid = stored_grid(whole->axes());
    const bool reported = reports(arguments) && identity.rows <= largest_report;
    std::optional<Scene> scene;
    if (reported && !arguments.inputs.scene.empty()) {
        scene = read_run_scene(arguments.inputs, streams);
        if (scene_hash(*scene) != identity.scene)
            refuse_usage(fmt::format("the parts are not of the scene {}.", arguments.inputs.scene.string()),
                         "the scene the parts were made from, with the same changes on the command line",
                         "leave SCENE out");
    }
    Table table{"", sweep_columns(grid), {}, {}};
    RowsOut out(arguments.out, identity, table.columns, streams);
    UnansweredRows unanswered;
    std::vector<SlipHistory> histories;
    SweepViewMaker view;
    constexpr std::size_t at_once = 8192;
    for (std::size_t first = 0; first < identity.rows; first += at_once) {
        std::vector<std::size_t> ids(std::min(at_once, identity.rows - first));
        std::iota(ids.begin(), ids.end(), first);
        const SweepOutcome part{whole->rows(ids.front(), ids.back()), ids.size(), ids.size(), {}};
        for_each_sweep_row(grid, ids, part, false, [&](const SweepLine& line, const std::vector<Cell>& row) {
            out.add(row);
            if (reported) table.rows.push_back(row);
            if (reported) view.add(line);
            if (identity.rows <= most_rows_with_history) histories.push_back(line.row->history);
            if (!line.row->good) unanswered.add(static_cast<std::int64_t>(line.id), status_of(*line.row));
        });
    }
    out.finish();
    if (reported)
        put_pages(arguments,
                  {scene ? &*scene : nullptr,
                   table,
                   view.view(),
                   {},
                   {},
                   scene ? *load_records(*scene, Method::rigid_block) : std::vector<RecordPair>(),
                   arguments.out,
                   histories},
                  streams);
    if (!arguments.out.empty()) whole->mark_done();
    if (!streams.quiet)
        streams.talk << fmt::format("{} rows of {} parts{}\n", identity.rows, parts,
                                    arguments.out.empty() ? "" : " in " + arguments.out.string());
    if (unanswered.words().empty()) return exit_ok;
    streams.talk << unanswered.words() << "\n";
    return exit_no_answer;
}

/// A line break in a name would end a command of the plan, or a comment of the job script, in the middle.
void check_for_scripts(const std::string& command)
{
    if (std::any_of(command.begin(), command.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
        refuse_usage("a name on the command line has a line break or another control character.",
                     "printable characters: the commands are lines of a file", "rename the file");
}

/// The commands of all parts, or a job script that runs them.
int print_plan(const SweepArguments& arguments, const TaskList& tasks, const Streams& streams)
{
    const std::size_t parts =
        arguments.parts ? static_cast<std::size_t>(*arguments.parts) : tasks.variants() * tasks.motions();
    check_for_scripts(sweep_command_line(arguments));
    if (arguments.plan && !put_json_document(streams, "sweep-plan", {{"plan", plan_text(arguments, parts)}}))
        streams.out << plan_text(arguments, parts);
    if (!arguments.slurm_array.empty()) write_file(arguments.slurm_array, slurm_script(arguments, parts));
    if (!streams.quiet)
        streams.talk << fmt::format("{} parts, {} rows; afterwards:  {}\n", parts, tasks.rows(),
                                    merge_command_line(arguments, parts));
    return exit_ok;
}

std::vector<SlipHistory> histories_of(const std::vector<std::size_t>& wanted, const SweepOutcome& outcome)
{
    std::vector<SlipHistory> histories;
    if (wanted.size() > most_rows_with_history) return histories;
    for (const std::size_t id : wanted) {
        const FinishedRow* row = outcome.find(id);
        histories.push_back(row ? row->history : SlipHistory{});
    }
    return histories;
}

void talk_of_damage(const ResultStore& store, const Streams& streams)
{
    if (!streams.quiet && store.damaged())
        streams.talk << fmt::format("{} damaged rows of the database are computed again\n", store.damaged());
}

/// What of the rows is no answer, said even when quiet, and what has no error estimate.
void talk_of_answers(const SweepView& view, const SweepOutcome& outcome, const Streams& streams)
{
    if (outcome.all_good() && !outcome.fe) return;
    if (const std::string words = view.unanswered.words(); !words.empty()) streams.talk << words << "\n";
    if (outcome.fe)
        for (const std::string& failure : outcome.fe->failures) streams.talk << "not resolved: " << failure << "\n";
    if (const std::string words = unknown_error_words(view); !words.empty() && !streams.quiet)
        streams.talk << "note: " << words << "\n";
}

/// A sweep, or one part of it, as the command line asks for it.
struct Job {
    const SweepArguments& arguments;
    const Scene& scene; ///< as given
    const Axes& axes;
    const TaskList& tasks;
    std::optional<Shard> shard;

    /// Where the rows are: the table, of a part the database; empty: standard output.
    std::filesystem::path named() const { return shard ? store_of(arguments.out, shard) : arguments.out; }
};

/// The rows go to standard output where no file is named, unless a person reads it and did not ask for all.
bool rows_on_out(const SweepArguments& a, const Streams& streams)
{
    return a.out.empty() && streams.form != Form::json && !(streams.form == Form::text && streams.out_is_terminal);
}

std::string rows_line(const Job& job, std::size_t rows)
{
    return fmt::format("{} rows{}, {}\n", rows, job.named().empty() ? "" : " in " + job.named().string(),
                       polarity_words(job.axes.polarity));
}

/// On standard output where that has no rows, else beside them; in full, and of a part, it is talk.
void put_sweep_answer(const Job& job, const SweepReportInput& in, const Streams& streams)
{
    const bool aside = rows_on_out(job.arguments, streams);
    if (streams.form == Form::json) put_answer(sweep_answer(in), "", streams);
    if (streams.form == Form::text && !job.shard && !in.rows.rows.empty()) {
        if (!aside || !streams.quiet)
            put_answer(sweep_answer(in), "--out FILE.csv", streams, aside ? &streams.talk : nullptr);
    } else if (!streams.quiet) {
        streams.talk << (job.shard ? in.closing : sweep_answer(in).full());
    }
}

int finish(const Job& job, const SweepIdentity& identity, const Grid& grid, const std::vector<RecordPair>& records,
           const std::vector<std::size_t>& wanted, const SweepOutcome& outcome, const Streams& streams)
{
    const Table table = sweep_table(grid, wanted, outcome, job.arguments.mean_polarity);
    Table compared;
    if (outcome.fe && !job.shard) compared = comparison_table(grid, compare_with_rigid(job.scene, grid, outcome));
    const auto text = [&] { return csv(table, csv_comments(identity)); };
    if (!job.shard && !job.arguments.out.empty()) write_file(job.arguments.out, text());
    if (!job.shard && rows_on_out(job.arguments, streams)) streams.out << text();
    const SweepView view = sweep_view(grid, wanted, outcome);
    const SweepReportInput in{.scene = &job.scene,
                              .rows = table,
                              .view = view,
                              .compared = compared,
                              .fe = outcome.fe,
                              .records = records,
                              .csv = job.arguments.out,
                              .histories = histories_of(wanted, outcome),
                              .closing = rows_line(job, outcome.rows.size())};
    put_sweep_answer(job, in, streams);
    if (streams.form != Form::text || streams.quiet || job.shard) talk_of_answers(view, outcome, streams);
    // A part has no report, nor has a table too large to be looked at.
    if (reports(job.arguments) && !job.shard && table.rows.size() <= largest_report)
        put_pages(job.arguments, in, streams);
    return outcome.complete() && outcome.all_good() ? exit_ok : exit_no_answer;
}

/// Many rows and nothing that asks for all of them at once.
bool is_long(const Job& job, const std::vector<std::size_t>& wanted, const Streams& streams)
{
    constexpr std::size_t most_rows_at_once = 10'000;
    return wanted.size() > most_rows_at_once && !job.axes.finite_elements() && !has_opening_axis(job.axes) &&
           streams.form != Form::json && !job.arguments.mean_polarity;
}

int stopped(std::size_t finished, std::size_t wanted, const Streams& streams)
{
    streams.talk << fmt::format("interrupted: {} of {} rows are finished; go on with --resume\n", finished, wanted);
    return exit_no_answer;
}

int run_long(const Job& job, const Sweep& inputs, const SweepIdentity& identity, const std::vector<std::size_t>& wanted,
             ResultStore* store, const Streams& streams)
{
    const std::size_t every = (wanted.size() + drawn_rows - 1) / drawn_rows;
    const bool reported =
        reports(job.arguments) && !job.shard &&
        wanted.size() / job.tasks.friction * ((job.tasks.friction + every - 1) / every) <= largest_report;
    Grid grid = begin_grid(job.scene, job.axes, job.tasks, inputs.records);
    Table listed{"", sweep_columns(grid), {}, {}};
    SweepViewMaker all(every);
    if (reported) all.expect(wanted.size() / every);
    UnansweredRows unanswered;
    const std::size_t rows_of_friction = job.tasks.rows() / job.tasks.friction;
    std::optional<RowsOut> rows; // of a part there is no table
    if (!job.shard && (!job.arguments.out.empty() || rows_on_out(job.arguments, streams)))
        rows.emplace(job.arguments.out, identity, listed.columns, streams);
    const bool in_brief = streams.form == Form::text && !job.shard;
    TerminalWatch watch(streams);
    const SweepTotals totals = run_long_sweep(
        inputs, std::move(grid), wanted, store, job.arguments.jobs, watch,
        [&](const Grid& held, const std::vector<std::size_t>& ids, const SweepOutcome& part) {
            if (store && !part.complete()) return;
            auto id = ids.begin();
            for_each_sweep_row(held, ids, part, false, [&](const SweepLine& line, const std::vector<Cell>& row) {
                if (rows) rows->add(row);
                const bool drawn = *id++ / rows_of_friction % every == 0;
                if (reported || in_brief) drawn ? all.add(line) : all.leave_out(line);
                if (listed.rows.size() < listed_rows) listed.rows.push_back(row);
                if (line.row && !line.row->good)
                    unanswered.add(static_cast<std::int64_t>(line.id), status_of(*line.row));
            });
        });
    if (store && totals.found && !streams.quiet)
        streams.talk << fmt::format("{} rows were finished before\n", totals.found);
    if (store) talk_of_damage(*store, streams);
    if (!totals.complete() && store) return stopped(totals.rows, totals.wanted, streams);
    if (rows) rows->finish();
    const SweepView view = reported || in_brief ? all.view() : SweepView();
    const SweepReportInput of_rows{.scene = &job.scene,
                                   .rows = listed,
                                   .view = view,
                                   .compared = {},
                                   .fe = {},
                                   .records = *inputs.records,
                                   .csv = job.arguments.out,
                                   .closing = rows_line(job, totals.rows)};
    put_sweep_answer(job, of_rows, streams);
    if (totals.bad) streams.talk << unanswered.words() << "\n";
    if (reported) {
        put_pages(job.arguments, of_rows, streams);
    } else if (reports(job.arguments) && !job.shard && !streams.quiet) {
        streams.talk << fmt::format("no report: {} rows are more than the {} it draws\n", totals.rows, largest_report);
    }
    if (store) store->mark_done();
    return totals.complete() && totals.bad == 0 ? exit_ok : exit_no_answer;
}

int run(const Job& job, const Records& records, const Streams& streams)
{
    const SweepArguments& a = job.arguments;
    const Sweep inputs{job.scene, job.axes, job.tasks, records, a.modes, a.penalty_stiffness, a.truncation_error};
    check_fe_scenes(inputs);
    const SweepIdentity identity = sweep_identity(inputs);
    const std::vector<std::size_t> wanted = shard_rows(job.tasks, job.shard.value_or(Shard{}));
    std::optional<ResultStore> store;
    if (!a.out.empty())
        store.emplace(store_of(a.out, job.shard), identity, job.shard.value_or(Shard{}),
                      a.resume ? StoreStart::resume : StoreStart::fresh);
    if (is_long(job, wanted, streams))
        return run_long(job, inputs, identity, wanted, store ? &*store : nullptr, streams);
    const Grid grid = make_grid(job.scene, job.axes, job.tasks, records, a.jobs);
    TerminalWatch watch(streams);
    const SweepOutcome outcome = run_sweep(inputs, grid, wanted, store ? &*store : nullptr, a.jobs, watch);
    if (store) {
        if (outcome.found && !streams.quiet)
            streams.talk << fmt::format("{} rows were finished before\n", outcome.found);
        talk_of_damage(*store, streams);
    }
    if (store && !outcome.complete()) { // a table with gaps would look like the whole
        return stopped(outcome.rows.size(), outcome.wanted, streams);
    }
    const int code = finish(job, identity, grid, *records, wanted, outcome, streams);
    if (store) store->mark_done();
    return code;
}

/// The full grid of friction x level x uplift x reservoir x size x scale x polarity x record x method, one CSV row each,
/// in that order: the same bytes for any number of threads, any parts, and any number of stops and resumptions.
int sweep(const SweepArguments& arguments, const Streams& streams)
{
    check_flags(arguments, streams.form);
    if (!arguments.merge.empty()) return merge(arguments, streams);
    Scene scene = read_run_scene(arguments.inputs, streams);
    const Axes axes = make_axes(arguments, scene);
    say(axes.notes, arguments.inputs.strict, streams);
    if (arguments.mean_polarity && axes.polarity.size() != 2)
        refuse_usage("--mean-polarity without both polarities.", "both", "add  --polarity 1,-1");
    if (std::any_of(axes.method.begin(), axes.method.end(),
                    [](const SweepMethod& method) { return method.kind == SweepKind::finite_elements; }))
        say_base(scene, streams);
    Scene asked = scene;
    for (const std::string& plane : axes.plane)
        if (!plane.empty()) asked.planes.slides_on = plane;
    const std::vector<Diagnostic> left_out = not_honoured(asked, methods_of(axes.method));
    say(left_out, false, streams);
    for (const auto* notes : {&axes.notes, &left_out})
        scene.notes.insert(scene.notes.end(), notes->begin(), notes->end());
    if (scene.motion.records.empty())
        refuse_usage("there is no record to sweep over.", "a [[motion.record]] in the scene or --record",
                     "add  --record FILE");
    const TaskList tasks = make_tasks(axes, motion_count(scene));
    if (tasks.rows() > 20'000'000)
        refuse_usage(fmt::format("the grid has {} rows.", tasks.rows()), "at most 20 million", "split it");
    for (const auto& [flag, given] :
         {std::pair{"--plan", arguments.plan}, {"--slurm-array", !arguments.slurm_array.empty()}})
        if (given) need_scene_file(arguments.inputs, flag);
    if (arguments.plan || !arguments.slurm_array.empty()) return print_plan(arguments, tasks, streams);
    Job job{arguments, scene, axes, tasks, std::nullopt};
    if (!arguments.shard.empty()) job.shard = parse_shard(arguments.shard, "--shard");
    return run(job, load_records(scene, Method::rigid_block), streams);
}

void add_sweep_parts(CLI::App& sub, SweepArguments& a)
{
    const char* const group = "Long sweeps";
    sub.option_defaults()->group(group);
    sub.add_flag("--resume", a.resume, "go on where a sweep with the same --out stopped");
    sub.add_option("--shard", a.shard, "i/n: the i-th of n parts, i from 0, into OUT.i-of-n.sqlite");
    sub.add_option("--merge", a.merge,
                   "put parts together: their databases, or folders of them; with SCENE its report has the section and "
                   "the records");
    sub.add_flag("--plan", a.plan, "print the commands of all parts, one a line");
    sub.add_option("--slurm-array", a.slurm_array, "write a Slurm job script for all parts")
        ->check(output_to(OutputPath::file, "--slurm-array"));
    sub.add_option("--parts", a.parts, "of --plan and --slurm-array; default: one per scene variant and motion")
        ->check(CLI::Range(1, 1000000));
    sub.option_defaults()->group("Options");
}

void sweep_flags(CLI::App& sub, SweepArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.get_option("SCENE")->required(false); // --merge has none
    const auto list = [&](const char* flag, std::string& target, const std::string& text) {
        sub.add_option(flag, target, text)->group("Grid");
    };
    list("--friction", a.friction, "Coulomb mu: 1.00,0.84,0.77 or first:last:step 0.65:1.0:0.05");
    list("--friction-deg", a.friction_deg, "friction angles instead [deg]");
    list("--plane", a.plane,
         "what the dam slides on: base, seams by name, of rigid blocks lifts such as \"lift at 30 m\", too; each has "
         "its own friction unless --friction gives one for all");
    list("--level", a.level, "water levels above the heel, at size 1 [m]");
    list("--uplift", a.uplift,
         fmt::format("{}", fmt::join(uplift_rows() | std::views::transform(&UpliftRow::word), ", ")));
    list("--opening-water", a.opening_water,
         "rules for the water in the opening base, side by side: unchanged, zero, full, mouth (with the scene's "
         "mouth_speed_m_s), reynolds");
    list("--reservoir", a.reservoir, fmt::format("{}", fmt::join(reservoir_axis_words(), ", ")));
    list("--size", a.size, "factors on all lengths of the scene: dam, rock, water, elements");
    list("--period", a.period, "periods of the flexible block [s], for decoupled and coupled");
    list("--damping", a.damping, "damping ratios of the flexible block, for decoupled and coupled");
    list("--scale", a.scale, "factors on the records");
    list("--polarity", a.polarity, "1, -1 or both (default: both, or motion.polarity of the scene)");
    sub.add_flag("--mean-polarity", a.mean_polarity, "a column with the mean slip of --polarity 1,-1");
    list("--method", a.method,
         "rigid (horizontal), rigid-v (with the vertical component), rocking (the same, free to rock on toe and heel), "
         "decoupled and coupled (the block that vibrates on its base: [flexible_block] or --period), fe (finite "
         "elements with the scene's contact law), fe-exact, fe-penalty, fe-slip-tolerance, fe-whole-steps, "
         "fe-goldgruber-2015, fe-radiating, fe-massless, fe-reduced, and regressions by id such as "
         "ambraseys-menu-1988, jibson-1993, jibson-1998");
    sub.add_option("--modes", a.modes, "elastic modes of fe-reduced (12)")->check(CLI::Range(1, 1000));
    sub.add_flag("--truncation-error", a.truncation_error,
                 "estimate for every row of fe-reduced what the modes left out change");
    sub.add_option("--penalty-stiffness", a.penalty_stiffness, "of fe-penalty [N/m3]")->check(in_range(1.0, 1e20));
    sub.add_option("--scheme", a.inputs.scheme, "exact (default) or slammer");
    add_out(sub, a.out, OutputPath::regular_file,
            "CSV file, beside it a report (.html) and a database of the rows (.sqlite) for --resume; without it the "
            "rows go to standard output",
            "-o,--out");
    add_pdf(sub, a.pdf);
    add_jobs(sub, a.jobs);
    add_sweep_parts(sub, a);
}

} // namespace

Command sweep_command()
{
    return {"sweep", "slip over a grid of friction, level, uplift, reservoir, size, scale, polarity and records; CSV",
            "damslip sweep examples/reference_dam.toml --friction 0.65:1.0:0.05 --uplift curtain,linear --scale 1,2",
            with_flags<SweepArguments>(sweep_flags, sweep)};
}

std::string sweep_command_line(const SweepArguments& a)
{
    std::string line = "damslip sweep " + shell_words(a.inputs);
    const auto add = [&line](const char* flag, const std::string& value) {
        if (!value.empty()) line += fmt::format(" {} {}", flag, shell_quoted(value));
    };
    for (const GridFlag& f : grid_flags) add(f.flag, a.*f.list);
    add("--method", a.method);
    if (a.modes) add("--modes", std::to_string(*a.modes));
    if (a.truncation_error) line += " --truncation-error";
    if (a.penalty_stiffness) add("--penalty-stiffness", shortest(*a.penalty_stiffness));
    add("--scheme", a.inputs.scheme);
    if (a.inputs.strict) line += " --strict";
    add("--out", a.out.string());
    return line;
}

std::string plan_text(const SweepArguments& arguments, std::size_t parts)
{
    const std::string command = sweep_command_line(arguments);
    std::string text;
    for (std::size_t i = 0; i < parts; ++i)
        text += fmt::format("{} --jobs {} --resume --shard {}/{}\n", command, std::max(1, arguments.jobs), i, parts);
    return text;
}

std::string merge_command_line(const SweepArguments& arguments, std::size_t parts)
{
    std::string line = "damslip sweep --merge";
    if (parts <= 20)
        for (std::size_t i = 0; i < parts; ++i)
            line += " " + shell_quoted(store_of(arguments.out, Shard{i, parts}).string());
    else {
        const auto folder = arguments.out.parent_path();
        line += " " + shell_quoted(folder.empty() ? "." : folder.string());
    }
    return line + " --out " + shell_quoted(arguments.out.string());
}

std::string slurm_head(const std::string& name, std::size_t parts, int jobs)
{
    return fmt::format(R"(#!/bin/sh
#SBATCH --job-name={0}
#SBATCH --array=0-{1}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={2}
#SBATCH --time=04:00:00
#SBATCH --mem-per-cpu=2G
#SBATCH --output={0}-%A-%a.log
)",
                       name, parts - 1, std::max(1, jobs));
}

std::string slurm_exec(const std::string& command, std::size_t parts)
{
    return fmt::format(R"(set -eu
exec {} --jobs "${{SLURM_CPUS_PER_TASK:-1}}" --resume --quiet --shard "$SLURM_ARRAY_TASK_ID/{}"
)",
                       command, parts);
}

std::string slurm_script(const SweepArguments& arguments, std::size_t parts)
{
    return slurm_head("damslip-sweep", parts, arguments.jobs) +
           fmt::format(
               R"(# Adjust time and memory; add partition and account. Submit in the folder the paths below start from:
#   sbatch this-script
# A part that was stopped goes on where it was when it is submitted again:  sbatch --array=3,7 this-script
# Sites limit the array (scontrol show config: MaxArraySize); fewer parts: write this script again with --parts N.
# When all parts are there:
#   {}
)",
               merge_command_line(arguments, parts)) +
           slurm_exec(sweep_command_line(arguments), parts);
}

} // namespace damslip::cli
