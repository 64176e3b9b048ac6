"""What people's heads wear, and how artists change them: hair, beards, glasses, shirts, bumps, toon proportions.

Each takes a head in Blender's axes (metres, the face looks along -Y, +Z up) and gives another; feature points go along
with the skin, and those that are buried are left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from risorius.arrays import Bools, Floats, Ints
from risorius.physics.mesh import vertex_normals
from scipy.spatial import cKDTree

from .heads import TrueHead

#: Points under more than this of hair cannot be seen, metres.
BURIED = 2e-3
#: How thick hair and beards are, metres, how wide their strands, and how wide the edge where they begin.
HAIR, BEARD, STRAND, EDGE = 18e-3, 14e-3, 9e-3, 12e-3
#: Sculpted bumps: height and width, metres.
BUMP, BUMP_WIDTH = 1.5e-3, 8e-3
#: Toon proportions: how much larger eyes are, how large the nose is, how much larger the skull.
TOON_EYES, TOON_NOSE, TOON_SKULL = 1.4, 0.6, 1.25
#: Glasses: radius of the rims, metres, their thickness, how far before the eyes; a shirt: how far from the skin.
RIM, RIM_THICK, RIM_BEFORE, SHIRT = 24e-3, 2e-3, 16e-3, 8e-3


def with_hair(head: TrueHead, skin: Bools) -> TrueHead:
    """Hair modelled over the skull and the forehead's upper edge, one surface with the skin `skin` (V,)."""
    brow, ear = head.points["4.3"], head.points["10.7"]
    line = brow + np.array([0.0, 0.0, 0.028])
    slope = (line[2] - ear[2] + 0.01) / (ear[1] - line[1] + 0.01)
    above = head.vertices[:, 2] - line[2] + slope * (head.vertices[:, 1] - line[1])
    return _grown(head, "hair", skin, _edge(above), HAIR)


def with_beard(head: TrueHead, skin: Bools) -> TrueHead:
    """A full beard on chin, jaw and cheeks, one surface with the skin `skin` (V,)."""
    lip, ear, chin = head.points["8.2"], head.points["10.7"], head.points["2.1"]
    corner = head.points["8.3"]
    forward = np.clip((ear[1] - head.vertices[:, 1]) / (ear[1] - lip[1]), 0.0, 1.0)
    line = ear[2] + forward * (lip[2] - 4e-3 - ear[2])
    across = np.clip(np.abs(head.vertices[:, 0]) / abs(corner[0]) - 1.0, 0.0, 1.0)
    below = line + 0.015 * across * forward - head.vertices[:, 2]
    kept = _edge(below) * _edge(ear[1] - head.vertices[:, 1]) * _edge(head.vertices[:, 2] - chin[2] + 0.03)
    return _grown(head, "beard", skin, kept, BEARD)


def with_bumps(head: TrueHead, seed: int = 1) -> TrueHead:
    """A head roughly sculpted."""
    rough = _rough(head.vertices, BUMP_WIDTH, seed) * BUMP
    return _displaced(head, "bumps", vertex_normals(head.vertices, head.polygons) * rough[:, None])


def with_glasses(head: TrueHead) -> TrueHead:
    """Glasses before the eyes: rims, a bridge and arms to the ears, in pieces of their own."""
    pieces: list[tuple[Floats, Ints]] = []
    for inner, outer, ear in (("3.11", "3.7", "10.9"), ("3.8", "3.12", "10.10")):
        middle = (head.points[inner] + head.points[outer]) / 2.0 - np.array([0.0, RIM_BEFORE, 0.0])
        pieces.append(_rim(middle))
        out = np.array([np.sign(middle[0]), 0.0, 0.0])
        pieces.append(_rod(middle + RIM * out, head.points[ear] + 4e-3 * out))
    left = (head.points["3.11"] + head.points["3.7"]) / 2.0
    reach = left[0] - RIM
    bridge = left[1] - RIM_BEFORE
    pieces.append(_rod(np.array([reach, bridge, left[2]]), np.array([-reach, bridge, left[2]])))
    return _joined(head, "glasses", pieces)


def with_shirt(body: TrueHead) -> TrueHead:
    """A body in a shirt: a copy of trunk and arms a little outside of the skin, and a collar round the neck."""
    chin = body.points["2.1"]
    normals = vertex_normals(body.vertices, body.polygons)
    worn = (body.vertices[:, 2] < chin[2] - 0.07) & (body.vertices[:, 2] > -0.1)
    quads = np.array([polygon for polygon in body.polygons if worn[np.asarray(polygon)].all()])
    used, numbered = np.unique(quads, return_inverse=True)
    shirt = (body.vertices + SHIRT * normals)[used]
    neck = body.vertices[np.abs(body.vertices[:, 2] - chin[2] + 0.04) < 0.01]
    centre = neck[np.abs(neck[:, 0]) < 0.1].mean(axis=0)
    turn = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
    rings = [
        centre + np.column_stack([wide * np.cos(turn), wide * np.sin(turn), np.full(48, high)])
        for wide, high in ((0.085, -0.04), (0.078, 0.0), (0.085, 0.025))
    ]
    k = np.arange(48)
    band = [np.column_stack([k, (k + 1) % 48, (k + 1) % 48 + 48, k + 48]) + 48 * ring for ring in (0, 1)]
    pieces = [(shirt, numbered.reshape(quads.shape)), (np.concatenate(rings), np.concatenate(band))]
    return _joined(body, "shirt and collar", pieces)


