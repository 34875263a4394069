// Audit B1, B3, B4, B5: a file in the layout of each agency and program, written here with a known motion and read back sample by sample;
// or refused with what its user is told.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>

namespace {

using namespace damslip;
using namespace damslip::records;

constexpr int n = 400;
constexpr double pi = 3.14159265358979323846, one_g = units::standard_gravity;

/// The three components [g]: 0.2079 g at 1.91 s, 0.147 g, 0.0996 g.
double motion(int component, double t)
{
    const double amplitude[] = {0.21, 0.15, 0.10}, hertz[] = {1.7, 1.1, 4.3}, phase[] = {0.0, 0.3, 0.5},
                 middle[] = {2.0, 2.1, 1.8}, width[] = {0.9, 1.0, 0.7};
    const double x = (t - middle[component]) / width[component];
    return amplitude[component] * std::sin(2.0 * pi * hertz[component] * t + phase[component]) * std::exp(-x * x);
}

/// Samples in a unit of `unit` m/s^2.
std::vector<double> samples(int component, double unit = one_g, int count = n, double dt = 0.01)
{
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(motion(component, k * dt) * one_g / unit);
    return values;
}

/// One value a line, or `per_line`, each by a format such as "{:10.6f}".
std::string block(const std::vector<double>& values, const char* format, std::size_t per_line = 1)
{
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k) {
        text += fmt::format(fmt::runtime(format), values[k]);
        if ((k + 1) % per_line == 0 || k + 1 == values.size()) text += "\n";
    }
    return text;
}

/// Lines made of the time and the three components in a unit.
std::string lines(const std::function<std::string(double t, double a, double b, double c)>& line, double unit = one_g,
                  int count = n, double dt = 0.01)
{
    std::string text;
    for (int k = 0; k < count; ++k) {
        const double t = k * dt, f = one_g / unit;
        text += line(t, f * motion(0, t), f * motion(1, t), f * motion(2, t)) + "\n";
    }
    return text;
}

/// Time and acceleration in g, with 6 decimals.
std::string two_columns(const char* format = "{:.2f} {:.6f}", double unit = one_g, int count = n, double dt = 0.01)
{
    return lines([&](double t, double a, double, double) { return fmt::format(fmt::runtime(format), t, a); }, unit,
                 count, dt);
}

/// Without blanks before or after and with one of the digits of the exponent: "1.2345E-1" as Fortran writes 1PE10.4E1.
std::string one_digit_exponent(double value)
{
    std::string s = fmt::format("{:.4E}", value);
    const std::size_t e = s.find('E');
    s.erase(e + 2, 1);
    return fmt::format("{:>10}", s);
}

struct Layout {
    std::string name, text;
    ReadOptions options = {};
    std::vector<std::pair<std::string, int>> channels = {{"", 0}}; ///< component as the file says it, and its motion
    std::string unit = "g";
    double error = 1e-5; ///< of a sample by the printed digits [m/s^2]
    int samples = n;
    double dt = 0.01;
    std::string refusal = {}; ///< what it is refused with instead
};

std::ostream& operator<<(std::ostream& out, const Layout& layout)
{
    return out << layout.name;
}

ReadOptions given(std::string unit, std::optional<double> dt = {}, std::string column = "")
{
    ReadOptions options;
    options.unit = std::move(unit), options.dt = dt, options.column = std::move(column);
    return options;
}

ReadOptions resampled(std::optional<double> dt = {})
{
    ReadOptions options;
    options.uneven = UnevenTime::resample, options.dt = dt;
    return options;
}

Layout refused(std::string name, std::string text, std::string refusal, ReadOptions options = {})
{
    Layout layout{std::move(name), std::move(text), std::move(options)};
    layout.refusal = std::move(refusal);
    return layout;
}

std::string at2(const std::string& component, const std::string& counts, const std::string& body,
                const std::string& quantity = "ACCELERATION TIME SERIES IN UNITS OF G")
{
    return "PEER NGA STRONG MOTION DATABASE RECORD\nMade-up, 1/1/2020, Nowhere #6, " + component + "\n" + quantity +
           "\n" + counts + "\n" + body;
}

agency_files::Cosmos cosmos(int component, int azimuth, int unit = 4)
{
    agency_files::Cosmos file;
    file.samples = samples(component, unit == 2 ? one_g : 0.01);
    file.unit = unit, file.azimuth = azimuth, file.length_s = 4.0;
    return file;
}

