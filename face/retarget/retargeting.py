"""A motion of the muscles as values of the controls that a rig already has.

Feature points and gaze count more than the skin around them, and controls that fight each other are kept apart, as far
as the skin's motion is shown hardly less well for it (`weighing`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Bools, Floats
from ...errors import ModelError, ParameterError
from ...mpeg4 import FAP_COUNT
from ..face import Face
from ..unmet import unmet
from .beyond import Beyond, between
from .controls import Controls
from .mirrored import mirrored_pairs
from .normal import Seen, Wishes, seen
from .shortfall import Shortfall, shortfalls
from .sight import sight_of
from .weighing import Counted, weighed_values

#: Weight of second differences over time, at 25 frames per second, where a motion is to be smooth.
SMOOTH = 4.0
USUAL_RATE = 25.0
#: Controls do the same where the cosine between their effects is at least this.
SAME = 0.9995
#: A head is at rest where half its skull moves less than this, metres of head space.
STEADY = 1e-5
#: Why a FAP does not show although the face could show it.
NO_CONTROL = "no control that can be used shows it"
#: Controls that carry less than this share of a motion are not worth naming.
CARRYING = 0.05
#: So many are named even so.
NAMED = 3


@dataclass(frozen=True, eq=False)
class Retargeted:
    """A motion on the controls of a rig.

    Attributes
    ----------
    names : of the K controls that were used.
    values : (T, K) of them, 0 at rest.
    asked, shown : (T, 68) FAPs of the motion and of what the controls show of it, FAP units; NaN where the face has no
        such point. Not those of head and eyeballs.
    moved, off : (T,) root mean square over the outer skin of the motion and of its distance from what is shown, metres.
    head_turns : (T, 3) FAPs 48-50 of the motion, which no control of the face shows.
    carriers : name -> share of the motion that goes through a control, the largest first.
    missing : FAPs that fall short. unmet : FAP number -> why, of FAPs that are requested and of which nothing shows.
    still, same : names of controls that do nothing; of those that do what another does -> that other. Neither is used.
    """

    names: tuple[str, ...]
    values: Floats
    asked: Floats
    shown: Floats
    moved: Floats
    off: Floats
    head_turns: Floats
    carriers: dict[str, float]
    missing: Sequence[Shortfall]
    unmet: dict[int, str]
    still: tuple[str, ...]
    same: dict[str, str]

    @property
    def explained(self) -> float:
        """Share of the motion of the outer skin that is shown: 1 - |off|^2 / |moved|^2; 1 where nothing moves."""
        size = float((self.moved**2).sum())
        return 1.0 if size == 0.0 else 1.0 - float((self.off**2).sum()) / size

    @property
    def off_at_peak(self) -> float:
        """`off` at the step at which most moves, metres."""
        return float(self.off[np.argmax(self.moved)])


def retarget(
    face: Face,
    controls: Controls,
    motion: Iterable[Floats],
    *,
    fps: float = 25.0,
    requested: ArrayLike | None = None,
    symmetric: bool = False,
    smooth: float = 1.0,
) -> Retargeted:
    """The values of controls that bring a face nearest to a motion.

    Parameters
    ----------
    motion : positions (V, 3) of the face, frame by frame; taken one by one. A turn of the head is set aside.
    fps : frames per second.
    requested : (..., 68) FAPs behind the motion, NaN where silent, if they are known: these count most.
    symmetric : controls that are each other's mirror image get one value.
    smooth : how smooth values are over time: 0 leaves each frame to itself, 1 is usual.

    Raises
    ------
    ModelError : no control does anything to this face.
    ParameterError : effects of another mesh, or a motion without frames.

    Examples
    --------
    >>> face = api.default_face()
    >>> smile = face.pose(api.expression("joy").frame()).positions
    >>> controls = api.Controls(("smile",), (smile - face.vertices)[None], np.zeros(1), np.ones(1))
    >>> found = api.retarget(face, controls, [face.vertices, smile])
    >>> bool(found.explained > 0.95)
    True
    """
    retargeting = Retargeting(face, controls, symmetric=symmetric)
    take = retargeting.take()
    for positions in motion:
        take.add(positions)
    return retargeting.values(take, fps=fps, requested=requested, smooth=smooth)


class Take:
    """A motion as the controls of a face see it; its frames are not kept, but for the skin of those that are named."""

    def __init__(self, seen_by: Retargeting, kept: Sequence[int]) -> None:
        self._by, self.kept = seen_by, tuple(kept)
        self._flat: dict[int, Floats] = {}
        self._skin: list[Floats] = []
        self._points: list[Floats] = []
        self._size: list[float] = []
        self.turns: list[Floats] = []

    def add(self, positions: ArrayLike) -> None:
        """Another frame: positions (V, 3) of the face. A turn of the head is set aside and noted in `turns`."""
        by = self._by
        rest, turn = by.face.anatomy.mesh.positions, by.face.anatomy.head_turn
        head = by.frame.to_head(np.asarray(positions, dtype=np.float64))
        faps: dict[int, float] = {}
        if turn.is_readable and np.median(np.abs(head[turn.skull] - rest[turn.skull])) > STEADY:
            head, faps = turn.undo(head, rest)
        self.turns.append(np.array([faps.get(number, 0.0) for number in (48, 49, 50)]))
        flat = by.sight.of_skin(head - rest)
        if len(self._size) in self.kept:
            self._flat[len(self._size)] = flat
        self._skin.append(by.does.skin @ flat)
        self._points.append(by.sight.of_points(head - rest))
        self._size.append(float(flat @ flat))

    def wishes(self) -> Wishes:
        """What the frames so far ask of the controls."""
        return Wishes(np.array(self._skin), np.array(self._points), np.array(self._size))

    def beyond(self, displacements: Floats) -> Beyond:
        """What a rig shows beyond the sum of its controls: (n, V, 3), metres, at the frames that are kept."""
        by = self._by
        frames = sorted(self._flat)
        extra = by.seen(displacements)
        along = np.array([self._flat[frame] @ flat for frame, flat in zip(frames, extra.skin, strict=True)])
        some = Beyond(extra.skin @ by.does.skin.T, extra.points, along, (extra.skin**2).sum(axis=1))
        return between(frames, len(self._size), some)


class Retargeting:
    """One face and the controls of its rig, ready for motions."""

    def __init__(self, face: Face, controls: Controls, *, symmetric: bool = False) -> None:
        """Prepare the controls; parameters and errors as for `retarget`."""
        if controls.effects.shape[1] != len(face.vertices):
            expected = f"must be of the face's {len(face.vertices)} vertices"
            raise ParameterError("effects", expected, controls.effects.shape)
        self.face, self.frame = face, face.anatomy.mesh.head_frame
        self.sight = sight_of(face.anatomy)
        still = controls.still(face.scale)
        self.still = tuple(name for name, idle in zip(controls.names, still, strict=True) if idle)
        if still.all():
            raise ModelError("none of the controls moves the face: choose controls that do, and unlock them")
        moving = controls.select(~still)
        does = self.seen(moving.effects)
        self.same = _doubles(moving, does)
        kept = np.array([name not in self.same for name in moving.names], dtype=bool)
        self.controls = moving.select(kept)
        self.does = does if kept.all() else Seen(does.skin[kept], does.points[kept])
        self.symmetric = symmetric

    def seen(self, displacements: Floats) -> Seen:
        """What counts of displacements (., V, 3) of the face, metres."""
        turn = self.frame.axes.T / self.frame.scale
        return seen(self.sight, (moved @ turn for moved in displacements))

    @cached_property
    def _mirrored(self) -> Sequence[tuple[int, int]]:
        """Pairs of controls that are each other's mirror image, left and right."""
        return mirrored_pairs(self.face.anatomy.mesh.positions[self.sight.skin], self.does.skin)

    @cached_property
    def ties(self) -> Floats:
        """(J, K) which controls have one value."""
        ties = np.eye(len(self.controls))
        if not self.symmetric:
            return ties
        for left, right in self._mirrored:
            ties[left, right] = 1.0
        return np.delete(ties, [right for _, right in self._mirrored], axis=0)

    @cached_property
    def _tied(self) -> Seen:
        """What controls do that have one value."""
        if len(self.ties) == len(self.controls):
            return self.does
        return Seen(self.ties @ self.does.skin, self.ties @ self.does.points)

    @cached_property
    def _mirror(self) -> dict[int, int]:
        """Control -> its mirror image; those that have one value are each their own."""
        pairs = () if self.symmetric else self._mirrored
        return dict(pairs) | {right: left for left, right in pairs}

    def values(
        self,
        take: Take,
        *,
        fps: float = 25.0,
        requested: ArrayLike | None = None,
        smooth: float = 1.0,
        beyond: Beyond | None = None,
    ) -> Retargeted:
        """The controls' values for a motion; see `retarget`.

        Parameters
        ----------
        beyond : what the rig shows beyond the sum of its controls; it is taken to stay as it is.
        """
        if not take.turns:
            raise ParameterError("motion", "must have at least one frame", 0)
        asked = take.wishes() if beyond is None else beyond.left_of(take.wishes())
        wish = Wishes(asked.skin @ self.ties.T, asked.points, asked.size)
        smoothing = smooth * SMOOTH * (fps / USUAL_RATE) ** 4
        found = weighed_values(
            self._tied, wish, self._counted(requested), *self._limits, smooth=smoothing, mirror=self._mirror
        )
        return self.told(take, found @ self.ties, requested=requested, beyond=beyond)

    def take(self, kept: Sequence[int] = ()) -> Take:
        """A motion to be added frame by frame; the skin of some frames is kept, to compare what the rig shows."""
        return Take(self, kept)

    def _counted(self, requested: ArrayLike | None) -> Counted:
        """Which points are read for FAPs, and which of those are requested."""
        faps = np.arange(self.does.points.shape[1]) < len(self.sight.numbers)
        wanted = np.zeros_like(faps)
        if requested is not None:
            silent = np.isnan(np.asarray(requested, dtype=np.float64).reshape(-1, FAP_COUNT))
            known: Bools = np.asarray(~silent.all(axis=0))
            wanted[: len(self.sight.numbers)] = known[self.sight.numbers - 1]
        return Counted(faps, wanted)

    @cached_property
    def _limits(self) -> tuple[Floats, Floats]:
        """(J,) the limits of values that controls share."""
        reach = np.where(self.ties > 0.0, 1.0, np.nan)
        return np.nanmax(reach * self.controls.low, axis=1), np.nanmin(reach * self.controls.high, axis=1)

    def told(
        self, take: Take, values: Floats, *, requested: ArrayLike | None = None, beyond: Beyond | None = None
    ) -> Retargeted:
        """What is told of values (T, K) for a motion; see `values`."""
        asked = take.wishes()
        goal = asked if beyond is None else beyond.left_of(asked)
        square, count = self.does.square, len(self.sight.skin)
        left = goal.size - 2.0 * (values * goal.skin).sum(axis=1) + np.einsum("tj,jk,tk->t", values, square, values)
        to_face = self.frame.scale / np.sqrt(max(count, 1))
        reached = values @ self.does.points + (0.0 if beyond is None else beyond.points)
        sought, shown = self._faps(asked.points), self._faps(reached)
        through = np.abs(values).sum(axis=0) * np.sqrt(np.diagonal(square))
        shares = through / max(float(through.sum()), 1e-300)
        order = [i for n, i in enumerate(np.argsort(-shares)) if shares[i] >= (CARRYING if n >= NAMED else 1e-9)]
        return Retargeted(
            names=tuple(self.controls.names),
            values=values,
            asked=sought,
            shown=shown,
            moved=np.sqrt(asked.size) * to_face,
            off=np.sqrt(np.maximum(left, 0.0)) * to_face,
            head_turns=np.array(take.turns),
            carriers={self.controls.names[i]: float(shares[i]) for i in order},
            missing=shortfalls(sought, shown, self._units),
            unmet=self._unmet(requested, shown),
            still=self.still,
            same=self.same,
        )

    def distance(self, found: Retargeted) -> float:
        """How far a rig is from a motion, over skin and FAPs alike: a mean of squares, summed over frames."""
        faps = (found.asked - found.shown) * self._units * self.frame.scale
        return float((found.off**2).sum() + np.nan_to_num(np.nanmean(faps**2, axis=1)).sum())

    def _unmet(self, requested: ArrayLike | None, shown: Floats) -> dict[int, str]:
        """FAP number -> why, of FAPs that are requested and of which nothing shows."""
        if requested is None:
            return {}
        asked = np.asarray(requested, dtype=np.float64).reshape(-1, FAP_COUNT).copy()
        asked[:, np.isnan(self._units)] = np.nan
        return unmet(self.face.anatomy, asked, shown, dict.fromkeys(range(1, FAP_COUNT + 1), NO_CONTROL))

    def _faps(self, points: Floats) -> Floats:
        """(T, 68) FAPs of what is seen of points (T, m)."""
        faps = np.full((len(points), FAP_COUNT), np.nan)
        numbers = self.sight.numbers
        faps[:, numbers - 1] = points[:, : len(numbers)] / self.sight.units
        return faps

    @cached_property
    def _units(self) -> Floats:
        """(68,) metres per FAP unit."""
        units = np.full(FAP_COUNT, np.nan)
        units[self.sight.numbers - 1] = self.sight.units
        return units


def _doubles(controls: Controls, does: Seen) -> dict[str, str]:
    """Controls that do what another before them does -> that other.

    The opposite is the same where that other goes both ways.
    """
    products = does.square + does.points @ does.points.T
    length = np.sqrt(np.diagonal(products))
    cosines = products / np.maximum(np.outer(length, length), 1e-300)
    ways = (controls.low < 0.0) & (controls.high > 0.0)
    alike, names = (cosines >= SAME) | (ways[:, None] & (cosines <= -SAME)), controls.names
    found: dict[str, str] = {}
    for later in range(len(names)):
        first = next((one for one in range(later) if alike[one, later] and names[one] not in found), None)
        if first is not None:
            found[names[later]] = names[first]
    return found
