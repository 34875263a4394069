"""Where program and examples are, and modules that a test needs."""

import importlib
import os
import subprocess
import sys
import pathlib

PROGRAM = os.environ.get("DAMSLIP_PROGRAM", "build/release/damslip")
SOURCE = pathlib.Path(os.environ.get("DAMSLIP_SOURCE", "."))
EXAMPLES = SOURCE / "examples"


def need(*modules):
    """Ends the test as skipped, with a word, where a module is not there."""
    for name in modules:
        try:
            importlib.import_module(name)
        except ImportError as missing:
            print(f"skipped: {missing}; scripts/python.sh installs what is missing")
            sys.exit(77)


def program(*arguments):
    """Standard output of the program; exit codes 0 and 4 are answers."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if run.returncode not in (0, 4):
        raise AssertionError(f"{arguments}: {run.stderr}")
    return run.stdout
