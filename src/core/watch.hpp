#pragma once

#include "core/stop.hpp"

#include <cstddef>
#include <string>

namespace damslip {

/// Whoever waits for a long computation: is told how far it is, and asked whether it shall end. All members may be
/// called from any thread. This one is silent and never ends anything; a program derives its own.
class Watch {
public:
    virtual ~Watch() = default;

    /// Shall the computation end? Asked at every step; what is finished is kept.
    virtual bool stop_asked() const { return false; }

    /// Results exist that nobody but the computation holds: a stop has to wait for it from now on.
    virtual void results_at_hand() {}

    /// A part of the computation begins. @param total  what at() counts up to
    virtual void begin(const std::string& /*label*/, double /*total*/) {}
    virtual void phase(const std::string& /*what*/) {} ///< what goes on before the first step: "set-up"
    virtual void at(double /*done*/) {}                ///< in the unit of the total; may step back
    virtual void end() {}                              ///< of the part

    /// stop_asked() as the function that solvers take. @pre this outlives it
    StopAsked stop() const
    {
        return [this] { return stop_asked(); };
    }
};

} // namespace damslip
