"""The loop of tests/bench/screen_loop.cpp in Python; both print the same sum of slips.

    PYTHONPATH=build/release/python python3 tests/bench/screen_loop.py SCENE COUNT
    python3 tests/bench/screen_loop.py SCENE COUNT build/bench/tests/bench/screen_loop    # both in turn, best of five
"""

import re
import subprocess
import sys
import time


def by_call(scene, count):
    import damslip
    text = damslip.load(scene)
    total = 0.0
    start = time.process_time()
    for i in range(count):
        for row in text.with_(contact__friction=0.7 + 0.1 * i / count).screen(jobs=1).slips:
            total += row.slip
    return 1e3 * (time.process_time() - start) / count, total


def main(scene, count, program=None):
    if program is None:
        print("%.6f ms by call, slips %.17g m" % by_call(scene, int(count)))
        return
    best = {}
    for _ in range(5):
        for name, command in [("C++", [program]), ("Python", [sys.executable, __file__])]:
            said = subprocess.run(command + [scene, count], capture_output=True, text=True, check=True).stdout
            seconds, slips = re.match(r"(\S+) ms by call, slips (\S+) m", said).groups()
            best[name] = min(best.get(name, 1e9), float(seconds))
            assert best.setdefault("slips", slips) == slips, "the loops compute different slips"
    print("C++ %.4f ms, Python %.4f ms by call: %+.1f %%" % (best["C++"], best["Python"],
                                                           100 * (best["Python"] / best["C++"] - 1)))


main(*sys.argv[1:])
