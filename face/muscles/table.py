"""The table of muscles: presets/anatomy/muscles/, a file per group, as frozen rows, checked once."""

from __future__ import annotations

from pathlib import Path

from ...tables import read_toml
from ..figures import ANATOMY
from ..mechanism import MUSCLE_GROUPS, Mechanism
from .kinds import KINDS
from .row import MuscleRow


def read_muscles(path: Path = ANATOMY / "muscles") -> dict[str, MuscleRow]:
    """The rows of a table of muscles by name; `path` is a file, or a folder of them.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    rows: dict[str, MuscleRow] = {}
    for file in sorted(path.glob("*.toml")) if path.is_dir() else [path]:
        table = read_toml(file)
        table.only("mechanism", "source", "muscles")
        mechanism = table.choice("mechanism", MUSCLE_GROUPS)
        for name, raw in table.tables("muscles", optional=True).items():
            if name in rows:
                raise raw.refuse(f"is also a muscle of the group {rows[name].mechanism}")
            rows[name] = KINDS[raw.choice("kind", KINDS)].read(mechanism, name, raw)
    return rows


def muscles_of(mechanisms: frozenset[Mechanism]) -> dict[str, MuscleRow]:
    """The built-in rows whose group, and whose kind where it is not the paper's, is among some mechanisms."""
    flat = Mechanism.FLAT_PULLS in mechanisms
    return {name: row for name, row in read_muscles().items() if row.mechanism in mechanisms and (flat or row.of_paper)}