std::string csmip(int component, const std::string& name, bool corrected = true)
{
    agency_files::Csmip file;
    file.corrected = corrected, file.component = name;
    file.data = corrected ? "  400 POINTS OF ACCEL DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM/SEC/SEC)\n" +
                                block(samples(component, 0.01), "{:10.3f}", 8)
                          : "  400 POINTS OF ACCEL DATA EQUALLY SPACED AT .010 SEC.  (UNITS: G)\n" +
                                block(samples(component), "{:9.6f}", 8);
    return file.text();
}

/// Volume 1 of film: times beside the samples, in tenths of g. @param jitter  of the times [s]
std::string csmip_film(const std::string& unit_line, double jitter, const std::string& component = " 90 DEG")
{
    agency_files::Csmip file;
    file.corrected = false, file.component = component, file.unit_line = unit_line, file.points = n;
    std::vector<double> pairs;
    for (int k = 0; k < n; ++k) {
        const double t = k * 0.01 + (k % 3 == 1 ? jitter : 0.0);
        pairs.insert(pairs.end(), {t, 10.0 * motion(0, t)});
    }
    file.data = block(pairs, "{:7.3f}", 10);
    return file.text();
}

std::string csmip_by_rate(const std::string& unit_line)
{
    agency_files::Csmip file;
    file.corrected = false, file.unit_line = unit_line, file.points = n, file.length_s = 4.0;
    file.data = "   400 Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)  \n" +
                block(samples(0), "{:9.6f}", 8);
    return file.text();
}

std::string smc(int component, const std::string& name, const std::string& first = "2 CORRECTED ACCELEROGRAM")
{
    agency_files::Smc file;
    file.first = first, file.component = name, file.rate = 100.0, file.samples = samples(component, 0.01);
    return file.text();
}

/// Digitised film: no rate, integer 17 counts values, pairs of time and acceleration.
std::string smc_film(double jitter)
{
    agency_files::Smc file;
    file.first = "1 UNCORRECTED ACCELEROGRAM", file.component = "     45", file.rate = 1.7e38, file.points = 2 * n;
    for (int k = 0; k < n; ++k) {
        const double t = k * 0.01 + (k % 3 == 1 ? jitter : 0.0);
        file.data +=
            one_digit_exponent(t) + one_digit_exponent(100.0 * one_g * motion(0, t)) + (k % 4 == 3 ? "\n" : "");
    }
    return file.text();
}

std::string k_net(int component, const std::string& direction)
{
    agency_files::KNet file;
    file.duration = "4", file.direction = direction, file.peak = "";
    for (const double gal : samples(component, 0.01))
        file.counts.push_back(static_cast<int>(std::round(gal * 6182761.0 / 3920.0)) + 1000);
    return file.text();
}

std::string esm(int component, const std::string& stream, const std::string& type = "ACCELERATION")
{
    agency_files::Esm file;
    file.type = type, file.dt = "0.010000", file.count = "400", file.pga = "",
    file.values = block(samples(component, 0.01), "{:.6f}");
    std::string text = file.text();
    text.replace(text.find("STREAM: HNE"), 11, "STREAM: " + stream);
    return text;
}

std::string geonet(int component, const std::string& name, bool corrected, const std::string& units = "1.00")
{
    std::string text =
        (corrected ? "Corrected" : "Uncorrected") + std::string(" accelerogram 20200101_000000_OWNS_20 GNS Science\n");
    text += "Site OWNS      42 00 00S  172 00 00E     Cusp file:  20200101_000000\nMade-up site\nInstrument Cusp_1\n"
            "Resolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700\nAccelerogram 20200101_000000_OWNS_20   "
            "Processed 2020\n"
            "10 km north of nowhere\n2020 January 01         00:00:00 UT\nEpicentre  42 05 00S 172 05 00E  Bearing "
            "S40E  Dist 12km\n";
    text += corrected
                ? "Number of points   400    Duration   4.00 sec\nInstrument corrected data at 0.010 sec intervals\n"
                  "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz\n"
                : "Number of points    400    Duration   4.00 s\nRaw readings in units of " + units +
                      " mm/s/s  at intervals of 0.010 s\nData is unfiltered\n";
    const std::vector<double> values = samples(component, 0.001);
    double peak = 0.0;
    for (const double a : values) peak = std::abs(a) > std::abs(peak) ? a : peak;
    text += "Component " + name +
            fmt::format("\nAcceleration:  peak {:8.1f} mm/s/s at   1.91 sec     rms    300.0 mm/s/s\n", peak);
    text += "Velocity:      peak     0.00 mm/s   at   0.00 sec\nDisplacement:  peak    0.000 mm     at   0.00 sec\n";
    std::vector<double> integers(40, 0.0), reals(60, 0.0);
    integers[30] = integers[33] = n, reals[25] = 0.01;
    text +=
        agency_files::fields(integers, 10, 8, 0) + agency_files::fields(reals, 10, 8, 4) + block(values, "{:8.1f}", 10);
    if (corrected) text += block(std::vector<double>(800, 1.0), "{:8.1f}", 10); // velocity and displacement
    return text;
}

