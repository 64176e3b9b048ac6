"""A skin of two layers: dermis over fat over a fascia that slides on the bone; the second paper's future work.

Both layers are copies of the outer skin, the fascia some way below it. The energy of small displacements u of the
dermis and w of the fascia is

    membranes and bending of both  +  fat  +  1/2 sum A (k_t |w_t|^2 + k_n w_n^2).

Membranes are the low-strain springs of equations (1)-(5), which resist stretching along themselves only. Bone holds the
fascia along its normal and lets it glide; lips, lids and the pouch of the cheek have no bone behind them.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Literal

import numpy as np
from risorius.arrays import Bools, Floats
from risorius.face.mesh.template import MM
from risorius.face.response import regions
from risorius.face.response.sheet import ElasticSheet
from risorius.face.skin.outer import OuterSkin, smoothstep
from risorius.physics.elastic import bending_matrix, diagonal_matrix, dirichlet_springs
from risorius.physics.mesh import Sparse
from risorius.physics.tissue import tissue as tissue_of
from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

from .fat import THINNEST, fat_depth, fat_matrix, near_lids, soft_tissue_depth

#: Radius of the cheek's pouch, and how far off the lips' edge bone (or teeth) holds their fascia, metres.
POUCH = 22 * MM
LIPS = (2 * MM, 16 * MM)


class Insertion(StrEnum):
    """Which layer muscles pull on."""

    SKIN = "skin"
    FASCIA = "fascia"
    ANATOMY = "anatomy"
    """Flat muscles of the fascia's own plane pull on it, those that end in the dermis on the dermis."""


#: Muscles in the fascia's plane (frontalis, ring muscles, risorius, platysma) or below it (buccinator, cheek's air).
IN_FASCIA = ("frontalis", "orb_oculi", "oris_", "platysma", "buccinator", "cheek_", "risorius")


@dataclass(frozen=True)
class Layers:
    """The figures of the two layers.

    Attributes
    ----------
    fat_modulus : shear modulus of fat, Pa; facial soft tissue on bone has a Young's modulus of 2.7 to 4.4 kPa in vivo
        (Wei et al. 2021, Int. J. Appl. Mech. 13:2150034), so about 0.9 to 1.5 kPa.
    poisson : its Poisson's ratio; 0.5 would keep all volume.
    depth : factor on the soft-tissue depths of the table.
    fat_share : share of that depth between dermis and fascia; the rest is the gliding plane.
    glide : shear modulus of the gliding plane, Pa.
    bone : how much firmer than gliding the bone holds the fascia along its normal.
    fascia : membrane of the fascia, as a multiple of the dermis's; skin and fascia behave alike (Har-Shai et al. 1997,
        Aesthetic Plast. Surg. 21:219-224).
    ligaments : share of the firmness of some regions that ties the dermis itself to the bone, through the fat.
    bending : bending length of both layers, metres.
    insertion : which layer muscles pull on.
    """

    fat_modulus: float = 1.0e3
    poisson: float = 0.48
    depth: float = 1.0
    fat_share: float = 0.6
    glide: float = 0.5e3
    bone: float = 30.0
    fascia: float = 1.0
    ligaments: float = 1.0
    bending: float = tissue_of().bending_length
    insertion: Insertion = Insertion.ANATOMY

    def deep(self, muscle: str) -> bool:
        """Whether a muscle of this name pulls on the fascia."""
        if self.insertion is Insertion.ANATOMY:
            return muscle.startswith(IN_FASCIA)
        return self.insertion is Insertion.FASCIA


def membrane_matrix(skin: OuterSkin, positions: Floats) -> Sparse:
    """(3n, 3n) low-strain stiffness of springs between positions (n, 3), per unit of membrane stiffness."""
    pairs, weights = dirichlet_springs(positions, skin.polygons)
    along = positions[pairs[:, 1]] - positions[pairs[:, 0]]
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    block = weights[:, None, None] * along[:, :, None] * along[:, None, :]
    start, end = (3 * pairs[:, k, None] + np.arange(3) for k in (0, 1))
    rows, columns, values = [], [], []
    for a, b, sign in ((start, start, 1), (end, end, 1), (start, end, -1), (end, start, -1)):
        rows.append(np.repeat(a, 3, axis=1).ravel())
        columns.append(np.tile(b, (1, 3)).ravel())
        values.append(sign * block.ravel())
    size = 3 * skin.vertex_count
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return sparse.coo_array(entries, shape=(size, size)).tocsr()


def on_bone(skin: OuterSkin) -> Floats:
    """(n,) 1 where bone lies behind the fascia, 0 at lips, lids and over the pouch of the cheek."""
    free = near_lids(skin)
    for cheek, corner in (("5.1", "8.3"), ("5.2", "8.4")):
        away = skin.positions - (skin.points[cheek] + skin.points[corner]) / 2.0
        free = 1.0 - (1.0 - free) * (1.0 - np.exp(-(away**2).sum(axis=1) / POUCH**2))
    return np.asarray((1.0 - free) * smoothstep((skin.lip_edge_distance - LIPS[0]) / (LIPS[1] - LIPS[0])))


def firmness(skin: OuterSkin) -> Floats:
    """(n,) by how much scalp, nose bridge, nose base, chin pad and neck are held more firmly than the cheek, 1/m^2."""
    return np.asarray(regions.anchor(skin) - 1.0 / tissue_of().anchor_length ** 2)


