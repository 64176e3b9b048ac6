"""A long motion: some hundred of its frames are posed, and the others lie between those, over what is asked.

Minutes of a recording ask for the same few hundred faces again and again. Frames that differ most from those posed
already are posed, and every other frame is a weighted sum of these, by a Gaussian process over the FAPs (Rasmussen and
Williams 2006, chapter 2). Faces without the head's turn are summed; the head turns as a body, frame by frame.

Limitations. Every frame is in balance: the skin has no inertia of its own. That suits a recording, whose face has moved
with its own; a motion that is made up wants `simulate`. Between the posed frames a vertex is off by some tenths of a
millimetre, told as `off`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..arrays import Bools, Floats, Ints
from ..errors import SolverError
from ..mpeg4 import ANGLE_UNIT, FAP_COUNT, FAPS, Feeling
from ..progress import Progress, Work, part_of
from .anatomy import Anatomy
from .assembly import check_finite
from .clip_balance import clip_balance
from .drive.request import Drive, Request
from .mesh.fap_units import unit_length
from .pose import Poser

#: Frames that are posed at most, and besides these, to see how far the others are off.
POSED, LOOKED_AT = 320, 32
#: FAPs so far apart, in millimetres of the feature points of a life-size face, still tell much of one another's faces.
REACH = 12.0
#: The share of what goes evenly with the FAPs, for a square millimetre.
EVEN = 0.1
#: Frames told apart by less than this share of all that could be different need no pose of their own.
ALIKE = 1e-6
#: What keeps alike frames from being weighed against each other.
RIDGE = 1e-6
#: Millimetres by which a FAP that is silent now and then differs from one that is stated as 0.
SILENT = 3.0
#: An angle counts as what it moves at this distance, millimetres: an eyeball's radius.
LEVER = 12.0
#: A millimetre, in metres.
MM = 1e-3
#: Positions are worked out for so many figures at once.
BLOCK = 4_000_000
#: How far the work is once what balances the posed frames is known.
BALANCED = 0.7
#: FAPs of the head's turn, as columns.
TURN = slice(47, 50)


@dataclass(frozen=True, eq=False)
class LongMotion:
    """A motion as sums of posed faces.

    Attributes
    ----------
    frames : (T, 68) FAPs; NaN where silent.
    posed : (S,) frames that were posed.
    shapes : (S, V, 3) of these, displacements without the head's turn, head space, metres.
    weights : (T, S) how much of each shows.
    off : (c,) the largest distance of any vertex, metres of the face, at frames that were posed to see; before these
        were taken in.
    """

    anatomy: Anatomy
    frames: Floats
    posed: Ints
    shapes: Floats
    weights: Floats
    off: Floats

    def __len__(self) -> int:
        return len(self.frames)

    def __iter__(self) -> Iterator[Floats]:
        """Positions (V, 3) in the face's coordinates, frame by frame."""
        size = max(1, BLOCK // max(1, self.shapes[0].size))
        for first in range(0, len(self), size):
            yield from self.positions(np.arange(first, min(first + size, len(self))))

    def positions(self, steps: Ints, vertices: Ints | slice[None, None, None] = slice(None)) -> Floats:
        """(n, v, 3) positions of all or some vertices at some frames, in the face's coordinates."""
        mesh, turn = self.anatomy.mesh, self.anatomy.head_turn
        shapes = self.shapes[:, vertices]
        moved = (self.weights[steps] @ shapes.reshape(len(shapes), -1)).reshape(len(steps), -1, 3)
        rest = mesh.positions[vertices]
        turned = [turn.apply(rest + each, self.frames[step], vertices) for each, step in zip(moved, steps, strict=True)]
        return mesh.head_frame.to_face(np.array(turned))


def long_motion(poser: Poser, frames: Floats, drive: Drive, *, planned: bool = False) -> Work[LongMotion]:
    """A motion (T, 68), NaN where silent, bit by bit; `planned` as for `stream_plans`."""
    anatomy = poser.anatomy
    asked = frames.copy()
    asked[:, TURN] = np.nan
    places = _places(asked, anatomy)
    chosen = _most_different(places)
    left = np.setdiff1d(np.arange(len(frames)), chosen)
    looked_at = left[:: max(1, len(left) // LOOKED_AT)][:LOOKED_AT]
    posed = np.concatenate([chosen, looked_at])
    requests = [Request(asked[step], drive, Feeling({}) if planned else None) for step in posed]
    try:
        shapes = yield from _shapes(poser, requests)
    except SolverError as error:
        raise error if error.frame is None else error.in_frame(int(posed[error.frame])) from error
    between = _weights(places[looked_at], places[chosen]) @ shapes[: len(chosen)].reshape(len(chosen), -1)
    apart = shapes[len(chosen) :] - between.reshape(len(looked_at), *shapes.shape[1:])
    off = np.linalg.norm(apart, axis=2).max(axis=1, initial=0.0) * anatomy.mesh.head_frame.scale
    return LongMotion(anatomy, frames, posed, shapes, _weights(places, places[posed]), off)


def _shapes(poser: Poser, requests: Sequence[Request]) -> Work[Floats]:
    """(S, V, 3) what a face is moved by in some requests of one drive, head space, metres."""
    mesh = poser.anatomy.mesh
    shapes = np.empty((len(requests), *mesh.positions.shape))
    if not len(requests):
        return shapes
    clip = yield from part_of(clip_balance(poser.balance, [poser.plan(request) for request in requests]), 0.0, BALANCED)
    for steps, postures in clip.along():
        check_finite(postures.displacements, range(steps.start, steps.stop))
        jaws = np.asarray(postures.surroundings.jaw)
        shown = poser.assembly.positions_each(postures.displacements, jaws, requests[steps])
        for number, positions in enumerate(shown, start=steps.start):
            shapes[number] = mesh.head_frame.to_head(positions) - mesh.positions
        yield Progress(BALANCED + (1.0 - BALANCED) * steps.stop / len(requests), "Posing the frames that differ")
    return shapes


def _places(frames: Floats, anatomy: Anatomy) -> Floats:
    """(T, n) where what is asked takes the feature points, millimetres of a life-size face, and what is silent."""
    columns: list[Floats] = []
    for number in range(3, FAP_COUNT + 1):
        fap, values = FAPS[number], frames[:, number - 1]
        stated: Bools = ~np.isnan(values)
        if not stated.any():
            continue
        scale = MM * anatomy.mesh.head_frame.scale
        unit = LEVER * ANGLE_UNIT if fap.angular else unit_length(fap.unit, anatomy.mesh.units) / scale
        columns.append(np.asarray(np.nan_to_num(values) * unit, dtype=np.float64))
        if not stated.all():
            columns.append(np.asarray(SILENT * stated, dtype=np.float64))
    return np.stack(columns, axis=1) if columns else np.zeros((len(frames), 1))


def _alike(one: Floats, other: Floats) -> Floats:
    """(n, m) how alike what is asked at places (n, d) and (m, d) makes faces."""
    apart = (one**2).sum(axis=1)[:, None] + (other**2).sum(axis=1) - 2.0 * one @ other.T
    return np.asarray(np.exp(-np.maximum(apart, 0.0) / (2.0 * REACH**2)) + EVEN * one @ other.T)


def _most_different(places: Floats) -> Ints:
    """Frames, each of which differs most from those before it and from rest; as many as it takes, or may be posed."""
    count = min(POSED, len(places))
    all_places = np.concatenate([np.zeros((1, places.shape[1])), places])  # the first is rest, which is known
    left = 1.0 + EVEN * (all_places**2).sum(axis=1)
    least = ALIKE * float(left.max())
    factor = np.empty((count + 1, len(all_places)))
    chosen: list[int] = []
    step = 0
    for number in range(count + 1):
        known = factor[:number]
        column = _alike(all_places, all_places[step : step + 1])[:, 0] - known[:, step] @ known
        factor[number] = column / np.sqrt(left[step])
        left = left - factor[number] ** 2
        chosen.append(step)
        left[chosen] = 0.0
        step = int(left.argmax())
        if left[step] <= least:
            break
    return np.array(chosen[1:], dtype=np.int64) - 1


def _weights(places: Floats, posed: Floats) -> Floats:
    """(n, S) how much of the faces posed at places (S, d) shows at places (n, d); all of none of them is rest."""
    known = np.concatenate([np.zeros((1, posed.shape[1])), posed])
    among = _alike(known, known)
    among[np.diag_indices(len(known))] *= 1.0 + RIDGE
    factor = cho_factor(among)
    return np.asarray(cho_solve(factor, _alike(known, places))[1:].T)
