#include "watched.hpp"

#include "core/input_error.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace damslip::python {

namespace py = pybind11;

namespace {

/// What the computation says from its threads, and whether it shall end.
class CalledWatch final : public Watch {
public:
    struct Reached {
        std::string label;
        double done = 0.0, total = 0.0;
    };

    bool stop_asked() const override { return stop_; }
    void begin(const std::string& label, double total) override
    {
        const std::lock_guard lock(mutex_);
        reached_ = {label, 0.0, total};
    }
    void at(double done) override
    {
        const std::lock_guard lock(mutex_);
        reached_.done = done;
    }

    void stop() { stop_ = true; }
    Reached reached() const
    {
        const std::lock_guard lock(mutex_);
        return reached_;
    }
    void work_is_over()
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
        ended_.notify_all();
    }
    bool over_within(std::chrono::milliseconds time)
    {
        std::unique_lock lock(mutex_);
        return ended_.wait_for(lock, time, [this] { return over_; });
    }

private:
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    std::condition_variable ended_;
    Reached reached_;
    bool over_ = false;
};

/// Ctrl-C, or an error of the progress function, as it stands in Python.
std::optional<py::error_already_set> look_at_python(const py::object& progress, const CalledWatch& watch)
{
    if (PyErr_CheckSignals() != 0) return py::error_already_set();
    if (progress.is_none()) return std::nullopt;
    try {
        const CalledWatch::Reached reached = watch.reached();
        progress(reached.label, reached.done, reached.total);
    } catch (py::error_already_set& error) {
        return error;
    }
    return std::nullopt;
}

} // namespace

bool run_watched(const py::object& progress, const std::function<void(Watch&)>& work)
{
    CalledWatch watch;
    std::exception_ptr failure;
    std::optional<py::error_already_set> raised;
    {
        const py::gil_scoped_release free;
        std::thread worker([&] {
            try {
                work(watch);
            } catch (...) {
                failure = std::current_exception();
            }
            watch.work_is_over();
        });
        while (!watch.over_within(std::chrono::milliseconds(50))) {
            const py::gil_scoped_acquire held;
            if (raised) continue;
            raised = look_at_python(progress, watch);
            if (raised) watch.stop();
        }
        worker.join();
    }
    if (raised && !raised->matches(PyExc_KeyboardInterrupt)) throw *raised;
    if (raised && failure) throw *raised;
    if (failure) std::rethrow_exception(failure);
    return raised.has_value();
}

} // namespace damslip::python
