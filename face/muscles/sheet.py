"""The second paper's sheet muscle (equations 18-22): from a line of the bone to a line of the skin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ...physics.muscles import SheetMuscle
from ..figures import Length, read_figures
from ..mechanism import Mechanism
from ..mechanisms import brow
from ..skin.outer import OuterSkin
from .figures import Line
from .span import SpanRow


@dataclass(frozen=True)
class SheetFigures:
    """Of every sheet (presets/anatomy/skin.toml)."""

    deep: Length


SHEET = read_figures("skin.sheet_muscle", SheetFigures)


@dataclass(frozen=True, kw_only=True, eq=False)
class SheetRow(SpanRow):
    """Figures of the equations: eta and delta.

    Attributes
    ----------
    reaction, reaction_at : how strongly a sheet without bony origin pulls that back, at which share of its length.
    """

    kind: ClassVar[str] = "sheet"
    of_paper: ClassVar[bool] = True

    attachment: Line
    insertion: Line
    exponent: float
    reach: float
    reaction: float = 0.0
    reaction_at: float = 0.0

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`: the paper's pull along the skin, fading to the sheet's edges, and on its own origin."""
        attachment, insertion = self.attachment, self.insertion
        origin, end = attachment.mean(axis=0), insertion.mean(axis=0)
        axis = end - origin
        length = float(np.linalg.norm(axis))
        axis = axis / length
        across = (attachment[1] - attachment[0] + insertion[1] - insertion[0]) / 2.0
        across = across - axis * (across @ axis)
        width = float(np.linalg.norm(across))
        paper = SheetMuscle(attachment, insertion, length=self.reach * length, exponent=self.exponent)
        if not skin.has(Mechanism.FADING):
            return paper.force(skin.positions)
        away = skin.positions - origin
        latitude = np.abs(away @ (across / width)) / (width / 2.0)
        window = np.cos(np.minimum(latitude, 1.0) ** 4 * np.pi / 2.0)
        back = brow.scalp_reaction(skin, away @ axis / length, self.reaction, self.reaction_at)
        deep = np.exp(-((np.abs(away @ np.cross(axis, across / width)) / SHEET.deep) ** 4))
        force = paper.force(skin.positions) + back[:, None] * axis
        return skin.tangential(force * (window * deep)[:, None])
