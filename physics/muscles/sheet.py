"""The sheet muscle: almost parallel fibres over a rectangle, all pulling the same way."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from .windows import finite_array, longitudinal, positive


@dataclass(frozen=True, eq=False)
class SheetMuscle:
    """A sheet muscle; Zhang, Sung and Prakash 2001, section 3.3, equations (18)-(22).

    The zone is the rectangle about the line between the middles of the attachment and the insertion line: W_j, the
    mean length of the two lines, across it, and `length` along it, starting at the attachment. Across, the paper has no
    fall-off, only the edge. Distance is from the (endless) attachment line, in space.

    Parameters
    ----------
    attachment_line, insertion_line : (2, 3) m, their ends in the same order (left with left).
    length : L_j, m, of the zone; longer than the distance of the lines' middles (delta > 1).
    exponent : eta_j > 0; smaller spreads the influence along the muscle.
    scale : alpha_st, N, the force at the insertion line at contraction 1.

    Raises
    ------
    ParameterError : a figure outside its rule.
    """

    attachment_line: Floats
    insertion_line: Floats
    length: float = field(kw_only=True)
    exponent: float = field(kw_only=True)
    scale: float = field(default=1.0, kw_only=True)

    def __post_init__(self) -> None:
        for name in ("attachment_line", "insertion_line"):
            line = finite_array(name, getattr(self, name), (2, 3))
            object.__setattr__(self, name, line)
            if not np.linalg.norm(line[1] - line[0]) > 0:
                raise ParameterError(name, "must have two different ends", line.tolist())
        if not self.fibre_length > 0:
            raise ParameterError("insertion_line", "must be apart from the attachment line", "at its middle")
        if not (np.isfinite(self.length) and self.length > self.fibre_length):
            raise ParameterError(
                "length", f"must exceed the fibres' length {self.fibre_length:.4g} m (delta > 1, eq. 22)", self.length
            )
        across = self.attachment_line[1] - self.attachment_line[0]
        if not across @ (self.insertion_line[1] - self.insertion_line[0]) > 0:
            raise ParameterError("insertion_line", "must point like the attachment line; swap its ends", "reversed")
        if np.linalg.norm(np.cross(across, self.direction)) < 1e-6 * np.linalg.norm(across):
            raise ParameterError("attachment_line", "must not run along the fibres", self.attachment_line.tolist())
        positive("exponent", self.exponent)
        positive("scale", self.scale)

    @property
    def fibre_length(self) -> float:
        """Between the middles of the two lines, |m^Ac - m^Ic|, m."""
        return float(np.linalg.norm(self.attachment_line.mean(axis=0) - self.insertion_line.mean(axis=0)))

    @property
    def width(self) -> float:
        """W_j, the mean length of the two lines, m."""
        ends = np.stack([self.attachment_line, self.insertion_line])
        return float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).mean())

    @property
    def direction(self) -> Floats:
        """The pull (3,), a unit vector from the insertion to the attachment; equation (19)."""
        return np.asarray((self.attachment_line.mean(axis=0) - self.insertion_line.mean(axis=0)) / self.fibre_length)

    def force(self, positions: Floats) -> Floats:
        """Force at contraction 1 on nodes at `positions` (V, 3) m: (V, 3) N, equation (18). Zero outside the zone."""
        pull = self.direction
        offset = np.asarray(positions, dtype=np.float64) - self.attachment_line.mean(axis=0)
        line = self.attachment_line[1] - self.attachment_line[0]
        line = line / np.linalg.norm(line)
        distance = np.linalg.norm(np.cross(offset, line), axis=1)
        sideways = line - (line @ pull) * pull
        sideways = sideways / np.linalg.norm(sideways)
        inside = (offset @ pull <= 0) & (np.abs(offset @ sideways) <= self.width / 2)
        ratio, reach = distance[inside] / self.fibre_length, self.length / self.fibre_length  # (21), (22)
        window = np.zeros(len(offset))
        window[inside] = longitudinal(ratio, reach, self.exponent)  # (20)
        return np.asarray((self.scale * window)[:, None] * pull)
