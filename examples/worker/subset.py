#!/usr/bin/env python3
"""P(slip > d) of block.toml by subset simulation, with `damslip worker` as the model.

Friction and strength of the pulse are lognormal. The slip of this block has a closed form, so that P is also an integral over one variable: the
script prints both, and fails where they differ by more than three standard errors.

    python3 examples/worker/subset.py [path of damslip]

Au & Beck (2001), Probabilistic Engineering Mechanics 16(4): levels of probability p0 = 0.1; within a level each chain steps to
u' = r u + sqrt(1 - r^2) xi, xi standard normal, and stays where the slip falls below the level (Papaioannou et al. 2015). The Python standard library is
all it needs.
"""
import json
import math
import os
import random
import subprocess
import sys
from statistics import NormalDist

FOLDER = os.path.dirname(os.path.abspath(__file__))
GRAVITY, ACCELERATION, DURATION = 9.81, 2.943, 0.4  # of block.toml and pulse.csv [m/s2, s]
FRICTION, BETA_FRICTION, BETA_SCALE = 0.35, 0.15, 0.2
LIMIT_MM = 520.0
SAMPLES, P0, STEP = 900, 0.1, 0.6


class Worker:
    """Slip [mm] of one point after the other."""

    def __init__(self, program):
        self.calls = 0
        self.process = subprocess.Popen([program, "worker", os.path.join(FOLDER, "block.toml"), "--method", "rigid"],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        json.loads(self.process.stdout.readline())  # "ready", with the keys that can be set

    def slip(self, u):
        self.calls += 1
        values = {"contact.friction": FRICTION * math.exp(BETA_FRICTION * u[0]),
                  "motion.scale": math.exp(BETA_SCALE * u[1])}
        print(json.dumps({"id": self.calls, "set": values}), file=self.process.stdin, flush=True)
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            sys.exit(f"damslip worker: {answer['error']}")
        return answer["slip_mm"]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def closed_form():
    """P = integral of F_mu(A^2 T^2 / (g (2 d + A T^2))) over the strength A, by Simpson's rule."""
    normal, n, ends = NormalDist(), 2000, 8.0
    total = 0.0
    for i in range(n + 1):
        z = -ends + 2 * ends * i / n
        a = ACCELERATION * math.exp(BETA_SCALE * z)
        friction = a * a * DURATION**2 / (GRAVITY * (2e-3 * LIMIT_MM + a * DURATION**2))
        p = normal.cdf(math.log(friction / FRICTION) / BETA_FRICTION)
        total += (1 if i in (0, n) else 4 if i % 2 else 2) * p * normal.pdf(z)
    return total * 2 * ends / n / 3


def dependence(failed, chains):
    """gamma of Au & Beck (2001), eq. (25)-(27): what the correlation within the chains adds to the variance."""
    length, p = len(failed) // chains, sum(failed) / len(failed)
    rows = [failed[c * length:(c + 1) * length] for c in range(chains)]
    gamma = 0.0
    for lag in range(1, length):
        pairs = [row[i] * row[i + lag] for row in rows for i in range(length - lag)]
        gamma += 2 * (1 - lag / length) * (sum(pairs) / len(pairs) - p * p) / (p * (1 - p))
    return max(gamma, 0.0)


def subset_simulation(slip, rng):
    """P(slip > LIMIT_MM) and its coefficient of variation."""
    points = [[rng.gauss(0, 1), rng.gauss(0, 1)] for _ in range(SAMPLES)]
    slips = [slip(u) for u in points]
    probability, variance, chains = 1.0, 0.0, SAMPLES
    while True:
        order = sorted(range(SAMPLES), key=lambda i: -slips[i])
        seeds = int(P0 * SAMPLES)
        level = min(slips[order[seeds]], LIMIT_MM)
        failed = [s > level for s in slips]
        share = sum(failed) / SAMPLES
        gamma = dependence(failed, chains) if chains < SAMPLES else 0.0
        probability *= share
        variance += (1 - share) / (share * SAMPLES) * (1 + gamma)
        if level >= LIMIT_MM:
            return probability, math.sqrt(variance)
        if level <= 0:
            sys.exit("less than a tenth of the points slide: no level to begin with")
        chains, starts = seeds, [(points[i], slips[i]) for i in order[:seeds]]
        points, slips = [], []
        for u, s in starts:
            for k in range(SAMPLES // seeds):
                if k > 0:
                    v = [STEP * x + math.sqrt(1 - STEP**2) * rng.gauss(0, 1) for x in u]
                    t = slip(v)
                    if t > level:
                        u, s = v, t
                points.append(u)
                slips.append(s)


def report(name, p, cov, calls):
    """Prints a probability beside the closed form, and ends the script where they do not agree."""
    exact = closed_form()
    print(f"{name:<18} P = {p:.3g}, c.o.v. {cov:.2f}, {calls} calls")
    print(f"{'closed form':<18} P = {exact:.4g}")
    if abs(p - exact) > 3 * cov * exact or calls > 4000:
        sys.exit("they differ by more than three standard errors, or it took more than 4000 calls")


def main():
    worker = Worker(sys.argv[1] if len(sys.argv) > 1 else "damslip")
    p, cov = subset_simulation(worker.slip, random.Random(1))
    worker.close()
    report("subset simulation", p, cov, worker.calls)


if __name__ == "__main__":
    main()
