"""Contact: lips and lids that meet without passing through each other, lids on the eyeballs, lips on the teeth.

Projections of the skin. A pose is settled: margins that have crossed go back to where they touch, all but shut lids are
shut, and skin that has sunk into an eyeball or a tooth is lifted out. Skin in motion is held: after every step what has
gone too deep is put back and loses the speed with which it went there, so that contact never adds to the motion.
What is not modelled: one lip lying over the other, and the lining of lips and cheeks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Floats, Ints
from ...physics.mesh import fans, within
from ...physics.skin import State
from ...progress import Progress, Work, part_of
from ..figures import Pair, Share, read_figures
from ..mechanism import Mechanism
from ..mechanisms.jaw import Jaw
from ..mechanisms.lids import Eye
from ..mesh.face_mesh import FaceMesh
from ..mesh.parts import Part
from ..skin.outer import OuterSkin, smoothstep
from .dental_arch import DentalArch, front_steps
from .eyeball import Eyeball
from .eyeball_surface import EyeballSurface, modelled_ball_steps, round_ball
from .margins import Depths, Meeting, build_meeting
from .surroundings import Body, Look, Surroundings


@dataclass(frozen=True)
class ContactFigures:
    """Who gives way, and how far from lids and lips skin is kept off what is behind (presets/anatomy/bodies.toml)."""

    upper_lip: Share
    upper_lid: Share
    unfelt: float
    lid_skin: Pair
    lip_skin: Pair


CONTACT = read_figures("bodies.contact", ContactFigures)

#: FAPs that move the upper and the lower lip up or down, inner and outer.
UPPER_LIP_FAPS, LOWER_LIP_FAPS = (4, 8, 9, 51, 55, 56), (5, 10, 11, 52, 57, 58)

#: Bodies may move margins that have been settled: both are repeated at most so often, while they move this, metres.
SWEEPS, UNDISTURBED = 3, 0.02e-3

#: Eyeballs and rows of teeth of a whole face.
BODIES = 4

AT_REST = Surroundings()


def lip_share(asked: Floats) -> float:
    """The upper lip's part of the way back, 0..1, for requests (68,): a lip that is asked to move pushes the other."""
    wanted = np.abs(np.nan_to_num(asked))
    upper, lower = (
        CONTACT.unfelt + float(wanted[np.array(faps) - 1].sum()) for faps in (UPPER_LIP_FAPS, LOWER_LIP_FAPS)
    )
    return lower / (upper + lower)


@dataclass(frozen=True, eq=False)
class Slack:
    """How far T poses pass contact, which skin on its way there may too: margins and bodies, in `Contact`'s order."""

    margins: tuple[Depths, ...]
    bodies: tuple[Floats, ...]

    def towards(self, other: Slack, share: float) -> Slack:
        """Part of the way (0..1) to another pose's slack."""

        def mixed(a: Floats, b: Floats) -> Floats:
            return (1.0 - share) * a + share * b

        margins = zip(self.margins, other.margins, strict=True)
        return Slack(
            tuple((mixed(a[0], b[0]), mixed(a[1], b[1])) for a, b in margins),
            tuple(mixed(a, b) for a, b in zip(self.bodies, other.bodies, strict=True)),
        )


