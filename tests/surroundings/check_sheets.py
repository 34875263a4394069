#!/usr/bin/env python3
"""check_sheets.py PROGRAM ROOT [--office]: the workbooks of --sheet, their formulas computed again.

By a small reader of formulas here: each cell equals the value the program left in it, the columns "this sheet" and "program" agree to 1e-9,
the program's are those of its JSON, and a cell that is changed moves what depends on it. --office: by LibreOffice, which has to be there.
"""
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile

program, root = sys.argv[1], pathlib.Path(sys.argv[2])
office = "--office" in sys.argv
NS = {"m": "http://schemas.openxmlformats.org/spreadsheetml/2006/main"}
FUNCTIONS = {"SQRT": math.sqrt, "ABS": abs, "MAX": max, "MIN": min, "SUM": lambda *terms: sum(terms),
             "IF": lambda test, then, otherwise: then if test else otherwise}
EXACT = 1e-9


def sheets(file):
    """By name: {cell: (formula or None, value)}."""
    with zipfile.ZipFile(file) as book:
        texts = [t.text or "" for t in xml.fromstring(book.read("xl/sharedStrings.xml")).iter("{%s}t" % NS["m"])]
        names = [s.get("name") for s in xml.fromstring(book.read("xl/workbook.xml")).find("m:sheets", NS)]
        found = {}
        for number, name in enumerate(names, 1):
            cells = {}
            for c in xml.fromstring(book.read(f"xl/worksheets/sheet{number}.xml")).iter("{%s}c" % NS["m"]):
                value, formula = c.find("m:v", NS), c.find("m:f", NS)
                if value is None:
                    continue
                kind = c.get("t")
                cells[c.get("r")] = (formula.text if formula is not None else None,
                                     texts[int(value.text)] if kind == "s" else value.text if kind == "str" else float(value.text))
            found[name] = cells
        return found


def computed(cells, changed=None):
    """Values of all cells by their formulas. changed: {cell: number} in place of what it holds."""
    values = {}

    def value(cell):
        if cell not in values:
            formula, kept = cells[cell]
            if changed and cell in changed:
                values[cell] = changed[cell]
            elif formula is None:
                values[cell] = kept
            else:
                python = re.sub(r"(?<![A-Z])([A-Z]\d+)", r'value("\1")', formula)
                python = re.sub(r"IF\(([^>]*)>", r"IF(\1>", python)
                values[cell] = eval(python, {"value": value, **FUNCTIONS})  # noqa: S307  formulas of the program under test
        return values[cell]

    for cell in cells:
        value(cell)
    return values


def by_office(file):
    """The same by LibreOffice, from the formulas alone: the values beside them are taken out first."""
    with tempfile.TemporaryDirectory() as folder:
        bare = pathlib.Path(folder) / "bare" / file.name
        bare.parent.mkdir()
        with zipfile.ZipFile(file) as full, zipfile.ZipFile(bare, "w") as without:
            for part in full.namelist():
                without.writestr(part, re.sub(rb"(</f>)<v>[^<]*</v>", rb"\1", full.read(part)))
        subprocess.run(["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", "xlsx:Calc MS Excel 2007 XML",
                        "--outdir", folder, str(bare)], check=True, capture_output=True)
        return {name: {cell: value for cell, (_, value) in cells.items()}
                for name, cells in sheets(pathlib.Path(folder) / file.name).items()}


def off(a, b):
    return abs(a - b) / max(abs(a), abs(b), 1e-300)


def comparisons(cells, values):
    """Lines "quantity, this sheet, program, difference" below their heads: {quantity: (sheet, program)}."""
    lines, inside = {}, False
    rows = sorted({int(c[1:]) for c in cells})
    for row in rows:
        second = values.get(f"B{row}")
        if second == "this sheet":
            inside = True
        elif inside and f"D{row}" in values and isinstance(second, float):
            lines[values[f"A{row}"]] = (second, values[f"C{row}"], f"B{row}")
    return lines


def check(file, least):
    kept = sheets(file)
    again = by_office(file) if office else None
    result = {}
    for name, cells in kept.items():
        values = again[name] if office else computed(cells)
        for cell, (formula, was) in cells.items():
            if formula is not None:
                assert off(values[cell], was) < EXACT or abs(values[cell] - was) < 1e-6, (file, name, cell, formula, was, values[cell])
        lines = comparisons(cells, values)
        assert len(lines) >= least, (file, name, lines)
        for quantity, (of_sheet, of_program, _) in lines.items():
            assert off(of_sheet, of_program) < EXACT, (file, name, quantity, of_sheet, of_program)
        result[name] = (cells, lines)
    return result


def run(*line):
    done = subprocess.run([program, *map(str, line)], cwd=root, capture_output=True, text=True)
    assert done.returncode in (0, 3, 4), (line, done.stderr)
    return done.stdout


