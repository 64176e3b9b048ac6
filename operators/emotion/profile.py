"""From the chosen emotion to what the solver takes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...arrays import Floats
from .props import DEFAULT_VARIANT

if TYPE_CHECKING:
    from ...api import Profile


def profile_of(emotion: Any) -> Profile:
    """The profile of the chosen word, variant and activation."""
    from ... import api

    variant = None if emotion.variant == DEFAULT_VARIANT else int(emotion.variant)
    return api.expression(emotion.word, activation=emotion.activation, variants=variant)


def frame_of(profile: Profile, seed: int) -> Floats:
    """(68,) FAPs: the middle of the profile's ranges for seed 0, else a draw."""
    return profile.frame() if seed == 0 else profile.frame(np.random.default_rng(seed))
