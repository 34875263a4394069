// The Python module damslip._core: the library of src/analysis with the tables, objects and reports of src/pages. The
// package python/damslip is around it.
#include "result.hpp"

#include "core/file.hpp"
#include "core/version.hpp"

PYBIND11_MODULE(_core, module)
{
    using namespace damslip::python;
    module.doc() = "How far a concrete gravity dam slides in an earthquake.";
    module.attr("__version__") = damslip::program_version();
    damslip::use_cache_folder(damslip::user_cache_folder()); // as the program does
    add_errors(module);
    add_results(module);
    add_scene(module);
    add_fe(module);
    add_modes(module);
    add_sweep(module);
    add_accuracy(module);
    add_fragility(module);
}
