"""Named vertex groups of the default head: loops in order, and the vertices of whole regions."""

from __future__ import annotations

import numpy as np

from ...arrays import Ints
from .cage import COLUMNS, EYE_RIM, MOUTH_RIM, ROWS, Region, grid_name, ring_name
from .skin import HeadSkin


def skin_groups(skin: HeadSkin) -> dict[str, Ints]:
    """Groups on the skin; `_l` is the subject's left, and every `_r` group mirrors its `_l` twin entry by entry.

    Loops (in order, mesh edge by mesh edge):
    `lash_line_l`, `lid_margin_l` (outer and inner edge of the lid rim) and `lid_fold_l` (the open end behind the lid),
    32 vertices: 0 medial canthus, 16 lateral canthus, the upper lid between them first;
    `vermilion_border`, `lip_contact`: 40 vertices: 0 upper midline, 10 left corner, 20 lower midline, 30 right corner;
    `neck_rim`: from the front midline round by the left.

    Regions (ascending): `lips`, `mouth_bag`, `under_lid_l`, `lid_rim_l`, `eyelid_l`, `ear_l`, `nostril_l`, and
    `lid_cover_l` (the lid rim and what lies behind it: vertices that must stay outside the eyeball).
    """
    groups: dict[str, Ints] = {}
    for name, ring in (("lash_line", "E2"), ("lid_margin", "E1"), ("lid_fold", "E0")):
        groups |= _both(skin, name, _loop(skin, [ring_name(f"eye{ring}", k) for k in range(len(EYE_RIM))], closed=True))
    for name, ring in (("vermilion_border", "M3"), ("lip_contact", "M1")):
        half = _loop(skin, [ring_name(f"mou{ring}", k) for k in range(len(MOUTH_RIM))], closed=False)
        groups[name] = _whole(skin, half)
    groups["neck_rim"] = _whole(skin, _loop(skin, [grid_name(ROWS - 1, c) for c in range(COLUMNS)], closed=False))
    for name, regions in (
        ("under_lid", (Region.UNDER_LID,)),
        ("lid_rim", (Region.LID_RIM,)),
        ("lid_cover", (Region.LID_RIM, Region.UNDER_LID)),
        ("eyelid", (Region.EYELID,)),
        ("ear", (Region.EAR,)),
        ("nostril", (Region.NOSTRIL, Region.NOSTRIL_DEPTH)),
    ):
        vertices = skin.region_vertices(*regions)
        groups |= _both(skin, name, vertices[skin.vertices[vertices, 0] > 0.0])
    groups["lips"] = skin.region_vertices(Region.LIPS)
    groups["mouth_bag"] = skin.region_vertices(Region.MOUTH_BAG)
    return groups


def _loop(skin: HeadSkin, nodes: list[str], *, closed: bool) -> Ints:
    """Vertices along a chain of nodes, with the vertex in the middle of each cage edge."""
    vertices: list[int] = []
    for k, node in enumerate(nodes):
        vertices.append(skin.vertex(node))
        if closed or k + 1 < len(nodes):
            vertices.append(skin.vertex(node, nodes[(k + 1) % len(nodes)]))
    return np.array(vertices, dtype=np.int64)


def _both(skin: HeadSkin, name: str, left: Ints) -> dict[str, Ints]:
    """A left group and its mirror image."""
    return {f"{name}_l": left, f"{name}_r": skin.mirror[left]}


def _whole(skin: HeadSkin, half: Ints) -> Ints:
    """A closed loop from its left half, both ends on the midline."""
    return np.concatenate([half, skin.mirror[half[-2:0:-1]]])
