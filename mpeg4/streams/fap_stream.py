"""A stream of FAP frames in memory, as a .fap file holds it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np

from ...arrays import Bools, Floats
from ...errors import ParameterError
from ..high_level import VISEME_SHAPES, ExpressionField, VisemeField, expand, expression_frame, viseme_frame
from ..standard import FAP_COUNT, FAP_LIMIT, check_fps
from .filling import Filling, checked_filling, fill

T = TypeVar("T")


def _undecided() -> Bools:
    """Stands for a mask that is yet to be read off the frames."""
    return np.zeros((0, FAP_COUNT), dtype=np.bool_)


@dataclass(frozen=True, eq=False)
class FapStream:
    """FAP frames at a fixed rate.

    Attributes
    ----------
    frames : (T, 68) float64, FAP units, index = FAP number - 1; NaN where masked off, which means *no statement* and
        not zero. The columns of FAP 1 and 2 are always NaN: their values are sub-fields (visemes, expressions).
    fps : frames per second.
    name : what the header calls the stream; may hold blanks.
    mask : (T, 68) bool, True where the frame states the FAP. By default it is read off frames, visemes, expressions.
    visemes, expressions : frame index -> value of FAP 1, FAP 2, where stated.
    first_frame : number of the first frame in a file (0, or 1 in files that count from one).
    version : of the file format.
    assumed : what the file did not say and was assumed to read it, in words for people.

    Raises
    ------
    ParameterError
        When shapes, rate, name or mask break their rule.

    Examples
    --------
    >>> frames = np.full((50, 68), np.nan)
    >>> frames[:, api.fap("open_jaw").number - 1] = np.linspace(0.0, 300.0, 50)
    >>> stream = api.FapStream(frames, fps=25.0, name="yawn")
    >>> bool(stream.mask[0, 2]), bool(stream.mask[0, 3])
    (True, False)
    """

    frames: Floats
    fps: float = 25.0
    name: str = "risorius"
    mask: Bools = field(default_factory=_undecided)
    visemes: Mapping[int, VisemeField] = field(default_factory=dict)
    expressions: Mapping[int, ExpressionField] = field(default_factory=dict)
    first_frame: int = 0
    version: str = "2.1"
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Check the arrays against one another."""
        frames = np.array(self.frames, dtype=np.float64)
        if frames.ndim != 2 or frames.shape[1] != FAP_COUNT:
            raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT})", frames.shape)
        if (np.abs(frames) > FAP_LIMIT).any():
            rule = f"must be finite, within {FAP_LIMIT:.0f} FAP units, or NaN where masked"
            raise ParameterError("frames", rule, float(np.nanmax(np.abs(frames))))
        check_fps(self.fps)
        if not self.name.isprintable():
            raise ParameterError("name", "must be one line of printable text", self.name)
        if self.first_frame < 0:
            raise ParameterError("first_frame", "must be 0 or more", self.first_frame)
        for what, values in (("visemes", self.visemes), ("expressions", self.expressions)):
            if any(not 0 <= index < len(frames) for index in values):
                raise ParameterError(what, f"must be frames in 0..{len(frames) - 1}", sorted(values))
        frames[:, :2] = np.nan
        stated = ~np.isnan(frames)
        stated[sorted(self.visemes), 0] = True
        stated[sorted(self.expressions), 1] = True
        if self.mask.shape != (0, FAP_COUNT) and not np.array_equal(self.mask, stated):
            raise ParameterError("mask", "must be True exactly where the frames state a FAP", self.mask.shape)
        object.__setattr__(self, "frames", frames)
        object.__setattr__(self, "mask", stated)

    def expanded(self, viseme_shapes: Mapping[int, Floats] = VISEME_SHAPES) -> Floats:
        """Frames with FAP 1 and 2 turned into low-level FAPs; explicit low-level values override.

        Parameters
        ----------
        viseme_shapes : viseme number -> (68,) FAPs, NaN where silent; by default those of the table.

        Returns
        -------
        (T, 68) float64, FAP units; NaN where still silent.

        Raises
        ------
        ParameterError
            When a viseme in use has no shape.

        Examples
        --------
        >>> stream = api.FapStream(np.full((2, 68), np.nan), visemes={0: api.VisemeField(select1=10)})
        >>> bool(np.isnan(stream.frames[0, 2])), bool(np.isnan(stream.expanded()[0, 2]))
        (True, False)
        """
        frames = self.frames.copy()
        for index in sorted({*self.visemes, *self.expressions}):
            parts = []
            if index in self.expressions:
                parts.append(expression_frame(self.expressions[index]))
            if index in self.visemes:
                parts.append(viseme_frame(self.visemes[index], viseme_shapes))
            frames[index] = expand(frames[index], *parts)
        return frames

    def filled(self, rule: str | Filling = Filling.STANDARD) -> FapStream:
        """The stream with FAPs that are not stated filled by a rule of the standard (`Filling`).

        Visemes and expressions have no other side: they are held, or left alone where the rule only copies.

        Raises
        ------
        ParameterError
            When there is no such rule.

        Examples
        --------
        >>> frames = np.full((1, 68), np.nan)
        >>> frames[0, 12 - 1] = 100.0  # raise_l_cornerlip
        >>> float(api.FapStream(frames).filled().frames[0, 13 - 1])  # raise_r_cornerlip
        100.0
        """
        frames = fill(self.frames, rule)
        if checked_filling(rule) is Filling.COPY:
            return replace(self, frames=frames, mask=_undecided())
        count = len(frames)
        visemes, expressions = _held(self.visemes, count), _held(self.expressions, count)
        return replace(self, frames=frames, mask=_undecided(), visemes=visemes, expressions=expressions)


def _held(fields: Mapping[int, T], count: int) -> dict[int, T]:
    """Every frame's field, the last one before it where it has none."""
    held: dict[int, T] = {}
    for index in range(count):
        if index in fields:
            held[index] = fields[index]
        elif index - 1 in held:
            held[index] = held[index - 1]
    return held
