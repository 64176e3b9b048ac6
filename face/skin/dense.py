"""The outer skin of a dense mesh: it is solved on a share of its vertices, and takes from these what is smooth."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...progress import Progress, Work, stepwise, worked_out
from .coarse import Thinning
from .outer import OuterSkin


@dataclass(frozen=True, eq=False)
class DenseSkin(OuterSkin):
    """A skin of more vertices than are solved."""

    @classmethod
    def of(cls, skin: OuterSkin) -> DenseSkin:
        """The same skin, to be solved on fewer vertices."""
        return cls(**{each.name: getattr(skin, each.name) for each in fields(OuterSkin)})

    @cached_property
    def thinning(self) -> Thinning:
        """The skin thinned out."""
        return Thinning(self)

    @stepwise
    def normals(self) -> Work[Floats]:
        """(n, 3) as of any skin, averaged on the few vertices: to do so on all of them takes seconds at a stretch."""
        yield from worked_out(self.thinning, "carry")
        yield from worked_out(self.thinning.skin, "normals")
        yield Progress(1.0, "Preparing the skin")
        carried = np.asarray(self.thinning.carry @ self.thinning.skin.normals)
        return np.asarray(carried / np.maximum(np.linalg.norm(carried, axis=1, keepdims=True), 1e-12))
