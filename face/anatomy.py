"""One face prepared for motion: skin, tissue, jaw, eyes, muscles, inverse; built from a checked mesh."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy import sparse

from ..arrays import Bools, Ints
from ..errors import ModelError
from ..mpeg4 import FAPS
from ..physics import mesh
from ..physics.mesh import Sparse
from ..polygons import PolygonTable
from ..progress import Progress, Work, part_of, stepwise, worked_out
from .bodies.contact import Contact, contact_steps
from .bodies.eyeball import Eyeball, build_eyeball
from .bodies.head_turn import HeadTurn, build_head_turn
from .bodies.tongue import Tongue, build_tongue
from .drive.inverse import Inverse, Kernel, kernel_steps
from .mechanism import EVERY, MUSCLE_GROUPS, Mechanism
from .mechanisms.jaw import Jaw, build_jaw
from .mechanisms.lids import Eye, build_eye
from .mesh.face_mesh import COPY, FaceMesh
from .mesh.fap_rows import FapRows, displacement_rows
from .mesh.fap_units import unit_length
from .mesh.openings import OPENINGS, Opening, find_opening_steps, outer_faces
from .mesh.parts import Part
from .mesh.points import FeaturePoints, lies_on_skin, rebound
from .mesh.reach import within_reach
from .mesh.sewn import sewn_steps, web_of
from .mesh.template import TEMPLATE_POINTS, TemplateWarp
from .muscles.placement import PlacedMuscle, place_muscles
from .muscles.table import muscles_of
from .response.actuators import Actuators
from .response.followers import InnerSkin
from .response.pulls import Pulls, pulls_steps
from .response.relaxation import Relaxation
from .response.rooted import RootedParts
from .response.sheet import ElasticSheet
from .skin.coarse import MOST, Thinning
from .skin.dense import DenseSkin
from .skin.fine import SOLVED, fine_skin
from .skin.outer import OuterSkin

#: Mechanisms without which the muscles pull on the skin as before. A mechanism that is not named here is taken to
#: change everything.
BESIDE_THE_PULLS = frozenset(MUSCLE_GROUPS) | {
    Mechanism.FOLDS,
    Mechanism.FLAT_PULLS,
    Mechanism.JAW,
    Mechanism.FLOOR,
    Mechanism.HOLLOW,
    Mechanism.LIDS,
    Mechanism.LID_SLIDE,
    Mechanism.CONTACT,
    Mechanism.LIP_MIDDLE,
    Mechanism.CORRECTION,
    Mechanism.BIPHASIC,
}
#: Mechanisms without which the skin answers forces as before.
BESIDE_THE_SKIN = BESIDE_THE_PULLS | {Mechanism.FADING, Mechanism.SUPERFICIAL, Mechanism.SCALP}


class Anatomy:
    """The moving parts of one face; each is built when first asked for."""

    def __init__(
        self, face_mesh: FaceMesh, mechanisms: frozenset[Mechanism] = EVERY, *, whole: Anatomy | None = None
    ) -> None:
        """Prepare a face with some mechanisms, all of them unless told otherwise.

        `whole` is the same face with these and more: what does not depend on the difference is taken from it.
        """
        self.mesh, self.mechanisms = face_mesh, mechanisms
        lost: frozenset[Mechanism] = frozenset() if whole is None else whole.mechanisms - mechanisms
        self._same_skin = whole if lost <= BESIDE_THE_SKIN else None
        self._same_pulls = whole if lost <= BESIDE_THE_PULLS else None

    @cached_property
    def warp(self) -> TemplateWarp:
        """Template to this face."""
        return TemplateWarp(self.mesh.landmarks)

    @cached_property
    def _whole_skin(self) -> PolygonTable:
        """Polygons of all skin, a body's too."""
        polygons = self.mesh.polygons.kept(self.mesh.polygons.within(self.mesh.parts == Part.SKIN))
        if not len(polygons):
            raise ModelError("the face has no skin polygons: check its parts")
        return polygons

    @cached_property
    def _skin_polygons(self) -> PolygonTable:
        """Polygons of the skin that the face can move."""
        polygons = self._whole_skin
        held = np.array(list(self.mesh.points.nearest.values()), dtype=np.int64)
        near = within_reach(self.mesh.positions, polygons, held[np.isin(held, polygons.loops)])
        return polygons.kept(polygons.within(near))

    @cached_property
    def still_skin(self) -> Ints:
        """Vertices of skin that no face moves."""
        return np.setdiff1d(self._whole_skin.loops, self._skin_polygons.loops)

    @stepwise
    def _openings(self) -> Work[dict[str, Opening]]:
        """Mouth and eyes ("l", "r") as the feature points tell, between the mesh's vertices."""
        yield from worked_out(self, "_skin_polygons")
        yield Progress(0.0, "Preparing the skin")
        graph = mesh.adjacency(self.mesh.positions, self._skin_polygons, diagonals=False)
        found = dict[str, Opening]()
        for name, arcs in OPENINGS.items():
            path = find_opening_steps(graph, self.mesh.points.nearest, *arcs)
            found[name] = yield from part_of(path, len(found) / len(OPENINGS), (len(found) + 1) / len(OPENINGS))
        return found

    @stepwise
    def _sewn(self) -> Work[frozenset[str]]:
        """Which openings are sewn."""
        places = self.mesh.points.nearest, self.mesh.landmarks
        return (yield from sewn_steps(self.mesh.positions, self._skin_polygons, *places))

    @stepwise
    def given_skin(self) -> Work[OuterSkin]:
        """The outer skin with the mesh's own vertices."""
        yield from part_of(worked_out(self, "_openings"), 0.0, 0.5)
        yield Progress(0.5, "Preparing the skin")
        yield from part_of(worked_out(self, "_sewn"), 0.5, 1.0)
        yield Progress(1.0, "Preparing the skin")
        face_mesh, polygons, sewn = self.mesh, self._skin_polygons, self._sewn
        openings = dict(self._openings)
        outside = outer_faces(polygons, list(openings.values()), face_mesh.points.nearest["9.3"])
        yield Progress(1.0, "Preparing the skin")
        web = np.zeros(len(polygons), dtype=bool)
        for name in sorted(sewn):
            own, openings[name] = web_of(face_mesh.positions, polygons, outside, openings[name])
            web |= own
        kept = PolygonTable.joined([polygons.kept(outside & ~web), polygons.kept(web)])
        index = np.unique(kept.loops)
        local = np.full(len(face_mesh.positions), -1, dtype=np.int64)
        local[index] = np.arange(len(index))

        def inside(opening: Opening) -> Opening:
            return Opening(*(local[arc][local[arc] >= 0] for arc in (opening.upper, opening.lower)))

        skin = OuterSkin(
            index=index,
            positions=face_mesh.positions[index],
            polygons=kept.numbered(local),
            points=dict(face_mesh.landmarks),
            mouth=inside(openings["mouth"]),
            eyes={side: inside(openings[side]) for side in "lr"},
            sewn=sewn,
            web=int(web.sum()),
            mechanisms=self.mechanisms,
        )
        return DenseSkin.of(skin) if skin.vertex_count > MOST else skin

    @property
    def is_thinned(self) -> bool:
        """Whether the outer skin is solved on a share of its vertices, as there are too many of them."""
        return self.given_skin.vertex_count > MOST

    @property
    def _thinning(self) -> Thinning | None:
        """The outer skin thinned out, where it is dense."""
        return self.given_skin.thinning if isinstance(self.given_skin, DenseSkin) else None

    @stepwise
    def skin(self) -> Work[OuterSkin]:
        """The outer skin as it is solved: split where the mesh is coarse, thinned out where it is dense.

        Where it is split, the vertices of `given_skin` are the first ones.
        """
        yield from worked_out(self, "given_skin")
        if self._thinning is None:
            return fine_skin(self.given_skin, SOLVED)[0]
        yield from worked_out(self._thinning, "cells")
        return self._thinning.skin

    @stepwise
    def carry(self) -> Work[Sparse]:
        """(g, n) takes fields over `skin` to the vertices of `given_skin`."""
        yield from worked_out(self, "skin")
        if self._thinning is not None:
            yield from worked_out(self._thinning, "carry")
            return self._thinning.carry
        return sparse.eye_array(self.given_skin.vertex_count, self.skin.vertex_count, format="csr")

    @cached_property
    def sheet(self) -> ElasticSheet:
        """Its elastic response."""
        return ElasticSheet(self.skin) if self._same_skin is None else self._same_skin.sheet

    @cached_property
    def jaw(self) -> Jaw:
        """The mandible."""
        return build_jaw(self.skin, self.warp)

    def _part(self, part: Part) -> Ints:
        return np.flatnonzero(self.mesh.parts == part)

    @cached_property
    def eyes(self) -> dict[str, Eye]:
        """The lids' axes, by "l" and "r"."""
        found = {}
        for side, part in (("l", Part.EYEBALL_L), ("r", Part.EYEBALL_R)):
            ball = self.mesh.positions[self._part(part)]
            found[side] = build_eye(self.skin, side, ball if len(ball) else None)
        return found

    @stepwise
    def contact(self) -> Work[Contact]:
        """Lips and lids where they meet, eyeballs and teeth behind them."""
        return (yield from contact_steps(self.skin, self.mesh, self.eyes, self.eyeballs, self.jaw))

    @cached_property
    def muscles(self) -> list[PlacedMuscle]:
        """The muscles of the table whose mechanisms this face has, placed on it."""
        return place_muscles(muscles_of(self.mechanisms), self.warp)

    @stepwise
    def pulls(self) -> Work[Pulls]:
        """What the muscles do to the skin."""
        if self._same_pulls is None:
            return (yield from pulls_steps(self.skin, self.sheet, self.muscles))
        yield from worked_out(self._same_pulls, "pulls")
        return self._same_pulls.pulls.of({muscle.name for muscle in self.muscles})

    @cached_property
    def actuators(self) -> Actuators:
        """Muscles, lids and jaw with their fields."""
        return Actuators(self.skin, self.pulls, self.jaw, self.eyes)

    @cached_property
    def relaxation(self) -> Relaxation:
        """The skin's equilibrium under the muscles."""
        return Relaxation(self.skin, self.sheet, self.actuators)

    @cached_property
    def points(self) -> FeaturePoints:
        """The feature points that FAPs are read off and moved by.

        A point of lips or lids may lie between vertices of which some are behind the margin: inside, nothing that acts
        on the outer skin reaches it. It is taken to be at the nearest place of the outer skin.
        """
        face_mesh, outside = self.mesh, self._is_outside
        behind = [
            name
            for name, point in face_mesh.points.items()
            if lies_on_skin(name)
            and point.is_bound
            and (face_mesh.parts[point.vertices] == Part.SKIN).all()
            and not outside[point.vertices].all()
        ]
        if not behind:
            return face_mesh.points
        triangles = self.given_skin.index[mesh.fans(self.given_skin.polygons)[0]]
        return rebound(face_mesh.points, face_mesh.head_frame.to_face(face_mesh.positions), triangles, behind)

    @cached_property
    def _is_outside(self) -> Bools:
        """(V,) which vertices are of the outer skin."""
        outside = np.zeros(len(self.mesh.positions), dtype=bool)
        outside[self.given_skin.index] = True
        return outside

    @cached_property
    def rows(self) -> FapRows:
        """Displacement FAPs whose points lie on the mesh."""
        return displacement_rows(self.points, self.mesh.units, self.mesh.head_frame)

    @cached_property
    def measured(self) -> Ints:
        """Vertices that FAPs are read off."""
        points = [*self.points.values(), *self.mesh.points.values()]
        held = [point.vertices for point in points if point.is_bound]
        return np.unique(np.concatenate([*held, *(ball.index for ball in self.eyeballs)]))

    @cached_property
    def skin_rows(self) -> FapRows:
        """Those of `rows` whose points lie wholly on the outer skin."""
        keep = np.array([bool(self._is_outside[self.points[n].vertices].all()) for n in self.rows.names])
        return FapRows(
            numbers=self.rows.numbers[keep],
            names=tuple(n for n, k in zip(self.rows.names, keep, strict=True) if k),
            directions=self.rows.directions[keep],
            units=self.rows.units[keep],
        )

    @cached_property
    def inverse_rows(self) -> FapRows:
        """Those of `skin_rows`, and the lips' middles."""
        return self.skin_rows.with_lip_middles() if Mechanism.LIP_MIDDLE in self.mechanisms else self.skin_rows

    @stepwise
    def kernel(self) -> Work[Kernel]:
        """How the skin answers loads on the rows."""
        rows = self.inverse_rows
        if self._same_skin is not None:
            yield from worked_out(self._same_skin, "kernel")
            return self._same_skin.kernel.first(len(rows))
        own = self.points.matrix(rows.names)[:, self.given_skin.index]
        return (yield from kernel_steps(rows, sparse.csr_array(own @ self.carry), self.sheet))

    @cached_property
    def inverse(self) -> Inverse:
        """FAP rows to amounts."""
        return Inverse(self.inverse_rows, self.actuators, self.kernel)

    @cached_property
    def points_on_skin(self) -> Ints:
        """Vertices of `skin` that FAPs are read off."""
        return np.unique(self.kernel.matrix.indices // 3).astype(np.int64)

    @cached_property
    def points_on_given_skin(self) -> Ints:
        """The same of `given_skin`."""
        read = self.points.matrix(self.inverse_rows.names)[:, self.given_skin.index]
        return np.unique(read.indices).astype(np.int64)

    @stepwise
    def inner_skin(self) -> Work[InnerSkin]:
        """Mouth cavity and eye sockets."""
        inner: Bools = self.mesh.parts == Part.SKIN
        inner[self.still_skin] = False
        inner[self.given_skin.index] = False
        polygons = self._skin_polygons
        about = polygons.kept(polygons.touching(inner))
        before = self.given_skin if self._thinning is None else self.skin
        return (yield from InnerSkin.steps(self.mesh.positions, about, inner, before))

    @stepwise
    def rooted_parts(self) -> Work[RootedParts]:
        """Brows, lashes and whatever has no part of its own: they grow out of outer skin and teeth."""
        teeth = (self._part(Part.TEETH_UPPER), self._part(Part.TEETH_LOWER))
        carriers = np.unique(np.concatenate([self.given_skin.index, self.still_skin, *teeth]))
        place = self.mesh.positions, self.mesh.polygons
        return (yield from RootedParts.steps(*place, self._part(Part.OTHER), carriers))

    def _fap_unit(self, number: int) -> float:
        """One unit of a FAP that is a length, metres of head space."""
        return unit_length(FAPS[number].unit, self.mesh.units) / self.mesh.head_frame.scale

    @cached_property
    def jaw_parts(self) -> Ints:
        """Vertices that turn with the mandible: lower teeth and tongue."""
        return np.union1d(self._part(Part.TEETH_LOWER), self._part(Part.TONGUE))

    @cached_property
    def eyeballs(self) -> list[Eyeball]:
        """The eyeballs that the mesh has."""
        found = []
        for side, part, pupil, faps in (
            ("l", Part.EYEBALL_L, "3.5", (23, 25, 27, 29)),
            ("r", Part.EYEBALL_R, "3.6", (24, 26, 28, 30)),
        ):
            index = self._part(part)
            if len(index) == 0:
                continue
            ball, pupil_at = self.mesh.positions[index], self.mesh.landmarks[pupil]
            iris = self.mesh.units.irisd0 / self.mesh.head_frame.scale / 2.0
            units = (self._fap_unit(faps[2]), self._fap_unit(faps[3]))
            found.append(build_eyeball(self.eyes[side], index, ball, pupil_at, iris, faps, units))
        return found

    @cached_property
    def tongue(self) -> Tongue | None:
        """The tongue, where the mesh has one."""
        index = self._part(Part.TONGUE)
        if len(index) == 0:
            return None
        lengths = (self._fap_unit(43), self._fap_unit(44))
        tip, body = (self.mesh.landmarks.get(name) for name in ("6.1", "6.2"))
        return build_tongue(index, self.mesh.positions[index], lengths, tip, body)

    @cached_property
    def head_turn(self) -> HeadTurn:
        """The head on its spine."""
        landmarks = self.mesh.landmarks
        pivot = landmarks["7.1"] if "7.1" in landmarks else self.warp(TEMPLATE_POINTS["7.1"])
        brow = float(landmarks["4.3"][1] + landmarks["4.4"][1]) / 2.0
        own = ~np.isin(self.mesh.parts, (COPY, Part.SKULL))
        return build_head_turn(self.mesh.positions, pivot, brow, own)
