"""A scene, and what can be computed of it."""

import contextlib
import os
import tempfile

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


_UNITS = {"g": "levels_g", "m/s2": "levels_m_s2", "m/s": "levels_m_s", "cm/s": "levels_cm_s"}
_FRAGILITY = ("probability", "suite", "intensity", "limit", "hazard")


def _numbers(values):
    if hasattr(values, "tolist"):
        values = values.tolist()
    return [float(v) for v in (values if isinstance(values, (list, tuple)) else [values])]


def _record_rows(records):
    """A list of records as the CSV that [suite] files takes: files, or pairs of horizontal and vertical."""
    rows = []
    for record in records:
        files = [record, ""] if isinstance(record, (str, os.PathLike)) else list(record)
        files = [os.path.abspath(f) if f else "" for f in files]
        if len(files) != 2 or any(c in f for f in files for c in ",\n"):
            raise UsageError(f"record {record!r} is not allowed: a file, or a pair of horizontal and vertical file, without commas")
        rows.append(",".join(files))
    return "\n".join(["horizontal,vertical", *rows, ""])


def _fragility_tables(tables, records, levels, unit, measure, design, limits_mm):
    """The tables of a fragility that take the place of the scene's, as dictionaries."""
    given = {name: dict(t) if isinstance(t, dict) else t for name, t in (tables or {}).items()}
    for name in given:
        if name not in _FRAGILITY:
            raise UsageError(f"tables has no {name!r}: one of {', '.join(_FRAGILITY)}")
    intensity = given.get("intensity", {})
    if levels is not None:
        if unit not in _UNITS:
            raise UsageError(f"unit={unit!r} is not allowed: one of {', '.join(_UNITS)}")
        intensity[_UNITS[unit]] = _numbers(levels)
    for key, value in (("measure", measure), ("design", design)):
        if value is not None:
            intensity[key] = value
    if intensity:
        given["intensity"] = intensity
    if limits_mm is not None:
        given["limit"] = [{"quantity": "slip", "above_mm": v} for v in _numbers(limits_mm)]
    if records is not None:
        given.setdefault("suite", {})["files"] = os.path.abspath(records)
    return given


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

    def screen(self, rocking=False, jobs=0, rigid_only=False):
        """Rigid block and regressions, as `damslip screen`. jobs: threads, 0: all cores."""
        return self._opened._screen(jobs, rocking, rigid_only)

    def fe(self, polarity=None, mesh_error=True, spread=False, reduced=False, modes=None, progress=None):
        """Finite elements, all records, as `damslip fe`.

        polarity: 1 or -1 alone; None: both, or the scene's. mesh_error, spread, reduced, modes: as --no-mesh-error, --spread,
        --reduced and --modes.
        progress(label, done, total) is called some twenty times a second. Raises NotConverged; Interrupted on Ctrl-C.
        """
        if polarity not in (None, 1, -1):
            raise UsageError(f"polarity={polarity!r} is not allowed: 1, -1, or None for both")
        return _whole(_core._fe(self._opened, polarity, mesh_error, spread, reduced, modes, progress))

    def modes(self, count=None, transfer=False, progress=None):
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

    def fragility(self, records=None, levels=None, unit="g", limits_mm=None, method=None, measure=None, design=None,
                  samples=None, tables=None, share_rows=128, conditioning="auto", jobs=0, progress=None):
        """How likely the dam slides too far, as `damslip fragility`: fragility(records="suite/*.AT2", levels=[0.1, 0.2, 0.4],
        limits_mm=[10, 50]).

        records: folder, pattern, or CSV of a suite, or a list of files or of pairs (horizontal, vertical); levels: of the measure, in
        unit ("g", "m/s2", "m/s", "cm/s"); limits_mm: slips; tables: dictionaries of [probability], [suite], [intensity], [[limit]],
        [hazard] with the keys of a file. What is given takes the place of what the scene says; the rest is the scene's. method:
        "rigid", "rigid-v", "fe", ...; samples, share_rows, conditioning: as
        --samples, --share-rows, --conditioning. Ctrl-C stops it and
        raises Interrupted, whose result has the runs that are finished; those that are not count as missing.
        """
        listed = records is not None and not isinstance(records, (str, os.PathLike))
        folder = tempfile.TemporaryDirectory() if listed else contextlib.nullcontext()
        with folder as place:
            if listed:
                rows = _record_rows(records)
                records = os.path.join(place, "records.csv")
                with open(records, "w", encoding="utf-8") as out:
                    out.write(rows)
            given = _fragility_tables(tables, records, levels, unit, measure, design, limits_mm)
            return _whole(_core._fragility(self._opened, _toml(given), method or "", samples, share_rows, conditioning, jobs,
                                           progress))

    def __repr__(self):
        return f"<damslip.Scene {self.title!r} ({self.file})>"
