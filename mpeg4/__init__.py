"""The MPEG-4 facial animation standard and the emotion model of Raouzaiou et al. 2002. NumPy only; knows no face.

standard, high_level    FAPs, feature points, units, visemes, expressions: data
emotions                words, profiles, the wheel, and recognition
timing, variation       profiles become frames, and look alive
preset_file             expressions and timelines as files to keep
preset_speech           speech in them
streams                 frames on disk, and what they do not state
"""

from .emotions.action_units import ACTION_UNITS, AuTerm
from .emotions.archetypes import (
    BASE_WORDS,
    FEATURE_SIGNED,
    PRINTED_PROFILES,
    STATISTICS,
    VARIANTS,
    VOCABULARIES,
    VOCABULARY_EXCEPTIONS,
    archetype,
    initial_profile,
)
from .emotions.belief_track import BeliefTrack, recognise_over_time, write_belief_csv
from .emotions.emotion_presets import WORDS, load_emotions
from .emotions.expressions import default_variant, expression, find_word, neighbours
from .emotions.features import FEATURES, Feature, faps_from_features
from .emotions.intermediate import between
from .emotions.profile import ARCHETYPES, AS_PRINTED, Archetype, Feeling, Profile, Signs
from .emotions.prototypes import Prototype, check_prototype, load_prototypes
from .emotions.recognition import (
    NEUTRAL,
    Beliefs,
    Rule,
    Verdict,
    recognise,
    recognise_features,
    recognise_words,
    shown_strength,
)
from .emotions.wheel import ACTIVATION_MAX, ACTIVATION_MIN
from .emotions.words import TABLE_WORDS, Word
from .high_level import (
    EXPRESSIONS,
    VISEME_SHAPES,
    VISEMES,
    Expression,
    ExpressionField,
    Viseme,
    VisemeField,
    expand,
    expression_frame,
    viseme_frame,
)
from .standard import (
    ANGLE_UNIT,
    FAP_COUNT,
    FAP_LIMIT,
    FAPS,
    FAPU,
    FEATURE_POINTS,
    GROUPS,
    LIP_TWINS,
    PAIRS,
    Fap,
    FapuDefinition,
    FeaturePoint,
    Motion,
    Side,
    Unit,
    check_fps,
    fap,
)
from .streams.bridging import Bridged, bridged
from .streams.fap_file import read_fap, write_fap
from .streams.fap_json import read_fap_json, write_fap_json
from .streams.fap_stream import FapStream
from .streams.fba import Decoded, decode_fba, encode_fba, read_fba, write_fba
from .streams.filling import Filling, fill
from .timing import (
    Cue,
    Ramp,
    Timing,
    emotion_weights,
    envelope,
    load_timings,
    sequence,
    sequence_at,
    step_count,
    strengths,
)
from .variation import Drawn, Liveliness, Overlay, drawn_within, way_drawn

__all__ = [
    "ACTION_UNITS",
    "ACTIVATION_MAX",
    "ACTIVATION_MIN",
    "ANGLE_UNIT",
    "ARCHETYPES",
    "AS_PRINTED",
    "BASE_WORDS",
    "EXPRESSIONS",
    "FAPS",
    "FAPU",
    "FAP_COUNT",
    "FAP_LIMIT",
    "FEATURES",
    "FEATURE_POINTS",
    "FEATURE_SIGNED",
    "GROUPS",
    "LIP_TWINS",
    "NEUTRAL",
    "PAIRS",
    "PRINTED_PROFILES",
    "STATISTICS",
    "TABLE_WORDS",
    "VARIANTS",
    "VISEMES",
    "VISEME_SHAPES",
    "VOCABULARIES",
    "VOCABULARY_EXCEPTIONS",
    "WORDS",
    "Archetype",
    "AuTerm",
    "BeliefTrack",
    "Beliefs",
    "Bridged",
    "Cue",
    "Decoded",
    "Drawn",
    "Expression",
    "ExpressionField",
    "Fap",
    "FapStream",
    "FapuDefinition",
    "Feature",
    "FeaturePoint",
    "Feeling",
    "Filling",
    "Liveliness",
    "Motion",
    "Overlay",
    "Profile",
    "Prototype",
    "Ramp",
    "Rule",
    "Side",
    "Signs",
    "Timing",
    "Unit",
    "Verdict",
    "Viseme",
    "VisemeField",
    "Word",
    "archetype",
    "between",
    "bridged",
    "check_fps",
    "check_prototype",
    "decode_fba",
    "default_variant",
    "drawn_within",
    "emotion_weights",
    "encode_fba",
    "envelope",
    "expand",
    "expression",
    "expression_frame",
    "fap",
    "faps_from_features",
    "fill",
    "find_word",
    "initial_profile",
    "load_emotions",
    "load_prototypes",
    "load_timings",
    "neighbours",
    "read_fap",
    "read_fap_json",
    "read_fba",
    "recognise",
    "recognise_features",
    "recognise_over_time",
    "recognise_words",
    "sequence",
    "sequence_at",
    "shown_strength",
    "step_count",
    "strengths",
    "viseme_frame",
    "way_drawn",
    "write_belief_csv",
    "write_fap",
    "write_fap_json",
    "write_fba",
]
