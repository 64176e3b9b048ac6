"""Hard heads: expressions, other meshes of the same head, bodies, and what people wear."""

from __future__ import annotations

from collections.abc import Iterator

from . import disguises, meshes
from .decimate import decimated
from .heads import SharedHeads, TrueHead

#: Expressions of the scanned mean head, by the weights of its shapes.
EXPRESSIONS = {
    "eyes closed": {"eyeBlink_L": 1.0, "eyeBlink_R": 1.0},
    "mouth open 9 mm": {"jawOpen": 0.25},
    "mouth open 19 mm": {"jawOpen": 0.5},
    "smile": {"mouthSmile_L": 1.0, "mouthSmile_R": 1.0},
}
#: Vertices of the coarse heads.
COUNTS = (500, 1000, 2000)


def hard_heads(heads: SharedHeads) -> Iterator[TrueHead]:
    """Expressions, meshes, bodies and disguises, in this order."""
    for name, weights in EXPRESSIONS.items():
        yield heads.expression(name, weights)
    yield from _meshes(heads)
    yield from _bodies(heads)
    for name in ("ict", "makehuman"):
        head, skin = heads.shared(name), heads.skin(name)
        yield disguises.with_hair(head, skin)
        yield disguises.with_beard(head, skin)
        yield disguises.with_beard(disguises.with_hair(head, skin), skin)
        yield disguises.with_glasses(head)
        yield disguises.with_bumps(head)
        yield disguises.stylised(head)


def _meshes(heads: SharedHeads) -> Iterator[TrueHead]:
    """The same heads as other meshes."""
    narrow = heads.shared("ict_narrow")
    for cell in (0.010, 0.018):
        yield meshes.coarse(narrow, cell)
    for count in COUNTS:
        yield decimated(heads.shared("makehuman"), count)
    yield meshes.face_mask(narrow)
    fine = meshes.subdivided(heads.shared("ict"))
    yield fine
    yield meshes.subdivided(fine)
    yield meshes.soup(heads.shared("ict"))
    yield meshes.soup(fine)
    yield meshes.not_manifold(heads.shared("ict"))
    yield meshes.not_manifold(heads.shared("makehuman"))


def _bodies(heads: SharedHeads) -> Iterator[TrueHead]:
    """A body cut, posed and dressed."""
    body = heads.shared("makehuman_body")
    yield meshes.bust(body)
    yield meshes.t_pose(body)
    yield disguises.with_shirt(body)
    yield meshes.turned_head(body, 10.0)
    yield meshes.turned_head(body, 20.0)
    yield meshes.turned_head(body, 20.0, 15.0)
