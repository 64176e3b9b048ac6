"""The public API: arrays and dataclasses in and out, no Blender.

Everything here may be used by scripts; names and shapes are kept. Examples in docstrings know it as `api`, and NumPy as
`np`; tests/test_examples.py runs them.

Your scripts and the command line need nothing else. Importing it loads SciPy, which a Blender may lack; so `scene` and
`operators` use what is here too, but import it late, and take what registering needs straight from `mpeg4` and from the
outer rooms of `face`. The inner rooms of a face (pyproject.toml names them) are closed to them as to everybody.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from .face.bodies.eyeball import EyeballPlace
from .face.contractible import Contractible, contractibles
from .face.default_head import HeadMesh, build_default_head
from .face.drive.request import Drive, EmotionShares
from .face.face import Face
from .face.fit.find import FoundPoints, find_points, find_points_steps
from .face.fit.topologies import (
    Topology,
    TopologyPoint,
    load_topologies,
    read_topology,
    recognise_topology,
    topology_of,
    write_topology,
)
from .face.kept.faces import KeptFaces
from .face.mechanism import ADDITIONS, MUSCLE_GROUPS, Mechanism
from .face.mesh.fap_units import Fapu
from .face.mesh.files import MeshFile, read_mesh
from .face.mesh.parts import Part, Told
from .face.mesh.point_files import PointTable, read_point_file
from .face.mesh.points import REQUIRED as REQUIRED_POINTS
from .face.pose import Pose
from .face.products.animation_table_building import face_animation_tables
from .face.products.animation_table_files import read_animation_tables, write_animation_tables, write_face_def_tables
from .face.products.animation_tables import AnimationTable, AnimationTables, TableError
from .face.products.blendshapes import arkit_shapes
from .face.products.creases import Creases
from .face.products.efforts import Efforts, explaining_units, performance_efforts, stream_efforts, unit_names
from .face.products.head_motion import head_motion
from .face.products.landmarks import Landmarks, face_landmarks
from .face.products.playing import play
from .face.retarget.controls import Controls
from .face.retarget.retargeting import Retargeted, Retargeting, Take, retarget
from .face.retarget.shortfall import Shortfall
from .face.retarget.weight_csv import write_weight_csv
from .face.simulate import Clip
from .face.tracked.formats import READABLE as READABLE_STREAMS
from .face.tracked.formats import WRITABLE as WRITABLE_STREAMS
from .face.tracked.formats import StreamFormat
from .face.tracked.landmarks import LandmarkReading, read_points
from .face.tracked.recording import Recording, read_capture, read_recording, read_stream, write_stream
from .face.unmet import unmet_lines
from .labels.view import View
from .mpeg4 import (
    ARCHETYPES,
    FAPS,
    FEATURE_POINTS,
    FEATURES,
    NEUTRAL,
    VISEMES,
    WORDS,
    Archetype,
    Beliefs,
    BeliefTrack,
    Cue,
    Decoded,
    Drawn,
    ExpressionField,
    Fap,
    FapStream,
    Feeling,
    Filling,
    Liveliness,
    Profile,
    Prototype,
    Ramp,
    Rule,
    Timing,
    Verdict,
    VisemeField,
    archetype,
    between,
    decode_fba,
    drawn_within,
    emotion_weights,
    encode_fba,
    envelope,
    expression,
    expression_frame,
    fap,
    initial_profile,
    load_emotions,
    load_prototypes,
    load_timings,
    read_fap,
    read_fap_json,
    read_fba,
    recognise,
    recognise_features,
    recognise_over_time,
    recognise_words,
    sequence,
    shown_strength,
    viseme_frame,
    way_drawn,
    write_belief_csv,
    write_fap,
    write_fap_json,
    write_fba,
)
from .mpeg4.streams.capture import CaptureShape, KeyShape, load_key_names, load_shapes, write_fap_csv
from .progress import Progress
from .speech.phonemes import Alphabet, Phoneme
from .speech.recorded import read_timings
from .speech.saying import Saying, say, say_steps
from .speech.utterance import Sound, SpokenWord, Utterance
from .speech.voice import Voiced, speak, voices

__all__ = [
    "ADDITIONS",
    "ARCHETYPES",
    "FAPS",
    "FEATURES",
    "FEATURE_POINTS",
    "MUSCLE_GROUPS",
    "NEUTRAL",
    "READABLE_STREAMS",
    "REQUIRED_POINTS",
    "VISEMES",
    "WORDS",
    "WRITABLE_STREAMS",
    "Alphabet",
    "AnimationTable",
    "AnimationTables",
    "Archetype",
    "BeliefTrack",
    "Beliefs",
    "CaptureFormat",
    "CaptureShape",
    "Clip",
    "Contractible",
    "Controls",
    "Creases",
    "Cue",
    "Decoded",
    "Drawn",
    "Drive",
    "Efforts",
    "EmotionShares",
    "ExpressionField",
    "EyeballPlace",
    "Face",
    "Fap",
    "FapStream",
    "Fapu",
    "Feeling",
    "Filling",
    "FitProgress",
    "FoundPoints",
    "HeadMesh",
    "KeptFaces",
    "KeyShape",
    "LandmarkReading",
    "Landmarks",
    "Liveliness",
    "Mechanism",
    "MeshFile",
    "Part",
    "Phoneme",
    "PointTable",
    "Pose",
    "Profile",
    "Progress",
    "Prototype",
    "Ramp",
    "Recording",
    "Retargeted",
    "Retargeting",
    "Rule",
    "Saying",
    "Shortfall",
    "Sound",
    "SpokenWord",
    "StreamFormat",
    "TableError",
    "Take",
    "Timing",
    "Told",
    "Topology",
    "Utterance",
    "Verdict",
    "View",
    "VisemeField",
    "Voiced",
    "archetype",
    "arkit_shapes",
    "between",
    "build_default_head",
    "contractibles",
    "decode_fba",
    "default_face",
    "drawn_within",
    "emotion_weights",
    "encode_fba",
    "envelope",
    "explaining_units",
    "expression",
    "expression_frame",
    "face_animation_tables",
    "face_landmarks",
    "fap",
    "find_points",
    "find_points_steps",
    "head_motion",
    "initial_profile",
    "load_emotions",
    "load_key_names",
    "load_prototypes",
    "load_shapes",
    "load_timings",
    "load_topologies",
    "performance_efforts",
    "play",
    "read_animation_tables",
    "read_capture",
    "read_fap",
    "read_fap_json",
    "read_fba",
    "read_mesh",
    "read_point_file",
    "read_points",
    "read_recording",
    "read_stream",
    "read_timings",
    "read_topology",
    "recognise",
    "recognise_features",
    "recognise_over_time",
    "recognise_topology",
    "recognise_words",
    "retarget",
    "save_topology",
    "say",
    "say_steps",
    "sequence",
    "shown_strength",
    "speak",
    "stream_efforts",
    "unit_names",
    "unmet_lines",
    "viseme_frame",
    "voices",
    "way_drawn",
    "write_animation_tables",
    "write_belief_csv",
    "write_face_def_tables",
    "write_fap",
    "write_fap_csv",
    "write_fap_json",
    "write_fba",
    "write_stream",
    "write_weight_csv",
]


CaptureFormat = StreamFormat
"""The formats of streams, by their older name."""

FitProgress = Progress
"""The steps of `find_points_steps`, by their older name."""


@lru_cache(maxsize=1)
def default_face() -> Face:
    """The default head as a face; built once.

    Examples
    --------
    >>> face = api.default_face()
    >>> round(face.units.mns0, 3)  # from nose to mouth, metres
    0.023
    """
    head = build_default_head()
    return Face.from_arrays(head.vertices, head.polygons, head.points, head.parts)


def save_topology(path: str | Path, face: Face, *, name: str, source: str = "") -> Topology:
    """Write a face's feature points as those of every mesh with its connectivity; returns what was written.

    `load_topologies(folder)` reads such tables for `find_points(..., topologies=...)`.

    Raises
    ------
    ModelError : when none of its points follows the mesh.

    Examples
    --------
    >>> topology = api.save_topology("mine.toml", api.default_face(), name="my heads")
    >>> api.read_topology("mine.toml").name
    'my heads'
    """
    points = {key: TopologyPoint(point.vertices, point.weights) for key, point in face.points.items() if point.is_bound}
    topology = topology_of(name, source, len(face.vertices), face.polygons, points)
    write_topology(path, topology)
    return topology
