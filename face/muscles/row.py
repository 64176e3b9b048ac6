"""A row of the table of muscles: what all kinds have in common, and how a kind says what its own rows hold.

A kind is a frozen dataclass in a file of its own that inherits from `MuscleRow`, or from `SpanRow` or `EllipseRow`. Its
fields are the figures of its rows, and their types say how a table writes them (`figures`): a `float` is a number as it
stands, a `Length` is in millimetres under `name_mm`, a `Place` is warped onto each face. A field with a default may be
left out of a table. What the muscle does to the skin is its `pull`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields, replace
from enum import StrEnum
from typing import ClassVar, Self

import numpy as np

from ...arrays import Floats
from ...tables import KeyedTable
from ..mechanism import Mechanism
from ..mesh.template import TemplateWarp
from ..skin.outer import OuterSkin
from .figures import Figure, Length, figures_of

MIRROR = np.array([-1.0, 1.0, 1.0])


class Sides(StrEnum):
    """Whether a muscle is one of a pair, or one muscle whose halves contract on their own."""

    PAIR = "pair"
    HALVES = "halves"


class Region(StrEnum):
    """The skin that a muscle inserts in."""

    ALL = "all"
    BROW = "brow"
    CHEEK = "cheek"
    CHEEK_POUCH = "cheek2"
    UPPER = "upper"
    LOWER = "lower"
    NOSE = "nose"


@dataclass(frozen=True, kw_only=True, eq=False)
class MuscleRow(ABC):
    """One row of the table, of the left side on the template; or the same on either side of a face (`placed`).

    Attributes
    ----------
    name : of the row, without a side. mechanism : the group that it belongs to. title, au : for people.
    region : the skin that it inserts in.
    prior, amplitude : usual and largest displacement of skin, metres.
    side : +1 left, -1 right.
    """

    kind: ClassVar[str]
    of_paper: ClassVar[bool] = False
    """Whether the kind is one of the three classes of Zhang, Sung, Prakash 2001."""

    name: str
    mechanism: Mechanism
    title: str
    au: str
    sides: Sides
    region: Region
    prior: Length
    amplitude: Length
    side: int = 1

    @classmethod
    def figures(cls) -> Mapping[str, Figure]:
        """Key in the table -> the figure that it writes."""
        return figures_of(cls, besides=("name", "mechanism", "side"))

    @classmethod
    def needed(cls) -> frozenset[str]:
        """The keys that a table must give."""
        optional = {field.name for field in fields(cls) if field.default is not MISSING}
        return frozenset(key for key, figure in cls.figures().items() if figure.field not in optional)

    @classmethod
    def read(cls, mechanism: Mechanism, name: str, raw: KeyedTable) -> Self:
        """A row of this kind from what a table says under its name.

        Raises
        ------
        FormatError : names the file, the key and the rule that is broken.
        """
        figures = cls.figures()
        if missing := [key for key in figures if key in cls.needed() and key not in raw.cells]:
            raise raw.refuse(f"a {cls.kind} muscle needs {', '.join(missing)}")
        raw.only("kind", *figures)
        given = {figures[key].field: figures[key].read(raw, key) for key in raw if key != "kind"}
        return cls(name=name, mechanism=mechanism, **given)

    def placed(self, side: int, warp: TemplateWarp) -> Self:
        """The row on one side of a face, +1 left or -1 right, in head space."""
        turn = np.ones(3) if side > 0 else MIRROR
        carried = {f.field: f.carry(getattr(self, f.field), turn, warp) for f in self.figures().values()}
        return replace(self, side=side, **carried)

    @abstractmethod
    def pull(self, skin: OuterSkin) -> Floats:
        """(n, 3) pull per area of a face's skin at full contraction, up to a factor, of a row placed on that face."""

    @abstractmethod
    def strands(self) -> tuple[Floats, Floats]:
        """Lines to look at: (s, n, 3) in head space, and (n,) how far their points go with the skin, 0 to 1."""
