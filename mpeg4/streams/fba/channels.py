"""What a frame of the FBA bitstream codes: 7 sub-fields of FAP 1 and 2 and the 66 low-level FAPs, as whole levels.

A channel's value is divided by its step, and the level must lie within its limits: those of the table, or those that an
I frame sends in multiples of `LIMIT_UNIT`. P frames code the difference to the frame before.
"""

from __future__ import annotations

from dataclasses import dataclass

from ....arrays import Bools
from ...high_level import FULL
from ...standard import FAP_COUNT, FAPS

LIMIT_UNIT, LARGEST_LIMIT_CODE, LARGEST_QUANTISER = 60, 31, 31
VISEMES, EXPRESSIONS = 14, 6  # largest select codes


@dataclass(frozen=True)
class Channel:
    """One number of a frame.

    Attributes
    ----------
    name : the sub-field's or the FAP's.
    fap : FAP number.
    step : FAP units per level at quantiser 1; None where the value is a code and is not quantised.
    top : largest value of a sub-field, whose smallest is 0; None for low-level FAPs.
    """

    name: str
    fap: int
    step: int | None
    top: int | None = None

    def step_at(self, quantiser: int) -> int:
        """FAP units per level; quantiser 0 is lossless."""
        return 1 if self.step is None or quantiser == 0 else self.step * quantiser

    def field_limits(self, quantiser: int, *, intra: bool) -> tuple[int, int]:
        """Smallest and largest level of a sub-field."""
        step = self.step_at(quantiser)
        largest = ((self.top or 0) + step // 2) // step
        return (0 if intra else -largest), largest


VISEME_CHANNELS = (
    Channel("viseme_select1", 1, None, VISEMES),
    Channel("viseme_select2", 1, None, VISEMES),
    Channel("viseme_blend", 1, 1, FULL),
)
EXPRESSION_CHANNELS = (
    Channel("expression_select1", 2, None, EXPRESSIONS),
    Channel("expression_intensity1", 2, 1, FULL),
    Channel("expression_select2", 2, None, EXPRESSIONS),
    Channel("expression_intensity2", 2, 1, FULL),
)
FAP_CHANNELS = tuple(Channel(FAPS[number].name, number, FAPS[number].quant_step) for number in range(3, FAP_COUNT + 1))


def level_of(value: int, step: int) -> int:
    """The level of a value: rounded, halves of a step that cannot leave 0 stay there."""
    size = abs(value)
    if size <= step // 2:
        return 0
    level = (size + step // 2) // step
    return level if value > 0 else -level


def limit_of(code: int, quantiser: int) -> int:
    """The largest level that a limit's code allows."""
    return code * LIMIT_UNIT // max(quantiser, 1)


def limit_code(level: int, quantiser: int) -> int | None:
    """The smallest code that allows a level (0 or more); None where none does."""
    codes = range(LARGEST_LIMIT_CODE + 1)
    return next((code for code in codes if limit_of(code, quantiser) >= level), None)


@dataclass(frozen=True)
class Limits:
    """The 5-bit codes of every low-level FAP's largest and smallest level, (66,) each, in I and P frames."""

    intra_high: tuple[int, ...]
    intra_low: tuple[int, ...]
    inter_high: tuple[int, ...]
    inter_low: tuple[int, ...]

    def of(self, channel: int, quantiser: int, *, intra: bool) -> tuple[int, int]:
        """Smallest and largest level of the low-level FAP at an index."""
        high, low = (self.intra_high, self.intra_low) if intra else (self.inter_high, self.inter_low)
        return -limit_of(low[channel], quantiser), limit_of(high[channel], quantiser)


def _outwards(limit: int) -> int:
    """A limit of the table as a code, rounded outwards."""
    return min(-(-abs(limit) // LIMIT_UNIT), LARGEST_LIMIT_CODE)


def _default_limits() -> Limits:
    """The table's limits."""
    rows = [FAPS[channel.fap] for channel in FAP_CHANNELS]
    intra, inter = ([row.intra_limits or (0, 0) for row in rows], [row.inter_limits or (0, 0) for row in rows])
    high, low = (tuple(_outwards(pair[side]) for pair in intra) for side in (1, 0))
    return Limits(high, low, *(tuple(_outwards(pair[side]) for pair in inter) for side in (1, 0)))


DEFAULT_LIMITS = _default_limits()
"""What holds until an I frame says otherwise."""


def channels_of(mask: Bools) -> list[Channel]:
    """The channels that a mask (68,) sends, in order."""
    channels = [*VISEME_CHANNELS] if mask[0] else []
    channels += EXPRESSION_CHANNELS if mask[1] else ()
    return channels + [channel for channel in FAP_CHANNELS if mask[channel.fap - 1]]


def bounds_of(channel: Channel, limits: Limits, quantiser: int, *, intra: bool) -> tuple[int, int]:
    """Smallest and largest level of a channel."""
    if channel.top is not None:
        return channel.field_limits(quantiser, intra=intra)
    return limits.of(channel.fap - 3, quantiser, intra=intra)
