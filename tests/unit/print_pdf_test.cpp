// Reports as PDF, by a stand-in for Chromium on the PATH: what it is asked, what becomes of what it prints, and what is said when it fails.
// That a real one prints the pages is a test of the reports.
#include "cli/verifier.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <unistd.h>

namespace damslip::pdf_tests {

namespace {

/// A variable of the environment, put back afterwards.
class Environment {
public:
    Environment(std::string name, const std::string& value) : name_(std::move(name))
    {
        if (const char* old = std::getenv(name_.c_str())) old_ = old;
        setenv(name_.c_str(), value.c_str(), 1);
    }
    ~Environment() { old_ ? setenv(name_.c_str(), old_->c_str(), 1) : unsetenv(name_.c_str()); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::string name_;
    std::optional<std::string> old_;
};

/// Takes the page and the file that it is asked for from its arguments, which it prints before the page.
constexpr const char* prints =
    "for word; do case $word in --print-to-pdf=*) out=${word#*=} ;; file://*) page=${word#file://} ;; esac; done\n"
    "{ printf '%s\\n' \"$@\"; while IFS= read -r line || [ -n \"$line\" ]; do printf '%s\\n' \"$line\"; done "
    "<\"$page\"; } >\"$out\"\n";

class PrintPdf : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder / "bin");
        std::filesystem::create_directories(folder / "tmp");
        path.emplace("PATH", (folder / "none").string() + ":" + (folder / "bin").string());
        tmp.emplace("TMPDIR", (folder / "tmp").string());
    }
    void TearDown() override
    {
        EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp")); // nothing stays behind
        tmp.reset();
        path.reset();
        std::filesystem::remove_all(folder);
    }
    void browser(const std::string& script, const char* name = "chromium") const
    {
        write_file(folder / "bin" / name, "#!/bin/sh\n" + script);
        std::filesystem::permissions(folder / "bin" / name, std::filesystem::perms::owner_all);
    }
    std::string failure() const
    {
        try {
            cli::print_pdf("<p>page</p>", target);
        } catch (const InputError& error) {
            EXPECT_FALSE(std::filesystem::exists(target));
            return error.what();
        }
        ADD_FAILURE() << "printed";
        return "";
    }

    std::filesystem::path folder = std::filesystem::temp_directory_path() / fmt::format("damslip_pdf_{}", ::getpid());
    std::filesystem::path target = folder / "report.pdf";
    std::optional<Environment> path, tmp;
};

TEST_F(PrintPdf, TheFileIsWhatTheBrowserPrinted)
{
    browser(prints, "google-chrome"); // any of the names
    EXPECT_NO_THROW(cli::check_pdf(target));
    cli::print_pdf("<p>one</p>\n<p>two</p>", target);
    const std::string text = read_file(target);
    EXPECT_TRUE(text.ends_with("<p>one</p>\n<p>two</p>\n")) << text;
    EXPECT_NE(text.find("--headless\n"), std::string::npos);
    EXPECT_NE(text.find("--no-pdf-header-footer\n"), std::string::npos);
    EXPECT_EQ(text.find("--no-sandbox\n") != std::string::npos, geteuid() == 0); // as root it starts no other way
    EXPECT_NE(text.find("--user-data-dir=" + (folder / "tmp").string()),
              std::string::npos); // not the user's own profile
}

TEST_F(PrintPdf, WhatABrowserSaysThatFailsIsTold)
{
    browser("echo out of memory >&2\nexit 1\n");
    const std::string words = failure();
    EXPECT_TRUE(words.starts_with(target.string() + ": error: Chromium did not print the report. out of memory"))
        << words;
    EXPECT_NE(words.find("a page within 120 s"), std::string::npos);
    EXPECT_NE(words.find("write the report (--out) and print it from a browser"), std::string::npos);
}

