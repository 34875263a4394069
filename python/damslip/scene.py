"""A scene, and what can be computed of it."""

import os

from . import _core
from .errors import Interrupted, UsageError


def _toml_value(value, key):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        escaped = ""
        for c in os.fspath(value):
            escaped += "\\" + c if c in '\\"' else c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}"
        return f'"{escaped}"'
    if hasattr(value, "item") and getattr(value, "ndim", 1) == 0:  # a number of numpy
        value = value.item()
    if isinstance(value, (int, float)):
        return repr(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml_value(v, key) for v in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_toml_value(k, key)} = {_toml_value(v, key)}" for k, v in value.items()) + "}"
    raise UsageError(f"{key} = {value!r} is not allowed: a scene holds numbers, words, true or false, and lists of them")


def _toml(tables, path=""):
    """A scene of dictionaries as TOML: plain keys first, then tables, lists of dictionaries as [[name]]."""
    lines, below = [], []
    for key, value in tables.items():
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict):
            below.append(f"\n[{name}]\n" + _toml(value, name))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(v, dict) for v in value):
            below.extend(f"\n[[{name}]]\n" + _toml(v, name) for v in value)
        elif value is not None:
            lines.append(f"{key} = {_toml_value(value, name)}\n")
    return "".join(lines) + "".join(below)


def load(scene, folder="."):
    """A scene from a file, or from dictionaries with the keys of a file.

    scene:  path of a TOML file, or a dictionary: {"title": ..., "contact": {"friction": 0.77}, ...}
    folder: of a dictionary's record files
    Raises InputError with all that is wrong.
    """
    if isinstance(scene, dict):
        return Scene(_core.Scene(_toml(scene), os.path.join(os.fspath(folder), "scene of a dictionary")))
    return Scene(_core.Scene.read(os.fspath(scene)))


def _axis(values):
    if isinstance(values, str):
        return values
    if isinstance(values, (int, float)) or getattr(values, "ndim", 1) == 0:
        values = [values]
    return ",".join(v if isinstance(v, str) else repr(v.item() if hasattr(v, "item") else v) for v in values)


def _whole(result):
    if result.interrupted:
        raise Interrupted(result)
    return result


class Scene:
    """A checked scene; never changes. with_() makes others."""

    def __init__(self, opened):
        self._opened = opened

    def with_(self, keys=None, **more):
        """The same scene with other values: with_(contact__friction=0.7), or with_({"contact.friction": 0.7}).

        A double underscore stands for the dot; an entry of a list needs its brackets: with_({"lift_joint[crown].friction":
        0.8}). Names carry the unit, as in the file. keys() lists them. Raises InputError.
        """
        changes = list((keys or {}).items()) + [(k.replace("__", "."), v) for k, v in more.items()]
        plain = [(k, v if isinstance(v, (bool, str)) else float(v)) for k, v in changes]
        return Scene(self._opened._with(plain))

    def keys(self):
        """Names that with_() takes."""
        return self._opened.keys()

    def words(self, key):
        """What a key that is a choice can be; empty for numbers."""
        return self._opened.words(key)

    @property
    def title(self):
        return self._opened.title

    @property
    def file(self):
        return self._opened.file

    @property
    def notes(self):
        """What is unusual in the scene, a sentence each."""
        return self._opened.notes

    @property
    def allowable_slip(self):
        """criteria.allowable_slip [m]; None: no criterion."""
        return self._opened.allowable_slip

    def resolved(self):
        """The scene as TOML with all defaults."""
        return self._opened.resolved()

    def screen(self, rocking=False, jobs=0):
        """Rigid block and regressions, as `damslip screen`. jobs: threads, 0: all cores."""
        return self._opened._screen(jobs, rocking)

    def fe(self, polarity=None, mesh_error=True, spread=False, progress=None):
        """Finite elements, all records, as `damslip fe`.

        polarity: 1 or -1 alone; None: both, or the scene's. mesh_error, spread: as --no-mesh-error and --spread.
        progress(label, done, total) is called some twenty times a second. Raises NotConverged; Interrupted on Ctrl-C.
        """
        if polarity not in (None, 1, -1):
            raise UsageError(f"polarity={polarity!r} is not allowed: 1, -1, or None for both")
        return _whole(_core._fe(self._opened, polarity, mesh_error, spread, progress))

    def modes(self, count=10, transfer=False, progress=None):
        """Natural frequencies and damping, as `damslip modes`."""
        return _whole(_core._modes(self._opened, count, transfer, progress))

    def sweep(self, jobs=0, progress=None, **axes):
        """A grid, as `damslip sweep`: sweep(friction=[0.7, 0.8], method=["rigid", "fe"]).

        Axes: friction, friction_deg, level, uplift, opening_water, reservoir, size, scale, polarity, method; a value, a list,
        or a text as on the command line ("0.65:1.0:0.05"). What is not named is the scene's. Ctrl-C stops it and raises
        Interrupted, whose result has the rows that are finished.
        """
        return _whole(_core._sweep(self._opened, {k: _axis(v) for k, v in axes.items()}, jobs, progress))

    def accuracy(self, tolerance=0.02, quick=False, progress=None):
        """Every method on all records of the scene, what each errs and costs, as `damslip accuracy --all-records`."""
        return _whole(_core._accuracy(self._opened, tolerance, quick, progress))

    def __repr__(self):
        return f"<damslip.Scene {self.title!r} ({self.file})>"
