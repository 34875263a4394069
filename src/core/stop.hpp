#pragma once

#include "core/input_error.hpp"

#include <functional>

namespace damslip {

/// Asked between the parts of a long computation: does the user want it to end? Empty: never. Called from any thread.
using StopAsked = std::function<bool()>;

/// The way out of a computation that has nothing to return yet.
/// @param where  what was going on: "the set-up of the finite elements"
/// @throws Interrupted
inline void stop_if_asked(const StopAsked& asked, const char* where)
{
    if (asked && asked()) throw Interrupted(where);
}

} // namespace damslip
