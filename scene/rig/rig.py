"""The controls of a rig, what each does to the face, and what is left alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...progress import Work
from ..faces import FaceSource
from .channels import Channel, refusing_what_is_gone
from .clips import refuse_unkeyable

if TYPE_CHECKING:
    from ...api import Controls

#: What a rig shows with channels at values that count from rest, frame by frame: (T, V, 3) displacement, metres.
Evaluate: TypeAlias = "Callable[[Sequence[Mapping[Channel, float]]], Work[Floats]]"


@dataclass(frozen=True)
class Control:
    """One way in which a channel goes from its rest: up or down (`sign` 1 or -1), or both ways alike (0).

    A channel whose two ways do different things, such as a slider from frown to smile, is two controls.
    """

    channel: Channel
    sign: int = 0

    @property
    def name(self) -> str:
        """The channel's name, and which way."""
        return self.channel.name + {0: "", 1: " +", -1: " -"}[self.sign]

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest value of the control, 0 at rest."""
        down, up = self.channel.low - self.channel.resting, self.channel.high - self.channel.resting
        return {0: (down, up), 1: (0.0, up), -1: (0.0, -down)}[self.sign]


@dataclass(frozen=True, eq=False)
class Rig:
    """Controls of one face.

    Attributes
    ----------
    source : the face, as it is at rest.
    entries : its K controls. effects : (K, V, 3) what a value of 1 does to the joined vertices of the face, metres.
    left_alone : name -> why, of what could have been a control.
    evaluate : shows the controls at values together, where they do not simply add up.
    """

    source: FaceSource
    entries: tuple[Control, ...]
    effects: Floats
    left_alone: Mapping[str, str] = field(default_factory=dict)
    evaluate: Evaluate | None = None

    def controls(self) -> Controls:
        """As `api.retarget` takes them.

        Raises
        ------
        SceneError : there are none; says why and what to do.
        """
        from ... import api

        if not self.entries:
            why = "; ".join(f"{name}: {reason}" for name, reason in self.left_alone.items())
            problem = f"has no controls that can be used: {why or 'add shape keys, or bake to New Keys'}"
            raise SceneError(self.source.head.name, problem)
        limits = np.array([entry.limits for entry in self.entries])
        return api.Controls(tuple(e.name for e in self.entries), self.effects, limits[:, 0], limits[:, 1])

    def refuse_changed(self) -> None:
        """Refuse to key controls that others have changed since they were measured; to be asked just before writing.

        Raises
        ------
        SceneError : the face was changed; a control was renamed or removed, or cannot be keyed any more.
        """
        self.source.refuse_changed(same_mesh=True)
        places = [(entry.name, place) for entry in self.entries for place in entry.channel.places]
        refuse_unkeyable(place.owner for _, place in places)
        for name, place in places:
            with refusing_what_is_gone(self.source.head, name):
                place.read(place.owner)

    def channel_values(self, names: Sequence[str], values: Floats) -> dict[Channel, Floats]:
        """Channel -> (T,) how far from rest it goes, from the values (T, K) of controls that are named."""
        by_name = {entry.name: entry for entry in self.entries}
        moved: dict[Channel, Floats] = {}
        for name, own in zip(names, values.T, strict=True):
            entry = by_name[name]
            moved[entry.channel] = moved.get(entry.channel, 0.0) + (own if entry.sign >= 0 else -own)
        return moved
