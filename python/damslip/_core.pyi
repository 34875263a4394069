from typing import Callable, Dict, List, Optional, Tuple, Union

import numpy
import numpy.typing
import pandas

Array = numpy.typing.NDArray[numpy.float64]
CountArray = numpy.typing.NDArray[numpy.uint64]
IntegerArray = numpy.typing.NDArray[numpy.int32]
Progress = Optional[Callable[[str, float, float], object]]

__version__: str

class Table:
    title: str
    notes: List[str]
    keys: List[str]
    headings: List[str]
    units: List[str]
    def to_dict(self) -> Dict[str, list]: ...
    def to_pandas(self) -> pandas.DataFrame: ...
    def csv(self) -> str: ...
    def __len__(self) -> int: ...

class Result:
    @property
    def tables(self) -> Dict[str, Table]: ...
    @property
    def sentence(self) -> str: ...
    @property
    def outcome(self) -> str: ...
    @property
    def interrupted(self) -> bool: ...
    def to_pandas(self, table: Optional[str] = None) -> pandas.DataFrame: ...
    def json(self) -> dict: ...
    def json_text(self) -> str: ...
    def report(self) -> str: ...
    def write_report(self, file: str) -> None: ...

class Slip:
    record: str
    polarity: int
    pga: float
    vertical_pga: float
    slip: Optional[float]
    max_slip: Optional[float]
    method: str
    status: str
    verdict: str

class ScreenResult(Result):
    yield_acceleration: float
    critical_friction: float
    slips: List[Slip]
    warnings: List[str]

class FeRun:
    record: str
    polarity: int
    status: str
    message: str
    verdict: str
    slip: Optional[float]
    max_slip: Optional[float]
    slip_error: Optional[float]
    step_error: Optional[float]
    mesh_error: Optional[float]
    rigid_slip: Optional[float]
    time_step: float
    end_time: float
    energy_error: float
    time: Array
    ground_acceleration: Array
    ground_acceleration_up: Array
    slip_history: Array
    slip_heel: Array
    slip_middle: Array
    slip_toe: Array
    rocking: Array
    crest_x: Array
    normal_force: Array
    shear_force: Array
    open_length: Array
    slipping_length: Array
    largest_opening: Array
    pair_pressure: Array
    pair_shear: Array
    pair_slip: Array
    pair_opening: Array
    distance: Array
    pressure_at_end: Array
    shear_at_end: Array
    slip_at_end: Array
    opening_at_end: Array

class FeResult(Result):
    runs: List[FeRun]
    worst: Optional[FeRun]
    verdict: str
    complete: bool
    model_spread: str
    warnings: List[str]

class ModesResult(Result):
    frequencies: Array
    complete: bool

class SweepResult(Result):
    complete: bool
    finished: int
    def __len__(self) -> int: ...

class AccuracyResult(Result):
    choice: Optional[str]

class FragilityCurve:
    limit: str
    allowable: float
    intensity: Array
    probability: Array
    probability_low: Array
    probability_high: Array
    lower: Array
    upper: Array
    runs: Array
    failures: Array
    median: Optional[float]
    beta: Optional[float]
    rate: Optional[Tuple[float, float]]

class FragilityResult(Result):
    curves: List[FragilityCurve]
    complete: bool
    finished: int
    method: str
    measure: str
    share_not_standing: float
    warnings: List[str]
    records: List[str]
    variables: List[str]
    intensity: Array
    level: CountArray
    record: CountArray
    polarity: IntegerArray
    factor: Array
    draw: CountArray
    slip: Array
    max_slip: Array
    def drawn(self, variable: str) -> List[Union[float, bool, str]]: ...
    def __len__(self) -> int: ...

class Scene:
    title: str
    file: str
    notes: List[str]
    allowable_slip: Optional[float]
    def __init__(self, text: str, file: str) -> None: ...
    @staticmethod
    def read(file: str) -> Scene: ...
    def keys(self) -> List[str]: ...
    def words(self, key: str) -> List[str]: ...
    def resolved(self) -> str: ...
