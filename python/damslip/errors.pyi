from typing import Dict, List, Sequence, Union

from ._core import Result

class DamslipError(Exception):
    diagnostics: List[Dict[str, Union[str, int]]]
    file: str
    line: int
    column: int
    problem: str
    expected: str
    fix: str
    def __init__(self, text: str, diagnostics: Sequence[Dict[str, Union[str, int]]] = ()) -> None: ...

class InputError(DamslipError, ValueError): ...
class UsageError(InputError): ...
class NotConverged(DamslipError, ArithmeticError): ...

class Interrupted(KeyboardInterrupt):
    result: Result
    def __init__(self, result: Result) -> None: ...
