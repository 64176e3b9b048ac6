"""One face: a neutral mesh with feature points that can be measured, posed and simulated."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Sized
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats, Ints
from ..mpeg4 import Cue, Liveliness
from ..physics.tissue import Tissue
from ..progress import Prepared, Progress, Work, run
from .anatomy import Anatomy
from .bodies.eyeball import EyeballPlace
from .drive.over_time import cue_plans, stream_plans
from .drive.request import Drive, EmotionShares
from .long_motion import LongMotion, long_motion
from .measure import features, measure
from .mechanism import Mechanism, named
from .mesh.building import face_mesh_steps
from .mesh.checks import checked_polygons, checked_vertices
from .mesh.fap_units import Fapu
from .mesh.points import FeaturePoints, PointSource
from .muscles.placement import PlacedMuscle
from .pose import Pose, Poser, Sketcher
from .preparation import preparation
from .requests import checked_drive, checked_emotions, checked_request, checked_stream
from .simulate import Clip, Simulation
from .unmet import unmet


class Face:
    """One face. Make it with `from_arrays`; nothing in it changes afterwards.

    `anatomy` is for the rooms of `face` alone: what others need of it, a property gives in the face's own coordinates.
    """

    def __init__(self, vertices: Floats, polygons: Sequence[Ints], anatomy: Anatomy) -> None:
        self._vertices, self._polygons = vertices, polygons
        self.anatomy = anatomy
        self.kept_as, self.is_from_file, self.was_explored = "", False, False
        """Its key where it is kept (`kept`); whether it comes out of a file, and with what sketches need."""

    @classmethod
    def from_arrays(
        cls,
        vertices: ArrayLike,
        polygons: Sequence[Sequence[int]] | ArrayLike,
        points: Mapping[str, PointSource],
        parts: ArrayLike | None = None,
        *,
        axes: ArrayLike | None = None,
    ) -> Face:
        """A face from a neutral mesh.

        Parameters
        ----------
        vertices : (V, 3) metres, any orientation and scale. Vertices at one place that are one, as importers leave them
            at seams, move as one (`mesh.weld`).
        polygons : (F, 3|4) ints, or a sequence of index sequences (three corners or more).
        points : feature point -> vertex index, or position (3,) on the surface (bound by barycentric weights). 3.5 and
            3.6 may be left out; they are then placed in the middle of each eye's opening.
        parts : (V,) numbers of `Part`, derived from connected pieces when None; and of `Told` where only what a vertex
            is among is known.
        axes : (3, 3) unit vectors to the subject's left, up and forward, along which FAPs are measured. None: the
            mesh's own axes where the face lies along them within 10 degrees, else as its feature points tell.

        Raises
        ------
        ModelError : names what the mesh or the points lack, and the remedy.

        Examples
        --------
        >>> head = api.build_default_head()
        >>> face = api.Face.from_arrays(head.vertices, head.polygons, head.points)
        >>> len(face.vertices) == len(head.vertices)
        True
        """
        return run(cls.from_arrays_steps(vertices, polygons, points, parts, axes=axes))

    @classmethod
    def from_arrays_steps(
        cls,
        vertices: ArrayLike,
        polygons: Sequence[Sequence[int]] | ArrayLike,
        points: Mapping[str, PointSource],
        parts: ArrayLike | None = None,
        *,
        axes: ArrayLike | None = None,
    ) -> Work[Face]:
        """As `from_arrays`, bit by bit, for whoever shows progress.

        Examples
        --------
        >>> head = api.build_default_head()
        >>> steps = api.Face.from_arrays_steps(head.vertices, head.polygons, head.points)
        >>> next(steps).text
        'Checking the mesh'
        """
        yield Progress(0.0, "Checking the mesh")
        array = checked_vertices(vertices)
        faces = checked_polygons(polygons, len(array))
        yield Progress(0.0, "Checking the mesh")
        return cls(array, faces, Anatomy((yield from face_mesh_steps(array, faces, points, parts, axes))))

    def without(self, *mechanisms: str | Mechanism) -> Face:
        """The same face with some mechanisms left out, to show what each is worth.

        `face.without(*ADDITIONS)` is the second paper's model alone: biphasic membrane springs and its three classes of
        muscles, tied evenly to the bone.

        Raises
        ------
        ParameterError : an unknown mechanism; lists the known ones.

        Examples
        --------
        >>> face = api.default_face().without("contact", "folds")
        >>> "contact" in face.mechanisms
        False
        """
        whole = self.anatomy
        left = Anatomy(whole.mesh, whole.mechanisms - named(mechanisms), whole=whole)
        return Face(self._vertices, self._polygons, left)

    @property
    def mechanisms(self) -> frozenset[Mechanism]:
        """What this face has and has not been left out by `without`."""
        return self.anatomy.mechanisms

    @property
    def vertices(self) -> Floats:
        """(V, 3) the neutral mesh as given."""
        return self._vertices

    @property
    def polygons(self) -> Sequence[Ints]:
        """Vertex indices of each polygon, as given."""
        return self._polygons

    @property
    def points(self) -> FeaturePoints:
        """Feature points bound to the mesh; of vertices at one place, to the first."""
        return self.anatomy.mesh.points

    @property
    def parts(self) -> Ints:
        """(V,) numbers of `Part`."""
        face_mesh = self.anatomy.mesh
        return face_mesh.parts[face_mesh.seams.leads]

    @property
    def axes(self) -> Floats:
        """(3, 3) unit vectors to the subject's left, up and forward, along which FAPs are measured."""
        return self.anatomy.mesh.head_frame.axes

    @property
    def outer_skin(self) -> Ints:
        """(n,) vertices of the skin that shows: without the lining of mouth and eyes."""
        showing = np.union1d(self.anatomy.given_skin.index, self.anatomy.still_skin)
        return self.anatomy.mesh.with_copies(showing)

    @property
    def eyeballs(self) -> tuple[EyeballPlace, ...]:
        """Its eyeballs at rest; none where the mesh has none."""
        face_mesh, placed = self.anatomy.mesh, self.anatomy.mesh.head_frame
        found = []
        for ball in self.anatomy.eyeballs:
            vertices, gaze = face_mesh.with_copies(ball.index), ball.gaze @ placed.axes
            found.append(EyeballPlace(vertices, placed.to_face(ball.centre), gaze, ball.iris, ball.pupil))
        return tuple(found)

    @property
    def sewn(self) -> frozenset[str]:
        """What has no opening: "mouth" where the lips are one surface, "l" and "r" where an eye's lids are, and shut.

        Sewn lips are kept whole: they do not part and the jaw drops a little. Shut lids stay shut.
        """
        return self.anatomy.given_skin.sewn

    @property
    def is_thinned(self) -> bool:
        """Whether its skin is so dense that a share of its vertices is solved; the others go with these.

        Poses are off those solved whole by about 1 % of the largest displacement in the mean square.
        """
        return self.anatomy.is_thinned

    @property
    def is_mask(self) -> bool:
        """Whether the mesh has no skull, so that a turn of the head cannot be told from expression."""
        return not self.anatomy.head_turn.is_readable

    @property
    def units(self) -> Fapu:
        """FAP units in metres."""
        return self.anatomy.mesh.units

    @property
    def scale(self) -> float:
        """How large the face is: its size over that of a life-size one in metres."""
        return self.anatomy.mesh.head_frame.scale

    @property
    def muscles(self) -> Mapping[str, PlacedMuscle]:
        """The placed muscles by name ("zygomaticus_major_l")."""
        return {muscle.name: muscle for muscle in self.anatomy.muscles}

    def measure(self, positions: ArrayLike) -> Floats:
        """(68,) FAPs read off deformed vertices (V, 3); NaN where the face has no such point.

        Examples
        --------
        >>> face = api.default_face()
        >>> bool(np.nanmax(np.abs(face.measure(face.vertices))) < 1e-6)  # at rest
        True
        """
        return measure(self.anatomy, np.asarray(positions, dtype=np.float64))

    def features(self, positions: ArrayLike) -> Floats:
        """(15,) features of Table 3 of Raouzaiou et al. 2002 read off deformed vertices (V, 3).

        Examples
        --------
        >>> face = api.default_face()
        >>> face.features(face.vertices).shape
        (15,)
        """
        return features(self.anatomy, np.asarray(positions, dtype=np.float64))

    def unmet(self, asked: ArrayLike, positions: Iterable[ArrayLike]) -> dict[int, str]:
        """FAP number -> why, of FAPs that are asked of a motion and of which nothing shows; a pose has its own.

        Parameters
        ----------
        asked : (T, 68) FAP units; NaN = silent.
        positions : (V, 3) of each step, of as many steps as there are.

        Examples
        --------
        >>> face, asked = api.default_face(), np.full((1, 68), np.nan)
        >>> asked[:, 31 - 1] = 100.0  # raise_l_i_eyebrow
        >>> face.unmet(asked, [face.vertices])  # nothing has moved
        {31: 'check feature point 4.1'}
        """
        return run(self.unmet_steps(asked, positions))

    def unmet_steps(self, asked: ArrayLike, positions: Iterable[ArrayLike]) -> Work[dict[int, str]]:
        """As `unmet`, one of the positions at a time, for whoever shows progress.

        Examples
        --------
        >>> face = api.default_face()
        >>> asked = api.expression("joy").frame()[None]
        >>> [step.text for step in face.unmet_steps(asked, [face.vertices])]
        ['0 of 1 steps measured']
        """
        frames, achieved = checked_stream(asked), list[Floats]()
        count = len(positions) if isinstance(positions, Sized) else None
        for place in positions:
            yield Progress.counted(len(achieved), count, "steps measured")
            achieved.append(self.measure(place))
        return unmet(self.anatomy, frames, np.stack(achieved))

    def unmet_measured(self, asked: ArrayLike, achieved: Floats) -> dict[int, str]:
        """As `unmet`, of FAPs (n, 68) that were measured on the motion already.

        Examples
        --------
        >>> face, asked = api.default_face(), np.full((1, 68), np.nan)
        >>> asked[:, 31 - 1] = 100.0  # raise_l_i_eyebrow
        >>> face.unmet_measured(asked, face.measure(face.vertices)[None])
        {31: 'check feature point 4.1'}
        """
        return unmet(self.anatomy, checked_stream(asked), achieved)

    @cached_property
    def _poser(self) -> Poser:
        return Poser(self.anatomy)

    @property
    def poser(self) -> Poser:
        """What poses it; for the rooms of `face` alone, as `anatomy` is."""
        return self._poser

    def pose(
        self,
        frame: ArrayLike,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
    ) -> Pose:
        """The equilibrium of the face for one frame of FAPs.

        Parameters
        ----------
        frame : (68,) FAP units, index = FAP number - 1; NaN = the profile is silent: anatomy decides, not zero.
        drive : "natural" (default), "exact", "muscles" or "points"; see `Drive`.
        emotion : archetype -> share, where the word behind the frame is known (`Profile.weights`); natural drive only.
        contractions : muscle name -> 0..1, set by hand.

        Raises
        ------
        ParameterError : a frame of another shape, an unknown drive, muscle or archetype.

        Examples
        --------
        >>> face = api.default_face()
        >>> joy = api.expression("joy")
        >>> pose = face.pose(joy.frame(), emotion=joy.weights)
        >>> pose.positions.shape == face.vertices.shape
        True
        >>> bool(pose.achieved[12 - 1] > 100.0)  # raise_l_cornerlip
        True
        >>> by_hand = face.pose(np.full(68, np.nan), contractions={"zygomaticus_major_l": 0.8})
        >>> round(by_hand.contractions["zygomaticus_major_l"], 3)
        0.8
        """
        return self._poser.pose(checked_request(frame, drive, emotion, contractions))

    def prepare(self) -> Work[None]:
        """Work out what a first pose needs, bit by bit; yields how far it is and what comes next.

        A first pose does the same by itself; this is for whoever shows progress.

        Examples
        --------
        >>> [step.text for step in api.default_face().prepare()][0]
        'Preparing the skin'
        """
        return preparation(self._poser)

    def sketcher(self) -> Sketcher:
        """Quick poses for a live preview; see `Sketcher`.

        Examples
        --------
        >>> sketcher = api.default_face().sketcher()
        >>> sketcher.sketch(api.expression("joy", activation=3.0).frame()).positions.shape[1]
        3
        """
        return Sketcher(self._poser)

    def simulation(
        self,
        frames: ArrayLike,
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotions: ArrayLike | None = None,
        planned: bool = False,
        integrator: str = "reduced",
        substeps: int = 2,
        tissue: str | Tissue = "default",
    ) -> Prepared[Floats]:
        """Positions (V, 3) frame by frame of the moving face; see `simulate`.

        Examples
        --------
        >>> face = api.default_face()
        >>> frames = api.envelope(api.expression("joy"), onset=0.2, apex=0.0, offset=0.2, fps=10.0)
        >>> for positions in face.simulation(frames, fps=10.0):
        ...     assert positions.shape == face.vertices.shape
        """
        checked = checked_stream(frames)
        weights = checked_emotions(emotions, len(checked))
        simulation = Simulation(self._poser, fps=fps, integrator=integrator, substeps=substeps, tissue=tissue)
        return simulation.run(stream_plans(checked, checked_drive(drive), weights, planned=planned))

    def long_motion(
        self, frames: ArrayLike, *, drive: str | Drive = Drive.NATURAL, planned: bool = False
    ) -> Work[LongMotion]:
        """A long stream of FAPs (T, 68) in balance, bit by bit: some hundred of its frames are posed, and the others
        lie between those; see `LongMotion`. The skin has no inertia: a recording has that of its own.

        Examples
        --------
        >>> face, frames = api.default_face(), np.full((500, 68), np.nan)
        >>> frames[:, 3 - 1] = 200.0 * (1.0 - np.cos(0.1 * np.arange(500.0)))  # open_jaw
        >>> work = face.long_motion(frames)
        >>> next(work).text
        'Finding the muscles behind the motion'
        """
        return long_motion(self._poser, checked_stream(frames), checked_drive(drive), planned=planned)

    def performance(
        self,
        cues: Sequence[Cue],
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        contractions: Sequence[Mapping[str, float]] | None = None,
        liveliness: Liveliness | None = None,
        integrator: str = "reduced",
        substeps: int = 2,
        tissue: str | Tissue = "default",
    ) -> Prepared[Floats]:
        """Positions (V, 3) frame by frame of expressions in time (`sequence` gives their frames).

        In the natural drive each cue is planned at its apex and the plans are blended, so that an apex that is held is
        the pose of its profile. `contractions`, one mapping per cue, are set by hand and come and go with it.
        `liveliness` adds blinks and small motions of head and eyes. Other keywords and errors as `simulate`. The
        result's `prepare` does what comes before the first frame bit by bit.

        Examples
        --------
        >>> face = api.default_face()
        >>> cue = api.Cue(api.expression("joy"), onset=0.2, apex=0.0, offset=0.2)
        >>> len(list(face.performance([cue], fps=10.0)))
        5
        """
        simulation = Simulation(self._poser, fps=fps, integrator=integrator, substeps=substeps, tissue=tissue)
        return simulation.run(cue_plans(cues, fps, checked_drive(drive), contractions, liveliness))

    def simulate(
        self,
        frames: ArrayLike,
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotions: ArrayLike | None = None,
        planned: bool = False,
        integrator: str = "reduced",
        substeps: int = 2,
        tissue: str | Tissue = "default",
    ) -> Clip:
        """The moving face: frames of FAPs with the skin's inertia and damping.

        Parameters
        ----------
        frames : (T, 68) FAP units; NaN = silent.
        fps : frames per second.
        emotions : (T, 6) strength of each archetype over time (`emotion_weights`), where the words are known.
        planned : the frames show all that is to be seen (`say`); the natural drive adds nothing of emotions.
        integrator : "reduced" (default); "balance" for motion that has inertia of its own, as speech; for reference
            "implicit", or "rk2", the paper's.
        substeps : steps per frame, after each of which contact is seen to; rk2 cuts them as it needs.
        tissue : "default", "young", "aged" or "stiff" (presets/tissue.toml), or figures of its own.

        Raises
        ------
        ParameterError : frames or emotions of another shape or not finite, unknown names, fps or substeps out of range.
        SolverError : names the frame whose motion was not solved.

        Examples
        --------
        >>> face = api.default_face()
        >>> frames = api.envelope(api.expression("joy"), onset=0.2, apex=0.0, offset=0.2, fps=10.0)
        >>> clip = face.simulate(frames, fps=10.0)
        >>> clip.positions.shape == (5, *face.vertices.shape)
        True
        """
        moving = self.simulation(
            frames,
            fps,
            drive=drive,
            emotions=emotions,
            planned=planned,
            integrator=integrator,
            substeps=substeps,
            tissue=tissue,
        )
        return Clip(np.stack(list(moving)), fps)
