// Record readers: any bytes either give records that keep the promises of read_record.hpp, or an InputError. What was
// read is written in both own formats and must read back bit for bit.
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"
#include "records/record.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace damslip;

void demand(bool condition)
{
    if (!condition) std::abort();
}

void check(const Record& record)
{
    demand(record.dt >= 1e-6 && record.dt <= 1.0);
    demand(record.acceleration.size() >= 2 && record.acceleration.size() <= 5'000'000);
    for (const double a : record.acceleration) demand(std::isfinite(a) && std::abs(a) <= 1e4);

    if (record.acceleration.size() > 20'000) return; // a few bytes of uneven times may be resampled to millions
    const auto back = records::parse_record(records::record_csv(record), "written");
    demand(back.size() == 1 && back[0].dt == record.dt && back[0].acceleration == record.acceleration);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0) return 0;
    // The first byte chooses what the user states; the rest is the file.
    records::ReadOptions options;
    if (data[0] & 1) options.unit = "cm/s2";
    if (data[0] & 2) options.dt = 0.01;
    if (data[0] & 4) options.uneven = records::UnevenTime::resample;
    if (data[0] & 8) options.column = "2";
    if (data[0] & 16) options.column = "up";
    const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        for (const Record& record : records::parse_record(content, "fuzz", options)) check(record);
    } catch (const InputError&) {
    }
    return 0;
}
