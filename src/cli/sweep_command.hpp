#pragma once

#include "cli/input/make_axes.hpp"
#include "cli/terminal/terminal.hpp"

namespace damslip::cli {

/// The full grid of friction x level x uplift x reservoir x size x scale x polarity x record x method, one CSV row each,
/// in that order: the same bytes for any number of threads, any parts, and any number of stops and resumptions.
int sweep(const SweepArguments& arguments, const Streams& streams);

} // namespace damslip::cli
