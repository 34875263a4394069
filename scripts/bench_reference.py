#!/usr/bin/env python3
"""Runs two builds of damslip in turn on the same scenes and prints medians and ratios of processor seconds.

Called by bench_reference.sh, which builds the reference. Each round runs every program once on a case, so a machine that is
busy for a while slows both. Processor seconds are user and system time of the process and its children.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENE = "examples/reference_dam_profile.toml"


@dataclass
class Side:
    """What one of both programs runs: the scene's changes (key of a section -> line) and the words of the command line."""
    changes: dict
    words: list


@dataclass
class Case:
    name: str
    reference: Side
    program: Side
    units: int = 1  # rows of the sweep, to print a row's share
    bar: str = ""
    scene: str = SCENE


BATCH = "batch"  # not a scene: a row of the table that tests/bench/sliding_bench prints
BATCH_NAME = "rigid block, batch, one thread, a sample and yield"
BATCH_BAR = "0.90"


FE_BEFORE = ["fe", "{scene}", "--json", "-q", "--polarity", "1"]
FE = FE_BEFORE + ["--no-mesh-error"]
MASSLESS = {"foundation": ['mass = "massless"']}
FIXED = {"time": ["substeps = 0"]}
ADDED = {"reservoir": ['model = "added-mass"']}
ACOUSTIC = {"reservoir": ['model = "acoustic"']}


def both(*parts):
    merged = {}
    for part in parts:
        for section, lines in part.items():
            merged.setdefault(section, []).extend(lines)
    return merged


FRICTIONS = "0.66,0.70,0.77,1.00"
RIGID = ["sweep", "{scene}", "-q", "--method", "rigid", "--friction", "0.65:1.0:0.0001", "--scale", "0.5,1,2",
         "--polarity", "1,-1", "-j", "1", "--out", "{folder}/rows.csv"]
RIGID_ROWS = 3501 * 3 * 2
SCALES = "0.5,0.6,0.7,0.8,0.9,1,1.1,1.2,1.3,1.4,1.5,2"
MILLION = ["sweep", "{scene}", "-q", "--method", "rigid", "--friction", "0.65:0.983336:0.000008", "--scale", SCALES,
           "--polarity", "1,-1", "-j", "1", "--out", "{folder}/rows.csv"]
MILLION_ROWS = 41668 * 12 * 2
REDUCED = ["sweep", "{scene}", "-q", "--method", "fe-reduced", "--friction", FRICTIONS, "-j", "1"]
REDUCED_16 = ["sweep", "{scene}", "-q", "--method", "fe-reduced", "--friction", "0.70:1.0:0.02", "-j", "1"]
WHOLE = ["sweep", "{scene}", "-q", "--method", "fe-whole-steps", "--friction", FRICTIONS, "-j", "1"]

# The scene of the reference needs no mass = "massless": its rock without a density has none.
CASES = {
    "exact": Case("exact contact run, massless, steps of dt", Side(both(ADDED, FIXED), FE_BEFORE),
                  Side(both(MASSLESS, ADDED, FIXED), FE), bar="0.60"),
    "reduced": Case("reduced, 12 modes, model kept, a row", Side(both(ADDED, FIXED), REDUCED),
                    Side(both(MASSLESS, ADDED, FIXED), REDUCED), units=4, bar="0.30"),
    "reduced-16": Case("reduced, 12 modes, model kept for 16 frictions, a row", Side(both(ADDED, FIXED), REDUCED_16),
                       Side(both(MASSLESS, ADDED, FIXED), REDUCED_16), units=16),
    "radiating": Case("radiating rock, cache warm, to massless", Side(both(ADDED, FIXED), FE_BEFORE),
                      Side(both(ADDED, FIXED), FE), bar="1.0"),
    "default": Case("default accuracy, radiating + acoustic, to massless + acoustic", Side(ACOUSTIC, FE_BEFORE),
                    Side(ACOUSTIC, FE), bar="0.50"),
    "default-massless": Case("default accuracy, massless + acoustic, both", Side(ACOUSTIC, FE_BEFORE),
                             Side(both(MASSLESS, ACOUSTIC), FE)),
    "rigid": Case(f"rigid sweep, a row of {RIGID_ROWS}", Side({}, RIGID), Side({}, RIGID), units=RIGID_ROWS, bar="0.20"),
    "million": Case(f"rigid sweep, a row of {MILLION_ROWS}; at most 200 MB", Side({}, MILLION), Side({}, MILLION),
                    units=MILLION_ROWS, bar="0.20"),
    "whole-steps": Case("whole steps, massless, a row of 4", Side(ADDED, WHOLE), Side(both(MASSLESS, ADDED), WHOLE),
                        units=4, bar="0.7"),
    "screen": Case("screen", Side({}, ["screen", "{scene}", "-q"]), Side({}, ["screen", "{scene}", "-q"])),
}