class Contact:
    """The contacts of one face's outer skin."""

    def __init__(self, skin: OuterSkin, sides: Sequence[str], bodies: Sequence[Body] = ()) -> None:
        """Lips and the lids of the eyes `sides` ("l", "r") as meetings, and the bodies that skin stays out of.

        What is sewn has no margins that could meet.
        """
        self.skin = skin
        self.bodies = tuple(bodies)
        self.lips = None if "mouth" in skin.sewn else build_meeting(skin, skin.mouth, skin.lip_distances, lids=False)
        free = [side for side in sides if side not in skin.sewn]
        self.lids = {side: build_meeting(skin, skin.eyes[side], skin.lid_distances(side), lids=True) for side in free}

    def settle(
        self,
        displacement: Floats,
        lip_share: Floats | float = CONTACT.upper_lip,
        at: Surroundings = AT_REST,
        *,
        shut: bool = True,
    ) -> Floats:
        """The displacement (..., n, 3) of the outer skin in head space, metres, with every contact resolved.

        `lip_share` (...) is the upper lip's part of the way back (`lip_share`). T moments have T of each. `shut`: lids
        that nearly meet are drawn together; what is settled again and again is so the last time alone.
        """
        if not self.skin.has(Mechanism.CONTACT):
            return displacement
        positions = (self.skin.positions + displacement).reshape(-1, *self.skin.positions.shape)
        shares = np.broadcast_to(lip_share, len(positions))
        at, going = at.each(len(positions)), np.arange(len(positions))
        closings = [meeting.closing(positions) if shut else None for meeting, _ in self._meetings(shares)]
        looked_at: list[Floats | None] = [None] * len(self.bodies)
        for _ in range(SWEEPS):
            whole = len(going) == len(positions)
            met = positions if whole else positions[going]
            for (meeting, share), closing in zip(self._meetings(shares[going]), closings, strict=True):
                met = meeting.settle(met, share, closing=None if closing is None else closing.some(going))
            before = met.take(self._kept_out, axis=1)
            self._lift(met, at if whole else at.some(going), looked_at=looked_at)
            if whole:
                positions = met
            else:
                positions[going] = met
            moved = np.abs(met.take(self._kept_out, axis=1) - before).max(axis=(1, 2), initial=0.0)
            stays = moved >= UNDISTURBED
            going, looked_at = going[stays], [None if seen is None else seen[stays] for seen in looked_at]
            if not len(going):
                break
        return positions.reshape(displacement.shape) - self.skin.positions

    def clear(self, displacement: Floats, at: Surroundings = AT_REST, spared: Floats | None = None) -> Floats:
        """The displacement (..., n, 3) with skin kept out of eyeballs and teeth; `spared` (n,) 0..1 of it stays."""
        if not self.skin.has(Mechanism.CONTACT):
            return displacement
        positions = (self.skin.positions + displacement).reshape(-1, *self.skin.positions.shape)
        self._lift(positions, at.each(len(positions)), spared=spared)
        return positions.reshape(displacement.shape) - self.skin.positions

    def slack(self, displacement: Floats, at: Surroundings) -> Slack:
        """How far displacements (T, n, 3) pass contact where poses have them."""
        positions = self.skin.positions + displacement
        margins = [meeting.depths(positions) for meeting, _ in self._meetings(np.empty(0))]
        return Slack(
            tuple((np.maximum(above, 0.0), np.maximum(below, 0.0)) for above, below in margins),
            tuple(np.maximum(body.depths(positions, at)[0], 0.0) for body in self.bodies),
        )

    def held(self, positions: Floats, lip_share: Floats, at: Surroundings, slack: Slack) -> Floats:
        """Positions (T, n, 3) with skin put back that has gone deeper than the slack."""
        positions = positions.copy()
        if self.skin.has(Mechanism.CONTACT):
            for (meeting, share), more in zip(self._meetings(lip_share), slack.margins, strict=True):
                positions = meeting.settle(positions, share, more)
            self._lift(positions, at, slack.bodies)
        return positions

    def hold(self, state: State, lip_share: float, at: Surroundings, slack: Slack, step: float) -> State:
        """The state with skin put back that has gone deeper than the slack, and without the speed of going there.

        A vertex loses no more speed than would have taken it as far as it was put back within the step (s).
        """
        positions = self.held(state.positions[None], np.array([lip_share]), at.each(1), slack)[0]
        back = positions - state.positions
        way = np.linalg.norm(back, axis=1)
        if not way.any():
            return state
        out = back / np.maximum(way, 1e-12)[:, None]
        inwards = np.clip(-(state.velocities * out).sum(axis=1), 0.0, way / step)
        return State(positions, state.velocities + inwards[:, None] * out)

    def _meetings(self, lip_share: Floats) -> list[tuple[Meeting, Floats]]:
        """Every pair of margins with the upper one's shares of the way (T,)."""
        lips = [] if self.lips is None else [(self.lips, lip_share)]
        return [*lips, *((lids, np.full(len(lip_share), CONTACT.upper_lid)) for lids in self.lids.values())]

    @cached_property
    def _kept_out(self) -> Ints:
        """Vertices that are kept out of any body."""
        return np.unique(np.concatenate([np.empty(0, dtype=np.int64), *(body.index for body in self.bodies)]))

    def _lift(
        self,
        positions: Floats,
        at: Surroundings,
        slack: Sequence[Floats] = (),
        spared: Floats | None = None,
        looked_at: list[Floats | None] | None = None,
    ) -> None:
        """Lift positions (T, n, 3), in place, out of bodies as far as they lie deeper than a slack, of each (T, k).

        `looked_at` holds the places (T, k, 3) of each body's skin when it was last seen to; where they are the same
        there is nothing to be done.
        """
        for number, (body, deep) in enumerate(zip(self.bodies, slack or [np.zeros(1)] * len(self.bodies), strict=True)):
            if looked_at is not None:
                near, seen = positions.take(body.index, axis=1), looked_at[number]
                if seen is not None and np.array_equal(near, seen):
                    continue
                looked_at[number] = near
            depth, out = body.depths(positions, at)
            way = np.maximum(depth - deep, 0.0) * body.firmness
            if spared is not None:
                way = way * (1.0 - spared[body.index])
            moment, place = np.nonzero(way)
            positions[moment, body.index[place]] += way[moment, place, None] * out[moment, place]


