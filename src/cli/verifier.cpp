#include "cli/verifier.hpp"

#include "cli/command.hpp"
#include "cli/terminal/terminal.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

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
    sub.add_option("--manual", a.manual,
                   "verification manual (.pdf or .html): every case by what it rests on, sheets, hard cases, results of others, errata")
        ->check([](const std::string& path) -> std::string {
            const std::string end = std::filesystem::path(path).extension().string();
            if (end == ".pdf")
                check_pdf(path);
            else if (end != ".html")
                refuse_usage("--manual " + path + " has no form.", "a file that ends in .pdf or .html", "for example  --manual manual.pdf");
            return end == ".html" ? output_to(OutputPath::file, "--manual")(path) : "";
        });
    sub.add_flag("--digest", a.digest, "run all cases and print the digest of references, tolerances and verdicts alone");
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

} // namespace

std::filesystem::path own_folder()
{
    char path[PATH_MAX];
    const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path);
    return length > 0 ? std::filesystem::path(std::string(path, static_cast<std::size_t>(length))).parent_path() : "";
}

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
    refuse(name, "this program is not installed; it carries out verify, study and mesh --to calculix.",
           "damslip-verify beside damslip or on the PATH",
           "install the whole package, or build it:  cmake --build --preset release");
}

namespace {

constexpr std::array browser_names{"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"};
constexpr std::array office_names{"soffice", "libreoffice"};
constexpr std::chrono::seconds longest_print{120};

/// The first of the names that the PATH has.
template <std::size_t n>
std::optional<std::filesystem::path> find_program(const std::array<const char*, n>& names)
{
    const char* path = std::getenv("PATH");
    std::string_view folders = path ? path : "";
    while (!folders.empty()) {
        const std::string_view folder = folders.substr(0, folders.find(':'));
        for (const char* name : names) {
            const std::filesystem::path file = std::filesystem::path(folder) / name;
            if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
        }
        folders.remove_prefix(std::min(folders.size(), folder.size() + 1));
    }
    return std::nullopt;
}

/// A folder of its own for what another program reads, its profile and what it writes; gone afterwards.
class PrintFolder {
public:
    PrintFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "damslip-print-XXXXXX").string();
        if (!mkdtemp(name.data()))
            refuse(name, "no folder can be made there to print from.",
                   "a folder for temporary files that can be written", "set TMPDIR to one");
        path_ = name;
    }
    ~PrintFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    PrintFolder(const PrintFolder&) = delete;
    PrintFolder& operator=(const PrintFolder&) = delete;
    std::filesystem::path operator/(const char* name) const { return path_ / name; }

private:
    Temporary kept_;
    std::filesystem::path path_;
};

/// Of a file, for a browser: bytes that mean something in a URL, or are not ASCII, by their numbers.
std::string url_of(const std::filesystem::path& file)
{
    std::string url = "file://";
    for (const char c : file.string()) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                           std::string_view("/-._~").find(c) != std::string_view::npos;
        url += plain && static_cast<unsigned char>(c) < 0x80 ? std::string(1, c)
                                                             : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
}

/// Runs it in a process group of its own, so that its helpers end with it. @returns false: not ended in time, or not well
bool run_to_end(const std::filesystem::path& program, std::vector<std::string> arguments,
                const std::filesystem::path& said)
{
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t child = 0;
    const int failed = posix_spawn(&child, program.c_str(), &files, &attributes, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (failed) return false;
    const auto end = std::chrono::steady_clock::now() + longest_print;
    int status = 0;
    const InterruptGuard guard;
    while (waitpid(child, &status, WNOHANG) == 0) {
        const bool stopped = guard.interrupted();
        if (stopped || std::chrono::steady_clock::now() > end) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            if (stopped) throw Interrupted("printing");
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The last lines of what the program said.
std::string last_words(const std::filesystem::path& said)
{
    constexpr std::size_t most = 400;
    std::error_code unreadable;
    if (std::filesystem::file_size(said, unreadable) > (1u << 20) || unreadable) return "";
    const std::string all = read_file(said);
    return all.size() > most ? "... " + all.substr(all.size() - most) : all;
}

} // namespace

void name_report(const std::filesystem::path& file, const Streams& streams)
{
    if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
}

void check_pdf(const std::filesystem::path& target)
{
    if (!find_program(browser_names))
        refuse_usage("--pdf " + target.string() + ": there is no Chromium to print with.",
                     fmt::format("one of {} on the PATH", fmt::join(browser_names, ", ")),
                     "apt install chromium, or write the report (--out) and print it from a browser");
    check_output(target, OutputPath::file, "--pdf");
}

void print_pdf(const std::string& html, const std::filesystem::path& target)
{
    const std::optional<std::filesystem::path> browser = find_program(browser_names);
    const PrintFolder folder;
    const std::filesystem::path page = folder / "report.html", printed = folder / "report.pdf", said = folder / "said";
    write_file(page, html);
    std::vector<std::string> arguments{browser ? browser->string() : browser_names.front(),
                                       "--headless",
                                       "--disable-gpu",
                                       "--no-first-run",
                                       "--no-pdf-header-footer",
                                       "--user-data-dir=" + (folder / "profile").string(),
                                       "--virtual-time-budget=20000", // the page draws its charts first
                                       "--print-to-pdf=" + printed.string()};
    if (geteuid() == 0) arguments.emplace_back("--no-sandbox"); // Chromium starts as root no other way
    arguments.push_back(url_of(page));
    const bool ended = browser && run_to_end(*browser, arguments, said);
    std::error_code missing;
    if (!ended || std::filesystem::file_size(printed, missing) == 0 || missing)
        refuse(target, "Chromium did not print the report. " + last_words(said),
               fmt::format("a page within {} s", longest_print.count()),
               "write the report (--out) and print it from a browser");
    write_file(target, read_file(printed));
}

void check_sheet(const std::filesystem::path& target)
{
    const std::string end = target.extension().string();
    if (end != ".xlsx" && end != ".ods")
        refuse_usage(fmt::format("--sheet {} is not a workbook.", target.string()), "a file that ends in .xlsx or .ods",
                     "for example  --sheet check.xlsx");
    if (end == ".ods" && !find_program(office_names))
        refuse_usage(fmt::format("--sheet {}: there is no LibreOffice to write it with.", target.string()),
                     fmt::format("one of {} on the PATH, or a file that ends in .xlsx", fmt::join(office_names, ", ")),
                     "apt install libreoffice-calc-nogui, or write  " + std::filesystem::path(target).replace_extension(".xlsx").string() +
                         " , which LibreOffice opens");
    check_output(target, OutputPath::file, "--sheet");
}

void write_sheet(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& write_xlsx)
{
    if (target.extension() != ".ods") {
        write_xlsx(target);
        return;
    }
    if (target.has_parent_path()) make_folder(target.parent_path());
    const std::optional<std::filesystem::path> office = find_program(office_names);
    const PrintFolder folder;
    const std::filesystem::path made = folder / "sheet.ods", said = folder / "said";
    write_xlsx(folder / "sheet.xlsx");
    const bool ended = office && run_to_end(*office,
                                            {office->string(), "-env:UserInstallation=" + url_of(folder / "profile"), "--headless",
                                             "--convert-to", "ods", "--outdir", made.parent_path().string(), (folder / "sheet.xlsx").string()},
                                            said);
    if (!ended || !std::filesystem::exists(made))
        refuse(target, "LibreOffice did not write the workbook. " + last_words(said),
               fmt::format("a file within {} s", longest_print.count()),
               "write a file that ends in .xlsx and save it from LibreOffice");
    write_file(target, read_file(made));
}

} // namespace damslip::cli
