#pragma once

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/parallel.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"

#include <nlohmann/json_fwd.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace damslip::python {

namespace py = pybind11;

/// What every result has: the answer of its command (tables by their names in the JSON object, this object), and the report.
class Result {
public:
    virtual ~Result() = default;
    virtual pages::Answer answer() const = 0;         ///< of the command
    /// By id: of the answer, and what the command writes into files alone (the rows of all runs).
    virtual std::vector<std::pair<std::string, Table>> tables() const { return answer().tables(); }
    virtual std::string first_table() const = 0;      ///< id of the one people look at first
    virtual pages::Page page() const = 0; ///< of the report
    virtual pages::Headline headline() const = 0;
    bool interrupted = false; ///< Ctrl-C: what is there is what was finished
};

/// Values that lie in a result, without a copy: the array keeps the result alive and cannot be written to.
/// @param owner  the Python object of the result
template <class Value>
py::array view_of(const Value* values, std::vector<py::ssize_t> shape, const py::object& owner)
{
    py::array view = py::array_t<Value>(std::move(shape), values, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

inline py::array view_of(const std::vector<double>& values, const py::object& owner)
{
    return view_of(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

/// A scene file, or text, that was read once, with the keys that were set since; checked.
struct OpenedScene {
    std::shared_ptr<const SceneText> text;
    std::shared_ptr<const std::string> written; ///< what the text was read from
    std::vector<KeyChange> changes;
    Scene scene;

    /// With keys set; what is wrong names the key.
    OpenedScene(std::shared_ptr<const SceneText> read, std::shared_ptr<const std::string> from,
                std::vector<KeyChange> set)
        : text(std::move(read)), written(std::move(from)), changes(std::move(set)), scene(text->with(changes))
    {
    }
    /// As the file is; what is wrong names its line, which a SceneText does not keep.
    explicit OpenedScene(const std::filesystem::path& file) : scene(read_scene(file))
    {
        written = std::make_shared<std::string>(read_file(file, 4u << 20));
        text = std::make_shared<SceneText>(*written, file);
    }
};

/// Runs a long computation on a thread of its own, without Python's lock, while the calling thread tells how far it is and
/// looks for Ctrl-C. Some twenty times a second `progress(label, done, total)` is called, on the calling thread.
/// @param progress  a callable, or None
/// @returns whether Ctrl-C ended it and the work has something to keep
/// @throws what the work throws; what progress throws, after the work has ended; KeyboardInterrupt where Ctrl-C left nothing
bool run_watched(const py::object& progress, const std::function<void(Watch&)>& work);

// The parts of the module, each with its classes.
void add_errors(py::module_& module);
void add_results(py::module_& module); ///< Table, Result
void add_scene(py::module_& module);   ///< Scene, ScreenResult
void add_fe(py::module_& module);
void add_modes(py::module_& module);
void add_sweep(py::module_& module);
void add_accuracy(py::module_& module);
void add_fragility(py::module_& module);

} // namespace damslip::python
