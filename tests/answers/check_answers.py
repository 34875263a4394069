#!/usr/bin/env python3
"""check_answers.py PROGRAM ROOT [--long]: what commands print in a pipe and on a terminal of 110 columns.

Shape, of any content: at most 25 lines of 110 characters, at most four digits that mean something, one unit for one quantity in a table,
one line with -q, all tables with --full, the same text on a terminal. Then the golden texts beside this file, which
DAMSLIP_UPDATE_GOLDEN=1 writes. --long: those that run finite elements many times, and the shape of all examples.
"""
import difflib
import fcntl
import os
import pathlib
import pty
import re
import struct
import subprocess
import sys
import tempfile
import termios
import time

program, root = sys.argv[1], pathlib.Path(sys.argv[2])
golden = pathlib.Path(__file__).resolve().parent
update = os.environ.get("DAMSLIP_UPDATE_GOLDEN") == "1"
LINES, COLUMNS, DIGITS = 25, 110, 4
UNITS = [{"mm", "cm", "m"}, {"g", "m/s²"}, {"N/m", "kN/m", "MN/m"}, {"Pa", "kPa", "MPa"}, {"J/m", "kJ/m"}, {"ms", "s"}]
# Texts with seconds, which differ from run to run, have no golden text.
COMMANDS = {
    "screen": "screen examples/own_dam.toml",
    "screen_records": "screen examples/reference_dam.toml --record records/data/rock_1.0_h.csv --record records/data/rock_1.0_v.csv",
    "screen_seam": "screen examples/seam_dam.toml",
    "screen_lifts": "screen examples/lifts_dam.toml",
    "screen_wedge": "screen examples/rock_wedge.toml",
    "fe": "fe examples/own_dam.toml",
    "fe_lifts": "fe examples/cracked_upper_block.toml --no-mesh-error",
    "fe_tied": "fe examples/own_dam.toml --base tied",
    "fe_reduced": "fe examples/own_dam.toml --reduced",
    "sweep": "sweep examples/own_dam.toml --friction 0.7:1.0:0.1",
    "fragility": "fragility examples/fragility/dam.toml --samples 64",
    "assess": "assess examples/own_dam.toml --budget 600",
    "explain": "explain examples/own_dam.toml",
    "explain_ablate": "explain examples/own_dam.toml --ablate",
    "modes": "modes examples/own_dam.toml",
    "calibrate": "calibrate examples/own_dam.toml --frequency 3.5 --second 9.8",
    "mesh": "mesh examples/own_dam.toml",
    "record_info": "record info records/data/rock_1.0_h.csv records/data/rock_1.0_v.csv",
    "record_spectrum": "record spectrum records/data/rock_1.0_h.csv",
    "slide": "slide --yield-g 0.05 --record records/data/rock_1.0_h.csv",
    "regress": "regress --yield-g 0.08 --pga-g 0.35 --pgv-cm-s 28 --magnitude 6.8 --allowable-mm 50",
}
TIMED = {"assess_plan": "assess examples/own_dam.toml --plan",
         "accuracy": "accuracy examples/own_dam.toml --quick --budget 5",
         "explain_fe": "explain examples/own_dam.toml --method fe"}
LONG = {"assess", "fe_lifts", "fe_reduced", "sweep"}
long = "--long" in sys.argv
wrong = []


def fail(name, what):
    wrong.append(f"{name}: {what}")


def in_pipe(words):
    run = subprocess.run([program, *words], cwd=root, capture_output=True, text=True, check=False)
    return run.returncode, run.stdout, run.stderr


def terminals():
    """A system folder without devpts has none; then the texts of pipes are checked alone."""
    try:
        for end in pty.openpty():
            os.close(end)
        return True
    except OSError:
        return False


