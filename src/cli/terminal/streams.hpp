#pragma once

#include "core/stop.hpp"

#include <functional>
#include <iosfwd>

namespace damslip::cli {

enum class Form { text, json };

/// Where a command puts what it has to say: data on `out`, talk and progress on `talk`. Control characters other than
/// newline and tab reach neither of them.
struct Streams {
    std::ostream& out;
    std::ostream& talk;
    Form form = Form::text;
    bool quiet = false;          ///< no talk but errors
    bool terminal = false;       ///< `talk` is a terminal: progress is drawn
    std::ostream* bar = nullptr; ///< the terminal itself, for a bar that is drawn over; null: no terminal
    StopAsked stop = {};         ///< does the user want the command to end? empty: never
    /// Hands the whole command line to damslip-verify, the second program; does not come back unless that cannot be started.
    /// @throws InputError where it is not installed
    std::function<int()> hand_on = {};
};

} // namespace damslip::cli
