// Errors of the library as exceptions of Python; their classes are in python/damslip/errors.py.
#include "result.hpp"

#include "core/input_error.hpp"
#include "scene/read.hpp"

namespace damslip::python {

namespace {

py::list as_dictionaries(const std::vector<Diagnostic>& diagnostics)
{
    py::list list;
    for (const Diagnostic& given : diagnostics) {
        const Diagnostic d = with_line(given);
        py::dict entry;
        entry["file"] = d.file;
        entry["line"] = d.line;
        entry["column"] = d.column;
        entry["problem"] = d.problem;
        entry["expected"] = d.expected;
        entry["fix"] = d.fix;
        list.append(entry);
    }
    return list;
}

void raise(const char* name, const char* text, const std::vector<Diagnostic>& diagnostics)
{
    const py::object type = py::module_::import("damslip.errors").attr(name);
    PyErr_SetObject(type.ptr(), type(text, as_dictionaries(diagnostics)).ptr());
}

} // namespace

void add_errors(py::module_&)
{
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const UsageError& e) {
            raise("UsageError", e.what(), e.diagnostics());
        } catch (const InputError& e) {
            raise("InputError", e.what(), e.diagnostics());
        } catch (const NotConverged& e) {
            raise("NotConverged", e.what(), {e.diagnostic()});
        } catch (const Interrupted&) {
            PyErr_SetNone(PyExc_KeyboardInterrupt);
        }
    });
}

} // namespace damslip::python