std::string bhrc(int component, const std::string& name, const std::string& volume = "VOL1DS", std::size_t reals = 44,
                 int points = n)
{
    std::string text = "* " + volume + " FILE:  0001/01\nInst Type = SSA-2\nOrigin Time : 2020/01/01   00:00:00\n\n" +
                       name.substr(0, 1) + "\n\nCOMP " + name +
                       "\nMade-up            Station   30.000 N 50.000 E   Altitude  100m   Azimuth L 010   T 100\n"
                       "Epicenter 30.100 N 50.100 E   FD 10 Km\nINSTR PERIOD =  .020 SEC   DAMPING =  .640\n";
    text += fmt::format("NO. OF POINTS = {:6}      DURATION ={:8.3f}\nUNITS ARE SECONDS AND G/10\n\n", points,
                        0.01 * points);
    text += agency_files::fields(std::vector<double>(88, 0.0), 14, 5, 0) +
            block(std::vector<double>(reals, 0.0), "{:15.6E}", 6);
    return text + block(samples(component, 0.1 * one_g), "{:13.5E}", 10) + "/&\n";
}

std::string itaca(const std::string& orientation, const std::string& title = "Acceleration time series in m/s/s")
{
    return "Event Date & Time             : 2020-01-01 00:00:00\nOrientation                   : " + orientation +
           "\nTime Increment (s)            : 0.01\nNumber of Data                : 400\nPGA (m/s/s)                   "
           ": 2.0385430E+00\n" +
           title + "\n" + block(samples(0, 1.0), "{:14.7E}", 5);
}

const std::vector<std::pair<std::string, int>> turkish_channels{{"N-S", 0}, {"E-W", 1}, {"U-D", 2}};
std::string turkish(int count = n)
{
    return fmt::format("STRONG GROUND MOTION RECORDS OF NOWHERE\nPLACE                   : MADE-UP TOWN\nNUMBER OF "
                       "DATA          : {}\n"
                       "SAMPLING INTERVAL (sec) : 0.01\nRAW PGA VALUES (gal)    : (N-S) 203.854296 (E-W) 144.000627 "
                       "(U-D) 97.666330\n"
                       "       N-S          E-W          U-D\n",
                       count) +
           lines(
               [](double, double a, double b, double c) { return fmt::format("{:12.6f} {:12.6f} {:12.6f}", a, b, c); },
               0.01);
}

std::string cwb()
{
    return "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n#StationCode: OWN\n#StartTime(GMT+08): "
           "2018/02/06-23:50:29.000\n"
           "#RecordLength(sec): 4\n#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n#AmplitudeMAX. U:  "
           "97.6~ -90.1\n"
           "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n" +
           lines([](double t, double a, double b,
                    double c) { return fmt::format("{:10.3f}{:10.3f}{:10.3f}{:10.3f}", t, c, a, b); },
                 0.01);
}

std::string unam()
{
    std::string text;
    for (int k = 0; k < 90; ++k) text += "      ----- REGISTRO DE PRUEBA -----\n";
    return text +
           "ARCHIVO ESTANDAR DE ACELERACION\nORIENTACION C1-C6 (rumbo;orientacion)   : /N00E;1/+V;2/N90E;3\n"
           "INTERVALO DE MUESTREO, C1-C6 (s)        : /.010/.010/.010\nNUM. TOTAL DE MUESTRAS, C1-C6           : /  "
           "400/  400/  400\n"
           "UNIDADES DE LOS DATOS                   : Gal [cm/s2]\n" +
           lines([](double, double a, double b, double c) { return fmt::format("{:10.4f}{:10.4f}{:10.4f}", a, c, b); },
                 0.01);
}

/// Eight numbers a line in an order that tells nothing.
std::string integers_above(const std::string& body)
{
    return "MADE-UP STATION\n" + agency_files::fields(std::vector<double>(40, 7.0), 10, 8, 0) + body;
}

const std::string three_bare =
    lines([](double, double a, double b, double c) { return fmt::format("{:.6f} {:.6f} {:.6f}", a, b, c); });
const std::string time_and_three = lines(
    [](double t, double a, double b, double c) { return fmt::format("{:.2f} {:.6f} {:.6f} {:.6f}", t, a, b, c); });

