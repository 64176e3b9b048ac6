"""The table of muscles: presets/anatomy/muscles/, a file per group, as frozen rows, checked once."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...errors import FormatError
from ..mechanism import MUSCLE_GROUPS, Mechanism
from ..mesh.template import ANATOMY
from ..tables import read_toml
from .kinds import KINDS
from .row import MuscleRow


def _row(path: Path, mechanism: Mechanism, name: str, raw: Mapping[str, Any]) -> MuscleRow:
    """One checked row of the kind that it says."""
    kind = raw.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        raise FormatError(path, f"must be one of {', '.join(KINDS)}, not {kind!r}", key=f"muscles.{name}.kind")
    return KINDS[kind].read(path, mechanism, name, raw)


def _group(path: Path, raw: Mapping[str, Any]) -> Mechanism:
    """The group that a table says it is."""
    name = raw.get("mechanism")
    if name not in MUSCLE_GROUPS:
        raise FormatError(path, f"must be one of {', '.join(MUSCLE_GROUPS)}, not {name!r}", key="mechanism")
    return Mechanism(name)


def read_muscles(path: Path = ANATOMY / "muscles") -> dict[str, MuscleRow]:
    """The rows of a table of muscles by name; `path` is a file, or a folder of them.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    rows: dict[str, MuscleRow] = {}
    for file in sorted(path.glob("*.toml")) if path.is_dir() else [path]:
        raw = read_toml(file)
        mechanism = _group(file, raw)
        for name, row in raw.get("muscles", {}).items():
            if name in rows:
                raise FormatError(file, f"is also a muscle of the group {rows[name].mechanism}", key=f"muscles.{name}")
            rows[name] = _row(file, mechanism, name, row)
    return rows


def muscles_of(mechanisms: frozenset[Mechanism]) -> dict[str, MuscleRow]:
    """The built-in rows whose group, and whose kind where it is not the paper's, is among some mechanisms."""
    flat = Mechanism.FLAT_PULLS in mechanisms
    return {name: row for name, row in read_muscles().items() if row.mechanism in mechanisms and (flat or row.of_paper)}
