"""Every error Risorius raises on purpose.

Pure code raises these and never prints; the Blender operators turn them into reports and the command line
into exit code 1. Each message names the thing that is wrong and the remedy.
"""

from __future__ import annotations

from pathlib import Path

#: Characters of a message, which may list all muscles; of what is told about a file, and of a name or value,
#: which may be of any length.
LONGEST, LONGEST_ABOUT_FILES, LONGEST_PART = 4000, 500, 120


def short(text: str, most: int = LONGEST_PART) -> str:
    """A text that people read: what is longer loses its middle, for the remedy stands at the end."""
    return text if len(text) <= most else f"{text[: most // 2]} ... {text[-(most // 3) :]}"


class RisoriusError(Exception):
    """Root of the tree: catch this to catch everything Risorius raises on purpose."""

    def __init__(self, message: str = "") -> None:
        super().__init__(short(message, LONGEST))


class FormatError(RisoriusError):
    """A file that cannot be read: says where, what is wrong and how to mend it.

    Parameters
    ----------
    path : the file, or a name for the stream.
    problem : what is wrong, and the remedy.
    line : 1-based line number, where the file is text.
    offset : byte offset, where the file is binary.
    column : name of a column, where the file is a table of rows (CSV).
    key : dotted key, where the file is a table of keys (TOML, JSON).
    """

    def __init__(
        self,
        path: str | Path,
        problem: str,
        *,
        line: int | None = None,
        offset: int | None = None,
        column: str | None = None,
        key: str | None = None,
    ) -> None:
        self.path, self.problem, self.line, self.offset = path, problem, line, offset
        self.column, self.key = column, key
        where = str(path)
        if line is not None:
            where += f", line {line}"
        if offset is not None:
            where += f", byte {offset}"
        if column is not None:
            where += f", column {short(column)}"
        if key is not None:
            where += f", key {short(key)}"
        super().__init__(f"{where}: {short(problem, LONGEST_ABOUT_FILES)}")


class ModelError(RisoriusError):
    """A face that lacks something the request needs (a feature point, a part, a skin)."""


class ParameterError(RisoriusError, ValueError):
    """A value outside its rule: carries the name, the rule and the value."""

    def __init__(self, name: str, rule: str, value: object) -> None:
        self.name, self.rule, self.value = name, rule, value
        super().__init__(f"{name} {rule}, but it is {short(repr(value))}")


class SolverError(RisoriusError):
    """A numerical solution that was not reached; carries frame, step and residual where known."""

    def __init__(
        self,
        problem: str,
        *,
        frame: int | None = None,
        step: int | None = None,
        residual: float | None = None,
    ) -> None:
        self.problem, self.frame, self.step, self.residual = problem, frame, step, residual
        known = [
            f"{name} {value:.3g}" if isinstance(value, float) else f"{name} {value}"
            for name, value in (("frame", frame), ("step", step), ("residual", residual))
            if value is not None
        ]
        super().__init__(problem + (f" ({', '.join(known)})" if known else ""))

    def in_frame(self, frame: int) -> SolverError:
        """The same error of a motion, which knows the frame too; one of a part of it becomes one of the whole."""
        problem = self.problem if self.frame is not None else f"the motion could not be solved: {self.problem}"
        return SolverError(problem, frame=frame, step=self.step, residual=self.residual)


class SceneError(RisoriusError):
    """Something in the Blender scene that Risorius refuses to touch: names the object and what to do."""

    def __init__(self, thing: str, problem: str) -> None:
        self.thing, self.problem = thing, problem
        super().__init__(f"{thing}: {problem}")
