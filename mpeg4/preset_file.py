"""Expressions and whole timelines as preset files (TOML): words or points of the wheel, times, contractions.

A preset says what is meant and holds no vertices, so it fits every face. The format is described in docs/formats.md.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field
from enum import StrEnum
from pathlib import Path

from ..errors import ParameterError
from ..files import write_whole
from ..tables import TomlTable, read_toml, toml_number, toml_text
from .emotions.expressions import expression, find_word
from .emotions.profile import Profile
from .preset_speech import KeptSpeech, read_speech, speech_lines
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
    variant: int | str | None = None
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
            raise ParameterError("peak", "must be in 0..1", self.peak)


@dataclass(frozen=True)
class Preset:
    """What a preset file holds.

    Attributes
    ----------
    kind : of what it is. emotion : of an expression. clips, speech : of a timeline, at least one.
    contractions : muscle name -> 0..1, set by hand. variation : name of `VARIATIONS` -> amount and seed.
    """

    kind: PresetKind
    emotion: Choice | None = None
    clips: tuple[Clip, ...] = ()
    contractions: Mapping[str, float] = field(default_factory=dict)
    variation: Mapping[str, tuple[float, int]] = field(default_factory=dict)
    speech: tuple[KeptSpeech, ...] = ()

    def __post_init__(self) -> None:
        """Check that it holds what its kind says."""
        if self.kind is PresetKind.EXPRESSION and self.emotion is None:
            raise ParameterError("preset", "must contain an emotion", self.kind)
        if self.kind is PresetKind.TIMELINE and not (self.clips or self.speech):
            raise ParameterError("preset", "must contain at least one clip or speech", str(self.kind))
        for name, value in self.contractions.items():
            if not 0.0 <= value <= 1.0:
                raise ParameterError(f"contraction of {name}", "must be in 0..1", value)


def write_preset(path: str | Path, preset: Preset) -> None:
    """Write a preset file.

    Raises
    ------
    FormatError : it cannot be written.
    """
    lines = [f"risorius = {toml_text(preset.kind.value)}"]
    if preset.emotion is not None:
        lines += ["", "[emotion]", *_choice_lines(preset.emotion)]
    for clip in preset.clips:
        lines += ["", "[[clips]]", *([f"name = {toml_text(clip.name)}"] if clip.name else [])]
        lines += _choice_lines(clip.emotion)
        lines += [f"{key} = {toml_number(getattr(clip, key))}" for key in ("start", "onset", "apex", "offset", "peak")]
        lines += [f"ramp = {toml_text(clip.ramp.value)}", *(["mute = true"] if clip.mute else [])]
    for speech in preset.speech:
        lines += speech_lines(speech)
    if preset.variation:
        lines += ["", "[variation]"]
        lines += [
            f"{name} = {{ amount = {toml_number(amount)}, seed = {seed} }}"
            for name, (amount, seed) in preset.variation.items()
        ]
    if preset.contractions:
        lines += ["", "[contractions]"]
        lines += [f"{toml_text(name)} = {toml_number(value)}" for name, value in preset.contractions.items()]
    write_whole(path, "\n".join(lines) + "\n")


def _choice_lines(choice: Choice) -> list[str]:
    """An emotion's own keys."""
    by_word = choice.angle is None
    lines = [f"word = {toml_text(choice.word or '')}" if by_word else f"angle = {toml_number(choice.angle or 0.0)}"]
    lines += [f"activation = {toml_number(choice.activation)}"]
    variant = toml_text(choice.variant) if isinstance(choice.variant, str) else choice.variant
    lines += [f"variant = {variant}"] if variant is not None else []
    return lines + ([f"seed = {choice.seed}"] if choice.seed else [])


def read_preset(path: str | Path) -> Preset:
    """Read a preset file.

    Raises
    ------
    FormatError : names the file, the key and the rule it breaks.
    """
    document = read_toml(path)
    if document.cells.get("risorius") not in list(PresetKind):
        kinds = " or ".join(f'"{kind}"' for kind in PresetKind)
        raise document.refuse(f"is not a Risorius preset: it must say risorius = {kinds}", "risorius")
    kind = PresetKind(document.text("risorius"))
    held = ("emotion",) if kind is PresetKind.EXPRESSION else ("clips", "speech")
    document.only("risorius", *held, "contractions", "variation")
    emotion = _choice(document.table("emotion")) if kind is PresetKind.EXPRESSION else None
    clips = () if kind is PresetKind.EXPRESSION else tuple(_clip(table) for table in document.listed("clips"))
    contractions = document.table("contractions", optional=True)
    strengths = {name: contractions.number(name, least=0.0, most=1.0) for name in contractions}
    variation = _variation(document.table("variation", optional=True))
    speech = () if kind is PresetKind.EXPRESSION else tuple(read_speech(table) for table in document.listed("speech"))
    return document.made(lambda: Preset(kind, emotion, clips, strengths, variation, speech))


#: Keys of an emotion, and of a clip besides.
EMOTION_KEYS = ("word", "angle", "activation", "variant", "seed")
CLIP_KEYS = ("start", "onset", "apex", "offset", "peak", "ramp", "name", "mute")


def _variant(table: TomlTable) -> int | str:
    """A variant of the paper's by its number, or a way of showing an emotion by its name."""
    return table.text("variant") if isinstance(table.cells["variant"], str) else table.integer("variant")


def _choice(table: TomlTable, *others: str) -> Choice:
    """An emotion, in a table that may have other keys."""
    table.only(*EMOTION_KEYS, *others)
    return table.made(
        lambda: Choice(
            table.number("activation"),
            word=table.text("word") if "word" in table else None,
            angle=table.number("angle") if "angle" in table else None,
            variant=_variant(table) if "variant" in table else None,
            seed=table.integer("seed", 0),
        )
    )


def _clip(table: TomlTable) -> Clip:
    """One clip."""
    emotion = _choice(table, *CLIP_KEYS)
    start, onset, apex, offset = (table.number(key) for key in ("start", "onset", "apex", "offset"))
    peak, ramp = table.number("peak", 1.0), table.choice("ramp", Ramp, Ramp.MINIMUM_JERK)
    name, mute = table.text("name", ""), table.flag("mute", False)
    return table.made(lambda: Clip(emotion, start, onset, apex, offset, peak=peak, ramp=ramp, name=name, mute=mute))


def _variation(table: TomlTable) -> dict[str, tuple[float, int]]:
    """Amounts and seeds."""
    table.only(*VARIATIONS)
    drawn = {name: table.table(name) for name in table}
    for entry in drawn.values():
        entry.only("amount", "seed")
    return {name: (entry.number("amount", least=0.0), entry.integer("seed", least=0)) for name, entry in drawn.items()}
