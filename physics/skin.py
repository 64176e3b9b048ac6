"""The skin as a mechanical system: nodes with mass, biphasic springs, bending, and anchors to the bone beneath.

Energy of positions x with anchors at a (the resting places on the bone, which a jaw may carry):

    E(x) = springs(x) + 1/2 (x - a)' B (x - a) + 1/2 sum k_i |x_i - a_i|^2.

Bending B acts on the displacement from the anchors, so that skin carried rigidly with its bone bears no force.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError
from .elastic import bending_matrix, diagonal_matrix, dirichlet_springs, pair_laplacian
from .mesh import Polygons, Sparse, vertex_areas, within
from .springs import SpringLaw, SpringNetwork
from .tissue import Tissue

Force: TypeAlias = "Floats | Callable[[Floats], Floats]"
"""A load on the nodes: (V, 3) N, or a function of the positions (V, 3) m, as the muscles of equation (23)."""

STANDARD_GRAVITY = (0.0, 0.0, -9.80665)
"""m/s^2, +Z up (CGPM 1901)."""


@dataclass(frozen=True, eq=False)
class State:
    """Where the nodes are and how they move.

    Parameters
    ----------
    positions : (V, 3) m.
    velocities : (V, 3) m/s; rest if left out.
    """

    positions: Floats
    velocities: Floats

    @classmethod
    def at_rest(cls, positions: Floats) -> State:
        """These positions without motion."""
        return cls(np.array(positions, dtype=np.float64), np.zeros_like(positions, dtype=np.float64))


@dataclass(frozen=True, eq=False)
class Skin:
    """One face's skin; Zhang, Sung and Prakash 2001, sections 2 and 4, with anchors and bending.

    Parameters
    ----------
    rest : (V, 3) m.
    springs : the network on these nodes.
    mass : (V,) kg, above 0.
    anchor : (V,) N/m, of each node to its place on the bone, >= 0.
    bending : (V, V) N/m symmetric positive semidefinite, or None.
    damping : (V,) kg/s, c_i of equation (23), >= 0.

    Raises
    ------
    ParameterError : shapes that do not fit or values outside their rule.
    """

    rest: Floats
    springs: SpringNetwork
    mass: Floats
    anchor: Floats
    bending: Sparse | None
    damping: Floats

    def __post_init__(self) -> None:
        rest = np.array(self.rest, dtype=np.float64)
        if rest.ndim != 2 or rest.shape[1] != 3 or not np.isfinite(rest).all():
            raise ParameterError("rest", "must be (V, 3) finite positions", rest.shape)
        object.__setattr__(self, "rest", rest)
        if self.springs.vertex_count != len(rest):
            raise ParameterError("springs", f"must connect {len(rest)} nodes", self.springs.vertex_count)
        for name in ("mass", "anchor", "damping"):
            values = np.array(getattr(self, name), dtype=np.float64)
            if values.shape != (len(rest),) or not np.isfinite(values).all() or (values < 0).any():
                raise ParameterError(name, f"must be ({len(rest)},) finite values, none negative", values.shape)
            object.__setattr__(self, name, values)
        if (self.mass == 0).any():
            raise ParameterError("mass", "must be above 0 at every node", 0.0)
        if self.bending is not None and self.bending.shape != (len(rest), len(rest)):
            raise ParameterError("bending", f"must be ({len(rest)}, {len(rest)})", self.bending.shape)

    @classmethod
    def from_mesh(
        cls,
        vertices: Floats,
        polygons: Polygons,
        tissue: Tissue,
        *,
        anchor: Floats | float | None = None,
        bending: Floats | float | None = None,
        damping: Floats | float | None = None,
        depth: Floats | float | None = None,
        mask: Bools | None = None,
        springs: tuple[Ints, Floats] | None = None,
        law: SpringLaw | str = SpringLaw.CONTINUOUS,
    ) -> Skin:
        """Build a skin whose every figure is scaled by area, so that a tissue means the same on any mesh.

        Parameters
        ----------
        vertices : (V, 3) m.
        polygons : see `mesh`; leave out mouth bag and eye sockets: lips and lids must be open borders.
        tissue : its figures.
        anchor : (V,) or one value, 1/m^2, the inverse square of the anchor length; the tissue's if left out.
        bending : (V,) or one value, m^2, the square of the bending length; the tissue's if left out.
        damping : (V,) or one value, 1/s, c / m; the tissue's if left out.
        depth : (V,) or one value, m, of the soft tissue that moves with the sheet; the tissue's if left out.
        mask : (V,) bool, only polygons with all corners in it are skin.
        springs : pairs (S, 2) and weights (S,) of the springs, as of `elastic.dirichlet_springs`; those of the
            polygons if left out.
        law : of the springs.

        Notes
        -----
        A node in no polygon is a mean node on the tissue's own anchor: it stays with its anchor.

        Raises
        ------
        ParameterError : shapes, values, or no skin at all.
        """
        vertices = np.asarray(vertices, dtype=np.float64)
        if mask is not None:
            polygons = within(polygons, np.asarray(mask, dtype=bool))
        areas = vertex_areas(vertices, polygons)
        skin = areas > 0
        if not skin.any():
            raise ParameterError("polygons", "must contain at least one polygon with an area", len(polygons))
        bed = np.array(np.broadcast_to(1 / tissue.anchor_length**2 if anchor is None else anchor, areas.shape))
        bed[~skin] = 1 / tissue.anchor_length**2
        lumps = np.where(skin, areas, areas[skin].mean())
        mass = tissue.density * (tissue.depth if depth is None else depth) * lumps
        squared = tissue.bending_length**2 if bending is None else bending
        operator = None
        pairs, weights = dirichlet_springs(vertices, polygons) if springs is None else springs
        if np.any(squared):
            evenness = pair_laplacian(pairs, weights, len(vertices))
            operator = tissue.membrane * bending_matrix(evenness, areas, squared)
        network = SpringNetwork.between(
            vertices,
            pairs,
            weights,
            stiffness=tissue.membrane,
            stiffening=tissue.stiffening,
            threshold=tissue.threshold,
            law=law,
        )
        rate = tissue.damping_rate if damping is None else damping
        return cls(vertices, network, mass, tissue.membrane * bed * lumps, operator, rate * mass)

    @cached_property
    def _linear(self) -> Sparse:
        """Bending and anchors (V, V) N/m, in one product."""
        anchor = diagonal_matrix(self.anchor)
        return anchor if self.bending is None else (self.bending + anchor).tocsr()

    def energy_and_force(self, positions: Floats, anchors: Floats | None = None) -> tuple[float, Floats]:
        """Elastic energy E in J and its negative gradient (V, 3) N at `positions` (V, 3) m.

        `anchors` (V, 3) m are the places on the bone; the rest positions if left out.
        """
        energy, force = self.springs.energy_and_force(positions)
        moved = positions - (self.rest if anchors is None else anchors)
        held = np.stack([self._linear @ column for column in np.ascontiguousarray(moved.T)], axis=1)
        force -= held
        return energy + 0.5 * float(np.vdot(moved, held)), force

    def force(self, positions: Floats, anchors: Floats | None = None) -> Floats:
        """Elastic force (V, 3) N on every node: springs, bending and anchors; see `energy_and_force`."""
        return self.energy_and_force(positions, anchors)[1]

    def energy(self, positions: Floats, anchors: Floats | None = None) -> float:
        """Elastic energy in J; see `energy_and_force`."""
        return self.energy_and_force(positions, anchors)[0]

    def held_stiffness_between(self, fields: Floats) -> Floats:
        """(k, k) N/m: what bending and anchors make of displacement fields (k, V, 3), each by each."""
        flat = fields.reshape(len(fields), -1)
        held = [(self._linear @ field).ravel() for field in fields]
        return np.asarray(flat @ np.stack(held).T)

    def kinetic_energy(self, velocities: Floats) -> float:
        """1/2 sum m |v|^2 in J, for `velocities` (V, 3) m/s."""
        return 0.5 * float(self.mass @ (velocities**2).sum(axis=1))

    def gravity(
        self,
        acceleration: tuple[float, float, float] | Floats = STANDARD_GRAVITY,
        *,
        rest: tuple[float, float, float] | Floats = STANDARD_GRAVITY,
    ) -> Floats:
        """Force of gravity (V, 3) N beyond what the rest pose already bears.

        A face is scanned or modelled under gravity, so its rest pose is in equilibrium with it: only the change counts,
        and upright the force is zero. A head on its back has another `acceleration` in its own axes.

        Parameters
        ----------
        acceleration : (3,) m/s^2 in the mesh's axes, now.
        rest : (3,) m/s^2 under which the rest pose was taken; zeros let the mesh sag under all its weight.
        """
        change = np.asarray(acceleration, dtype=np.float64) - np.asarray(rest, dtype=np.float64)
        return np.asarray(self.mass[:, None] * change)

    def matrix(self, *, high: bool = False) -> Sparse:
        """Scalar stiffness (V, V) N/m: springs as a Laplacian, bending, anchors; the solvers' prefactored matrix.

        The springs' part bounds their true stiffness at low strain (`high`: at any strain) from above.
        """
        return (self.springs.laplacian(high=high) + self._linear).tocsr()


def force_at(force: Force | None, positions: Floats) -> Floats:
    """The load (V, 3) N at these positions; zeros for None.

    Raises
    ------
    ParameterError : a load of another shape or not finite.
    """
    if force is None:
        return np.zeros_like(positions)
    load = np.asarray(force(positions) if callable(force) else force, dtype=np.float64)
    if load.shape != positions.shape:
        raise ParameterError("force", f"must have the shape {positions.shape}", load.shape)
    if not np.isfinite(load).all():
        raise ParameterError("force", "must be finite at every node", int(np.argwhere(~np.isfinite(load))[0, 0]))
    return load
