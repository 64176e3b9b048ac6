"""Biphasic springs: soft at low strain, stiffer past a threshold, on every side and diagonal of the skin's polygons.

Zhang, Sung and Prakash 2001, section 2, equations (1)-(5), with lengths made relative: extension and threshold are
strains (change of length over rest length), so one preset serves every mesh density and every unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np
from scipy import sparse

from ..arrays import Floats, Ints, Singles
from ..errors import ParameterError
from .elastic import dirichlet_springs, pair_laplacian
from .mesh import Polygons, Sparse


class SpringLaw(StrEnum):
    """How tension passes the threshold."""

    CONTINUOUS = "continuous"
    """k_l e up to the threshold, then k_l e_c + k_h (e - e_c): real tissue, and every solver, needs no jump."""
    PRINTED = "printed"
    """Equation (3) as printed, k_l e or k_h e: the tension jumps at the threshold, where a spring then has no place of
    balance. For comparison, with `rk2`; the implicit and the equilibrium solver raise where they meet the jump."""


def spring_tension(
    extension: Floats | float,
    *,
    stiffness_low: Floats | float,
    stiffness_high: Floats | float,
    threshold: Floats | float,
    law: SpringLaw | str = "continuous",
) -> Floats:
    """Tension of biphasic springs; equation (3), made continuous unless told otherwise.

    Parameters
    ----------
    extension : strain, (r - r^r) / r^r, dimensionless, any shape; negative where a spring is compressed.
    stiffness_low, stiffness_high : k_l and k_h, N per unit of strain (spring constant times rest length).
    threshold : strain e^c past which k_h holds.
    law : `SpringLaw`, or its name.

    Returns
    -------
    Tension in N, positive when it pulls the ends together; the common shape of the arguments.

    Raises
    ------
    ParameterError : unknown law.
    """
    extra = np.subtract(stiffness_high, stiffness_low)
    e = np.asarray(extension, dtype=np.float64)
    return _tension_and_work(e, np.asarray(stiffness_low), extra, np.asarray(threshold), spring_law(law))[0]


def spring_energy(
    extension: Floats | float,
    *,
    stiffness_low: Floats | float,
    stiffness_high: Floats | float,
    threshold: Floats | float,
    law: SpringLaw | str = "continuous",
) -> Floats:
    """Integral of `spring_tension` over the strain from 0: energy in N; times the rest length, in J. Same arguments."""
    extra = np.subtract(stiffness_high, stiffness_low)
    e = np.asarray(extension, dtype=np.float64)
    return _tension_and_work(e, np.asarray(stiffness_low), extra, np.asarray(threshold), spring_law(law))[1] / 2


def spring_law(law: SpringLaw | str) -> SpringLaw:
    """The law of that name, or a ParameterError that lists the names."""
    try:
        return SpringLaw(law)
    except ValueError:
        raise ParameterError("law", f"must be one of {[str(known) for known in SpringLaw]}", law) from None


def _tension_and_work(e: Floats, low: Floats, extra: Floats, limit: Floats, law: SpringLaw) -> tuple[Floats, Floats]:
    """Tension and twice its integral; `extra` is k_h - k_l. Homogeneous: strains with N, or lengths with N/m."""
    base = low * e
    over = np.maximum(e - limit, 0.0)
    if law is SpringLaw.CONTINUOUS:
        beyond = extra * over
        return base + beyond, base * e + beyond * over
    return base + extra * (over > 0) * e, base * e + extra * over * (e + limit)


@dataclass(frozen=True, eq=False)
class SpringNetwork:
    """Springs between the nodes of a skin.

    Parameters
    ----------
    vertex_count : V.
    i, j : (S,) int64, the nodes each spring joins.
    rest_length : (S,) m, above 0.
    stiffness_low, stiffness_high : (S,) spring constants in N/m below and above the threshold, >= 0.
    threshold : (S,) strain, >= 0.
    law : `SpringLaw`, or its name.

    Raises
    ------
    ParameterError : shapes that do not fit or values outside their rule.
    """

    vertex_count: int
    i: Ints
    j: Ints
    rest_length: Floats
    stiffness_low: Floats
    stiffness_high: Floats
    threshold: Floats
    law: SpringLaw = SpringLaw.CONTINUOUS

    def __post_init__(self) -> None:
        object.__setattr__(self, "law", spring_law(self.law))
        count = len(self.i)
        for name in ("i", "j"):
            index = np.array(getattr(self, name), dtype=np.int64)
            if index.shape != (count,) or (count and (index.min() < 0 or index.max() >= self.vertex_count)):
                raise ParameterError(name, f"must be ({count},) vertex indices below {self.vertex_count}", index.shape)
            object.__setattr__(self, name, index)
        for name in ("rest_length", "stiffness_low", "stiffness_high", "threshold"):
            values = np.array(getattr(self, name), dtype=np.float64)
            if values.shape != (count,) or not np.isfinite(values).all() or (values < 0).any():
                raise ParameterError(name, f"must be ({count},) finite values, none negative", values.shape)
            object.__setattr__(self, name, values)
        if (self.rest_length == 0).any():
            raise ParameterError("rest_length", "must be above 0; merge doubled vertices", 0.0)

    @classmethod
    def from_polygons(
        cls,
        vertices: Floats,
        polygons: Polygons,
        *,
        stiffness: Floats | float,
        stiffening: float,
        threshold: float,
        law: SpringLaw | str = "continuous",
    ) -> SpringNetwork:
        """Springs on all sides and diagonals, stiff in proportion to the area they stand for.

        Parameters
        ----------
        vertices : (V, 3) m, at rest.
        polygons : see `mesh`.
        stiffness : membrane stiffness w at low strain, N/m, one value or (V,) (a spring takes its ends' mean). A
            spring's constant is w * 2 A / (n |e|^2) summed over its polygons, as in `elastic.laplacian`: the sheet is
            the same at any mesh density, with Young's modulus times thickness 2 w / 3 and Poisson's ratio 1/3.
        stiffening : k_h / k_l, >= 1.
        threshold : strain at which the springs stiffen.
        law : `SpringLaw`, or its name.

        Raises
        ------
        ParameterError : values outside their rule.
        """
        springs = dirichlet_springs(np.asarray(vertices, dtype=np.float64), polygons)
        return cls.between(vertices, *springs, stiffness=stiffness, stiffening=stiffening, threshold=threshold, law=law)

    @classmethod
    def between(
        cls,
        vertices: Floats,
        pairs: Ints,
        weights: Floats,
        *,
        stiffness: Floats | float,
        stiffening: float,
        threshold: float,
        law: SpringLaw | str = "continuous",
    ) -> SpringNetwork:
        """Springs between pairs (S, 2) of vertices with weights (S,), as of `elastic.dirichlet_springs`.

        The other parameters and the errors are those of `from_polygons`.
        """
        if not (np.isfinite(stiffening) and stiffening >= 1):
            raise ParameterError("stiffening", "must be 1 or more (k_h at least k_l)", stiffening)
        vertices = np.asarray(vertices, dtype=np.float64)
        i, j = pairs.T
        length = np.linalg.norm(vertices[j] - vertices[i], axis=1)
        real = (length > 0) & (weights > 0)  # a doubled vertex gives a spring that has no direction
        i, j, length, weights = i[real], j[real], length[real], weights[real]
        membrane = np.broadcast_to(np.asarray(stiffness, dtype=np.float64), (len(vertices),))
        low = weights * (membrane[i] + membrane[j]) / 2
        return cls(len(vertices), i, j, length, low, stiffening * low, np.full(len(i), threshold), spring_law(law))

    @cached_property
    def incidence(self) -> Sparse:
        """(S, V) sparse: row s has -1 at i and +1 at j, so that `incidence @ positions` is x_j - x_i."""
        count = len(self.i)
        columns = np.stack([self.i, self.j], axis=1).astype(np.int32).ravel()
        starts = np.arange(0, 2 * count + 1, 2, dtype=np.int32)
        return sparse.csr_array((np.tile([-1.0, 1.0], count), columns, starts), shape=(count, self.vertex_count))

    @cached_property
    def _scatter(self) -> Sparse:
        """The incidence's transpose by rows."""
        return self.incidence.T.tocsr()

    @cached_property
    def _figures(self) -> tuple[Floats, Floats]:
        """k_h - k_l in N/m and the stretch in m at the threshold."""
        return self.stiffness_high - self.stiffness_low, self.threshold * self.rest_length

    def energy_and_force(self, positions: Floats) -> tuple[float, Floats]:
        """Elastic energy in J and the force (V, 3) N on every node at `positions` (V, 3) m; equations (1)-(5)."""
        columns = np.ascontiguousarray(positions.T)  # three plain vectors are twice as fast as rows of three
        apart = np.stack([self.incidence @ column for column in columns])
        length = np.sqrt(apart[0] ** 2 + apart[1] ** 2 + apart[2] ** 2)
        pull, work = _tension_and_work(length - self.rest_length, self.stiffness_low, *self._figures, self.law)
        apart *= pull / np.where(length > 0, length, 1.0)
        return 0.5 * float(work.sum()), -np.stack([self._scatter @ column for column in apart], axis=1)

    def force(self, positions: Floats) -> Floats:
        """Force (V, 3) N on every node at `positions` (V, 3) m: Q of equation (5), minus the gradient of `energy`."""
        return self.energy_and_force(positions)[1]

    def energy(self, positions: Floats) -> float:
        """Elastic energy in J at `positions` (V, 3) m; 0 where every spring has its rest length."""
        return self.energy_and_force(positions)[0]

    def stiffness_between(self, positions: Floats, apart: Singles) -> Floats:
        """(k, k) N/m: what the true stiffness at positions (V, 3) m makes of k displacement fields, each by each.

        `apart` (3, S, k) is how far each field takes the ends of each spring apart, along x, y and z.
        """
        way = np.stack([self.incidence @ column for column in np.ascontiguousarray(positions.T)])
        length = np.linalg.norm(way, axis=0)
        stretch = length - self.rest_length
        extra, limit = self._figures
        pull, _ = _tension_and_work(stretch, self.stiffness_low, extra, limit, self.law)
        across = pull / np.where(length > 0, length, 1.0)
        along = self.stiffness_low + extra * (stretch > limit) - across
        sideways, lengthways = (each[:, None].astype(np.float32) for each in (across, along))
        x, y, z = (way / np.where(length > 0, length, 1.0)).astype(np.float32)[:, :, None] * apart
        lengthened = x + y + z
        turned = sum((part.T @ (sideways * part) for part in apart), np.zeros(2 * (apart.shape[2],)))
        return np.asarray(turned + lengthened.T @ (lengthways * lengthened), dtype=np.float64)

    def laplacian(self, *, high: bool = False) -> Sparse:
        """Graph Laplacian (V, V) N/m of the low (or high) constants: a bound from above on the true stiffness."""
        weights = self.stiffness_high if high else self.stiffness_low
        return pair_laplacian(np.stack([self.i, self.j], axis=1), weights, self.vertex_count)
