"""How far a concrete gravity dam slides in an earthquake.

    import damslip
    dam = damslip.load("dam.toml")
    print(dam.screen().yield_acceleration)               # m/s2
    print(dam.with_(contact__friction=0.7).screen().sentence)
    dam.fe().worst.slip                                  # m

Attributes are in SI units. Tables (to_pandas) have the columns of the command line's files, each with its unit in its
name, and the same digits.
"""

from . import errors
from ._core import (AccuracyResult, FeResult, FeRun, FragilityCurve, FragilityResult, ModesResult, Result, ScreenResult,
                    Slip, SweepResult, Table, __version__)
from .errors import DamslipError, InputError, Interrupted, NotConverged, UsageError
from .scene import Scene, load
from . import display as _display

_display.add_to(Result, Table)

__all__ = ["AccuracyResult", "DamslipError", "FeResult", "FeRun", "FragilityCurve", "FragilityResult", "InputError",
           "Interrupted", "ModesResult", "NotConverged", "Result", "Scene", "ScreenResult", "Slip", "SweepResult", "Table",
           "UsageError", "__version__", "errors", "load"]