def bed_matrix(skin: OuterSkin, layers: Layers, membrane: float) -> Sparse:
    """(3n, 3n) hold of the bone on the fascia, N/m: it glides along the bone and is held along the bone's normal."""
    plane = np.maximum((1.0 - layers.fat_share) * layers.depth * soft_tissue_depth(skin), THINNEST)
    gliding = layers.glide / plane + membrane * firmness(skin)
    firm = gliding * (layers.bone - 1.0) * on_bone(skin)
    normals = skin.normals
    blocks = gliding[:, None, None] * np.eye(3) + firm[:, None, None] * normals[:, :, None] * normals[:, None, :]
    index = np.arange(skin.vertex_count + 1, dtype=np.int32)
    return sparse.bsr_array((blocks * skin.areas[:, None, None], index[:-1], index)).tocsr()


def two_layer_matrix(skin: OuterSkin, layers: Layers) -> Sparse:
    """(6n, 6n) stiffness of dermis, fat and fascia, N/m; three unknowns a node, dermis first."""
    membrane = tissue_of().membrane
    depth = fat_depth(skin, layers.depth * layers.fat_share * soft_tissue_depth(skin))
    squared = regions.correction_bending(skin) * (layers.bending / tissue_of().bending_length) ** 2
    bending = sparse.kron(bending_matrix(skin.laplacian, skin.areas, squared), np.eye(3), format="csr")
    tied = diagonal_matrix(np.repeat(layers.ligaments * membrane * firmness(skin) * skin.areas, 3))
    dermis = membrane * (membrane_matrix(skin, skin.positions) + bending) + tied
    inner = skin.positions - depth[:, None] * skin.normals
    fascia = layers.fascia * membrane * (membrane_matrix(skin, inner) + bending) + bed_matrix(skin, layers, membrane)
    fat = fat_matrix(skin, depth, layers.fat_modulus, layers.poisson)
    whole: Sparse = (sparse.block_diag([dermis, fascia], format="csr") + fat).tocsr()
    return whole


def _factored(matrix: Sparse, ordering: Literal["MMD_AT_PLUS_A", "NATURAL"]) -> SuperLU[np.float64]:
    """LU of a symmetric matrix without pivoting."""
    symmetric = {"SymmetricMode": True}
    return splu(sparse.csc_array(matrix), permc_spec=ordering, diag_pivot_thresh=0.0, options=symmetric)


class BlockFactor:
    """A factored symmetric positive definite matrix, its unknowns six to a vertex and eliminated vertex by vertex."""

    def __init__(self, matrix: Sparse, vertex_count: int) -> None:
        """`matrix` (6n, 6n): n nodes of three unknowns, then n more."""
        entries = matrix.tocoo()
        vertex = np.tile(np.repeat(np.arange(vertex_count), 3), 2)
        pattern = (np.ones(matrix.nnz), (vertex[entries.row], vertex[entries.col]))
        graph = sparse.coo_array(pattern, shape=(vertex_count, vertex_count)).tocsr()
        dominant = graph + diagonal_matrix(np.asarray(graph.sum(axis=0)))
        order = np.argsort(_factored(dominant, "MMD_AT_PLUS_A").perm_c)
        blocks = 3 * order[:, None] + np.arange(3)
        self._order = np.concatenate([blocks, blocks + 3 * vertex_count], axis=1).ravel()
        self._factor = _factored(matrix[self._order][:, self._order], "NATURAL")

    def solve(self, right: Floats) -> Floats:
        """The solution of matrix @ x = right for columns (6n, k)."""
        solution = np.empty_like(right)
        solution[self._order] = self._factor.solve(np.ascontiguousarray(right[self._order]))
        return solution


class LayeredTissue(ElasticSheet):
    """Stands in for `ElasticSheet`: loads on a two-layer skin in, displacements of its dermis out."""

    def __init__(self, skin: OuterSkin, layers: Layers, deep: Bools) -> None:
        """`deep` tells of every muscle whose forces `relax` will be given whether it pulls on the fascia."""
        super().__init__(skin)
        self.layers, self._deep = layers, deep

    @cached_property
    def layered_factor(self) -> BlockFactor:
        """The prefactored stiffness of both layers."""
        return BlockFactor(two_layer_matrix(self.skin, self.layers), self.skin.vertex_count)

    def respond(self, skin_loads: Floats, fascia_loads: Floats) -> Floats:
        """(k, n, 3) displacements of the dermis under loads (k, n, 3) on dermis and fascia, metres for newtons."""
        k, n, _ = skin_loads.shape
        loads = np.concatenate([skin_loads, fascia_loads], axis=1).reshape(k, 6 * n)
        return self.layered_factor.solve(np.ascontiguousarray(loads.T)).T.reshape(k, 2 * n, 3)[:, :n]

    def relax(self, forces: Floats) -> Floats:
        """(k, n, 3) displacement of the dermis under every muscle's forces (k, n, 3) on its own layer."""
        deep = self._deep[:, None, None]
        return self.respond(np.where(deep, 0.0, forces), np.where(deep, forces, 0.0))

    def point_responses(self, loads: Floats) -> Floats:
        """R (k, n, 3): what the face shows when unit loads (k, n, 3) act on it."""
        return self.show(self.respond(self.show_transposed(loads), np.zeros_like(loads)))
