#pragma once

namespace damslip::cli {

/// While this object lives, Ctrl-C (SIGINT) and SIGTERM only set a mark, so that a long run can end in order and write what it has.
/// A second Ctrl-C ends the process as usual.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    bool interrupted() const;
};

} // namespace damslip::cli
