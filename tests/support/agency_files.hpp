#pragma once

#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

/// Small accelerogram files in the layouts of the agencies, made here: every number in them is chosen by the test.
namespace damslip::agency_files {

/// What a file is refused with; empty where it is read.
inline std::string refusal(const std::string& text, const std::string& name, const records::ReadOptions& options)
{
    try {
        records::parse_record(text, name, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

inline bool warned(const Record& record, std::string_view words)
{
    for (const std::string& warning : record.warnings)
        if (warning.find(words) != std::string::npos) return true;
    return false;
}

/// Numbers in fields of `width`, `per_line` to a line, with `decimals` places (0: whole numbers).
inline std::string fields(const std::vector<double>& values, int per_line, int width, int decimals)
{
    std::string out;
    for (std::size_t k = 0; k < values.size(); ++k) {
        out += fmt::format("{:{}.{}f}", values[k], width, decimals);
        if ((k + 1) % static_cast<std::size_t>(per_line) == 0 || k + 1 == values.size()) out += "\n";
    }
    return out;
}

struct Cosmos {
    std::vector<double> samples{1.0, -2.0, 3.0};
    double dt_ms = 10.0, raw_dt_s = 0.005;
    int quantity = 1, unit = 4, station = 4, azimuth = 90, azimuth_in_structure = -999, problem = 0, volume = 2;
    double length_s = 0.03;
    int unknown = -999;
    std::string data_line; ///< empty: made from the samples
    bool with_velocity = false;

    std::string text() const
    {
        std::vector<double> integers(100, unknown), reals(100, unknown);
        integers[0] = volume, integers[1] = quantity, integers[2] = unit, integers[18] = station;
        integers[53] = azimuth, integers[54] = azimuth_in_structure, integers[75] = problem;
        reals[33] = raw_dt_s, reals[61] = dt_ms, reals[62] = length_s;
        std::string out = "Corrected acceleration    (Format v01.20 with 13 text lines) Src: made\nTest earthquake\n";
        out += "Hypocenter:\nOrigin:\nStatn No: 01-1\nCoords:\nRecorder:\nRcrd start time:\n";
        out += "Sta Cha:  7: 123 deg (Rcrdr Chan  1) Location: none\nRaw record\nProcessed:\nRecord filtered\n";
        out += fmt::format("Values used when parameter or data value is unknown/unspecified:{:7}, {}.0\n", unknown,
                           unknown);
        out += " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" + fields(integers, 10, 8, 0);
        out += " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" + fields(reals, 6, 13, 6);
        out += "  1 Comment line(s) follow, each starting with a \"|\":\n | 1 2 3 4\n";
        out += data_line.empty()
                   ? fmt::format("{:7}  acceleration pts, approx   1 secs, units=cm/sec2({:02}),Format=(8F10.5)\n",
                                 samples.size(), unit)
                   : data_line + "\n";
        out += fields(samples, 8, 10, 5);
        if (with_velocity)
            out += "      3  velocity     pts, approx   1 secs, units=cm/sec (05),Format=(8F10.5)\n" +
                   fields({7, 8, 9}, 8, 10, 5);
        return out + "/&  ----------  End of data for channel  1  ----------\n";
    }
};

struct Csmip {
    bool corrected = true;
    std::string component = " 90 DEG", unit_line = "UNITS OF UNCOR ACCEL IS G/10.              MAX = .1 G";
    int points = 10;       ///< integer 27 of volume 1
    double length_s = 0.0; ///< real 2 of volume 1
    std::string data;      ///< from the line that names the samples on
    std::string text() const
    {
        std::string out;
        if (corrected) out += "CORRECTED ACCELEROGRAM   1-2-3.01       CHAN  1:" + component + "     FROM\r\n";
        out += "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/01/00, TEST\r\nTEST "
               "EARTHQUAKE\r\nDATE\r\n1-2-3\r\n";
        out += "STATION NO. 1   35.908N, 120.458W     SMA-1  S/N 1\r\nTEST STATION\r\nCHAN  1:" + component + "\r\n";
        out += "TEST EARTHQUAKE\r\nHYPOCENTER\r\nINSTR PERIOD\r\n";
        out += "NO. OF POINTS\r\n" + unit_line + "\r\nRMS ACCEL\r\n";
        for (int k = 0; corrected && k < 11; ++k) out += "TEXT\r\n";
        std::vector<double> integers(100, 0), reals(corrected ? 100 : 50, 0);
        integers[26] = 90, integers[27] = points, reals[2] = length_s;
        out += fields(integers, 16, 5, 0) + fields(reals, 8, 10, 3);
        return out + data + "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\r\n";
    }
};

struct Smc {
    std::string first = "2 CORRECTED ACCELEROGRAM", station = "ABCD", component = "    360";
    double rate = 200.0;
    int problem = -32768, structure = -32768, place_on_dam = -32768, place_on_bridge = -32768, vertical = 90;
    double largest = 1.7e38, smallest = 1.7e38; ///< of the samples, by the header [cm/s^2]; 1.7e38: not given
    int comments = 2, points = -1;
    std::vector<double> samples{1.5, -2.25, 3.0};
    std::string data; ///< empty: made from the samples
    std::string text() const
    {
        std::vector<double> integers(48, -32768);
        integers[12] = vertical, integers[13] = 360, integers[15] = comments, integers[17] = problem;
        integers[16] = points >= 0 ? points : static_cast<double>(samples.size());
        integers[18] = structure, integers[26] = place_on_bridge, integers[27] = place_on_dam;
        std::string out = first + "\n*\n" + station + "\n     1989  10  18    0004 Test event\nMoment Mag=\n";
        out += "station = Test place           component=" + component + "\nepicentral dist\ninst type\n*\n*\n*\n";
        out += fields(integers, 8, 10, 0);
        std::vector<double> reals(50, 1.7e38);
        reals[1] = rate, reals[29] = largest, reals[31] = smallest;
        for (std::size_t k = 0; k < reals.size(); ++k)
            out += fmt::format("{:15.7E}", reals[k]) + (k % 5 == 4 ? "\n" : "");
        for (int k = 0; k < comments; ++k) out += "| 1 2 3 comment\n";
        return out + (data.empty() ? fields(samples, 8, 10, 4) : data);
    }
};

struct KNet {
    std::string frequency = "100Hz", duration = "1", direction = "N-S", factor = "3920(gal)/6182761", peak = "0.063";
    std::vector<int> counts;
    std::string text() const
    {
        std::string out = "Origin Time       2011/03/11 14:46:00\nLat.              38.103\nLong.             142.860\n"
                          "Depth. (km)       24\nMag.              9.0\nStation Code      TST001\n"
                          "Station Lat.      36.1256\nStation Lon.      140.0901\nStation Height(m) -9999\n"
                          "Record Time       2011/03/11 14:47:21\n";
        out +=
            "Sampling Freq(Hz) " + frequency + "\nDuration Time(s)  " + duration + "\nDir.              " + direction;
        out += "\nScale Factor      " + factor + "\nMax. Acc. (gal)   " + peak;
        out += "\nLast Correction   2011/03/11 14:47:06\nMemo.             \n";
        for (std::size_t k = 0; k < counts.size(); ++k)
            out += fmt::format("{:9}", counts[k]) + (k % 8 == 7 ? "\n" : "");
        return out + "\n";
    }
};

struct Esm {
    std::string type = "ACCELERATION", units = "cm/s^2", dt = "0.005000", count = "3", pga = "-3.0";
    std::string values = "1.0\n-3.0\n2.5\n";
    std::string text() const
    {
        return "EVENT_NAME: TEST\nEVENT_ID: \nEVENT_DATE_YYYYMMDD: 20160824\nEVENT_TIME_HHMMSS: 01:36:32\nNETWORK: IT\n"
               "STATION_CODE: TST\nSTATION_NAME: \nNDATA: " +
               count + "\nSAMPLING_INTERVAL_S: " + dt + "\nSTREAM: HNE\nUNITS: " + units + "\nPGA_CM/S^2: " + pga +
               "\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20160824_013632.000\nDATA_TYPE: " + type +
               "\nUSER1: a: b: c\n" + values;
    }
};

} // namespace damslip::agency_files