def changed_scene(text, changes):
    """The scene with lines put below the headings of their sections; sections that it has not are added."""
    text = re.sub(r'"\.\./records/', f'"{ROOT}/records/', text)
    for section, lines in changes.items():
        heading = f"[{section}]\n"
        block = "".join(line + "\n" for line in lines)
        text = text.replace(heading, heading + block, 1) if heading in text else f"{text}\n{heading}{block}"
    return text


def run(program, side, folder, name, scene):
    """Processor seconds, wall seconds, largest memory [MB] of one run."""
    file = folder / f"{name}.toml"
    file.write_text(changed_scene((ROOT / scene).read_text(), side.changes))
    for left in folder.glob("rows*"):  # a sweep goes on from its own database alone
        left.unlink()
    words = [word.format(scene=file, folder=folder) for word in side.words]
    begin = time.monotonic()
    with open(folder / f"{name}.out", "w") as out, open(folder / f"{name}.err", "w") as err:
        process = subprocess.Popen([program, *words], stdout=out, stderr=err)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.monotonic() - begin
    if process.returncode not in (0, 4):  # 4: a dam that fails its criterion of some row, or no answer; said in the output
        sys.exit(f"{program} {' '.join(words)}: exit code {process.returncode}\n{(folder / f'{name}.err').read_text()}")
    return usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / 1024


def batch_nanoseconds(bench):
    """What the bench of a program says of its batch on one thread: processor and wall time [ns per sample and yield]."""
    out = subprocess.run([bench], check=True, capture_output=True, text=True).stdout
    row = re.search(r"^batch, skipping blocks, threads: 1 +([0-9.]+) +([0-9.]+)", out, re.MULTILINE)
    if not row:
        sys.exit(f"{bench}: no row of the batch on one thread")
    return float(row[1]), float(row[2])


def print_batch(benches, runs):
    measured = ([], [])
    for _ in range(runs):
        for i, bench in enumerate(benches):
            measured[i].append(batch_nanoseconds(bench))
    cpu, wall = zip(*([statistics.median(column) for column in zip(*rows)] for rows in measured))
    print(f"{BATCH_NAME:64} {cpu[0]:>7.3f} ns {cpu[1]:>7.3f} ns {cpu[1] / cpu[0]:6.2f} {BATCH_BAR:>5} | "
          f"{wall[0]:8.3f} {wall[1]:8.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reference", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--reference-bench", help="sliding_bench of the reference, for the case batch")
    parser.add_argument("--program-bench", help="sliding_bench of this program")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    arguments = parser.parse_args()
    names = {key: case.name for key, case in CASES.items()} | {BATCH: BATCH_NAME}
    if arguments.list:
        print("\n".join(f"{key:18} {name}" for key, name in names.items()))
        return
    wrong = [key for key in arguments.cases if key not in names]
    if wrong or arguments.runs < 1:
        sys.exit(f"unknown case {', '.join(wrong)}; cases: {', '.join(names)}" if wrong else "--runs: 1 or more")
    benches = [arguments.reference_bench, arguments.program_bench]
    if BATCH in arguments.cases and not all(benches):
        sys.exit("the case batch needs --reference-bench and --program-bench")
    programs = [str(pathlib.Path(p).resolve()) for p in (arguments.reference, arguments.program)]
    print(f"{'case':64} {'reference':>10} {'now':>10} {'ratio':>6} {'bar':>5} | {'wall':>8} {'now':>8} | {'MB':>5} {'now':>5}")
    with tempfile.TemporaryDirectory(prefix="damslip-bench-") as name:
        for key in arguments.cases or names:
            if key == BATCH:
                if all(benches):
                    print_batch(benches, arguments.runs)
                continue
            case, folder = CASES[key], pathlib.Path(name)
            sides = (case.reference, case.program)
            for program, side, label in zip(programs, sides, ("reference", "now")):
                if key in ("radiating", "default"):  # reduced rock into the cache
                    run(program, side, folder, label, case.scene)
            measured = ([], [])
            for _ in range(arguments.runs):
                for i, (program, side, label) in enumerate(zip(programs, sides, ("reference", "now"))):
                    measured[i].append(run(program, side, folder, label, case.scene))
            cpu, wall, memory = zip(*([statistics.median(column) for column in zip(*runs)] for runs in measured))
            cpu, wall = [[x / case.units for x in pair] for pair in (cpu, wall)]
            factor, unit = (1e6, "us") if cpu[0] < 1e-3 else (1.0, "s")
            print(f"{case.name:64} {factor * cpu[0]:>7.4g} {unit:2} {factor * cpu[1]:>7.4g} {unit:2} {cpu[1] / cpu[0]:6.2f} "
                  f"{case.bar:>5} | {factor * wall[0]:8.4g} {factor * wall[1]:8.4g} | {memory[0]:5.0f} {memory[1]:5.0f}",
                  flush=True)


if __name__ == "__main__":
    main()