def on_terminal(words):
    """Output and talk on one terminal of 110 columns, without what progress drew over."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 40, COLUMNS, 0, 0))
    process = subprocess.Popen([program, *words], cwd=root, stdout=slave, stderr=slave, stdin=subprocess.DEVNULL)
    os.close(slave)
    seen = b""
    while True:
        try:
            piece = os.read(master, 1 << 16)
        except OSError:  # the terminal's other end is closed
            break
        if not piece:
            break
        seen += piece
    process.wait()
    os.close(master)
    lines = seen.decode().replace("\r\n", "\n").split("\n")
    return "\n".join(line.rsplit("\r\x1b[K", 1)[-1] for line in lines)


def check_shape(name, text):
    lines = text.rstrip("\n").split("\n")
    if len(lines) > LINES:
        fail(name, f"{len(lines)} lines")
    for line in lines:
        if len(line) > COLUMNS:
            fail(name, f"{len(line)} columns: {line}")
    for at, line in enumerate(lines):
        if not line or set(line) != {"─"}:
            continue
        units = set(lines[at - 1].split())
        for family in UNITS:
            if len(units & family) > 1:
                fail(name, f"units of one table: {sorted(units & family)}")
        for row in lines[at + 1:]:
            if not row or row.startswith("  ") and row.endswith("more rows"):
                break
            for cell in re.split(r"\s{2,}", row.strip()):
                number = re.fullmatch(r"[-−]?(\d+)\.(\d+)(e[-+]\d+)?", cell)
                if number and len((number[1] + number[2]).lstrip("0")) > DIGITS:
                    fail(name, f"more than {DIGITS} digits: {cell}")


def check(name, command, with_golden):
    words = command.split()
    rows = words[0] == "sweep"  # standard output is the rows' where it is a pipe
    begin = time.monotonic()
    code, out, talk = in_pipe(words)
    quick = time.monotonic() - begin < 1.0
    answer = "\n".join(line for line in talk.split("\n") if not re.match(r"\w[\w, ]*: (set-up|\d+ %)", line)) if rows else out
    if code not in (0, 4) or not answer:
        return fail(name, f"exit code {code}: {talk}")
    check_shape(name, answer)
    if not quick:  # finite-element runs: once
        return compare(name, f"$ damslip {command}\n{answer}") if with_golden else None
    if with_golden and terminal and on_terminal(words) != answer:
        fail(name, "a terminal shows another text than a pipe")
    if rows and not terminal:
        return compare(name, f"$ damslip {command}\n{answer}")
    shown = on_terminal([*words, "-q"]) if rows else in_pipe([*words, "-q"])[1]
    if shown.count("\n") != 1 or not shown.strip() or len(shown) > COLUMNS + 1:
        fail(name, f"-q: {shown!r}")
    if with_golden:
        full = in_pipe([*words, "--full"])
        if len((full[1] + full[2]).split("\n")) <= len(answer.split("\n")) and name not in ("mesh", "slide", "record_info"):
            fail(name, "--full has no more than the answer in brief")
        compare(name, f"$ damslip {command}\n{answer}")


def compare(name, text):
    text = re.sub(r"\d\.\de-1\d", "round-off", text)  # another processor, other last bits
    file = golden / f"{name}.txt"
    if update:
        file.write_text(text)
    elif not file.exists() or file.read_text() != text:
        old = file.read_text().split("\n") if file.exists() else []
        fail(name, "another text than before:\n" + "\n".join(difflib.unified_diff(old, text.split("\n"), lineterm="")))


terminal = terminals()
for name, command in COMMANDS.items():
    if (name in LONG) == long:
        check(name, command, True)
for name, command in TIMED.items() if long else []:
    check(name, command, False)
for scene in sorted((root / "examples").glob("*.toml")) if long else []:
    code, out, talk = in_pipe(["screen", f"examples/{scene.name}"])
    check_shape(f"screen {scene.name}", out) if code in (0, 4) else fail(scene.name, talk)
with tempfile.TemporaryDirectory() as folder:  # rows in a file: the answer has standard output
    code, out, talk = in_pipe(["sweep", "examples/own_dam.toml", "--out", f"{folder}/rows.csv"])
    check_shape("sweep --out", out) if out else fail("sweep --out", talk)
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
