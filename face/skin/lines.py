"""Lines of the template laid on the skin of a face, which folds and creases run along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ..mesh.template import TemplateWarp
from .outer import OuterSkin

#: Points along a line, for its course.
COURSE = 49


@dataclass(frozen=True, eq=False)
class Beside:
    """Where the skin lies about a line.

    Attributes
    ----------
    across : (n,) signed distance, metres; positive away from the face's middle.
    share : (n,) share of the line's length at the nearest place on it.
    off : (n,) plain distance, metres.
    """

    across: Floats
    share: Floats
    off: Floats


@dataclass(frozen=True, eq=False)
class SkinLine:
    """A line on the skin.

    Attributes
    ----------
    course : (COURSE, 3) places along it, metres of head space.
    normal : (COURSE, 3) unit normals of the skin there.
    outwards : (COURSE, 3) unit directions along the skin across the line, away from the face's middle.
    """

    course: Floats
    normal: Floats
    outwards: Floats

    def beside(self, positions: Floats) -> Beside:
        """The skin (n, 3) about the line."""
        away = positions[:, None] - self.course
        flat = away - self.normal * (away * self.normal).sum(axis=2, keepdims=True)
        closest: Ints = np.argmin((flat**2).sum(axis=2) + 0.1 * (away**2).sum(axis=2), axis=1)
        every = np.arange(len(positions))
        return Beside(
            across=(flat[every, closest] * self.outwards[closest]).sum(axis=1),
            share=closest / (COURSE - 1.0),
            off=np.linalg.norm(away[every, closest], axis=1),
        )


def line_on(skin: OuterSkin, warp: TemplateWarp, line: Floats) -> SkinLine:
    """A line (k, 3) of the template, carried to the skin of a face."""
    course = warp(resampled(line, COURSE))
    _, nearest = skin.tree.query(course)
    normal = skin.normals[nearest]
    course = course + normal * (normal * (skin.positions[nearest] - course)).sum(axis=1, keepdims=True)
    outwards = np.cross(np.gradient(course, axis=0), normal)
    outwards /= np.maximum(np.linalg.norm(outwards, axis=1, keepdims=True), 1e-12)
    outwards *= np.copysign(1.0, (outwards[:, 0] * course[:, 0]).sum())
    return SkinLine(course, normal, outwards)


def resampled(line: Floats, count: int) -> Floats:
    """(count, 3) points at even distances along a line (k, 3)."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    places = np.linspace(0.0, along[-1], count)
    return np.column_stack([np.interp(places, along, line[:, axis]) for axis in range(3)])
