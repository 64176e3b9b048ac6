"""What trackers and engines call ARKit's blend shapes: one place for every format.

"eyeBlinkLeft", "EyeBlinkLeft", "eyeBlink_L", "L_eyeBlink", "eye_blink_left", "blendShapes.EyeBlinkLeft",
"Head|eyeBlink.L", "CTRL_eyeBlinkLeft" are one shape. A shape without sides may be given for one of them
("browInnerUp_L"): then it stands for that side's motion.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ....arrays import Floats
from ...standard import FAP_COUNT, FAPS
from .row_names import plain_name
from .shapes import load_shapes

#: Marks of a side before a name: "L_eyeBlink".
SIDE_BEFORE = re.compile(r"([LlRr])[_ -]+(\w+)")

#: Something of a rig's own before a name that is written in one word: "CTRL_eyeBlinkLeft", not "corner_mouth_left".
OWN_BEFORE = re.compile(r"([A-Za-z0-9]+)[_ -]+([A-Za-z]*[a-z][A-Z].*)")

#: What says before a name that it is no value of a shape.
NO_VALUE = (
    "d", "dt", "delta", "diff", "vel", "velocity", "acc", "std", "sd", "var", "sem", "conf", "confidence", "se", "n",
    "not", "no", "min", "max",
)  # fmt: skip

#: What stands before a shape's name, and behind it, beside the object that it is of.
BEFORE = ("blendshapes", "blendshape", "blend", "bs", "arkit", "shape", "face", "morph", "weight", "value")
BEHIND = ("value", "weight", "score", "coefficient")
SIDES = {"l": "left", "r": "right", "left": "left", "right": "right"}

#: Names that stand for nothing that moves.
NOTHING = ("neutral", "basis", "default")


@dataclass(frozen=True)
class Named:
    """A column that is a blend shape: its name in arkit.toml in lower case, and a side where the shape has none."""

    shape: str
    side: str | None = None


@lru_cache(maxsize=1)
def _known() -> frozenset[str]:
    """The names of arkit.toml in lower case."""
    return frozenset(name.lower() for name in load_shapes())


@lru_cache(maxsize=4096)
def shape_named(name: str) -> Named | None:
    """The blend shape that a name means; None where it means none."""
    parts = [part for part in re.split(r"[.:/|>\[\]()'\"]+", name.strip()) if part.strip(" %")]
    if len(parts) > 1 and plain_name(parts[-1]) in SIDES:
        parts = [*parts[:-2], parts[-2] + "_" + parts[-1]]
    return _in_one_word(parts[-1].strip()) if parts else None


def _in_one_word(word: str) -> Named | None:
    """See `shape_named`; without the object that a shape is of."""
    found = _plainly(plain_name(word))
    if found is not None:
        return found
    sided, own = SIDE_BEFORE.fullmatch(word), OWN_BEFORE.fullmatch(word)
    if sided is not None:
        return _plainly(plain_name(sided[2] + sided[1]))
    if own is not None and own[1].lower() not in NO_VALUE:
        return _in_one_word(own[2])
    return None


def _plainly(plain: str) -> Named | None:
    """The blend shape of a plain name."""
    for stem in _stems(plain):
        if stem in _known():
            return Named(stem)
        for mark, side in SIDES.items():
            if stem.endswith(mark):
                whole = stem.removesuffix(mark)
                if whole + side in _known():
                    return Named(whole + side)
                if whole in _known():
                    return Named(whole, side)
            if len(mark) > 1 and stem.startswith(mark) and stem.removeprefix(mark) + side in _known():
                return Named(stem.removeprefix(mark) + side)
    return None


def is_turn(name: str) -> bool:
    """Whether a name is Live Link Face's of a turn of the head or an eye."""
    return re.fullmatch(r"(head|lefteye|righteye)(yaw|pitch|roll)", plain_name(name)) is not None


def means_nothing(name: str) -> bool:
    """Whether a name stands for a face at rest."""
    return plain_name(name) in NOTHING


def _stems(plain: str) -> list[str]:
    """A plain name, and what it is without what stands before or behind."""
    stems = [plain]
    stems += [stem.removeprefix(before) for stem in stems for before in BEFORE if stem.startswith(before)]
    return stems + [stem.removesuffix(behind) for stem in stems for behind in BEHIND if stem.endswith(behind)]


def side_shares(side: str) -> Floats:
    """(68,) how much of a shape without sides one side has of each FAP: all of its own, half of those of the middle."""
    own, other = ("_l_", "_r_") if side == "left" else ("_r_", "_l_")
    shares = np.full(FAP_COUNT, 0.5)
    for number, fap in FAPS.items():
        name = f"_{fap.name}_"
        shares[number - 1] = 1.0 if own in name else 0.0 if other in name else 0.5
    return shares
