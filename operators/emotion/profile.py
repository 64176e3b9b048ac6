"""From the chosen emotion to what the solver takes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats
from ...mpeg4 import Drawn, way_drawn
from ..blender_types import Object
from ..muscles.props import by_hand_of
from .props import DEFAULT_VARIANT, RISORIUS_PG_emotion

if TYPE_CHECKING:
    from ...api import Profile


@dataclass(frozen=True, eq=False)
class Wanted:
    """What the user wants a face to show.

    Attributes
    ----------
    profile : of the emotion. faps : (68,) FAPs drawn from it, NaN where it is silent. drive : see `api.Drive`.
    contractions : muscle name -> 0..1, those set by hand. drawn : archetype -> way of showing it that a seed drew.
    """

    profile: Profile
    faps: Floats
    drive: str
    contractions: Mapping[str, float] = field(default_factory=dict)
    drawn: Mapping[str, str] = field(default_factory=dict)


def wanted_of(obj: Object, emotion: RISORIUS_PG_emotion | None = None) -> Wanted:
    """What is chosen for `obj` now, or an emotion (of a clip) shown as all that is chosen for `obj` besides it."""
    chosen = obj.risorius.emotion
    shown = chosen if emotion is None else emotion
    plain = profile_of(shown)
    profile = way_drawn(plain, Drawn(1.0, shown.seed)) if shown.seed else plain
    drawn = ways_between(plain, profile)
    return Wanted(profile, frame_of(profile, shown.seed), chosen.drive, by_hand_of(obj), drawn)


def ways_between(chosen: Profile, profile: Profile) -> dict[str, str]:
    """Archetype -> way of showing it that was not chosen."""
    return {str(name): way for name, way in profile.prototypes.items() if name not in chosen.prototypes}


def profile_of(emotion: RISORIUS_PG_emotion) -> Profile:
    """The profile of the chosen word, or point of the wheel, at the chosen activation."""
    from ... import api

    if emotion.by == "WHEEL":
        return api.expression(angle=math.degrees(emotion.angle), activation=emotion.activation)
    return api.expression(emotion.word, activation=emotion.activation, variants=variant_of(emotion))


def variant_of(emotion: RISORIUS_PG_emotion) -> int | str | None:
    """The chosen variant of the paper by its number, way of showing the emotion by its name, or None for the usual."""
    chosen = str(emotion.variant)
    return None if chosen == DEFAULT_VARIANT else int(chosen) if chosen.isdigit() else chosen


def frame_of(profile: Profile, seed: int) -> Floats:
    """(68,) FAPs: the middle of the profile's ranges for seed 0, else a draw."""
    return profile.frame() if seed == 0 else profile.frame(np.random.default_rng(seed))


def title_of(emotion: RISORIUS_PG_emotion) -> str:
    """The word, or the point of the wheel in words."""
    if emotion.by == "WHEEL":
        return f"{math.degrees(emotion.angle) % 360.0:.0f}° at {emotion.activation:.1f}"
    return str(emotion.word)
