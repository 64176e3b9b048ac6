"""One face held ready for a live preview: read once, worked out bit by bit, sketched again and again."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats, Ints
from ...mpeg4 import Feeling
from ...progress import Work
from ..bake.motion import Motion
from ..bake.target import Target
from ..faces import face_of, keep_steps
from ..fingerprint import fingerprint, uid_of
from ..points.kept import mesh_counts
from . import preview
from .played import PlayedMotion

if TYPE_CHECKING:
    from ...api import EmotionShares
    from ...face.products.muscle_lines import MuscleLines

#: Stops on a traced way, and distance of the traced vertices, metres.
STOPS, SPACING = 7, 7e-3
#: Expressions that are kept in full, so that a timeline plays without posing the face in every frame.
KEPT_APEXES = 24


@dataclass(frozen=True, eq=False)
class LivePose:
    """What a face would show.

    Attributes
    ----------
    displacement : (V, 3) of all its vertices, metres. contractions : muscle name -> 0..1.
    unmet : FAP number -> why, of what is asked and does not show; of a sketch nothing is known.
    """

    displacement: Floats
    contractions: Mapping[str, float]
    unmet: Mapping[int, str] = field(default_factory=dict)


class LiveFace:
    """A face that shows itself on its own objects without changing them; see `preview`."""

    def __init__(self, target: Target) -> None:
        """Read the face.

        Raises
        ------
        SceneError, ModelError : as for a bake.
        """
        self.uid = uid_of(target.obj)
        self._source = target.source()
        self._seen, self._counts = time.monotonic(), _counts(target)
        self._face = face_of(self._source)
        self._sketcher = self._face.sketcher()
        self._apexes: OrderedDict[str, Floats] = OrderedDict()
        self._played: tuple[str, PlayedMotion] | None = None
        self._motion: Work[None] | None = None
        self._keeping: Work[None] | None = self._explored_and_kept()

    def is_of(self, target: Target, *, since: float = 0.0) -> bool:
        """Whether the face is still as it was read.

        Where that was seen less than `since` seconds ago, only the counts of its meshes are looked at.
        """
        if time.monotonic() < self._seen + since:
            return self._counts == _counts(target)
        same = fingerprint(target.obj, target.companions).matches(self._source.fingerprint)
        self._seen = time.monotonic() if same else -np.inf
        return same

    def prepare(self) -> Work[None]:
        """Work out what the first sketch needs."""
        yield from self._face.prepare()

    @property
    def has_more(self) -> bool:
        """Whether there is something to be done for it once nothing else is due."""
        return self._motion is not None or self._keeping is not None

    def _explored_and_kept(self) -> Work[None]:
        """Find out what is near, for quick sketches, and keep all that was worked out for the next time."""
        yield from self._face.prepare()
        yield from self._sketcher.explore()
        yield from keep_steps(self._face)

    def go_on(self) -> None:
        """A share of that: the motion that is played first, then what is kept for the next time.

        Raises
        ------
        RisoriusError : it cannot be done, and will not be tried again.
        """
        motion, keeping = self._motion, self._keeping
        if motion is not None:
            self._motion = None
            if next(motion, None) is not None:
                self._motion = motion
        elif keeping is not None and next(keeping, None) is None:
            self._keeping = None

    def drop(self) -> None:
        """Do no more for it."""
        for work in (self._motion, self._keeping):
            if work is not None:
                work.close()
        self._motion = self._keeping = None

    def played(self, settings: str, motion: Motion, *, first_frame: float, fps: float, drive: str) -> PlayedMotion:
        """A motion of this face, of which `go_on` works out more and more; another one where its settings differ."""
        if self._played is None or self._played[0] != settings:
            played = PlayedMotion(self._face, motion, first_frame=first_frame, fps=fps, drive=drive)
            self._played, self._motion = (settings, played), played.work()
        return self._played[1]

    def pose(
        self,
        faps: Floats,
        *,
        drive: str,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
        exact: bool = False,
        passing: bool = False,
    ) -> LivePose:
        """The face for some FAPs (68,): a sketch (`Face.sketcher`), in passing or not, or in balance as a bake is."""
        if exact:
            pose = self._sketcher.pose(faps, drive=drive, emotion=emotion, contractions=contractions)
            return LivePose(pose.positions - self._face.vertices, pose.contractions, pose.unmet)
        sketch = self._sketcher.sketch(faps, drive=drive, emotion=emotion, contractions=contractions, passing=passing)
        return LivePose(sketch.positions - self._face.vertices, sketch.contractions)

    def apex(
        self,
        faps: Floats,
        *,
        drive: str,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
    ) -> Floats:
        """(V, 3) displacement of a sketch, metres; those last asked for are kept."""
        name = repr((faps.tolist(), drive, emotion, contractions))
        found = self._apexes.pop(name, None)
        if found is None:
            found = self.pose(faps, drive=drive, emotion=emotion, contractions=contractions).displacement
        self._apexes[name] = found
        while len(self._apexes) > KEPT_APEXES:
            self._apexes.popitem(last=False)
        return found

    def spoken(self, faps: Floats, *, drive: str) -> Floats:
        """(V, 3) displacement of a sketch of planned FAPs (68,), metres: they show all that is felt, too."""
        return self.pose(faps, drive=drive, emotion={}).displacement

    def paths_to(
        self,
        faps: Floats,
        *,
        drive: str,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
    ) -> Floats:
        """(k, T, 3) the skin's ways from rest to FAPs (68,), in the head mesh's own coordinates."""
        rest, stops = self._source.vertices[self._traced], [np.zeros((len(self._traced), 3))]
        for share in np.linspace(0.0, 1.0, STOPS)[1:]:
            felt = None if emotion is None else Feeling.of(emotion).faded(share)
            pose = self.pose(share * faps, drive=drive, emotion=felt, contractions=contractions)
            stops.append(pose.displacement[self._traced])
        return self._local(np.stack([rest + moved for moved in stops], axis=1))

    @cached_property
    def _traced(self) -> Ints:
        """The vertices whose ways are traced."""
        from ...face.products.trajectories import sampled_vertices

        return sampled_vertices(self._face, SPACING)

    def muscle_strands(self, shown: Floats) -> dict[str, Floats]:
        """Muscle name -> (s, n, 3) strands, in the head mesh's own coordinates, where its vertices show (V, 3)."""
        head = self._source.pieces[0]
        moved = np.zeros_like(self._source.vertices)
        moved[head.slice] = (shown - head.rest) @ head.to_metres[:3, :3].T
        return {name: self._local(lines.moved(moved)) for name, lines in self._muscle_lines.items()}

    @cached_property
    def _muscle_lines(self) -> Mapping[str, MuscleLines]:
        from ...face.products.muscle_lines import muscle_lines

        return muscle_lines(self._face)

    def _local(self, places: Floats) -> Floats:
        """Places (..., 3) of the joined metres in the head mesh's own coordinates."""
        to_metres = self._source.pieces[0].to_metres
        local: Floats = (places - to_metres[:3, 3]) @ np.linalg.inv(to_metres[:3, :3]).T
        return local

    def show(self, target: Target, displacement: Floats) -> None:
        """Show a displacement (V, 3) on the objects of the face: after an undo they are others than those read."""
        for piece, obj in zip(self._source.pieces, target.objects(), strict=True):
            if piece is self._source.pieces[0] or piece.moves(displacement, 0.0):
                preview.show(obj, piece.local_positions(displacement))
            else:
                preview.rest([obj])


def _counts(target: Target) -> list[tuple[int, tuple[int, int, int]]]:
    """Number of each object of a face, and how many vertices, corners and polygons it has."""
    return [(uid_of(obj), mesh_counts(obj.data)) for obj in target.objects()]
