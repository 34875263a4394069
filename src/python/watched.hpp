#pragma once

#include "core/watch.hpp"

#include <pybind11/pybind11.h>

#include <functional>

namespace damslip::python {

/// Runs a long computation on a thread of its own, without Python's lock, while the calling thread tells how far it is and
/// looks for Ctrl-C. Some twenty times a second `progress(label, done, total)` is called, on the calling thread.
/// @param progress  a callable, or None
/// @returns whether Ctrl-C ended it and the work has something to keep
/// @throws what the work throws; what progress throws, after the work has ended; KeyboardInterrupt where Ctrl-C left nothing
bool run_watched(const pybind11::object& progress, const std::function<void(Watch&)>& work);

} // namespace damslip::python