def contact_steps(
    skin: OuterSkin, mesh: FaceMesh, eyes: Mapping[str, Eye], eyeballs: Sequence[Eyeball], jaw: Jaw
) -> Work[Contact]:
    """Every contact of a face: its outer skin and mesh, lids by "l" and "r", the eyeballs it has, its mandible."""
    positions = mesh.positions
    bodies: list[Body] = []
    balls = {ball.side: ball for ball in eyeballs}
    for side, eye in eyes.items():
        index, firmness = _near(np.min(skin.lid_distances(side), axis=0), CONTACT.lid_skin)
        look = Look(eye.centre, balls[side].gaze if side in balls else np.array([0.0, 0.0, 1.0]))
        triangles = _triangles(mesh, Part.EYEBALL_L if side == "l" else Part.EYEBALL_R)
        if len(triangles):
            share = len(bodies) / BODIES
            ball = yield from part_of(modelled_ball_steps(look, positions, triangles), share, share)
        else:
            ball = round_ball(look, eye.radius)
        bodies.append(EyeballSurface(side, ball, index, firmness, skin.positions[index]))
        yield Progress(len(bodies) / BODIES, "Preparing contact of lips and lids")
    index, firmness = _near(skin.lip_edge_distance, CONTACT.lip_skin)
    for part, carried_by in ((Part.TEETH_UPPER, None), (Part.TEETH_LOWER, jaw)):
        triangles = _triangles(mesh, part)
        if len(triangles):
            share = len(bodies) / BODIES
            front = yield from part_of(front_steps(positions, triangles), share, share)
            bodies.append(DentalArch(front, carried_by, index, firmness, skin.positions[index]))
            yield Progress(len(bodies) / BODIES, "Preparing contact of lips and lids")
    return Contact(skin, list(eyes), bodies)


def _triangles(mesh: FaceMesh, part: Part) -> Ints:
    """(t, 3) vertices of a part's surface; none where the face has none."""
    return fans(within(mesh.polygons, mesh.parts == part))[0]


def _near(distance: Floats, within: tuple[float, float]) -> tuple[Ints, Floats]:
    """Vertices at a distance (n,) of less than the second of two lengths, and 1 within the first, fading to 0."""
    index = np.flatnonzero(distance < within[1])
    return index, 1.0 - smoothstep((distance[index] - within[0]) / (within[1] - within[0]))
