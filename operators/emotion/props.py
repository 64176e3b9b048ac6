"""The emotion chosen for a face. Saved by number, so every word and variant keeps its number for ever.

An emotion is a word, or a point of the emotion wheel: an angle beside the activation.
"""

from __future__ import annotations

import math
import zlib

from bpy.props import EnumProperty, FloatProperty, IntProperty

from ...mpeg4.emotions.archetypes import BASE_WORDS, VARIANTS
from ...mpeg4.emotions.emotion_presets import WORDS
from ...mpeg4.emotions.profile import ARCHETYPES
from ...mpeg4.emotions.prototypes import load_prototypes
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context
from ..changes import changed

#: Blender wants a dynamic enum's strings to be held somewhere.
_word_items: list[tuple[str, str, str, str, int]] = []
_variant_items: dict[str, list[tuple[str, str, str, int]]] = {}

FIRST_WORD = "joy"
DEFAULT_VARIANT = "DEFAULT"
#: Numbers of ways of showing an emotion begin here, those of the paper's variants before.
FIRST_WAY = 100
#: Way of showing an emotion -> what it does.
WAYS = {
    "open": "Lips part and teeth show",
    "closed": "Lips stay closed",
    "shut": "Lips stay closed",
    "bared": "The mouth opens squarely and teeth show",
    "pressed": "Lips are pressed together",
    "glaring": "Upper lids rise against lowered brows",
    "drawn": "Brows are drawn together and rise in the middle",
    "raised": "Brows rise from end to end",
    "drop": "The jaw drops",
    "plain": "Brows rise in the middle and the mouth corners sink",
}
FALLBACK_ACTIVATION = 4.0
#: A whole turn, radians.
WHOLE = 2.0 * math.pi


def own_activation(word: str) -> float:
    """The word's own activation; the middle of the scale for a neutral word."""
    entry = WORDS.get(word)
    return float(entry.activation) if entry is not None and entry.activation is not None else FALLBACK_ACTIVATION


def own_angle(word: str) -> float:
    """The word's angle on the wheel, radians; 0 for a neutral word."""
    entry = WORDS.get(word)
    angle = entry.angle if entry is not None else None
    if angle is None and entry is not None and entry.category is not None:
        angle = BASE_WORDS[entry.category].angle
    return math.radians(angle or 0.0)


def _number(word: str) -> int:
    """A number that a word keeps whatever other words come and go; the first one's is 0, Blender's default."""
    return 0 if word == FIRST_WORD else (zlib.crc32(word.encode()) & 0x3FFFFFFF) | 1


def _described(word: str) -> str:
    """The word's tooltip."""
    entry = WORDS[word]
    if entry.neutral:
        return "No expression: the neutral face"
    if entry.category == word:
        where = "one of the six archetypes"
    elif entry.category is not None:
        where = f"a degree of {entry.category}"
    else:
        where = f"at {entry.angle:g}° on the emotion wheel"
    return f"{where[0].upper()}{where[1:]}; its own activation is {entry.activation:g} of 7"


def word_items(owner: RISORIUS_PG_emotion, context: Context) -> list[tuple[str, str, str, str, int]]:
    """The words: the six archetypes first, then the others by alphabet."""
    if not _word_items:
        archetypes = [str(a) for a in ARCHETYPES if str(a) in WORDS]
        first = sorted(archetypes, key=lambda word: word != FIRST_WORD)
        others = sorted(word for word in WORDS if word not in archetypes)
        _word_items.extend((w, w.capitalize(), _described(w), "NONE", _number(w)) for w in [*first, *others])
    return _word_items


def variant_items(owner: RISORIUS_PG_emotion, context: Context) -> list[tuple[str, str, str, int]]:
    """Ways of showing the word's category, and its variants in the paper; only the default between categories."""
    entry = WORDS.get(owner.word)
    category = entry.category if entry is not None else None
    key = str(category or "")
    if key not in _variant_items:
        items = [(DEFAULT_VARIANT, "Default", "As people show this emotion most", 0)]
        for place, way in enumerate(load_prototypes()[category] if category is not None else ()):
            items.append((way, way.capitalize(), WAYS.get(way, way), FIRST_WAY + place))
        for number in VARIANTS[category] if category is not None else ():
            said = f"Variant {number} of {key} in the paper, and no more"
            items.append((str(number), f"{key.capitalize()} {number}", said, int(number) + 1))
        _variant_items[key] = items
    return _variant_items[key]


def _word_chosen(owner: RISORIUS_PG_emotion, context: Context) -> None:
    """A new word starts with its own place on the wheel and its default variant."""
    owner.by = "WORD"
    owner.angle = own_angle(owner.word)
    owner.activation = own_activation(owner.word)
    owner.variant = DEFAULT_VARIANT


def _turned(owner: RISORIUS_PG_emotion, context: Context) -> None:
    """The wheel has no end: past 360° it goes on from 0."""
    if 0.0 <= owner.angle < WHOLE:
        changed(owner, context)
    else:
        owner.angle %= WHOLE  # comes here again


class RISORIUS_PG_emotion(PropertyGroup):
    """Word or point of the wheel, variant, activation and seed."""

    by: Annotated[
        str,
        EnumProperty(
            name="Choose By",
            description="Choose the emotion by a word or by a point of the emotion wheel",
            items=(
                ("WORD", "Word", "One of the emotion words"),
                ("WHEEL", "Wheel", "Any point of the emotion wheel: direction and distance from the centre"),
            ),
            update=changed,
        ),
    ]
    angle: Annotated[
        float,
        FloatProperty(
            name="Angle",
            description="Direction on the emotion wheel, counter-clockwise from the right: fear is at 70°, joy "
            "at 323°. Between two archetypes, their expressions mix",
            default=own_angle(FIRST_WORD),
            subtype="ANGLE",
            soft_min=-WHOLE,
            soft_max=2.0 * WHOLE,
            step=100,
            precision=1,
            update=_turned,
        ),
    ]
    word: Annotated[
        str,
        EnumProperty(
            name="Emotion", description="Emotion that the face expresses", items=word_items, update=_word_chosen
        ),
    ]
    variant: Annotated[
        str,
        EnumProperty(
            name="Variant",
            description="Variant of the expression: people show the same emotion in several ways",
            items=variant_items,
            update=changed,
        ),
    ]
    activation: Annotated[
        float,
        FloatProperty(
            name="Activation",
            description="How strongly the emotion is felt, from 1 (calm) to 7 (extreme). The word's own value "
            "is shown below the slider",
            default=own_activation(FIRST_WORD),
            min=1.0,
            max=7.0,
            step=10,
            precision=1,
            update=changed,
        ),
    ]
    seed: Annotated[
        int,
        IntProperty(
            name="Seed",
            description="Random seed of the expression. 0 is the typical face; any other number draws a "
            "different face within the emotion's ranges, and the way of showing it unless a variant is chosen",
            default=0,
            min=0,
            update=changed,
        ),
    ]
    drive: Annotated[
        str,
        EnumProperty(
            name="Drive",
            description="How the face carries out the requested animation parameters",
            items=(
                (
                    "natural",
                    "Natural",
                    "What a face can do: anatomy limits the request and fills in the parts "
                    "that the emotion leaves open",
                ),
                ("exact", "Exact", "Reach the requested animation parameters exactly"),
                ("muscles", "Muscles Only", "Muscle contractions only, without correction"),
                ("points", "Points Only", "Move the feature points and let the skin follow, without muscles"),
            ),
            default="natural",
            update=changed,
        ),
    ]
