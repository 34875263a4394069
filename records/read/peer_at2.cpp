#include "records/read/format.hpp"

#include "core/number.hpp"
#include "records/read/agency_samples.hpp"
#include "records/read/cut_end.hpp"
#include "records/read/samples.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

constexpr std::size_t header_lines = 10; // keywords are looked for in so many

bool names_npts_and_dt(std::string_view line)
{
    const std::string s = lower(line);
    return !is_comment(line) && contains(s, "npts") && contains(s, "dt");
}

struct PeerHeader {
    Stated<std::size_t> samples;
    Stated<double> dt;
    std::optional<Stated<std::string>> unit;
    std::string title;
};

/// Number after "key =" in the line, or nothing; `rest`: what follows it.
std::optional<double> assigned(std::string_view line, std::string_view key, std::string_view& rest)
{
    const std::size_t at = lower(line).find(key);
    const std::size_t equals = line.find_first_not_of(" \t", at + key.size());
    if (equals == std::string_view::npos || line[equals] != '=') return std::nullopt;
    std::size_t used = 0;
    const auto value = parse_number(line.substr(equals + 1), &used);
    if (value) rest = line.substr(equals + 1 + used);
    return value;
}

void read_npts_and_dt(const RecordText& text, std::size_t line, PeerHeader& header)
{
    const std::string_view s = text.lines[line - 1];
    std::string_view rest;
    std::optional<double> npts = assigned(s, "npts", rest), dt = assigned(s, "dt", rest);
    if (!npts && !dt) { // "3930 0.00500 NPTS, DT"
        std::size_t used = 0;
        if ((npts = parse_number(s, &used))) {
            rest = s.substr(used);
            rest.remove_prefix(std::min(rest.size(), std::min(rest.find_first_not_of(" \t,"), rest.size())));
            dt = parse_number(rest, &used);
        }
        rest = {};
    }
    const auto fail = [&](std::string problem) {
        refuse(text, {line, 0}, std::move(problem), "\"NPTS=  3930, DT= .00500 SEC\" or \"3930 0.00500 NPTS, DT\"",
               "correct the line");
    };
    if (!npts || !dt) fail(fmt::format("no number for {} in {}.", npts ? "DT" : "NPTS", in_quotes(trimmed(s))));
    if (!(*npts >= 2.0 && *npts <= static_cast<double>(max_samples)) || *npts != std::floor(*npts))
        fail(fmt::format("NPTS = {} is not allowed: a whole number from 2 to {} is.", shortest(*npts), max_samples));
    const std::string unit = lower(trimmed(rest)).substr(0, 4);
    if (!unit.empty() && unit.front() != 's' && unit.front() != ',' && unit.front() != '.')
        fail(fmt::format("DT is followed by {}, not by SEC.", in_quotes(trimmed(rest))));
    header.samples = {static_cast<std::size_t>(*npts), line};
    header.dt = {*dt, line};
}

/// The line "ACCELERATION TIME HISTORY IN UNITS OF G", last one above the samples.
void read_quantity(const RecordText& text, std::size_t last, PeerHeader& header)
{
    for (std::size_t line = last; line >= 1; --line) {
        const std::string s = lower(text.lines[line - 1]);
        const bool other = contains(s, "velocity") || contains(s, "displacement");
        const bool accel = contains(s, "acceleration");
        if (!accel && !other) continue;
        const std::size_t units = s.find("units of");
        if (other && !accel && (units != std::string::npos || contains(s, "time")))
            refuse(text, {line, 0},
                   fmt::format("{}: this file holds no acceleration.", in_quotes(trimmed(text.lines[line - 1]))),
                   "an acceleration file (.AT2); .VT2 and .DT2 are its integrals",
                   "download the .AT2 file of the same record");
        if (!accel) continue;
        if (units != std::string::npos)
            header.unit = Stated<std::string>{std::string(trimmed(text.lines[line - 1].substr(units + 8))), line};
        return;
    }
}

/// All numbers from `first` on, stuck negatives ("1.2-5.6") split.
std::vector<double> read_values(const RecordText& text, std::size_t first, const AccelerationUnit& unit,
                                std::size_t expected)
{
    std::vector<double> accel;
    accel.reserve(expected);
    for (std::size_t line = first; line <= text.lines.size(); ++line) {
        const std::string_view s = text.lines[line - 1];
        for (std::size_t at = 0; (at = s.find_first_not_of(" \t", at)) != std::string_view::npos;) {
            std::size_t used = 0;
            const Place place{line, at + 1};
            const double value = number_at(text, s.substr(at), place, used);
            const std::size_t end = at + used;
            if (end < s.size() && std::string_view(" \t-+").find(s[end]) == std::string_view::npos)
                refuse(text, place,
                       fmt::format("{} is not a number.", in_quotes(s.substr(at, s.find_first_of(" \t", at) - at))),
                       "numbers separated by blanks", "correct it");
            accel.push_back(checked_sample(text, value, unit, place));
            at = end;
        }
        if (accel.size() > max_samples) break; // check_count names the number so far
    }
    return accel;
}

} // namespace

/// One of the first ten lines (not a # comment) names NPTS and DT.
bool looks_like_peer_at2(const RecordText& text)
{
    const auto end = text.lines.begin() + static_cast<std::ptrdiff_t>(std::min(header_lines, text.lines.size()));
    return std::any_of(text.lines.begin(), end, names_npts_and_dt);
}

/// PEER strong-motion text file: some lines of title, one naming quantity and unit, one with the number of samples and
/// the time step as "NPTS=  3930, DT= .00500 SEC" or "3930 0.00500 NPTS, DT", then samples, any number to a line,
/// negatives possibly stuck together. An older header repeated on top holds another DT: the last such line of the first
/// ten counts.
/// @throws InputError: velocity or displacement, NPTS that is not the number of values, anything that is no number.
std::vector<Record> read_peer_at2(const RecordText& text, const ReadOptions& options)
{
    std::size_t last = std::min(header_lines, text.lines.size());
    while (last > 1 && !names_npts_and_dt(text.lines[last - 1])) --last;
    PeerHeader header;
    read_npts_and_dt(text, last, header);
    read_quantity(text, last, header);
    if (last >= 3) header.title = trimmed(text.lines[last - 3]);

    const AccelerationUnit unit = settle_unit(text, header.unit, options);
    const double dt = *settle_dt(text, header.dt, options);
    std::vector<double> accel = read_values(text, last + 1, unit, header.samples.value);
    check_count(text, header.samples, accel.size(), "NPTS");
    const std::string open_end = refuse_cut_end(text, last + 1);

    RecordSource source;
    source.format = "PEER AT2";
    source.unit = unit.name;
    source.title = header.title;
    const std::size_t comma = header.title.rfind(',');
    if (comma != std::string::npos && header.title.size() - comma <= 12)
        source.component = trimmed(std::string_view(header.title).substr(comma + 1));
    source.first_line = last + 1;
    source.last_line = text.lines.size();
    std::vector<Record> records{finished_record(text, std::move(accel), dt, std::move(source))};
    if (!open_end.empty()) records.front().warnings.push_back(open_end);
    return chosen_channels(text, std::move(records), options);
}

RecordFormat peer_at2_format()
{
    return {"PEER AT2", looks_like_peer_at2, read_peer_at2};
}

} // namespace damslip::records