std::string with_commas(std::string text)
{
    std::replace(text.begin(), text.end(), '.', ',');
    return text;
}

std::string with_line_ends(std::string text, const std::string& end)
{
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
        text.replace(at, 1, end);
    return text;
}

/// Times as single precision holds them, from -300.17 on.
std::string single_precision()
{
    std::string text;
    for (int k = 0; k < n; ++k)
        text += fmt::format("{:.6f} {:.6f}\n", static_cast<double>(static_cast<float>(-300.17 + 0.01 * k)),
                            motion(0, 0.01 * k));
    return text;
}

std::vector<Layout> corpus()
{
    std::vector<Layout> all;
    const auto add = [&all](Layout layout) { all.push_back(std::move(layout)); };
    const auto e15 = [](int component) { return block(samples(component), "{:15.7E}", 5); };
    // PEER
    add({"peer_nga_west2", at2("180", "NPTS=    400, DT=   .0100 SEC,", e15(0)), {}, {{"180", 0}}});
    add({"peer_numbers_first", at2("090", "400 0.0100 NPTS, DT", e15(1)), {}, {{"090", 1}}});
    add({"peer_up", at2("UP", "NPTS= 400, DT= .01 SEC", e15(2)), {}, {{"UP", 2}}});
    add({"peer_down", at2("DWN", "NPTS= 400, DT= .01 SEC", e15(2)), {}, {{"DWN", 2}}});
    add({"peer_touching", at2("230", "NPTS= 400, DT= .01 SEC", block(samples(0), "{:10.6f}", 8)), {}, {{"230", 0}}});
    add({"peer_cm",
         at2("230", "NPTS= 400, DT= .01 SEC", block(samples(0, 0.01), "{:12.4f}", 5),
             "ACCELERATION IN UNITS OF CM/S**2"),
         {},
         {{"230", 0}},
         "cm/s2"});
    add(refused("peer_velocity", at2("180", "NPTS= 400, DT= .01 SEC", e15(0), "VELOCITY TIME SERIES IN UNITS OF CM/S"),
                "this file holds no acceleration"));
    add(refused("peer_cut", at2("180", "NPTS= 401, DT= .01 SEC", e15(0)), "NPTS = 401, but 400 values follow"));
    add(refused("peer_column_3", at2("180", "NPTS= 400, DT= .01 SEC", e15(0)), "there is no one channel '3'",
                given("", {}, "3")));
    // COSMOS
    add({"cosmos_v2", cosmos(0, 90).text(), {}, {{"90 deg", 0}}, "cm/s2"});
    add({"cosmos_up", cosmos(2, 400).text(), {}, {{"up", 2}}, "cm/s2"});
    agency_files::Cosmos v1 = cosmos(1, 180, 2);
    v1.volume = 1;
    add({"cosmos_v1_in_g", v1.text(), {}, {{"180 deg", 1}}, "g", 6e-5});
    agency_files::Cosmos with_velocity = cosmos(0, 360);
    with_velocity.with_velocity = true;
    add({"cosmos_with_velocity", with_velocity.text(), {}, {{"360 deg", 0}}, "cm/s2"});
    add({"cosmos_station",
         cosmos(0, 90).text() + cosmos(2, 400).text() + cosmos(1, 360).text(),
         {},
         {{"90 deg", 0}, {"up", 2}, {"360 deg", 1}},
         "cm/s2"});
    add(refused("cosmos_counts", cosmos(0, 90, 50).text(), "counts or volts"));
    // CSMIP
    add({"csmip_v2", csmip(0, " 90 DEG"), {}, {{"90 DEG", 0}}, "cm/s2"});
    add({"csmip_v2_station",
         csmip(0, " 90 DEG") + csmip(2, " UP") + csmip(1, " 360 DEG"),
         {},
         {{"90 DEG", 0}, {"UP", 2}, {"360 DEG", 1}},
         "cm/s2"});
    add({"csmip_v2_one_of_three",
         csmip(0, " 90 DEG") + csmip(2, " UP") + csmip(1, " 360 DEG"),
         given("", {}, "UP"),
         {{"UP", 2}},
         "cm/s2"});
    add({"csmip_v1", csmip(0, " 90 DEG", false), {}, {{"90 DEG", 0}}});
    add({"cisn_sec_and_g",
         csmip_by_rate("UNITS OF UNCOR DATA ARE SEC AND G.        MAX  =    0.208 G, AT    1.910 SEC."),
         {},
         {{"90 DEG", 0}}});
    add({"cisn_accel_is_g",
         csmip_by_rate("UNITS OF UNCOR ACCEL IS G.        MAX  =    0.208 G, AT    1.910 SEC."),
         {},
         {{"90 DEG", 0}}});
    add({"cdmg_film_g10",
         csmip_film("UNITS OF UNCOR ACCEL ARE SEC AND G/10.    MAX  =    0.208 G", 0.0),
         {},
         {{"90 DEG", 0}},
         "g/10",
         6e-4});
    add({"renadic",
         csmip_film("UNITS OF UNCORRECTED ACCELEROGRAM: SEC AND G/10", 0.0, " L    UNIVERSIDAD"),
         {},
         {{"L", 0}},
         "g/10",
         6e-4});
    add(refused("renadic_uneven", csmip_film("UNITS OF UNCOR ACCEL ARE SEC AND G/10.", 0.003),
                "the time step is uneven"));
    add({"renadic_resampled",
         csmip_film("UNITS OF UNCOR ACCEL ARE SEC AND G/10.", 0.003),
         resampled(0.01),
         {{"90 DEG", 0}},
         "g/10",
         0.03});
    add(refused("csmip_spectra",
                "RESPONSE AND FOURIER AMPLITUDE SPECTRA\nCORRECTED ACCELEROGRAM\nUNCORRECTED ACCELEROGRAM\n1 2\n",
                "response spectra"));
    add(refused("csmip_cut", csmip(0, " 90 DEG").substr(0, 6000), "ends in the middle of its field"));
    // SMC
    add({"smc", smc(0, "    360"), {}, {{"360", 0}}, "cm/s2"});
    add({"smc_uncorrected_up", smc(2, "     UP", "1 UNCORRECTED ACCELEROGRAM"), {}, {{"UP", 2}}, "cm/s2"});
    add({"smc_nul_padding", smc(0, "    360") + std::string(80, '\0'), {}, {{"360", 0}}, "cm/s2"});
    add(refused("smc_film_uneven", smc_film(0.003), "or rounded to the printed digits (digitised film is uneven)"));
    add({"smc_film_resampled", smc_film(0.003), resampled(0.01), {{"45", 0}}, "cm/s2", 0.03});
    add({"smc_film_even", smc_film(0.0), {}, {{"45", 0}}, "cm/s2", 6e-4});
    agency_files::Smc impossible;
    impossible.rate = -5.0;
    add(refused("smc_impossible_rate", impossible.text(), "-5 samples per second are not possible"));
    // K-NET: the offset of the sensor is the mean of the record
    add({"k_net_ns", k_net(0, "N-S"), {}, {{"N-S", 0}}, "gal", 0.01});
    add({"k_net_ud", k_net(2, "U-D"), {}, {{"U-D", 2}}, "gal", 0.01});
    add({"kik_net_borehole", k_net(1, "2"), {}, {{"E-W borehole", 1}}, "gal", 0.01});
    add({"kik_net_surface", k_net(2, "6"), {}, {{"U-D surface", 2}}, "gal", 0.01});
    // ESM, ITACA, AFAD, Swiss
    add({"esm_hne", esm(0, "HNE"), {}, {{"HNE", 0}}, "cm/s2"});
    add({"esm_hnz", esm(2, "HNZ"), {}, {{"HNZ", 2}}, "cm/s2"});
    add({"swiss_hg", esm(1, "HGN"), {}, {{"HGN", 1}}, "cm/s2"});
    add({"afad_u", esm(2, "U"), {}, {{"U", 2}}, "cm/s2"});
    add(refused("esm_velocity", esm(0, "HNE", "VELOCITY"), "the file holds 'VELOCITY'"));
    add({"itaca_touching", itaca("NS"), {}, {{"NS", 0}}, "m/s2"});
    add({"itaca_given_too", itaca("UP"), given("m/s2", 0.01), {{"UP", 0}}, "m/s2"});
    add(refused("itaca_wrong_unit", itaca("NS", "Acceleration time series"), "the file's header says 2.039 m/s2",
                given("g")));
    // GeoNet
    add({"geonet_v1a",
         geonet(0, "N10E", false) + geonet(1, "N80W", false) + geonet(2, "Up", false),
         {},
         {{"N10E", 0}, {"N80W", 1}, {"Up", 2}},
         "mm/s2",
         6e-5});
    add({"geonet_v2a",
         geonet(0, "N10E", true) + geonet(1, "N80W", true) + geonet(2, "Up", true),
         {},
         {{"N10E", 0}, {"N80W", 1}, {"Up", 2}},
         "mm/s2",
         6e-5});
    add({"geonet_one_of_three",
         geonet(0, "N10E", true) + geonet(1, "N80W", true),
         given("", {}, "N80W"),
         {{"N80W", 1}},
         "mm/s2",
         6e-5});
    add(refused("geonet_other_units", geonet(0, "N10E", false, "2.00"), "in units of 2"));
    // BHRC
    add({"bhrc_v1", bhrc(0, "L1") + bhrc(2, "V1") + bhrc(1, "T1"), {}, {{"L1", 0}, {"V1", 2}, {"T1", 1}}, "g/10"});
    add({"bhrc_seven_lines_of_reals", bhrc(0, "L1", "VOL1DS", 42), {}, {{"L1", 0}}, "g/10"});
    add(refused("bhrc_given_mg", bhrc(0, "L1"), "the file says its unit is g/10, but mg was given", given("mg", 0.01)));
    add(refused("bhrc_v2", bhrc(0, "L1", "VOL2DS"), "of BHRC only volume 1 is read"));
    add(refused("bhrc_cut", bhrc(0, "L1", "VOL1DS", 44, 500), "number of points = 500, but 400 values follow"));
    // Three components side by side
    add({"turkish", turkish(), given("gal"), turkish_channels, "gal"});
    add({"turkish_column", turkish(), given("gal", 0.01, "U-D"), {{"U-D", 2}}, "gal"});
    add(refused("turkish_count", turkish(399), "n = 399, but 400 values follow", given("gal")));
    add({"taiwanese", cwb(), {}, {{"U(+)", 2}, {"N(+)", 0}, {"E(+)", 1}}, "gal", 6e-6});
    add({"mexican", unam(), {}, {{"N00E_1", 0}, {"+V_2", 2}, {"N90E_3", 1}}, "gal"});
    add({"pesmos",
         "Strong motion of nowhere\nSampling Rate   100 Hz\nNumber of Samples: 400\nComponent: N85E\nAcceleration "
         "(cm/s/s)\n" +
             block(samples(0, 0.01), "{:12.5f}"),
         {},
         {{"N85E", 0}},
         "cm/s2"});
    // Programs
    add({"seismosignal_tabs", "Time [sec]\tAcceleration [g]\n" + two_columns("{:.2f}\t{:.6f}")});
    add({"seismosignal_blanks", "Time [sec]   Acceleration [g]\n" + two_columns("{:8.2f} {:12.6f}")});
    add({"seismosignal_cm",
         "Time (sec) Acceleration (cm/sec2)\n" + two_columns("{:8.2f} {:12.4f}", 0.01),
         {},
         {{"", 0}},
         "cm/s2"});
    add({"slammer_comments",
         "# Time Series: own motion\n# Time (s),Acceleration (g's)\n" + two_columns("{:.2f},{:.6f}")});
    add({"deepsoil", "400 0.01\n" + two_columns(), given("g")});
    add({"shake", "own motion\n400 0.0100\n" + block(samples(0), "{:.6f}"), given("g")});
    add({"rsp_match", "Time history matched to spectrum: own\n  400  0.0100  656\n" + block(samples(0), "{:15.6E}", 5),
         given("g", 0.01)});
    add({"count_and_step_in_two_lines", "400\n0.01\n" + block(samples(0), "{:.6f}"), given("g")});
    add({"step_before_count", "0.01 400\n" + block(samples(0), "{:.6f}"), given("g")});
    add(refused("count_that_is_another", "401 0.01\n" + block(samples(0), "{:.6f}"),
                "lines of different numbers of values: 2 in line 1, 1 here", given("g", 0.01)));
    add(refused("count_alone_that_is_another", "401\n" + block(samples(0), "{:.6f}"),
                "whole numbers stand above the numbers with decimals", given("g", 0.01)));
    add(refused("step_against_the_given_one", "400 0.02\n" + block(samples(0), "{:.6f}"),
                "the file says dt = 0.02 s, but dt = 0.01 s was given", given("g", 0.01)));
    // Columns
    add({"csv", "time_s,accel_g\n" + two_columns("{:.2f},{:.6f}")});
    add({"csv_semicolons_decimal_commas",
         "Zeit t [s];a [m/s2]\n" + with_commas(two_columns("{:.2f};{:.6f}", 1.0)),
         {},
         {{"", 0}},
         "m/s2"});
    add({"csv_two_heading_lines",
         "Time,NS,EW,UD\n(s),(gal),(gal),(gal)\n" +
             lines([](double t, double a, double b,
                      double c) { return fmt::format("{:.2f},{:.4f},{:.4f},{:.4f}", t, a, b, c); },
                   0.01),
         {},
         {{"NS [gal]", 0}, {"EW [gal]", 1}, {"UD [gal]", 2}},
         "gal"});
    add({"csv_milliseconds",
         "Time (ms),Acc (mg)\n" +
             lines([](double t, double a, double, double) { return fmt::format("{:.0f},{:.4f}", 1000.0 * t, a); },
                   0.001 * one_g),
         {},
         {{"", 0}},
         "mg"});
    add({"csv_per_cent_of_g", "time_s,accel [%g]\n" + two_columns("{:.2f},{:.5f}", 0.01 * one_g), {}, {{"", 0}}, "%g"});
    add({"one_unit_for_all_headings",
         "NS EW UD (g)\n" + three_bare,
         given("", 0.01),
         {{"NS", 0}, {"EW", 1}, {"UD (g)", 2}}});
    add({"labels_rate",
         "% Sampling Frequency (Hz): 100\n% Unit: mm/s^2\n% Component: HNZ\n" + block(samples(2, 0.001), "{:.3f}"),
         {},
         {{"HNZ", 2}},
         "mm/s2"});
    add({"labels_decimal_comma",
         "Sampling interval: 0,01 s\nUnits: m/s2\n" + block(samples(0, 1.0), "{:.6f}"),
         {},
         {{"", 0}},
         "m/s2"});
    add({"time_and_one_of_three", time_and_three, given("g", {}, "3"), {{"3", 1}}});
    add(refused("time_and_three", time_and_three, "4 numbers a line without headings, and the first rises like a time",
                given("g", 0.01)));
    add(refused("the_time_chosen", time_and_three, "column 1 rises like a time", given("g", {}, "1")));
    add(refused("column_that_is_not_there", two_columns(), "there is no column '3'", given("g", {}, "3")));
    add(refused("three_side_by_side", three_bare, "3 numbers a line look like 3 components side by side",
                given("g", 0.01)));
    add({"three_counted", "# n: 400\n" + three_bare, given("g", 0.01), {{"1", 0}, {"2", 1}, {"3", 2}}});
    add({"three_chosen", three_bare, given("g", 0.01, "3"), {{"3", 2}}});
    add(refused("three_without_a_step", three_bare, "3 numbers a line, without headings and without a time step",
                given("g")));
    // Samples in reading order
    add({"eight_a_line", block(samples(0), "{:10.6f}", 8), given("g", 0.01)});
    add({"seven_a_line_the_last_shorter", block(samples(0), "{:10.6f}", 7), given("g", 0.01)});
    add({"touching_5e14", block(samples(0, 1.0), "{:14.7E}", 5), given("m/s2", 0.01), {{"", 0}}, "m/s2"});
    add({"touching_8f9", block(samples(0, 0.01), "{:9.3f}", 8), given("gal", 0.01), {{"", 0}}, "gal"});
    const std::vector<double> first = samples(0);
    add({"ragged_but_counted",
         "# n: 400\n" + block({first.begin(), first.begin() + 2}, "{:9.6f}", 2) +
             block({first.begin() + 2, first.end()}, "{:.6f}"),
         given("g", 0.01)});
    add(refused("ragged", "0.1 0.2\n" + block(samples(0), "{:.6f}"), "lines of different numbers of values",
                given("g", 0.01)));
    add(refused("integers_above", integers_above(block(samples(0), "{:10.6f}", 10)), "whole numbers stand above",
                given("g", 0.01)));
    add(refused("integers_above_others", integers_above(block(samples(0), "{:10.6f}", 8)),
                "lines of different numbers of values: 10 in line 2, 8 here", given("g", 0.01)));
    // Times
    add({"rounded_256_hz",
         "time_s,accel_g\n" + two_columns("{:.3f},{:.6f}", one_g, 1024, 1.0 / 256.0),
         {},
         {{"", 0}},
         "g",
         1e-5,
         1024,
         1.0 / 256.0});
    add({"rounded_two_decimals",
         "time_s,accel_g\n" + two_columns("{:.2f},{:.6f}", one_g, 800, 0.005),
         given("", 0.005),
         {{"", 0}},
         "g",
         1e-5,
         800,
         0.005});
    add(refused("rounded_and_open", "time_s,accel_g\n" + two_columns("{:.2f},{:.6f}", one_g, 800, 0.005),
                "the times are rounded: their step lies between 0.00499374 and 0.00501877 s"));
    add(refused("rounded_against_the_given_step", "time_s,accel_g\n" + two_columns("{:.2f},{:.6f}", one_g, 800, 0.005),
                "does not follow", given("", 0.0051)));
    add({"single_precision", single_precision(), given("g")});
    add({"single_precision_given", single_precision(), given("g", 0.01)});
    add(refused("uneven", "0 0.1\n0.01 0.2\n0.0200101 0.1\n0.03 0.2\n0.04 0.1\n",
                "0.0099899 s here, 0.01 s on average (0.11 % off)", given("g")));
    // Text
    add({"carriage_returns", with_line_ends("time_s,accel_g\n" + two_columns("{:.2f},{:.6f}"), "\r")});
    add({"byte_order_mark",
         "\xef\xbb\xbf" + with_line_ends("time_s,accel_g\n" + two_columns("{:.2f},{:.6f}"), "\r\n")});
    add({"end_of_file_marks", block(samples(0), "{:10.6f}", 8) + "\x1a\x1a", given("g", 0.01)});
    add(refused("cut_in_the_last_number", block(samples(0), "{:10.6f}", 8).substr(0, 8 * 400 + 300),
                "is shorter than all before it", given("g", 0.01)));
    return all;
}

