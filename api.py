"""The public API: arrays and dataclasses in and out, no Blender.

Everything here may be used by scripts; names and shapes are kept. The operators, the command line and your scripts
all go through it.
"""

from __future__ import annotations

from functools import lru_cache

from .face.creases import Creases
from .face.default_head import HeadMesh, build_default_head
from .face.face import Clip, Face
from .face.frame import Fapu
from .face.mechanisms import ADDITIONS, MUSCLE_GROUPS, Mechanism
from .face.parts import Part
from .face.points import REQUIRED as REQUIRED_POINTS
from .face.pose import Pose
from .face.wishes import Drive
from .mpeg4 import (
    ARCHETYPES,
    FAPS,
    FEATURE_POINTS,
    FEATURES,
    VISEMES,
    WORDS,
    Archetype,
    Beliefs,
    Cue,
    ExpressionField,
    Fap,
    FapStream,
    Profile,
    Ramp,
    Timing,
    VisemeField,
    archetype,
    between,
    emotion_weights,
    envelope,
    expression,
    expression_frame,
    fap,
    initial_profile,
    load_emotions,
    load_timings,
    read_fap,
    recognise,
    recognise_features,
    sequence,
    viseme_frame,
    write_fap,
)

__all__ = [
    "ADDITIONS",
    "ARCHETYPES",
    "FAPS",
    "FEATURES",
    "FEATURE_POINTS",
    "MUSCLE_GROUPS",
    "REQUIRED_POINTS",
    "VISEMES",
    "WORDS",
    "Archetype",
    "Beliefs",
    "Clip",
    "Creases",
    "Cue",
    "Drive",
    "ExpressionField",
    "Face",
    "Fap",
    "FapStream",
    "Fapu",
    "HeadMesh",
    "Mechanism",
    "Part",
    "Pose",
    "Profile",
    "Ramp",
    "Timing",
    "VisemeField",
    "archetype",
    "between",
    "build_default_head",
    "default_face",
    "emotion_weights",
    "envelope",
    "expression",
    "expression_frame",
    "fap",
    "initial_profile",
    "load_emotions",
    "load_timings",
    "read_fap",
    "recognise",
    "recognise_features",
    "sequence",
    "viseme_frame",
    "write_fap",
]


@lru_cache(maxsize=1)
def default_face() -> Face:
    """The default head as a face; built once."""
    head = build_default_head()
    return Face.from_arrays(head.vertices, head.polygons, head.points, head.parts)
