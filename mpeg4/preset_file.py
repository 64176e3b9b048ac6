"""Expressions and whole timelines as preset files (TOML): words or points of the wheel, times, contractions.

A preset says what is meant and holds no vertices, so it fits every face. The format is described in docs/formats.md.
"""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, TypeVar

from ..errors import FormatError, ParameterError
from ..files import write_whole
from .emotions.expressions import expression, find_word
from .emotions.profile import Profile
from .timing import Ramp


class PresetKind(StrEnum):
    """What a preset file holds: one expression, or several in time."""

    EXPRESSION = "expression"
    TIMELINE = "timeline"


#: What a variation may be given; an amount and a seed each.
VARIATIONS = ("draws", "blinks", "head", "eyes")


@dataclass(frozen=True)
class Choice:
    """An emotion as it is chosen: a word, or else an angle of the wheel in degrees; with its activation and seed.

    Raises
    ------
    ParameterError : both or neither of word and angle, or one that the model does not know.
    """

    activation: float
    word: str | None = None
    angle: float | None = None
    variant: int | None = None
    seed: int = 0

    def __post_init__(self) -> None:
        """Check it by making its profile."""
        if (self.word is None) == (self.angle is None):
            raise ParameterError("emotion", "must be either a word or an angle", (self.word, self.angle))
        if self.word is not None:
            find_word(self.word)
        if self.seed < 0:
            raise ParameterError("seed", "must be 0 or more", self.seed)
        self.profile()

    def profile(self) -> Profile:
        """Its profile."""
        if self.angle is not None:
            return expression(angle=self.angle, activation=self.activation)
        return expression(self.word, activation=self.activation, variants=self.variant)


@dataclass(frozen=True)
class Clip:
    """An emotion in time: seconds from the timeline's beginning, then as in `Cue`."""

    emotion: Choice
    start: float
    onset: float
    apex: float
    offset: float
    _: KW_ONLY
    peak: float = 1.0
    ramp: Ramp = Ramp.MINIMUM_JERK
    name: str = ""
    mute: bool = False

    def __post_init__(self) -> None:
        """Check times and peak."""
        for key in ("start", "onset", "apex", "offset"):
            value = getattr(self, key)
            if not (math.isfinite(value) and value >= 0.0):
                raise ParameterError(key, "must be a number of seconds, 0 or more", value)
        if not 0.0 <= self.peak <= 1.0:
            raise ParameterError("peak", "must lie in 0..1", self.peak)


