#pragma once

#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <string>

/// Reports: where they are, and as PDF, printed by a Chromium of this machine, without a window and without a network.
namespace damslip::cli {

/// "report: FILE" in the talk, unless it is to be quiet.
void name_report(const std::filesystem::path& file, const Streams& streams);

/// For use before anything is computed. @throws UsageError  no Chromium on the PATH, or nothing can be written there
void check_pdf(const std::filesystem::path& target);

/// Prints the page as A4 with everything open. The file appears whole or not at all.
/// @param html  of page_html() @throws InputError with what the browser said when it prints nothing within two minutes
void print_pdf(const std::string& html, const std::filesystem::path& target);

} // namespace damslip::cli
