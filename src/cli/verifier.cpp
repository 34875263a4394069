#include "cli/verifier.hpp"

#include "cli/flags.hpp"
#include "core/usage_error.hpp"

#include <climits>
#include <unistd.h>

namespace damslip::cli {

namespace {

void verify_flags(CLI::App& sub, VerifyArguments& a)
{
    sub.add_option("FILTER", a.filter,
                   "part of the case ids to run; with --external the folder of results that are not shipped");
    sub.add_flag("--hard", a.hard, "scenes chosen to break the numerics instead: two methods each");
    sub.add_flag("--external", a.external, "published results of others instead, each with its own accuracy");
    sub.add_option("--svg", a.svg, "with --external: scatter plot of slips, ours over theirs");
    sub.add_flag("--markdown", a.markdown, "print the results as a page; with --external docs/evidence.md");
    sub.add_flag("--list", a.list, "print the ids of the cases alone");
}


void study_flags(CLI::App& sub, StudyArguments& a)
{
    add_run_inputs(sub, a.inputs);
    sub.add_option("--method", a.method, "as of sweep; with fe the finite elements run to the default accuracy")
        ->capture_default_str();
    add_out(sub, a.out, OutputPath::folder, "folder for rows.csv, findings.csv and report.html", "-o,--out")
        ->required();
    add_jobs(sub, a.jobs);
    sub.add_flag("--resume", a.resume, "go on where a study with the same --out stopped");
}

/// Where this program stands, without its name. Empty where the system does not say.
std::filesystem::path own_folder()
{
    char path[PATH_MAX];
    const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path);
    return length > 0 ? std::filesystem::path(std::string(path, static_cast<std::size_t>(length))).parent_path() : "";
}

} // namespace

Command verify_command(Carry<VerifyArguments> verify)
{
    return {"verify", "closed-form and published cases: expected, computed, error, pass",
            "damslip verify sliding.block", with_flags<VerifyArguments>(verify_flags, std::move(verify))};
}

Command study_command(Carry<StudyArguments> study)
{
    return {
        "study",
        "the study of Goldgruber (2015), chapter 4: 6 frictions, 3 uplifts, 3 waters, 2 sizes; figures and findings",
        "damslip study examples/thesis-study/dam.toml --out study",
        with_flags<StudyArguments>(study_flags, std::move(study))};
}

int start_verifier(const std::vector<std::string>& arguments)
{
    const char* const name = "damslip-verify";
    std::vector<char*> words{const_cast<char*>(name)};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    ::execv((own_folder() / name).c_str(), words.data()); // comes back only where it failed
    ::execvp(name, words.data());
    throw InputError(Diagnostic{name, 0, 0, "this program is not installed; it carries out verify, study and mesh --to calculix.",
                                "damslip-verify beside damslip or on the PATH",
                                "install the whole package, or build it:  cmake --build --preset release"});
}

} // namespace damslip::cli
