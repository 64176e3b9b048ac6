"""Brows that show on a face: where they are sought, and the feature points of their middle lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ....arrays import Floats

#: Where brows are sought: from the inner eye corner, towards the ear and upwards, shares of the eyes' width; the width
#: of a pixel.
ASIDE, UP, PIXEL = (-0.2, 0.6), (0.1, 0.44), 0.012
#: Shortest, longest and thickest brow; how far that of one side may lie above that of the other; shares of the width.
SHORTEST, LONGEST, THICKEST, UNEVEN = 0.22, 0.7, 0.17, 0.06
#: Where brows usually arch, share of their length, and how firmly that is believed of straight ones.
ARCH, ARCH_COST = 0.6, 0.06
#: Blur of a brow's line, pixels.
LINE_BLUR = 3.0


@dataclass(frozen=True, eq=False)
class Eye:
    """An eye: its inner corner (x, z) and the direction towards the ear, in the picture; the width of both eyes."""

    inner: Floats
    outward: Floats
    width: float

    def local(self, places: Floats) -> Floats:
        """(N, 2) how far places (N, 2) of the picture lie towards the ear and upwards, shares of the width."""
        up = self.upward()
        return np.column_stack([(places - self.inner) @ self.outward, (places - self.inner) @ up]) / self.width

    def place(self, aside: float, up: float) -> Floats:
        """(2,) the other way."""
        return np.asarray(self.inner + self.width * (aside * self.outward + up * self.upward()))

    def upward(self) -> Floats:
        """(2,) at a right angle to the way outward."""
        x, z = self.outward
        return np.asarray(np.array([-z, x]) * np.sign(x), dtype=np.float64)


def box_of_brows(places: Mapping[str, Floats]) -> tuple[Floats, Floats]:
    """Least and greatest (3,) of the box that brows are sought in, from the eye corners, template coordinates."""
    corners = np.array([places[name] for name in ("3.7", "3.11", "3.8", "3.12")])
    width = float(np.linalg.norm(places["3.7"] - places["3.12"]))
    low = corners.min(axis=0) - width * np.array([0.35, 0.6, 0.0])
    high = corners.max(axis=0) + width * np.array([0.35, 0.4, UP[1] + 0.1])
    return low, high


def brow_points(places: Mapping[str, Floats], line_of: Callable[[Eye], Floats | None]) -> dict[str, Floats]:
    """Name -> (x, z) of the brows' feature points in template coordinates; none unless both brows show.

    Parameters
    ----------
    places : name -> (3,) the eye corners.
    line_of : (N, 2) the middle line of the brow over an eye from its inner end to its outer one, as `Eye.local`, or
        None where there is none.
    """
    picture = [0, 2]
    width = float(np.linalg.norm(places["3.7"] - places["3.12"]))
    across = (places["3.7"] - places["3.12"])[picture]
    across /= np.linalg.norm(across)
    found: dict[str, tuple[float, float]] = {}
    brows = []
    for inner, outward, names in (("3.11", across, ("4.1", "4.3", "4.5")), ("3.8", -across, ("4.2", "4.4", "4.6"))):
        eye = Eye(places[inner][picture], outward, width)
        line = line_of(eye)
        if line is None:
            return {}
        brows.append(line)
        top = line[_uppermost(line)]
        for name, (aside, up) in zip(names, (line[0], top, line[-1]), strict=True):
            found[name] = tuple(eye.place(float(aside), float(up)))
    if abs(brows[0][:, 1].mean() - brows[1][:, 1].mean()) > UNEVEN:
        return {}
    return {name: np.array(place) for name, place in found.items()}


def _uppermost(line: Floats) -> int:
    """The highest place of a brow's line; of a straight one that where brows usually arch."""
    share = np.linspace(0.0, 1.0, len(line))
    return int((line[:, 1] - ARCH_COST * (share - ARCH) ** 2).argmax())
