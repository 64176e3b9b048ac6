"""One frame of the FBA bitstream as the decoder reads it: an I frame's settings, and the levels of any frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...standard import FAP_COUNT, GROUPS
from ..fap_file import LONGEST_GAP
from .arithmetic import Model, SegmentReader
from .bits import BitReader, EndOfBits
from .channels import Channel, Limits, bounds_of, channels_of
from .syntax import LONGEST_SKIP, MARKER_EVERY, SKIP_BITS, MaskType, Rate, read_time


class Damage(Exception):
    """What is wrong at the reader's position."""


@dataclass
class Coding:
    """What an I frame sets, and P frames go on with."""

    quantiser: int
    channels: list[Channel]
    limits: Limits
    models: list[Model]  # of P frames
    reached: list[int]


@dataclass(frozen=True)
class Clock:
    """What an I frame says of time: frames per second and seconds, None where it is silent."""

    rate: float | None
    seconds: int | None


def read_clock(bits: BitReader) -> Clock:
    """Frame rate and time code of an I frame.

    Raises
    ------
    EndOfBits, Damage : what is wrong.
    """
    rate = Rate.read(bits).fps if bits.get() else None
    if rate == 0.0:
        raise Damage("has the frame rate 0")
    if not bits.get():
        return Clock(rate, None)
    seconds = read_time(bits)
    if seconds is None:
        raise Damage("has a time code without its marker bit: the stream is damaged")
    return Clock(rate, seconds)


def read_skip(bits: BitReader) -> int:
    """How many frames are left out.

    Raises
    ------
    EndOfBits, Damage : what is wrong.
    """
    skipped = 0
    count = LONGEST_SKIP if bits.get() else 0
    while count == LONGEST_SKIP:
        count = bits.get(SKIP_BITS)
        skipped += count
        if skipped > LONGEST_GAP:
            raise Damage(f"skips more than {LONGEST_GAP} frames")
    return skipped


def read_coding(bits: BitReader, before: Limits) -> Coding:
    """Quantiser, masks and limits of an I frame; limits that it does not send are those before.

    Raises
    ------
    EndOfBits, Damage : what the frame lacks; DCT coding by name.
    """
    quantiser = bits.get(5)
    mask = np.zeros(FAP_COUNT, dtype=np.bool_)
    for members in GROUPS.values():
        _read_marker(bits, "a mask")
        kind = MaskType(bits.get(2))
        for number in members:
            some = kind in (MaskType.SOME_OTHERS_HELD, MaskType.SOME_OTHERS_INTERPOLATED)
            mask[number - 1] = bits.get() if some else kind is MaskType.ALL
    bits.get()  # suggested gender
    if bits.get():
        raise Damage("uses DCT coding, which is not supported: encode it in predictive mode")
    flags = [bits.get() for _ in range(4)]
    channels = channels_of(mask)
    kinds = (before.intra_high, before.intra_low, before.inter_high, before.inter_low)
    sent = {channel.fap for channel in channels}
    limits = Limits(
        *(_read_limits(bits, sent, kind) if flag else kind for flag, kind in zip(flags, kinds, strict=True))
    )
    models = [_model(channel, limits, quantiser, intra=False) for channel in channels]
    return Coding(quantiser, channels, limits, models, [0] * len(channels))


def _read_limits(bits: BitReader, sent: set[int], old: tuple[int, ...]) -> tuple[int, ...]:
    """One kind of limits; FAPs that are not sent keep theirs."""
    codes = list(old)
    for members in list(GROUPS.values())[1:]:
        for place, number in enumerate(members):
            if place % MARKER_EVERY == 0:
                _read_marker(bits, "the limits")
            if number in sent:
                codes[number - 3] = bits.get(5)
    return tuple(codes)


def _read_marker(bits: BitReader, where: str) -> None:
    """A bit that must be 1."""
    if not bits.get():
        raise Damage(f"lacks a marker bit in {where}: the stream is damaged")


def _model(channel: Channel, limits: Limits, quantiser: int, *, intra: bool) -> Model:
    """A fresh model of a channel's levels."""
    low, high = bounds_of(channel, limits, quantiser, intra=intra)
    return Model(high - low + 1)


def read_levels(bits: BitReader, coding: Coding, *, intra: bool) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """The segments of a frame, into `coding.reached`; the flags of FAP 1 and of FAP 2.

    Raises
    ------
    EndOfBits : the frame is cut off.
    """
    counts = [sum(channel.fap == fap for channel in coding.channels) for fap in (1, 2)]
    values: list[int] = []
    flags: list[tuple[int, ...]] = []
    for count, flag_count in zip((*counts, len(coding.channels) - sum(counts)), (1, 2, 0), strict=True):
        if flag_count and not count:
            flags.append(())
            continue
        segment = SegmentReader(bits)
        for place in range(len(values), len(values) + count):
            values.append(_read_value(segment, coding, place, intra=intra))
        segment.finish()
        if bits.overrun:
            raise EndOfBits
        flags.append(tuple(bits.get() for _ in range(flag_count)))
    coding.reached = values
    return flags[0], flags[1]


def _read_value(segment: SegmentReader, coding: Coding, place: int, *, intra: bool) -> int:
    """One channel's value."""
    channel = coding.channels[place]
    model = _model(channel, coding.limits, coding.quantiser, intra=True) if intra else coding.models[place]
    low, _ = bounds_of(channel, coding.limits, coding.quantiser, intra=intra)
    symbol = segment.get(model)
    if not intra:
        model.learn(symbol)
    change = (symbol + low) * channel.step_at(coding.quantiser)
    return change if intra else coding.reached[place] + change
