#pragma once

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// Where an accelerogram came from; printed in provenance, never used in a computation.
struct RecordSource {
    std::string file;                          ///< as the user named it
    std::string format;                        ///< "PEER AT2", "one column", "two columns", "CSV", "generated"
    std::string unit;                          ///< unit of the samples in the file: "g", "m/s2", "cm/s2"
    std::string component;                     ///< as the file says: "NS", "up", "090"; empty if it does not say
    std::string title;                         ///< event and station line of the file
    std::string sha256;                        ///< of the file's bytes
    std::size_t first_line = 0, last_line = 0; ///< lines of the file that hold the samples, from 1
};

/// One accelerogram component: uniform step, acceleration linear between samples.
/// Sign: as in the file; the meaning (horizontal positive upstream, vertical positive up) is given where it is used.
struct Record {
    std::string name;                 ///< short name for tables
    double dt = 0.0;                  ///< time step [s], > 0
    std::vector<double> acceleration; ///< [m/s^2], sample k at time k dt; at least 2, all finite
    RecordSource source;
    std::vector<std::string> warnings; ///< what the reader noticed and the user should know

    double duration() const
    {
        return acceleration.empty() ? 0.0 : dt * static_cast<double>(acceleration.size() - 1);
    } ///< [s]
};

/// One record of a sequence.
struct MotionEvent {
    std::string name;
    std::size_t first = 0; ///< its first sample in the motion
};

/// Ground acceleration of one run: a_h positive upstream (drives the dam downstream), a_v positive up, on one time grid.
struct GroundMotion {
    std::string name;
    double dt = 0.0;                ///< [s]
    std::vector<double> accel_h;    ///< [m/s^2], positive upstream
    std::vector<double> accel_v;    ///< [m/s^2], positive up; empty: no vertical motion. Else as long as accel_h
    std::vector<std::string> notes; ///< what was changed to make it: zero sample prepended, padding, resampling

    /// Of a sequence, the first at sample 0: each event begins when all has come to rest after the one before. What shakes
    /// meets zero samples between them, one at least, for `pause` from the moment of rest on. Empty: one record.
    std::vector<MotionEvent> events = {};
    double pause = 0.0; ///< [s]

    bool is_sequence() const { return events.size() > 1; }
    /// Its last sample.
    std::size_t last_of(std::size_t event) const
    {
        return event + 1 < events.size() ? events[event + 1].first - 1 : accel_h.size() - 1;
    }
};

} // namespace damslip

namespace damslip::records {

/// The project's own text: "# key: value" lines (title, component, source, units, dt, n), the heading accel_m_s2, one
/// sample a line in m/s^2 as the shortest text of the double. Reading it gives the same samples and step, bit for bit.
std::string record_csv(const Record& record);

/// The same with a time column: time_s,accel_m_s2. For plotting programs; reads back bit for bit too.
std::string record_csv_with_time(const Record& record);

/// PEER AT2: four header lines, samples in g, five a line with 8 significant digits (relative rounding 5e-8).
std::string record_at2(const Record& record);

} // namespace damslip::records
