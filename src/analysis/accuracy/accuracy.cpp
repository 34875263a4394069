#include "analysis/accuracy/accuracy.hpp"

#include "core/processor_clock.hpp"

namespace damslip {

Accuracy measure_accuracy(const Scene& scene, double tolerance, Effort effort, const Watch& watch)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    Records records = load_records(scene, Method::finite_elements);
    const RungRunner runner(scene, std::move(records), clock.seconds(), watch);
    ClimbOptions options;
    options.ladder = {effort, tolerance};
    ClimbCalls calls;
    calls.run = [&](const Rung& rung) { return runner.run(rung); };
    calls.interrupted = watch.stop();
    Accuracy accuracy{climb(runner.facts(), options, calls), {}};
    accuracy.judgement = judge_rungs(accuracy.rungs, tolerance);
    return accuracy;
}

} // namespace damslip
