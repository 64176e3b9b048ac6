"""Reading a face as Blender shows it: shape keys, bones and modifiers applied, however it was animated.

What shows is measured against the resting mesh. Motion of the head as a whole (a bone, the object) is no expression:
the object's own motion is left out by its coordinates, a bone's by the skull, or by points that expressions hardly move
where the mesh is a mask without one. Only the head's own mesh is read: eyes that are objects of their own are not.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ModelError, ParameterError, SceneError
from ...progress import Progress, Work
from ..blender_types import Depsgraph, Object, Scene
from ..faces import face_of, read_face
from ..fingerprint import fingerprint, uid_of
from ..mesh import mesh_vertices
from ..points.kept import as_found
from ..points.seen import Visible
from .shown_rest import shown_rest

if TYPE_CHECKING:
    from ...api import Beliefs, BeliefTrack
    from ...physics.mesh import Sparse

#: Corners of the eyes, bridge of the nose and ears: they tell how a mask without a skull has moved as a whole.
STEADY = ("3.7", "3.8", "3.11", "3.12", "9.12", "10.7", "10.8", "10.9", "10.10")
#: An expression less strong than this share of the one it is most like is as good as none.
RESTING = 0.2


@dataclass(frozen=True, eq=False)
class Reading:
    """What a face shows at one moment.

    Attributes
    ----------
    faps : (68,) FAPs in FAP units; NaN where the face has no such point.
    features : (15,) features of Table 3; None where the face lacks points for them.
    beliefs : in the six emotions.
    words : emotion word -> belief, the most believed first.
    strength : how strongly the most believed emotion is shown, 1 as its profile asks.
    """

    faps: Floats
    features: Floats | None
    beliefs: Beliefs
    words: dict[str, float]
    strength: float

    @property
    def is_resting(self) -> bool:
        """Whether there is hardly any expression: what the robust rule calls neutral, too."""
        return self.strength < RESTING


class FaceReader:
    """One face held ready to be read again and again, as long as its resting mesh stays as it is."""

    def __init__(self, obj: Object) -> None:
        """Read the resting face.

        Raises
        ------
        SceneError, ModelError : no face, no feature points; says what to do.
        """
        self.obj, self.uid = obj, uid_of(obj)
        source = read_face(obj, resting=as_found, rigged=False)
        self._face, self._fingerprint = face_of(source), source.fingerprint
        self._to_metres = source.pieces[0].to_metres[:3, :3]
        self._rest = source.pieces[0].rest
        self._shown_rest: Floats | None = None
        points = self._face.points
        held = [name for name in STEADY if name in points and points[name].is_bound]
        self._steady = points.matrix(held) if self._face.is_mask and len(held) >= 4 else None

    def is_of(self, obj: Object) -> bool:
        """Whether `obj` still is the face that was read."""
        return uid_of(obj) == self.uid and fingerprint(obj, resting=as_found, rigged=False).matches(self._fingerprint)

    def positions(self, depsgraph: Depsgraph) -> Floats:
        """(V, 3) vertices of the mesh in metres as they show.

        Raises
        ------
        SceneError : modifiers make other vertices of the mesh; names them.
        """
        visible = Visible.of(self.obj, depsgraph)
        moved = visible.vertices if visible.same_polygons else self._rest + self._displacement(visible)
        found = moved @ self._to_metres.T
        return found if self._steady is None else _steadied(found, self._rest @ self._to_metres.T, self._steady)

    def _displacement(self, visible: Visible) -> Floats:
        """(V, 3) of the mesh's own vertices, which lead those that show; in the object's coordinates."""
        shown = visible.shown.data
        if self._shown_rest is None or len(self._shown_rest) != len(shown.vertices):
            self._shown_rest = shown_rest(self.obj, len(shown.vertices))
        count = len(self._rest)
        moved: Floats = mesh_vertices(shown)[:count] - self._shown_rest[:count]
        return moved

    def measure(self, depsgraph: Depsgraph) -> Floats:
        """(68,) FAPs as the face shows them; NaN where it has no such point.

        Raises
        ------
        SceneError : as `positions`; vertices that are not finite.
        """
        return self._measured(self.positions(depsgraph))

    def _measured(self, positions: Floats) -> Floats:
        """(68,) FAPs of positions."""
        try:
            return self._face.measure(positions)
        except ParameterError as problem:
            raise SceneError(self.obj.name, f"cannot be measured as shown: {problem}") from problem

    def read(self, depsgraph: Depsgraph, *, rule: str = "paper", words: Iterable[str] = ()) -> Reading:
        """What the face shows now.

        Parameters
        ----------
        rule : as for `recognise`. words : emotion words to compare with, besides the six.

        Raises
        ------
        SceneError : as `measure`.
        """
        from ... import api

        positions = self.positions(depsgraph)
        faps = self._measured(positions)
        try:
            features: Floats | None = self._face.features(positions)
        except ModelError:
            features = None
        beliefs = api.recognise(faps, rule=rule)
        profile = beliefs.best_profile
        strength = 0.0 if profile is None else api.shown_strength(faps, profile)
        return Reading(faps, features, beliefs, api.recognise_words(faps, words), strength)


def _steadied(positions: Floats, rest: Floats, reader: Sparse) -> Floats:
    """Positions (V, 3) moved back as a whole, so that their steady points lie on those at rest."""
    from scipy.spatial.transform import Rotation

    was, now = np.asarray(reader @ rest), np.asarray(reader @ positions)
    turn, _ = Rotation.align_vectors(was - was.mean(axis=0), now - now.mean(axis=0))
    back: Floats = turn.apply(positions - now.mean(axis=0)) + was.mean(axis=0)
    return back


def read_animation(obj: Object, scene: Scene, *, start: int, end: int, rule: str = "paper") -> Work[BeliefTrack]:
    """Read a face at every frame of a range. The scene's frame is put back, also where the work is closed early.

    Raises
    ------
    SceneError, ModelError : as `FaceReader`. ParameterError : an empty range.
    """
    from ... import api

    if end < start:
        raise ParameterError("end", f"must not be before the first frame {start}", end)
    yield Progress(0.0, "Reading the resting face")
    reader = FaceReader(obj)
    now, between = scene.frame_current, scene.frame_subframe
    stream = []
    try:
        for number in range(start, end + 1):
            scene.frame_set(number)
            stream.append(reader.measure(bpy.context.evaluated_depsgraph_get()))
            yield Progress((number - start + 1) / (end - start + 1) * 0.98, f"Reading frame {number}")
    finally:
        scene.frame_set(now, subframe=between)
    fps = scene.render.fps / scene.render.fps_base
    return api.recognise_over_time(np.array(stream), rule=rule, fps=fps, first_frame=start)
