"""The skin of the default head: cage through the figures, one Catmull-Clark step, pushed to the limit surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...arrays import Floats, Ints
from ...errors import ModelError
from .cage import EYE_RIM, RIGHT_SUFFIX, Cage, Region, build_cage, ring_name
from .figures import EyeballFigures, HeadFigures
from .limit import QuadEdges, cage_through, limit_matrix, subdivide
from .rings import computed_nodes

_MIRROR = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class HeadSkin:
    """The finished skin.

    Attributes
    ----------
    vertices : (V, 3) float64, metres; the cage nodes first, so every figure is a vertex.
    quads : (F, 4) int64, outward winding; in the cage's order, four per cage quad or, where it is denser, more.
    regions : (F,) region of every quad.
    mirror : (V,) int64, the vertex on the other side.
    node_index : cage node name -> vertex.
    cage_matrix : (V, C) sparse; carries weights from cage nodes to vertices as the surface itself is carried.
    cage_positions : (C, 3) of the cage's nodes, so that the surface passes through its figures.
    cage_edges : the cage's edges, in the order of their vertices.
    cage : the cage's topology.
    """

    vertices: Floats
    quads: Ints
    regions: tuple[Region, ...]
    mirror: Ints
    node_index: Mapping[str, int]
    cage_matrix: sparse.csr_matrix
    cage_positions: Floats
    cage_edges: QuadEdges
    cage: Cage

    def vertex(self, *nodes: str) -> int:
        """Vertex at a node, in the middle of a cage edge (2 names) or of a cage quad (4 names).

        Raises
        ------
        ModelError : a name that is no node, or nodes that do not bound an edge or a quad.
        """
        unknown = [name for name in nodes if name not in self.node_index]
        if unknown:
            raise ModelError(f"the default head has no node {unknown[0]!r}; names look like 'r03c07' or 'eyeE2_04'")
        indices = sorted(self.node_index[name] for name in nodes)
        if len(indices) == 1:
            return indices[0]
        table = self.cage_edges.ends if len(indices) == 2 else np.sort(self.cage.quads, axis=1)
        found = np.flatnonzero((table == indices).all(axis=1)) if len(indices) in (2, 4) else np.empty(0)
        if len(found) != 1:
            raise ModelError(f"the nodes {', '.join(nodes)} do not bound one edge or quad of the default head")
        offset = len(self.cage.names) + (len(self.cage_edges.ends) if len(indices) == 4 else 0)
        return offset + int(found[0])

    def region_vertices(self, *regions: Region) -> Ints:
        """Vertices (N,) of all quads in some regions, ascending."""
        chosen = np.array([region in regions for region in self.regions])
        found: Ints = np.unique(self.quads[chosen])
        return found


def build_skin(figures: HeadFigures) -> HeadSkin:
    """Skin through the figures, each cage quad in four.

    Raises
    ------
    SolverError : figures that no smooth surface reaches.
    """
    cage = build_cage()
    index = {name: i for i, name in enumerate(cage.names)}
    left = dict(figures.nodes) | computed_nodes(figures)
    targets = np.array(
        [left[n.removesuffix(RIGHT_SUFFIX)] * (_MIRROR if n.endswith(RIGHT_SUFFIX) else 1.0) for n in cage.names]
    )
    nodes = cage_through(targets, cage.quads, tolerance=1e-5)
    step = subdivide(len(cage.names), cage.quads)
    matrix = sparse.csr_matrix(limit_matrix(step.matrix.shape[0], step.quads) @ step.matrix)
    regions = tuple(region for region in cage.regions for _ in range(4))
    skin = HeadSkin(
        vertices=matrix @ nodes,
        quads=step.quads,
        regions=regions,
        mirror=_vertex_mirror(cage, step.edges),
        node_index=index,
        cage_matrix=matrix,
        cage_positions=nodes,
        cage_edges=step.edges,
        cage=cage,
    )
    skin.vertices[: len(targets)] = targets  # to the last bit, not only to the solver's tolerance
    settle(skin, figures)
    return skin


def settle(skin: HeadSkin, figures: HeadFigures) -> None:
    """Keep the lids clear of the eyeballs, and both halves alike, in place."""
    _clear_eyeball(skin, figures.eyeball, figures.lid_margin.gap)
    _mirror_left(skin)


def _vertex_mirror(cage: Cage, edges: QuadEdges) -> Ints:
    """Mirror vertex of every vertex of the subdivided mesh."""
    count = len(cage.names)
    mirrored = np.sort(cage.mirror[edges.ends], axis=1)
    order = {(int(a), int(b)): i for i, (a, b) in enumerate(edges.ends)}
    edge_mirror = np.array([order[int(a), int(b)] for a, b in mirrored])
    faces = len(cage.quads)
    face_mirror = np.roll(np.arange(faces), faces // 2)
    mirror: Ints = np.concatenate([cage.mirror, edge_mirror + count, face_mirror + count + len(edges.ends)])
    return mirror


def _clear_eyeball(skin: HeadSkin, ball: EyeballFigures, gap: float) -> None:
    """Push the left lid's hidden vertices out of the eyeball, in place; measured nodes stay where they are."""
    rings = [skin.node_index[ring_name(f"eye{ring}", k)] for ring in ("E2", "E1", "E0") for k in range(len(EYE_RIM))]
    lid = np.unique(skin.quads[np.isin(skin.quads, rings).any(axis=1)])
    radial = skin.vertices[lid] - ball.centre
    distance = np.linalg.norm(radial, axis=1)
    reach = np.maximum(distance, ball.radius + gap)
    skin.vertices[lid] = ball.centre + radial * (reach / distance)[:, None]


def _mirror_left(skin: HeadSkin) -> None:
    """Make the right half the exact mirror image of the left, in place."""
    middle = np.flatnonzero(skin.mirror == np.arange(len(skin.mirror)))
    skin.vertices[middle, 0] = 0.0
    right = np.flatnonzero(skin.vertices[:, 0] < 0.0)
    skin.vertices[right] = skin.vertices[skin.mirror[right]] * _MIRROR
