#!/usr/bin/env python3
"""The same probability as subset.py by the subset sampling of OpenTURNS, with `damslip worker` as its model.

    python3 examples/worker/openturns_subset.py [path of damslip]

OpenTURNS (Debian's python3-openturns) needs a function from points to numbers, which is `Worker.slip` of subset.py, and the law of the points.
Fails where its answer is more than three of its standard errors from the closed form, or took more than 4000 calls.
"""
import sys

import subset

try:
    import openturns as ot
except ImportError:
    print("skipped: OpenTURNS (package python3-openturns) is not installed")
    sys.exit(77)  # a test that is skipped


def main():
    worker = subset.Worker(sys.argv[1] if len(sys.argv) > 1 else "damslip")
    slip = ot.PythonFunction(2, 1, lambda u: [worker.slip(u)])
    points = ot.RandomVector(ot.Normal(2))
    event = ot.ThresholdEvent(ot.CompositeRandomVector(slip, points), ot.Greater(), subset.LIMIT_MM)

    ot.RandomGenerator.SetSeed(1)
    method = ot.SubsetSampling(event)
    method.setConditionalProbability(subset.P0)
    method.setMaximumOuterSampling(900)
    method.setBlockSize(1)
    method.run()
    worker.close()

    result = method.getResult()
    subset.report(f"OpenTURNS {ot.__version__}", result.getProbabilityEstimate(), result.getCoefficientOfVariation(), worker.calls)


if __name__ == "__main__":
    main()
