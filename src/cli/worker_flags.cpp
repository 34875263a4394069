#include "cli/flags.hpp"
#include "cli/worker_command.hpp"

namespace damslip::cli {

namespace {

void worker_flags(CLI::App& sub, WorkerArguments& a)
{
    sub.add_option("SCENE", a.scene, "scene file (TOML)")->required();
    sub.add_option("--method", a.method,
                   "where a line names none: a method of sweep, such as rigid or fe; default rigid-v, without vertical "
                   "motion rigid");
    sub.add_option("--record", a.record, "where a line names none: a record of the scene");
    sub.add_option("--dakota", a.dakota, "Dakota's parameters file and the results file to write: one point")
        ->expected(2)
        ->group("Other programs");
    sub.add_option("--quofem", a.quofem, "quoFEM's params.in and the results.out to write: one point")
        ->expected(2)
        ->group("Other programs");
}

} // namespace

Command worker_command()
{
    return {"worker", "slip of points that another program asks for: JSON lines, Dakota, quoFEM",
            "damslip worker examples/reference_dam.toml",
            with_flags<WorkerArguments>(worker_flags,
                                        [](const WorkerArguments& a, const Streams& s) { return worker(a, s); })};
}

} // namespace damslip::cli
