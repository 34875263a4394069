#include "cli/flags.hpp"
#include "cli/study_command.hpp"

namespace damslip::cli {

namespace {

void study_flags(CLI::App& sub, StudyArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--method", a.method, "as of sweep; with fe the finite elements run to the default accuracy")
        ->capture_default_str();
    sub.add_option("-o,--out", a.out, "folder for rows.csv, findings.csv and report.html")
        ->check(output_to(OutputPath::folder, "--out"))
        ->required();
    sub.add_option("-j,--jobs", a.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
    sub.add_flag("--resume", a.resume, "go on where a study with the same --out stopped");
}

} // namespace

Command study_command()
{
    return {
        "study",
        "the study of Goldgruber (2015), chapter 4: 6 frictions, 3 uplifts, 3 waters, 2 sizes; figures and findings",
        "damslip study examples/thesis-study/dam.toml --out study", with_flags<StudyArguments>(study_flags, study)};
}

} // namespace damslip::cli
