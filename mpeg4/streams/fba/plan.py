"""How a stream is cut into runs, an I frame and the P frames that build on it, before it is written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from ....arrays import Bools
from ....errors import ParameterError
from ..fap_file import LONGEST_GAP
from ..fap_stream import FapStream
from .channels import FAP_CHANNELS, LARGEST_LIMIT_CODE, Channel, Limits, channels_of, level_of, limit_code, limit_of
from .syntax import first_frame_of


@dataclass(frozen=True, eq=False)
class Picture:
    """One coded frame: values and flags of all channels that its mask sends, in order; flags follow FAP 1 and 2."""

    index: int
    mask: Bools
    values: tuple[int, ...]
    viseme_flags: tuple[int, ...] = ()
    expression_flags: tuple[int, ...] = ()


@dataclass
class Run:
    """An I frame and the P frames that build on it, as levels."""

    pictures: list[Picture] = field(default_factory=list)
    levels: list[list[int]] = field(default_factory=list)
    reached: list[int] = field(default_factory=list)  # what the decoder has after the last frame


def runs(stream: FapStream, quantiser: int, refresh: float) -> Iterator[Run]:
    """The frames in runs, with their levels."""
    run = Run()
    count = 0
    for picture in _pictures(stream):
        due = picture.index >= first_frame_of(count * refresh, stream.fps)
        count = max(count, int(picture.index / stream.fps / refresh))  # of those that skipped frames have passed
        while picture.index >= first_frame_of(count * refresh, stream.fps):
            count += 1
        same = run.pictures and np.array_equal(run.pictures[-1].mask, picture.mask)
        if due or not same or not _follows(run, picture, quantiser):
            if run.pictures:
                yield run
            run = _begun(picture, quantiser)
    yield run


def _begun(picture: Picture, quantiser: int) -> Run:
    """A run of one I frame."""
    channels = channels_of(picture.mask)
    steps = [channel.step_at(quantiser) for channel in channels]
    levels = [level_of(value, step) for value, step in zip(picture.values, steps, strict=True)]
    largest = limit_of(LARGEST_LIMIT_CODE, quantiser)
    for place, (channel, value) in enumerate(zip(channels, picture.values, strict=True)):
        if channel.top is not None:
            continue
        reach = limit_of(LARGEST_LIMIT_CODE, 1) * channel.step_at(min(quantiser, 1))
        if abs(value) > reach:
            remedy = "choose quantiser 1 or more" if quantiser == 0 else "no quantiser can code more"
            rule = f"must be within {reach} FAP units in frame {picture.index} ({remedy})"
            raise ParameterError(channel.name, rule, value)
        levels[place] = min(max(levels[place], -largest), largest)  # limits are whole levels, rounded down
    return Run([picture], [levels], [level * step for level, step in zip(levels, steps, strict=True)])


def _follows(run: Run, picture: Picture, quantiser: int) -> bool:
    """Add a P frame to a run; False, and nothing added, where a difference is beyond all limits."""
    channels = channels_of(picture.mask)
    steps = [channel.step_at(quantiser) for channel in channels]
    changes = [value - reached for value, reached in zip(picture.values, run.reached, strict=True)]
    levels = [level_of(change, step) for change, step in zip(changes, steps, strict=True)]
    largest = limit_of(LARGEST_LIMIT_CODE, quantiser)
    if any(channel.top is None and abs(level) > largest for channel, level in zip(channels, levels, strict=True)):
        return False
    run.pictures.append(picture)
    run.levels.append(levels)
    run.reached = [old + level * step for old, level, step in zip(run.reached, levels, steps, strict=True)]
    return True


def _pictures(stream: FapStream) -> Iterator[Picture]:
    """The frames that are coded."""
    last, sent = len(stream.frames) - 1, 0
    for index, (frame, mask) in enumerate(zip(stream.frames, stream.mask, strict=True)):
        if not mask.any() and index not in (0, last) and index - sent <= LONGEST_GAP:
            continue
        sent = index
        viseme, expression = stream.visemes.get(index), stream.expressions.get(index)
        fields = (*(viseme.values[:3] if viseme else ()), *(expression.values[:4] if expression else ()))
        values = np.rint(frame[2:][mask[2:]]).astype(np.int64)
        yield Picture(
            index,
            mask,
            (*fields, *values.tolist()),
            viseme.values[3:] if viseme else (),
            expression.values[4:] if expression else (),
        )


def limits_of(run: Run, channels: Sequence[Channel], quantiser: int) -> Limits:
    """The tightest limits that allow all levels of a run."""
    codes: dict[str, list[int]] = {name: [0] * len(FAP_CHANNELS) for name in ("ih", "il", "ph", "pl")}
    for kind, rows in (("i", run.levels[:1]), ("p", run.levels[1:])):
        for place, channel in enumerate(channels):
            if channel.top is None and rows:
                column = [row[place] for row in rows]
                codes[kind + "h"][channel.fap - 3] = limit_code(max(0, *column), quantiser) or 0
                codes[kind + "l"][channel.fap - 3] = limit_code(max(0, *(-level for level in column)), quantiser) or 0
    return Limits(*(tuple(codes[name]) for name in ("ih", "il", "ph", "pl")))