def stylised(head: TrueHead) -> TrueHead:
    """Toon proportions: large eyes, a small nose, a large skull."""
    brow, nose = head.points["4.3"], head.points["9.3"]
    base = (head.points["9.1"] + head.points["9.2"]) / 2.0 + np.array([0.0, 6e-3, 4e-3])
    eyes = [(head.points[a] + head.points[b]) / 2.0 for a, b in (("3.7", "3.11"), ("3.8", "3.12"))]

    def toon(places: Floats) -> Floats:
        places = places.copy()
        for middle, factor, width in (
            (eyes[0], TOON_EYES, 0.026),
            (eyes[1], TOON_EYES, 0.026),
            (base, TOON_NOSE, 0.024),
        ):
            away = places - middle
            share = np.exp(-((np.linalg.norm(away, axis=1) / width) ** 4))[:, None]
            places = middle + away * (1.0 + (factor - 1.0) * share)
        centre = np.array([0.0, nose[1] + 0.1, brow[2]])
        share = np.clip((places[:, 2] - brow[2] + 0.02) / 0.06, 0.0, 1.0)[:, None]
        return np.asarray(centre + (places - centre) * (1.0 + (TOON_SKULL - 1.0) * share * share * (3.0 - 2.0 * share)))

    points = {key: toon(place[None])[0] for key, place in head.points.items()}
    return TrueHead(f"{head.name}, toon", toon(head.vertices), head.polygons, points)


def _edge(inside: Floats) -> Floats:
    """From 0 to 1 across an edge, by the distance inside of it."""
    share = np.clip(inside / EDGE, 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _grown(head: TrueHead, name: str, skin: Bools, share: Floats, thick: float) -> TrueHead:
    """A head whose skin stands off by a share (V,) of hair so thick."""
    strands = 1.0 + 0.25 * _rough(head.vertices, STRAND, 2)
    off = np.where(skin, share * thick * strands, 0.0)
    return _displaced(head, name, vertex_normals(head.vertices, head.polygons) * off[:, None], BURIED)


def _displaced(head: TrueHead, name: str, moves: Floats, most: float = np.inf) -> TrueHead:
    """A head whose vertices are moved by (V, 3); points that would move farther than `most` are left out."""
    names = list(head.points)
    _, found = cKDTree(head.vertices).query(np.array([head.points[key] for key in names]))
    points: Mapping[str, Floats] = {
        key: head.points[key] + moves[index]
        for key, index in zip(names, np.asarray(found), strict=True)
        if np.linalg.norm(moves[index]) < most
    }
    return TrueHead(f"{head.name}, {name}", head.vertices + moves, head.polygons, points)


def _rough(places: Floats, width: float, seed: int) -> Floats:
    """(V,) a smooth random field of about -1 to 1."""
    random = np.random.default_rng(seed)
    waves = random.normal(scale=1.0 / width, size=(32, 3))
    return np.asarray(np.sin(places @ waves.T + random.uniform(0.0, 2.0 * np.pi, 32)).sum(axis=1) / 4.0)


def _rim(middle: Floats) -> tuple[Floats, Ints]:
    """The rim of a glass, upright before the face."""
    around, count, sides = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False), 48, 8
    section = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    reach = RIM + RIM_THICK * np.cos(section)[None, :]
    x, z = reach * np.cos(around)[:, None], 0.85 * reach * np.sin(around)[:, None]
    y = np.broadcast_to(RIM_THICK * np.sin(section)[None, :], x.shape)
    i, k = np.meshgrid(np.arange(count), np.arange(sides), indexing="ij")
    after, beside = (i + 1) % count, (k + 1) % sides
    corners = [i * sides + k, after * sides + k, after * sides + beside, i * sides + beside]
    return middle + np.stack([x, y, z], axis=-1).reshape(-1, 3), np.stack(corners, axis=-1).reshape(-1, 4)


def _rod(start: Floats, end: Floats) -> tuple[Floats, Ints]:
    """A square rod between two places."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * RIM_THICK
    along = (end - start) / np.linalg.norm(end - start)
    a = np.cross(along, [0.0, 0.0, 1.0])
    a /= np.linalg.norm(a)
    section = corners @ np.stack([a, np.cross(along, a)])
    k = np.arange(4)
    return np.concatenate([start + section, end + section]), np.column_stack([k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4])


def _joined(head: TrueHead, name: str, pieces: list[tuple[Floats, Ints]]) -> TrueHead:
    """A head with further pieces (vertices, polygons) in its mesh."""
    vertices = [head.vertices]
    polygons = [np.asarray(polygon) for polygon in head.polygons]
    for places, faces in pieces:
        polygons += list(faces + sum(len(v) for v in vertices))
        vertices.append(places)
    return replace(head, name=f"{head.name}, {name}", vertices=np.concatenate(vertices), polygons=polygons)
