#include "records/record.hpp"

#include "core/text.hpp"
#include "core/units.hpp"

#include <fmt/format.h>

namespace damslip::records {

namespace {

/// One line of text: line ends and control characters become blanks.
std::string one_line(std::string s)
{
    for (char& c : s)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return s;
}

std::string header(const Record& record)
{
    std::string out = "# format: damslip accelerogram\n";
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) out += fmt::format("# {}: {}\n", key, one_line(value));
    };
    add("name", record.name);
    add("title", record.source.title);
    add("component", record.source.component);
    add("source", record.source.file);
    for (const std::string& warning : record.warnings) add("note", warning);
    return out + fmt::format("# units: m/s2\n# dt: {} s\n# n: {}\n", shortest(record.dt), record.acceleration.size());
}

} // namespace

std::string record_csv(const Record& record)
{
    std::string out = header(record) + "accel_m_s2\n";
    for (const double a : record.acceleration) out += shortest(a) + "\n";
    return out;
}

std::string record_csv_with_time(const Record& record)
{
    std::string out = header(record) + "time_s,accel_m_s2\n";
    for (std::size_t k = 0; k < record.acceleration.size(); ++k)
        out += shortest(static_cast<double>(k) * record.dt) + "," + shortest(record.acceleration[k]) + "\n";
    return out;
}

std::string record_at2(const Record& record)
{
    std::string out = "ACCELEROGRAM WRITTEN BY DAMSLIP\n";
    const std::string& title = record.source.title.empty() ? record.name : record.source.title;
    out += one_line(title) + (record.source.component.empty() ? "" : ", " + one_line(record.source.component)) + "\n";
    out += "ACCELERATION TIME SERIES IN UNITS OF G\n";
    out += fmt::format("NPTS= {:6d}, DT= {} SEC\n", record.acceleration.size(), shortest(record.dt));
    for (std::size_t k = 0; k < record.acceleration.size(); ++k) {
        out += fmt::format("{:15.7E}", record.acceleration[k] / units::standard_gravity);
        if (k % 5 == 4 || k + 1 == record.acceleration.size()) out += '\n';
    }
    return out;
}

} // namespace damslip::records
