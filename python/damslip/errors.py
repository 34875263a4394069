"""What can go wrong. The text of an error says what is wrong, what is allowed and what to do."""


class DamslipError(Exception):
    """Of the first of its diagnostics: file, line, column, problem, expected, fix."""

    def __init__(self, text, diagnostics=()):
        super().__init__(text)
        self.diagnostics = list(diagnostics)
        first = self.diagnostics[0] if self.diagnostics else {}
        self.file = first.get("file", "")
        self.line = first.get("line", 0)
        self.column = first.get("column", 0)
        self.problem = first.get("problem", text)
        self.expected = first.get("expected", "")
        self.fix = first.get("fix", "")


class InputError(DamslipError, ValueError):
    """A file, or a value in it, is wrong; nothing was computed. All that is wrong is in diagnostics."""


class UsageError(InputError):
    """What was asked for is wrong: an axis that does not exist, a method that cannot take this scene."""


class NotConverged(DamslipError, ArithmeticError):
    """A solver found no answer. Nothing is said of the dam."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C, after something was finished: it is in result."""

    def __init__(self, result):
        super().__init__("interrupted; what was finished is in .result of this exception")
        self.result = result