// Of a long story the end, where the reason stands: 400 characters.
TEST_F(PrintPdf, OfALongStoryTheEndIsTold)
{
    browser("i=0; while [ $i -lt 100 ]; do echo beginning; i=$((i+1)); done\nprintf '%0399d' 7; echo\nexit 3\n");
    const std::string words = failure();
    EXPECT_NE(words.find("... " + std::string(398, '0') + "7"), std::string::npos) << words;
    EXPECT_EQ(words.find("beginning"), std::string::npos);
}

TEST_F(PrintPdf, APageThatIsNotThereIsNoReport)
{
    for (const char* script :
         {"exit 0\n",                                                              // nothing
          "for w; do case $w in --print-to-pdf=*) : >\"${w#*=}\" ;; esac; done\n", // an empty file
          "for w; do case $w in --print-to-pdf=*) echo half >\"${w#*=}\" ;; esac; done\nkill -9 $$\n"}) { // and dies
        browser(script);
        EXPECT_NE(failure().find("Chromium did not print the report."), std::string::npos) << script;
    }
    std::filesystem::remove(folder / "bin" / "chromium");
    EXPECT_NE(failure().find("Chromium did not print the report."), std::string::npos); // gone since it was looked for
}

TEST_F(PrintPdf, WithoutAFolderForTemporaryFilesItSaysSo)
{
    browser(prints);
    const Environment nowhere("TMPDIR", (folder / "bin" / "chromium").string()); // a file
    try {
        cli::print_pdf("<p>page</p>", target);
        ADD_FAILURE() << "printed";
    } catch (const std::exception& error) {
        EXPECT_FALSE(std::filesystem::exists(target)) << error.what();
    }
}

// Asked before anything is computed: no browser, or nowhere to write. A file of that name that cannot be run is no browser.
TEST_F(PrintPdf, IsRefusedBeforeTheRun)
{
    write_file(folder / "bin" / "chromium", "#!/bin/sh\n");
    std::filesystem::permissions(folder / "bin" / "chromium", std::filesystem::perms::owner_read);
    try {
        cli::check_pdf(target);
        ADD_FAILURE() << "not refused";
    } catch (const UsageError& error) {
        const std::string words = error.what();
        EXPECT_NE(words.find("there is no Chromium to print with."), std::string::npos) << words;
        EXPECT_NE(words.find("one of chromium, chromium-browser, google-chrome, google-chrome-stable on the PATH"),
                  std::string::npos);
    }
    browser(prints);
    EXPECT_THROW(cli::check_pdf(folder), UsageError); // a folder is no file
}

// The command: the same page in --out and on paper, and the report's name.
TEST_F(PrintPdf, TheCommandPrintsItsReport)
{
    const std::string scene = (folder / "block.toml").string(), pdf = target.string();
    write_file(folder / "h.csv", "t,a\n0,0\n0.5,4\n1,0\n");
    write_file(scene, "title = \"A block on paper\"\n[section]\nheight_m = 8\nbase_m = 4\ncrest_m = "
                      "4\n[dam]\ndensity_kg_m3 = 2400\n[contact]\n"
                      "friction = 0.6\n[[motion.record]]\nname = \"pulse\"\nhorizontal = \"h.csv\"\nunit = \"m/s2\"\n");
    const ProgramAnswer none = answer_of({"screen", scene, "--pdf", pdf});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.talk.find("--pdf " + pdf + ": there is no Chromium to print with."), std::string::npos) << none.talk;
    browser(prints);
    const ProgramAnswer good = answer_of({"screen", scene, "--pdf", pdf});
    EXPECT_EQ(good.code, 0) << good.talk;
    EXPECT_NE(good.talk.find("report: " + pdf), std::string::npos) << good.talk;
    EXPECT_NE(read_file(target).find("A block on paper"), std::string::npos);
    std::filesystem::remove(target);
    browser("echo no display\nexit 1\n");
    const ProgramAnswer bad = answer_of({"screen", scene, "--pdf", pdf});
    EXPECT_EQ(bad.code, 3);
    EXPECT_NE(bad.talk.find("no display"), std::string::npos) << bad.talk;
}

} // namespace

} // namespace damslip::pdf_tests
