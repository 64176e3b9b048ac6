"""What is pictured: a head with an action unit or an emotion, at a strength, from a side, in a light; and its FAPs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.api import Face
from risorius.arrays import Floats
from risorius.face.drive.natural.synergies import load_synergies
from risorius.mpeg4 import FAP_COUNT
from risorius.tables import read_csv

ACTIONS = Path(__file__).with_name("actions.csv")

HEADS = ("default", "ict", "makehuman")
EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")
REST = "rest"

#: Shares of a unit's full amount (a scanned action at its strongest, or as strong), in per cent; where the camera
#: stands, degrees to the subject's left; lights in Workbench, and in Cycles.
STRENGTHS, YAWS, LIGHTS, TRACED = (33, 67, 100), (0, 20, 40), ("side", "front"), ("portrait", "hard")

#: Heads that are lit in Cycles, too, which takes some seconds a picture.
TRACED_HEADS = HEADS[:1]


@dataclass(frozen=True)
class Action:
    """An action unit, the blend shape that means the same, and the FAPs that tell of it."""

    unit: str
    name: str
    shape: str
    faps: tuple[int, ...]


@dataclass(frozen=True)
class Still:
    """One picture. `shows`: an action unit, an emotion or "rest"; `strength` in per cent; `yaw` in degrees."""

    head: str
    shows: str
    strength: int = 100
    yaw: int = 0
    light: str = LIGHTS[0]

    @property
    def file(self) -> str:
        """Its file's name, which tells all."""
        return f"{self.head}-{self.shows}-{self.strength}-{self.yaw}-{self.light}.png"

    @property
    def at_rest(self) -> Still:
        """The same head at rest, seen in the same way."""
        return Still(self.head, REST, 100, self.yaw, self.light)


@cache
def actions() -> Mapping[str, Action]:
    """actions.csv by unit."""
    return {
        row.text("unit"): Action(
            row.text("unit"), row.text("name"), row.text("shape"), tuple(map(int, row.numbers("faps")))
        )
        for row in read_csv(ACTIONS)
    }


def stills(heads: Sequence[str] = HEADS) -> list[Still]:
    """All pictures: units at every strength from the front; units, emotions and rest at full from all sides and in all
    lights (but for the first, from the front alone; in Cycles, some heads)."""
    found = []
    for head in heads:
        found += [Still(head, unit, strength) for unit in actions() for strength in STRENGTHS[:-1]]
        for shows in (REST, *actions(), *EMOTIONS):
            found += [Still(head, shows, yaw=yaw) for yaw in YAWS]
            lights = (*LIGHTS[1:], *(TRACED if head in TRACED_HEADS else ()))
            found += [Still(head, shows, light=light) for light in lights]
    return found


def few() -> list[Still]:
    """Some of them, to try it all in minutes: one head, rest, smiles and emotions, from the front."""
    head, smile = HEADS[0], "AU12"
    found = [Still(head, smile, strength) for strength in STRENGTHS[:-1]]
    return found + [Still(head, shows) for shows in (REST, smile, "AU27", *EMOTIONS)]


def unit_faps(unit: str, strength: float) -> Floats:
    """(68,) FAPs of an action unit on both sides, FAP units; NaN where it moves none.

    `strength`: a share of its full amount.
    """
    known = load_synergies()
    columns = [index for index, name in enumerate(known.unit_names) if name in (unit, f"{unit}_l", f"{unit}_r")]
    metres = known.shown[:, columns].sum(axis=1)
    frame = np.full(FAP_COUNT, np.nan)
    moved = np.abs(metres) > 0.0
    frame[known.numbers[moved] - 1] = strength * (metres / known.per_fap)[moved]
    return frame


def posed(face: Face, still: Still) -> Floats:
    """(V, 3) the face of a still; as a user gets it, in the natural drive."""
    if still.shows == REST:
        return face.vertices
    if still.shows in EMOTIONS:
        profile = api.expression(still.shows)
        pose = face.pose(profile.frame(), emotion=profile.weights)
    else:
        pose = face.pose(unit_faps(still.shows, still.strength / 100.0), emotion={})
    positions: Floats = pose.positions
    return positions