class Audit3Corpus : public testing::TestWithParam<Layout> {};

TEST_P(Audit3Corpus, IsReadWithItsDigitsOrRefused)
{
    const Layout& layout = GetParam();
    if (!layout.refusal.empty()) {
        const std::string said = agency_files::refusal(layout.text, "x.dat", layout.options);
        EXPECT_NE(said.find(layout.refusal), std::string::npos) << (said.empty() ? "was read" : said);
        EXPECT_NE(said.find("fix:"), std::string::npos) << said;
        return;
    }
    std::vector<Record> records;
    ASSERT_NO_THROW(
        try { records = parse_record(layout.text, "x.dat", layout.options); } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
            throw;
        });
    ASSERT_EQ(records.size(), layout.channels.size());
    for (std::size_t c = 0; c < records.size(); ++c) {
        const Record& record = records[c];
        EXPECT_EQ(record.source.component, layout.channels[c].first);
        EXPECT_EQ(record.source.unit, layout.unit);
        EXPECT_NEAR(record.dt, layout.dt, 1e-12);
        const bool whole = record.acceleration.size() == static_cast<std::size_t>(layout.samples);
        ASSERT_TRUE(whole || (layout.options.uneven == UnevenTime::resample &&
                              record.acceleration.size() + 1 >= static_cast<std::size_t>(layout.samples)))
            << record.acceleration.size();
        double peak = 0.0, worst = 0.0;
        for (std::size_t k = 0; k < record.acceleration.size(); ++k) {
            const double exact = one_g * motion(layout.channels[c].second, layout.dt * static_cast<double>(k));
            worst = std::max(worst, std::abs(record.acceleration[k] - exact));
            peak = std::max(peak, std::abs(record.acceleration[k]));
        }
        EXPECT_LE(worst, layout.error);
        if (layout.channels[c].second == 0) {
            EXPECT_NEAR(peak, layout.samples == n ? 2.0385 : 2.0399, 5e-4 + layout.error);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(layouts, Audit3Corpus, testing::ValuesIn(corpus()),
                         [](const auto& info) { return info.param.name; });

TEST(Audit3, B4_CorpusHasEveryAgency)
{
    EXPECT_GE(corpus().size(), 60u);
}

/// A column that is not there, one number a line with a column asked for, "(g's)", an uneven step, a rate of 1.7e38.
TEST(Audit3, B5_ColumnUnitStepAndRateAreCasesOfTheCorpus)
{
    const std::vector<Layout> files = corpus();
    for (const char* name : {"column_that_is_not_there", "peer_column_3", "slammer_comments", "smc_film_uneven", "smc_film_even", "smc_impossible_rate"})
        EXPECT_EQ(std::count_if(files.begin(), files.end(), [&](const Layout& file) { return file.name == name; }), 1) << name;
}

// The last number of a file of unequal numbers, without a line end, may have lost its exponent: a remark.
TEST(Audit3, D_RecordCutExponent)
{
    const std::string whole = "# units: m/s2\n# dt: 0.02 s\n# n: 5\n0.1\n0.25\n-0.3\n0.011771579\n-1.7997117e-31";
    const auto remarked = [](const std::string& text) {
        return agency_files::warned(parse_record(text, "x").at(0), "may have been cut");
    };
    EXPECT_TRUE(remarked(whole.substr(0, whole.size() - 4)));
    EXPECT_TRUE(remarked(whole.substr(0, whole.size() - 1)));
    EXPECT_FALSE(remarked(whole + "\n"));
}

} // namespace
