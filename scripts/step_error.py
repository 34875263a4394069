#!/usr/bin/env python3
"""Is the slip within its stated step error? Each example at default accuracy beside the same run with steps of dt/32.

    scripts/step_error.py build/release/damslip              # all scenes, an hour or more of processor time
    scripts/step_error.py build/release/damslip own_dam      # one of them; rows go to standard output as CSV

Four frictions, added mass and acoustic water on radiating rock, added mass on massless rock; the first record, polarity 1.
The last lines count the slips within their stated error and a micrometre, which a table does not show, and those that say nothing
because the run chose dt/32 itself. Exit code 1 where one is outside.
"""
import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ["anchored_dam", "bonded_dam", "cracked_upper_block", "opening_water", "own_dam", "reference_dam",
          "reference_dam_printed_uplift", "reference_dam_profile", "reference_dam_rock_mass", "reference_dam_ruptured",
          "sequence"]
MODELS = [("fe-radiating", "westergaard"), ("fe-radiating", "acoustic"), ("fe-massless", "westergaard")]
FRICTIONS = "1.00,0.77,0.70,0.66"
HALVINGS = 5  # dt/32


def one_record(text):
    """The scene with its first record alone; a sequence keeps all of its records."""
    if "sequence" in text:
        return text
    parts = re.split(r"(?m)^(?=\[\[motion\.record\]\])", text)
    if len(parts) < 3:
        return text
    after = re.search(r"(?m)^\[(?!\[motion)", parts[-1])
    return parts[0] + parts[1] + (parts[-1][after.start():] if after else "")


def with_steps(text, halvings):
    """Fixed sub-steps of dt/2^halvings in place of those that the slip tolerance chooses."""
    line = f"substeps = {halvings}\n"
    return text.replace("[time]\n", "[time]\n" + line, 1) if "\n[time]\n" in text else f"{text}\n[time]\n{line}"


def rows(program, scene, method, water, jobs, frictions=FRICTIONS, polarity="1"):
    process = subprocess.run([program, "sweep", str(scene), "-q", "--method", method, "--reservoir", water, "--friction", frictions,
                              "--polarity", polarity, "-j", jobs], capture_output=True, text=True)
    if process.returncode not in (0, 4):  # 4: rows without an answer
        sys.exit(f"{scene.name}, {method}, {water}: exit code {process.returncode}\n{process.stderr}")
    return list(csv.DictReader(line for line in process.stdout.splitlines() if not line.startswith("#")))


def number(text):
    return float(text) if text else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=f"of {', '.join(SCENES)}")
    parser.add_argument("-j", "--jobs", default="1")
    parser.add_argument("--friction", default=FRICTIONS)
    parser.add_argument("--polarity", default="1", choices=["1", "-1"])
    arguments = parser.parse_args()
    wrong = [name for name in arguments.scenes if name not in SCENES]
    if wrong:
        sys.exit(f"unknown scene {', '.join(wrong)}; scenes: {', '.join(SCENES)}")
    out = csv.writer(sys.stdout)
    out.writerow(["scene", "method", "water", "friction", "status", "slip_mm", "stated_error_mm", "slip_dt32_mm", "error_mm", "ratio"])
    compared = within = same = 0
    outside = []
    with tempfile.TemporaryDirectory(prefix="damslip-step-error-") as folder:
        for name in arguments.scenes or SCENES:
            text = re.sub(r'"\.\./records/', f'"{ROOT}/records/', one_record((ROOT / f"examples/{name}.toml").read_text()))
            text = re.sub(r"(?m)^(mass *=.*)$", "", text)  # the method says which rock
            chosen, fine = (pathlib.Path(folder) / f"{name}{end}.toml" for end in ("", "_dt32"))
            chosen.write_text(text)
            fine.write_text(with_steps(text, HALVINGS))
            for method, water in MODELS:
                for a, b in zip(rows(arguments.program, chosen, method, water, arguments.jobs, arguments.friction, arguments.polarity),
                                rows(arguments.program, fine, method, water, arguments.jobs, arguments.friction, arguments.polarity)):
                    slip, stated, finest = number(a["slip_m"]), number(a["slip_error_m"]), number(b["slip_m"])
                    line = [name, method, water, a["friction"], a["status"]]
                    if slip is None or finest is None or stated is None:
                        out.writerow(line + ["", "", "", "", ""])
                    else:
                        error = abs(slip - finest)
                        out.writerow(line + [f"{1e3 * x:.5g}" for x in (slip, stated, finest, error)] + [f"{error / max(stated, 1e-9):.3g}"])
                        compared += 1
                        same += slip == finest
                        if error <= stated + 1e-6:
                            within += 1
                        else:
                            outside.append(line)
                    sys.stdout.flush()
    print(f"# {within} of {compared} slips within their stated error of dt/32; {same} of them are its own")
    for line in outside:
        print(f"# outside: {', '.join(line)}")
    sys.exit(1 if outside or not compared else 0)


if __name__ == "__main__":
    main()
