"""The figures of docs/rigs.md, between their marks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from places import DOCS
from risorius.face.retarget.fights import OPPOSED

from .measuring import ON, Followed
from .take import FPS, Take

PAGE = DOCS / "rigs.md"
START, END = "<!-- measured: keys -->", "<!-- end of keys -->"

INTRODUCTION = """
Written by `make rigs` (`tools/rigs.py`); do not edit between the marks. *Plain* is bounded least squares over all outer
skin (`scipy.optimize.lsq_linear`), which nothing can beat there; *ours* is what Risorius keys.

- **explained**: share of the skin's motion in the muscles' own pose that the keys show.
- **FAPs**: how far all measurable FAPs, and those that the emotion asks for, are from the muscles' own; root mean
  square in millimetres on a life-size face.
- **asked**: how far the requested FAPs are from what the profile asks; root mean square in FAP units. The muscles' own
  pose does not meet all of it, either.
- **gaze**: the largest error of an eye, degrees.
- **on**: keys above {on}. **fights**: pairs of these that pull against each other (cosine below -{opposed}).
"""


def write_page(emotions: Sequence[Followed], takes: Sequence[Take]) -> None:
    """Write what was measured into the page; a part that was not measured stays as it is."""
    text = PAGE.read_text(encoding="utf-8") if PAGE.exists() else "# Keep your rig\n"
    if START not in text:
        text = f"{text.rstrip()}\n\n## Figures\n\n{START}\n{END}\n"
    before, rest = text.split(START)
    _, after = rest.split(END)
    lines = [INTRODUCTION.format(on=ON, opposed=OPPOSED), *_emotions(emotions), "", *_takes(takes)]
    PAGE.write_text("\n".join([before + START, *lines, "", END]) + after, encoding="utf-8")


def _emotions(rows: Sequence[Followed]) -> list[str]:
    """A row per head and emotion."""
    found = [
        "| keys | emotion | explained: plain, ours | FAPs, all: plain, ours | requested: plain, ours "
        "| asked: muscles, plain, ours | gaze: plain, ours | on: plain, ours | fights: plain, ours |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        plain, ours = row.plain, row.ours
        cells = [
            f"{plain.explained:.3f} {ours.explained:.3f}",
            f"{plain.every:.2f} {ours.every:.2f}",
            f"{plain.requested:.2f} {ours.requested:.2f}",
            f"{row.muscles:.0f} {plain.units:.0f} {ours.units:.0f}",
            "-" if np.isnan(plain.gaze) else f"{plain.gaze:.1f} {ours.gaze:.1f}",
            f"{plain.on} {ours.on}",
            f"{plain.fights} {ours.fights}",
        ]
        found.append(f"| {row.head} | {row.word} | {' | '.join(cells)} |")
    return found


def _takes(takes: Sequence[Take]) -> list[str]:
    """A paragraph and a table about the takes."""
    if not takes:
        return []
    rows = [
        f"A take: emotions one after another with blinks, small motions of head and eyes, {FPS:.0f} frames a second.",
        "*Bends* are second differences over time: root mean square and the largest, of the skin in micrometres; of",
        "the keys as a share of how much they move, beside the same of the take's skin. Seconds are of processor time.",
        "",
        "| keys | frames | muscles, s | relating, s | solving, s | explained: plain, ours | bends: take, ours "
        "| largest: take, ours | bends of keys: take, ours | fights per frame: plain, ours |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    rows += [
        f"| {take.head} | {take.frames} | {take.muscles:.0f} | {take.seeing:.1f} | {take.solving:.1f} "
        f"| {take.plain:.3f} {take.explained:.3f} | {take.own_bends:.1f} {take.bends:.1f} "
        f"| {take.own_jerks:.0f} {take.jerks:.0f} | {take.own_share:.4f} {take.share:.4f} "
        f"| {take.plain_fights:.1f} {take.fights:.1f} |"
        for take in takes
    ]
    return rows
