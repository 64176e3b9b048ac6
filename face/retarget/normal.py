"""A motion and the effects of controls as normal equations of least squares.

Each control is scaled to move the skin by one metre root mean square per value 1, so that a penalty means the same for
all of them; a control that moves no skin, an eye's, is scaled by what it does to points and eyeballs.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Floats
from .sight import Sight


@dataclass(frozen=True, eq=False)
class Seen:
    """What is seen of displacements: of controls (K rows), or of a motion's frames (T rows).

    Attributes
    ----------
    skin : (., 3n) outer skin. points : (., m) what FAPs and gaze are read from. Both in head space, metres.
    """

    skin: Floats
    points: Floats

    @cached_property
    def square(self) -> Floats:
        """Inner products of the rows of `skin`."""
        return np.asarray(self.skin @ self.skin.T)


def seen(sight: Sight, displacements: Iterable[Floats]) -> Seen:
    """What is seen of displacements (V, 3) in head space, one after another."""
    skin, points = [], []
    for moved in displacements:
        skin.append(sight.of_skin(moved))
        points.append(sight.of_points(moved))
    return Seen(np.array(skin), np.array(points))


@dataclass(frozen=True, eq=False)
class Wishes:
    """A motion as the controls see it.

    Attributes
    ----------
    skin : (T, K) inner products of the motion's skin with that of each control. points : (T, m) its points.
    size : (T,) squared length of the motion's skin.
    """

    skin: Floats
    points: Floats
    size: Floats


@dataclass(frozen=True, eq=False)
class Normal:
    """Least squares over skin and points: the w with the least ``w @ matrix @ w / 2 - right @ w``.

    Attributes
    ----------
    matrix : (K, K) with ones on its diagonal. right : (T, K).
    scale : (K,) w = scale * value of a control.
    """

    matrix: Floats
    right: Floats
    scale: Floats


def normal_equations(controls: Seen, asked: Wishes, weights: Floats) -> Normal:
    """The normal equations in which points count as `weights` (m,) say, where all skin counts 1."""
    weight = max(controls.skin.shape[1] // 3, 1) * weights
    counted = np.flatnonzero(weight)
    points = controls.points[:, counted]
    plain = controls.square + (weight[counted] * points) @ points.T
    scale = np.sqrt(np.diagonal(plain))
    scale = np.where(scale > 0.0, scale, 1.0)
    right = asked.skin + (weight * asked.points)[:, counted] @ points.T
    return Normal(plain / np.outer(scale, scale), right / scale, scale)