SILT = """title = "silt, drains, tailwater, ice, inclined base"
section = { polygon_m = [[0, 0], [40, -3], [8, 45], [6, 50], [0, 50]] }
dam = { density_kg_m3 = 2400 }
reservoir = { level_m = 47, overtopped = true }
tailwater = { level_m = 6 }
silt = { level_m = 12, submerged_unit_weight_kN_m3 = 9, pressure_coefficient = 0.4 }
ice = { force_kN_m = 150, level_m = 47 }
drains = { distance_m = 5, efficiency = 0.6 }
uplift = { model = "drains", crack = "seismic-zero" }
contact = { friction = 0.8, cohesion_kPa = 50 }
[[force]]
name = "gate"
x_m = 3
y_m = 50
force_x_kN_m = 20
force_y_kN_m = -30
[[combination]]
name = "earthquake"
kind = "extreme"
k_h = 0.15
k_v = -0.05
[[combination]]
name = "flood"
reservoir_level_m = 51
water_factor = 1.1
"""

if office and not shutil.which("soffice"):
    print("no LibreOffice")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "silt.toml").write_text(SILT)
    scenes = [root / "examples" / f"{name}.toml" for name in ["judged_dam", "own_dam", "gated_spillway", "anchored_dam", "bonded_dam"]]
    scenes.append(folder / "silt.toml")
    for scene in scenes:
        file = folder / f"{scene.stem}.xlsx"
        answer = json.loads(run("screen", scene, "--rigid-only", "--sheet", file, "--json", "--quiet"))
        found = check(file, 10)
        states = answer["limit_equilibrium"]
        assert len(states) == len(found)
        for state, (cells, lines) in zip(states, found.values()):
            if state["sliding_factor"] is not None:
                assert off(lines["sliding factor"][1], state["sliding_factor"]) < 1e-12, (scene, state["combination"])
        # Twice the friction and the cohesion are twice the factor.
        cells, lines = next(iter(found.values()))
        named = {text: f"B{cell[1:]}" for cell, (_, text) in cells.items() if cell[0] == "A" and isinstance(text, str)}
        twice = {named[key]: 2 * cells[named[key]][1] for key in ["friction", "cohesion"]}
        of_sheet, _, at = lines["sliding factor"]
        if "anchor" not in scene.stem:  # whose dowels stay
            assert off(computed(cells, twice)[at], 2 * of_sheet) < 1e-12
        print(f"{scene.name}: {len(found)} load combinations, {sum(len(l) for _, l in found.values())} quantities")

    file = folder / "base.xlsx"
    answer = json.loads(run("fe", root / "examples" / "own_dam.toml", "--no-mesh-error", "--sheet", file, "--json", "--quiet"))
    found = check(file, 3)
    assert len(found) == len(answer["runs"])
    for cells, _ in found.values():
        factor = next(f"B{cell[1:]}" for cell, (_, text) in cells.items() if text == "sliding factor with the peak strength")
        assert abs(computed(cells)[factor] - 1.0) < 1e-3  # own_dam slides: all friction is used
    print(f"own_dam.toml by finite elements: {len(found)} runs")
    assert not list(folder.glob("*.part"))
    again = folder / "again.xlsx"
    run("screen", root / "examples" / "own_dam.toml", "--rigid-only", "--sheet", again, "--quiet")
    assert again.read_bytes() == (folder / "own_dam.xlsx").read_bytes(), "the same scene gives the same bytes"
    if pathlib.Path("/proc").exists():  # a folder that cannot be made
        done = subprocess.run([program, "screen", "examples/own_dam.toml", "--rigid-only", "--sheet", "/proc/none/check.xlsx"], cwd=root,
                              capture_output=True, text=True)
        assert done.returncode == 3 and "/proc/none" in done.stderr and "fix:" in done.stderr, (done.returncode, done.stderr)
    for name, env in [("check.csv", None), ("check.ods", {"PATH": "/none"})]:  # no workbook; no LibreOffice
        done = subprocess.run([program, "screen", "examples/own_dam.toml", "--sheet", name], cwd=root, capture_output=True, text=True, env=env)
        assert done.returncode == 2 and ".xlsx" in done.stderr, done.stderr
    if office:  # .ods, converted back: the same cells
        run("screen", root / "examples" / "own_dam.toml", "--rigid-only", "--sheet", folder / "ods" / "own_dam.ods", "--quiet")
        subprocess.run(["soffice", f"-env:UserInstallation=file://{folder}/profile", "--headless", "--convert-to", "xlsx:Calc MS Excel 2007 XML",
                        "--outdir", folder / "ods", folder / "ods" / "own_dam.ods"], check=True, capture_output=True)
        ours, theirs = sheets(folder / "own_dam.xlsx"), sheets(folder / "ods" / "own_dam.xlsx")
        assert list(ours) == list(theirs)
        for name in ours:
            assert {c: v is None for c, (v, _) in ours[name].items()} == {c: v is None for c, (v, _) in theirs[name].items()}, name
            for c, (_, value) in ours[name].items():
                same = value == theirs[name][c][1] if isinstance(value, str) else off(value, theirs[name][c][1]) < EXACT or abs(value - theirs[name][c][1]) < 1e-12
                assert same, (name, c, value, theirs[name][c])
