"""The parts of a mouth, what each viseme asks of them, and how strongly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from types import MappingProxyType

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAP_COUNT, VISEME_SHAPES, fap
from ...tables import KeyedTable, read_toml
from ..phonemes import FOLDER, Phoneme

JAW = fap("open_jaw").number


class MouthPart(StrEnum):
    """Parts that sounds share, each in its own time."""

    JAW = "jaw"
    OPENING = "opening"
    WIDTH = "width"
    ROUNDING = "rounding"
    TONGUE = "tongue"


#: FAPs of each part. Opening: the lips' own, beside what the jaw carries.
FAPS_OF: Mapping[MouthPart, tuple[int, ...]] = MappingProxyType({
    MouthPart.JAW: (3,),
    MouthPart.OPENING: (4, 5, 8, 9, 10, 11, 51, 52, 55, 56, 57, 58, 18),
    MouthPart.WIDTH: (6, 7, 12, 13),
    MouthPart.ROUNDING: (16, 17),
    MouthPart.TONGUE: (44, 45, 46),
})  # fmt: skip

#: FAPs of the lower lip, and how far each falls as the jaw opens by one unit; the shapes of visemes are drawn so.
CARRIED: Mapping[int, float] = MappingProxyType({5: 1.0, 52: 1.0, 10: 0.95, 11: 0.95, 57: 0.95, 58: 0.95})


@dataclass(frozen=True)
class Closure:
    """What a viseme reaches: the share of its sound that it holds, seconds to get there, the jaw's most, and FAPs."""

    hold: float
    ramp: float
    jaw: float
    faps: Mapping[int, float]


@dataclass(frozen=True)
class Manner:
    """The figures of articulation.toml.

    Attributes
    ----------
    reach : part -> seconds ahead and behind. strength : viseme -> part -> weight.
    core : share of a sound at full weight. closures : by viseme.
    stressed, unstressed : shares of the jaw's opening. pause : seconds of the shortest rest.
    """

    reach: Mapping[MouthPart, tuple[float, float]]
    strength: Mapping[int, Mapping[MouthPart, float]]
    core: float
    closures: Mapping[int, Closure]
    stressed: float
    unstressed: float
    pause: float


@cache
def manner() -> Manner:
    """The figures, read once."""
    table = read_toml(FOLDER / "articulation.toml")
    reach, core, stress, pause = (table.table(name) for name in ("reach", "core", "stress", "pause"))
    ahead_behind = {part: reach.numbers(part, 2) for part in MouthPart}
    return Manner(
        {part: (float(times[0]), float(times[1])) for part, times in ahead_behind.items()},
        {
            int(viseme): {part: row.number(part, above=0.0, most=1.0) for part in MouthPart}
            for viseme, row in table.tables("strength").items()
        },
        core.number("share", above=0.0, most=1.0),
        {int(viseme): _closure(row) for viseme, row in table.tables("closure").items()},
        stress.number("stressed", above=0.0),
        stress.number("unstressed", above=0.0),
        pause.number("least", least=0.0),
    )


def _closure(row: KeyedTable) -> Closure:
    """A row as a closure."""
    asked = row.table("faps")
    return Closure(
        row.number("hold", above=0.0, most=1.0),
        row.number("ramp", above=0.0),
        row.number("jaw", above=0.0),
        {int(number): asked.number(number) for number in asked},
    )


def target(phoneme: Phoneme, *, jaw: float = 1.0) -> Floats:
    """(68,) what a sound asks: of the lower lip beside what the jaw carries; 0 at rest, never silent.

    Parameters
    ----------
    jaw : share of the jaw's opening, for stress.
    """
    shape = np.nan_to_num(VISEME_SHAPES[phoneme.viseme]) if phoneme.viseme else np.zeros(FAP_COUNT)
    own = beside_jaw(shape[None])[0] * phoneme.lips
    own[JAW - 1] = shape[JAW - 1] * phoneme.jaw * jaw
    return np.asarray(own)


def beside_jaw(frames: Floats) -> Floats:
    """(T, 68) frames whose lower lip is told beside what the jaw carries of it."""
    moved = frames.copy()
    for number, share in CARRIED.items():
        moved[:, number - 1] += share * frames[:, JAW - 1]
    return moved


def carried_by_jaw(frames: Floats) -> Floats:
    """(T, 68) frames with what the jaw carries of the lower lip put back; undoes `beside_jaw`."""
    moved = frames.copy()
    for number, share in CARRIED.items():
        moved[:, number - 1] -= share * frames[:, JAW - 1]
    return moved
