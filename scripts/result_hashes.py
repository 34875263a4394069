#!/usr/bin/env python3
"""Hashes of the numbers the program prints on every example: what may not change is compared before and after a change.

    scripts/result_hashes.py PROGRAM [--fe] [--values FOLDER] > before
    ... change, build ...
    scripts/result_hashes.py PROGRAM [--fe] > after ; diff before after

One line for each example, table and column: screen (limit equilibrium, yield, displacements, uplift profiles), sweep
--method rigid over five frictions and both polarities, and with --fe the slip history of each record and polarity.
A line that differs names the column that moved; --values keeps the numbers themselves, to see by how much.
Texts (statuses, remarks, headings) are not part of it, nor are columns that only one of two versions has.
"""
import argparse
import csv
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FRICTIONS = "0.66,0.7,0.77,0.84,1.0"


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)


def number(cell):
    """A number as the bits of its double; anything else is no number."""
    try:
        return float(cell).hex()
    except (TypeError, ValueError):
        return "-"


class Printer:
    def __init__(self, values):
        self.values = values
        if values:
            values.mkdir(parents=True, exist_ok=True)

    def columns(self, name, rows):
        """`rows`: dictionaries of one table."""
        keys = []
        for row in rows:
            keys += [key for key in row if key not in keys]
        for key in keys:
            cells = [number(row.get(key)) for row in rows]
            if all(cell == "-" for cell in cells):
                continue
            digest = hashlib.sha256("\n".join(cells).encode()).hexdigest()[:16]
            print(f"{name} {key} {len(cells)} {digest}")
            if self.values:
                text = "\n".join(str(row.get(key)) for row in rows)
                (self.values / (f"{name}.{key}".replace("/", "_").replace(" ", "_"))).write_text(text + "\n")


def csv_rows(text):
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def screen(program, scene, out):
    answer = run(program, "screen", scene, "--json")
    tables = json.loads(answer.stdout) if answer.stdout else {}
    for table in ("limit_equilibrium", "yield", "wedge", "planes", "displacements", "flexible_block", "uplift_profiles"):
        if table in tables:
            out.columns(f"{scene} screen.{table}", tables[table])


def sweep(program, scene, out):
    answer = run(program, "sweep", scene, "--friction", FRICTIONS, "--polarity", "1,-1", "--method", "rigid")
    out.columns(f"{scene} sweep", csv_rows(answer.stdout))


def finite_elements(program, scene, out):
    for polarity in (1, -1):
        with tempfile.TemporaryDirectory() as folder:
            run(program, "fe", scene, "--polarity", polarity, "--out", folder, "--quiet")
            for file in sorted(pathlib.Path(folder).glob("history_*.csv")):
                rows = [{k: v for k, v in row.items() if k in ("time_s", "slip_m")} for row in csv_rows(file.read_text())]
                out.columns(f"{scene} fe {polarity:+d} {file.stem}", rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--fe", action="store_true", help="slip histories of damslip fe, too (minutes)")
    parser.add_argument("--values", type=pathlib.Path, help="folder for the numbers themselves")
    arguments = parser.parse_args()
    program = str(arguments.program.resolve())
    out = Printer(arguments.values)
    for scene in sorted(path.relative_to(ROOT) for path in (ROOT / "examples").rglob("*.toml")):
        screen(program, scene, out)
        sweep(program, scene, out)
        if arguments.fe:
            finite_elements(program, scene, out)
        sys.stdout.flush()


if __name__ == "__main__":
    main()
