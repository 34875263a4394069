// Bad wishes to `record generate`, `scale`, `baseline`, `spectrum`, and what is answered.
#include "cli/record_command.hpp"
#include "core/input_error.hpp"
#include "pages/record/record_tables.hpp"
#include "records/generate/wavelet_match.hpp"
#include "source_dir.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

namespace {

using namespace damslip;
using namespace damslip::records;

std::string problem_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const InputError& error) {
        for (const Diagnostic& d : error.diagnostics()) EXPECT_FALSE(d.expected.empty() || d.fix.empty()) << d.text();
        return error.diagnostics()[0].problem;
    }
    return "accepted";
}

std::string generating(const std::function<void(GenerateOptions&)>& change)
{
    GenerateOptions o;
    change(o);
    return problem_of([&] { generate_record(rock_spectrum(), o); });
}

TEST(BadRecordWish, generate_options)
{
    EXPECT_EQ(generating([](auto& o) { o.pga = 0.0; }), "record generate: pga = 0 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.pga = std::numeric_limits<double>::quiet_NaN(); }),
              "record generate: pga = nan is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.duration = 1.0; }), "record generate: duration = 1 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.duration = 1e9; }), "record generate: duration = 1000000000 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.dt = 0.02; }), "record generate: dt = 0.02 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.duration = 20.003; }),
              "record generate: duration = 20.003 s is no whole number of dt = 0.01 s.");
    EXPECT_EQ(generating([](auto& o) { o.tolerance = 0.0; }), "record generate: tolerance = 0 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.envelope.rise = 0.0; }), "record generate: envelope rise = 0 is not allowed.");
    EXPECT_EQ(generating([](auto& o) { o.envelope.level = 0.05; }),
              "record generate: envelope level = 0.05 is not allowed.");
}

TEST(BadRecordWish, target_spectrum_files)
{
    const auto reading = [](const char* content) {
        return problem_of([&] { parse_target_spectrum(content, "s.csv"); });
    };
    EXPECT_EQ(reading("0 1\n0.1 2\n1 1\n2 0.5\n"), "accepted");
    EXPECT_EQ(reading("0 1\n0.1 2 3\n"), "3 numbers in a line of a target spectrum.");
    EXPECT_EQ(reading("0 1\n"), "a target spectrum of 1 rows.");
    EXPECT_EQ(reading("0 1\n0.1 0\n"), "spectral acceleration 0 at 0.1 s.");
    EXPECT_EQ(reading("0 1\n0.1 -2\n"), "spectral acceleration -2 at 0.1 s.");
    EXPECT_EQ(reading("0 1\n0.2 2\n0.1 2\n"), "period 0.1 s in row 3.");
    EXPECT_EQ(reading("0.1 1\n2 2\n"), "the first period is 0.1 s.");
    EXPECT_EQ(reading("0 1\n1 2\n"), "the last period is 1 s.");
    EXPECT_EQ(reading("0 1\n1 nan\n"), "the sample is 'nan'.");
    EXPECT_EQ(reading("words\n"), "no line of numbers was found.");
}

TEST(BadRecordWish, command_lines)
{
    using namespace cli;
    std::ostringstream out, talk;
    const Streams streams{out, talk};
    RecordGenerateArguments g;
    g.target = "moon";
    EXPECT_EQ(problem_of([&] { generate(g); }), "--target moon is not known.");
    g.target = "ec8-1";
    g.ground = "F";
    EXPECT_EQ(problem_of([&] { generate(g); }), "--ground F is not known.");
    g.ground = "A";
    g.component = "x";
    EXPECT_EQ(problem_of([&] { generate(g); }), "--component x is not known.");
    g.component = "h";
    g.envelope = "round";
    EXPECT_EQ(problem_of([&] { generate(g); }), "--envelope round is not known.");
    RecordScaleArguments s;
    EXPECT_EQ(problem_of([&] { record_scale(s, streams); }), "record scale needs one of --factor and --pga-m-s2.");
    s.factor = 0.0;
    EXPECT_EQ(problem_of([&] { record_scale(s, streams); }), "--factor 0 is not allowed.");
    s.factor.reset();
    s.pga_m_s2 = -1.0;
    EXPECT_EQ(problem_of([&] { record_scale(s, streams); }), "--pga-m-s2 -1 is not allowed.");
    EXPECT_EQ(problem_of([&] { record_output("wav", ""); }), "--to wav is not known.");
    EXPECT_EQ(record_output("", "x.at2"), RecordOutput::at2);
    const Record record{"r", 0.01, {0.0, 1.0, 0.0}, {}, {}};
    RecordSpectrumArguments p;
    p.ratio = 1.5;
    EXPECT_EQ(problem_of([&] { record_spectrum_of(record, p); }), "--damping 1.5 is not allowed.");
    p.ratio = 0.05;
    p.from = 0.0;
    EXPECT_EQ(problem_of([&] { record_spectrum_of(record, p); }), "--from 0 --to 4 is not allowed.");
    p.from = 0.1;
    p.count = 1;
    EXPECT_EQ(problem_of([&] { record_spectrum_of(record, p); }), "--count 1 is not allowed.");
    p.count = 5;
    EXPECT_EQ(record_spectrum_of(record, p).points.size(), 5u);
    RecordBaselineArguments b;
    b.degree = "cubic";
    EXPECT_EQ(problem_of([&] { record_baseline(b, streams); }), "--degree cubic is not known.");
}

// The whole way of a file through the commands.
TEST(RecordCommand, converts_scales_and_informs)
{
    using namespace cli;
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "damslip_record_command";
    std::filesystem::create_directories(folder);
    const auto data = std::filesystem::path(source_dir()) / "records/data/rock_1.0_h.csv";
    std::ostringstream out, talk;
    const Streams streams{out, talk, Form::text, true};
    RecordInput input;
    input.file = data;
    EXPECT_EQ(record_convert({input, {folder / "a.at2", ""}, {}}, streams), 0);
    input.file = folder / "a.at2";
    const Record at2 = read(input);
    EXPECT_EQ(at2.source.format, "PEER AT2");
    EXPECT_EQ(at2.acceleration.size(), 2001u);
    RecordScaleArguments scale{input, {folder / "b.csv", ""}, {}, 2.0};
    EXPECT_EQ(record_scale(scale, streams), 0);
    input.file = folder / "b.csv";
    const Table table = pages::record_info_table({read(input)}, pages::Checksums::shown);
    EXPECT_NEAR(std::get<double>(table.rows[0][7]), 2.0, 1e-12);
    RecordBaselineArguments baseline;
    baseline.input = input;
    EXPECT_EQ(record_baseline(baseline, streams), 0);
    EXPECT_NE(out.str().find("accel_m_s2\n"), std::string::npos);
    std::filesystem::remove_all(folder);
}

} // namespace
