#pragma once

#include "cli/command.hpp"
#include "cli/input/run_inputs.hpp"
#include "cli/terminal/terminal.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Commands that damslip-verify carries out: the program beside damslip that holds its evidence (verification/, studies/).
/// damslip knows their flags, for help, completion and manual pages, and hands the command line on.
namespace damslip::cli {

struct VerifyArguments {
    std::string filter;        ///< part of the ids to run; empty: all
    bool list = false;         ///< print the ids alone
    bool markdown = false;     ///< print the results as a page
    bool hard = false;         ///< the hard cases instead
    bool external = false;     ///< results of others instead; `filter` is then the folder of what is not shipped
    std::filesystem::path svg; ///< scatter plot of those
    std::filesystem::path manual; ///< the verification manual, .pdf or .html; empty: none
    bool digest = false;          ///< print the digest of the verification record alone
};

struct StudyArguments {
    RunInputs inputs;
    std::string method = "rigid,rigid-v,fe,fe-whole-steps,fe-goldgruber-2015,fe-radiating";
    std::filesystem::path out; ///< folder for rows.csv, findings.csv and report.html
    int jobs = 0;              ///< threads; 0: all cores
    bool resume = false;       ///< go on from rows.sqlite
};

struct MeshArguments {
    RunInputs inputs;
    std::filesystem::path out;      ///< Gmsh file; empty: none
    std::string format = "4.1";     ///< of the Gmsh file: "2.2" or "4.1"
    std::string base = "twice";     ///< nodes of the base in it: "twice" or "shared"
    std::string to = "gmsh";        ///< for whom `out` is: "gmsh" or "calculix"
    std::string analysis = "modes"; ///< of the deck for CalculiX: "modes", "tied" or "static-contact"
    int modes = 10;                 ///< of that deck: found, or superposed
    std::filesystem::path results;  ///< .dat file that ccx made of the deck, to compare with; empty: none
};

template <class Arguments>
using Carry = std::function<int(const Arguments&, const Streams&)>;

/// The commands with what carries them out: Streams::hand_on in damslip, the work itself in damslip-verify.
Command verify_command(Carry<VerifyArguments> verify);
Command study_command(Carry<StudyArguments> study);
Command mesh_command(Carry<MeshArguments> calculix); ///< only --to calculix is carried out by the second program

/// Where this program stands, without its name. Empty where the system does not say.
std::filesystem::path own_folder();

/// Starts `arguments` in damslip-verify, which stands beside this program or on the PATH.
/// @throws InputError where there is none
int start_verifier(const std::vector<std::string>& arguments);

/// Reports: where they are, and as PDF, printed by a Chromium of this machine, without a window and without a network.

/// "report: FILE" in the talk, unless it is to be quiet.
void name_report(const std::filesystem::path& file, const Streams& streams);

/// For use before anything is computed. @throws UsageError  no Chromium on the PATH, or nothing can be written there
void check_pdf(const std::filesystem::path& target);

/// Prints the page as A4 with everything open. The file appears whole or not at all.
/// @param html  of page_html() @throws InputError with what the browser said when it prints nothing within two minutes
void print_pdf(const std::string& html, const std::filesystem::path& target);

/// For use before anything is computed. @throws UsageError  neither .xlsx nor .ods, .ods without LibreOffice on the PATH, or nothing can be
/// written there
void check_sheet(const std::filesystem::path& target);

/// Writes a workbook by `write_xlsx`; one that ends in .ods is converted by a LibreOffice of this machine. The file appears whole or not at all.
/// @throws InputError with what LibreOffice said when it writes nothing within two minutes
void write_sheet(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& write_xlsx);

} // namespace damslip::cli
