"""The tables of docs/recordings.md, between its marks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from places import DOCS
from risorius.arrays import Floats
from risorius.mpeg4 import FAP_COUNT, FAPS

from .played import SHUT, Played
from .takes import Take

PAGE = DOCS / "recordings.md"
START, END = "<!-- measured: {} -->", "<!-- end of {} -->"

#: FAPs of visemes and expressions, which no tracker states; others that a recording lacks are listed by name.
STANDS_ASIDE = (1, 2)


#: What a recording is played with -> seconds (68,) by which the default head follows it.
Lateness = Mapping[str, Floats]


def write_tables(takes: Sequence[Take], played: Mapping[str, Sequence[Played]], late: Mapping[str, Lateness]) -> None:
    """Write what was measured into the page."""
    text = PAGE.read_text(encoding="utf-8")
    for name, lines in (
        ("recordings", _recordings(takes, played)),
        ("faps", _faps(takes, played)),
        ("lateness", _lateness(takes, late)),
        ("silence", _silence(takes)),
    ):
        start, end = START.format(name), END.format(name)
        before, rest = text.split(start)
        _, after = rest.split(end)
        text = before + "\n".join([start, "", *lines, "", end]) + after
    PAGE.write_text(text, encoding="utf-8")


def _recordings(takes: Sequence[Take], played: Mapping[str, Sequence[Played]]) -> list[str]:
    """A row per recording and head."""
    rows = [
        f"| recording | head | FAPs moved | correlation | slope | left open where the blink is {SHUT:g} or more "
        "| late, ms | trembling of a still face | step at a missing frame | off between posed frames, mm |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for take in takes:
        for figures in played[take.title]:
            lids = "no blink" if np.isnan(figures.open_lids[0]) else _percent(figures.open_lids)
            jump = f"{100 * figures.jump:.1f} %" if take.unknown.any() else "none missing"
            rows.append(
                f"| {take.title}, {len(take.frames)} frames | {figures.head} | {np.isfinite(figures.slope).sum()} "
                f"| {np.nanmedian(figures.correlation):.3f} | {np.nanmedian(figures.slope):.2f} | {lids} "
                f"| {_milliseconds(figures.late)} "
                f"| {figures.trembling:.2f} | {jump} | {1e3 * figures.off[0]:.2f}, at most {1e3 * figures.off[1]:.1f} |"
            )
    return rows


def _milliseconds(late: Floats) -> str:
    """The median over the FAPs, and the largest."""
    usual, most = 1e3 * np.nanmedian(late), 1e3 * late[np.nanargmax(np.abs(np.nan_to_num(late)))]
    return f"{_rounded(usual)}, at most {_rounded(most)}"


def _rounded(value: float) -> str:
    """A whole number; no negative 0."""
    return str(round(value))


def _lateness(takes: Sequence[Take], late: Mapping[str, Lateness]) -> list[str]:
    """A row per FAP, or pair of sides, and one of all: milliseconds, as it is played and with inertia."""
    columns = {f"{take.title}: {how}": seconds for take in takes for how, seconds in late[take.title].items()}
    rows = [f"| FAP | {' | '.join(columns)} |", "|---|" + "---|" * len(columns)]
    rows.append(f"| all: median, largest | {' | '.join(map(_milliseconds, columns.values()))} |")
    for pair in _pairs():
        each = [seconds[np.array(pair) - 1] for seconds in columns.values()]
        if any(np.isfinite(seconds).any() for seconds in each):
            cells = [_rounded(1e3 * np.nanmean(s)) if np.isfinite(s).any() else "-" for s in each]
            rows.append(f"| {_name_of(pair)} | {' | '.join(cells)} |")
    return rows


def _pairs() -> list[list[int]]:
    """Numbers of the low-level FAPs, those of two sides together."""
    mirrors = {number: FAPS[number].mirror or number for number in range(3, FAP_COUNT + 1)}
    return [sorted({number, mirror}) for number, mirror in mirrors.items() if mirror >= number]


def _name_of(pair: Sequence[int]) -> str:
    """A FAP, or both sides of one, by number and name."""
    name = FAPS[pair[0]].name.replace("_l_", "_l/r_") if len(pair) > 1 else FAPS[pair[0]].name
    return f"{', '.join(map(str, pair))} {name}"


def _percent(shares: Floats) -> str:
    """Median and largest share; lids that lie on each other are not open."""
    median, most = (max(0.0, 100.0 * share) for share in shares.tolist())
    return f"{median:.0f} %, at most {most:.0f} %"


def _faps(takes: Sequence[Take], played: Mapping[str, Sequence[Played]]) -> list[str]:
    """A row per FAP, or pair of sides: correlation and slope on each head."""
    heads = [f"{take.title}: {figures.head}" for take in takes for figures in played[take.title]]
    rows = [f"| FAP | {' | '.join(heads)} |", "|---|" + "---|" * len(heads)]
    every = [figures for take in takes for figures in played[take.title]]
    for pair in _pairs():
        cells = [_fit(figures, pair) for figures in every]
        if any(cells):
            rows.append(f"| {_name_of(pair)} | {' | '.join(cell or '-' for cell in cells)} |")
    return rows


def _fit(figures: Played, pair: Sequence[int]) -> str:
    """Correlation and slope of a FAP or of the worse one of a pair; empty where the recording does not move it."""
    columns = [number - 1 for number in pair if np.isfinite(figures.slope[number - 1])]
    if not columns:
        return ""
    worst = min(columns, key=lambda column: figures.correlation[column])
    return f"{figures.correlation[worst]:.3f} × {figures.slope[worst]:.2f}"


def _silence(takes: Sequence[Take]) -> list[str]:
    """What each format has no word for."""
    lines = []
    for take in takes:
        silent = np.flatnonzero(np.isnan(take.recording.stream.frames).all(axis=0)) + 1
        names = [f"{FAPS[int(number)].name} ({number})" for number in silent if number not in STANDS_ASIDE]
        lines.append(f"- **{take.title}** states {FAP_COUNT - len(silent)} FAPs. Silent: {', '.join(names)}.")
    return lines