@dataclass(frozen=True)
class Preset:
    """What a preset file holds.

    Attributes
    ----------
    kind : of what it is. emotion : of an expression. clips : of a timeline, at least one.
    contractions : muscle name -> 0..1, set by hand. variation : name of `VARIATIONS` -> amount and seed.
    """

    kind: PresetKind
    emotion: Choice | None = None
    clips: tuple[Clip, ...] = ()
    contractions: Mapping[str, float] = field(default_factory=dict)
    variation: Mapping[str, tuple[float, int]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check that it holds what its kind says."""
        if self.kind is PresetKind.EXPRESSION and self.emotion is None:
            raise ParameterError("preset", "must hold an emotion", self.kind)
        if self.kind is PresetKind.TIMELINE and not self.clips:
            raise ParameterError("preset", "must hold at least one clip", self.kind)
        for name, value in self.contractions.items():
            if not 0.0 <= value <= 1.0:
                raise ParameterError(f"contraction of {name}", "must lie in 0..1", value)


def write_preset(path: str | Path, preset: Preset) -> None:
    """Write a preset file.

    Raises
    ------
    FormatError : it cannot be written.
    """
    lines = [f"risorius = {_text(preset.kind.value)}"]
    if preset.emotion is not None:
        lines += ["", "[emotion]", *_choice_lines(preset.emotion)]
    for clip in preset.clips:
        lines += ["", "[[clips]]", *([f"name = {_text(clip.name)}"] if clip.name else [])]
        lines += _choice_lines(clip.emotion)
        lines += [f"{key} = {_number(getattr(clip, key))}" for key in ("start", "onset", "apex", "offset", "peak")]
        lines += [f"ramp = {_text(clip.ramp.value)}", *(["mute = true"] if clip.mute else [])]
    if preset.variation:
        lines += ["", "[variation]"]
        lines += [
            f"{name} = {{ amount = {_number(amount)}, seed = {seed} }}"
            for name, (amount, seed) in preset.variation.items()
        ]
    if preset.contractions:
        lines += ["", "[contractions]"]
        lines += [f"{_text(name)} = {_number(value)}" for name, value in preset.contractions.items()]
    write_whole(path, "\n".join(lines) + "\n")


def _choice_lines(choice: Choice) -> list[str]:
    """An emotion's own keys."""
    by_word = choice.angle is None
    lines = [f"word = {_text(choice.word or '')}" if by_word else f"angle = {_number(choice.angle or 0.0)}"]
    lines += [f"activation = {_number(choice.activation)}"]
    lines += [f"variant = {choice.variant}"] if choice.variant is not None else []
    return lines + ([f"seed = {choice.seed}"] if choice.seed else [])


def _text(words: str) -> str:
    """A text as TOML has it."""
    return json.dumps(words, ensure_ascii=False)


def _number(value: float) -> str:
    """A float as TOML has it, without the noise of single precision."""
    return repr(round(float(value), 6))


def read_preset(path: str | Path) -> Preset:
    """Read a preset file.

    Raises
    ------
    FormatError : names the file, the key and the rule it breaks.
    """
    file = Path(path)
    try:
        document = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise FormatError(file, f"cannot be read ({error.strerror})") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(file, f"is not valid TOML: {error}") from error
    if document.get("risorius") not in list(PresetKind):
        kinds = " or ".join(f'"{kind}"' for kind in PresetKind)
        raise FormatError(file, f"is no Risorius preset: it must say risorius = {kinds}", key="risorius")
    return _Reader(file).preset(document)


M = TypeVar("M")


class _Reader:
    """Checks tables while they are read; every refusal names file and key."""

    def __init__(self, file: Path) -> None:
        self.file = file

    def preset(self, document: Mapping[str, Any]) -> Preset:
        """The whole file."""
        kind = PresetKind(document["risorius"])
        held = "emotion" if kind is PresetKind.EXPRESSION else "clips"
        self._only(document, "", {"risorius", held, "contractions", "variation"})
        emotion: Choice | None = None
        clips: tuple[Clip, ...] = ()
        if kind is PresetKind.EXPRESSION:
            emotion = self._choice(self._table(document.get("emotion"), "emotion"), "emotion")
        elif isinstance(document.get("clips"), list):
            clips = tuple(self._clip(self._table(c, "clips"), f"clips.{k}") for k, c in enumerate(document["clips"]))
        contractions = self._table(document.get("contractions", {}), "contractions")
        strengths = {name: self._real(contractions, name, "contractions") for name in contractions}
        variation = self._variation(self._table(document.get("variation", {}), "variation"))
        return self._made(held, lambda: Preset(kind, emotion, clips, strengths, variation))

    def _choice(self, table: Mapping[str, Any], key: str) -> Choice:
        """An emotion."""
        self._only(table, key, {"word", "angle", "activation", "variant", "seed"})
        word, variant, seed = table.get("word"), table.get("variant"), table.get("seed", 0)
        if word is not None and not isinstance(word, str):
            raise FormatError(self.file, "must be a text", key=f"{key}.word")
        for name, value in (("variant", variant), ("seed", seed)):
            if value is not None and (isinstance(value, bool) or not isinstance(value, int)):
                raise FormatError(self.file, "must be a whole number", key=f"{key}.{name}")
        angle = self._real(table, "angle", key) if "angle" in table else None
        activation = self._real(table, "activation", key)
        return self._made(key, lambda: Choice(activation, word, angle, variant, seed))

    def _clip(self, table: Mapping[str, Any], key: str) -> Clip:
        """One clip."""
        times, others = ("start", "onset", "apex", "offset"), ("peak", "ramp", "name", "mute")
        emotion = self._choice({k: v for k, v in table.items() if k not in (*times, *others)}, key)
        ramp = table.get("ramp", Ramp.MINIMUM_JERK.value)
        if ramp not in list(Ramp):
            raise FormatError(self.file, f"must be one of {', '.join(Ramp)}", key=f"{key}.ramp")
        values = [self._real(table, name, key) for name in times]
        peak = self._real(table, "peak", key) if "peak" in table else 1.0
        name, mute = str(table.get("name", "")), bool(table.get("mute", False))
        return self._made(key, lambda: Clip(emotion, *values, peak=peak, ramp=Ramp(ramp), name=name, mute=mute))

    def _variation(self, table: Mapping[str, Any]) -> dict[str, tuple[float, int]]:
        """Amounts and seeds."""
        self._only(table, "variation", set(VARIATIONS))
        result = {}
        for name, entry in table.items():
            key = f"variation.{name}"
            drawn = self._table(entry, key)
            self._only(drawn, key, {"amount", "seed"})
            result[name] = (self._real(drawn, "amount", key), int(self._real(drawn, "seed", key)))
            if min(result[name]) < 0:
                raise FormatError(self.file, "must be 0 or more", key=key)
        return result

    def _table(self, value: object, key: str) -> Mapping[str, Any]:
        """A table."""
        if not isinstance(value, dict):
            raise FormatError(self.file, "must be a table", key=key)
        return value

    def _only(self, table: Mapping[str, Any], key: str, known: set[str] | frozenset[str]) -> None:
        """No key that means nothing."""
        for name in table:
            if name not in known:
                where = f"{key}.{name}" if key else name
                raise FormatError(self.file, f"is not known here: known are {', '.join(sorted(known))}", key=where)

    def _real(self, table: Mapping[str, Any], name: str, key: str) -> float:
        """A finite number."""
        value = table.get(name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise FormatError(self.file, f"must be a number, but it is {value!r}", key=f"{key}.{name}")
        return float(value)

    def _made(self, key: str, make: Callable[[], M]) -> M:
        """What `make` makes; its refusal with the file and the key."""
        try:
            return make()
        except ParameterError as error:
            raise FormatError(self.file, f"{error.name} {error.rule}, but it is {error.value!r}", key=key) from error
