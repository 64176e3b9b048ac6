"""docs/performance.md and its picture, from the figures in out/bench.

Needs matplotlib, which the Pythons that have bpy may lack: `.venv/bin/python tools/bench_speed.py page`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from places import DOCS, OUT

from .growth import EACH, ONCE

PAGE, PICTURE = DOCS / "performance.md", DOCS / "pictures" / "performance.png"
LAID_OVER = DOCS / "pictures" / "laid_over.jpg"

HEADING = """# How fast, and how it grows

Written by `make bench`. All figures are processor time on one core of the machine on which it ran last, which others
used at the same time: **ratios count, milliseconds are a hint**. Blender's own solvers ran in the same process as the
head beside them, with their default settings (cloth: quality 5), each vertex of the same outer skin held half.
"""

MOTION = """## A motion of four overlapping emotions

Ten seconds of joy, anger, surprise and sadness at 25 frames per second, with all that surrounds the skin: what is once
for the clip is shared out among its frames. *× cloth*: how many times as long Blender's cloth takes for a frame of the
skin alone; *per vertex*: with each divided by its own vertices. *XPBD*: Blender's experimental cloth on its XPBD solver
node. The error is that of the same four emotions in less than two seconds, against the implicit integrator with eight
steps per frame, as a share of the largest motion: at the worst vertex and frame, and in the mean square of the worst
frame. Below 1,000 vertices most of the time goes to skin that is split finer to be solved; `jeeliz_boy` is a cartoon's
head, whose skin is, too.
"""

GOALS = """### What is reached, and what is not

Twenty times as fast as cloth was the goal. Counted by all vertices of a mesh it is reached on the heads of which much
is not outer skin, and by the frame on none. What is left is spread: equilibria and preparation of a clip take a
third, contact, correction, folds, inner skin, hair and lashes, and compression share the rest.

Ten seconds on `ict`, compression into keys included, are baked in less than 5.5 seconds (the goal was 6); the version
before took 6.4 to 6.8 within the same hour. A clip takes 25 equilibria instead of 38, what is held is settled once, and
keys are looked for among the vertices that tell. 62 seconds of talk took 27 before that (the goal was 40).

Lips that press on each other and part again lose speed to one another. With that in the fields in which skin is left
behind, the exact drive is within 1 % of the reference, too: 0.79 % instead of 2.0 % on the default head, 0.69 % instead
of 2.4 % on `makehuman`, 0.61 % on `ict`. The two coarsest meshes have 20 fields of the balance instead of 12: exactly
driven, `mediapipe` is off by 0.69 % and `suzanne` by 0.96 %. Denser heads do not need them (`ict` would take half a
second more for ten seconds of film).
"""

FILMS = """## Films laid over one another

![Before, after, and eight times their difference](pictures/laid_over.jpg)

The same four emotions, by eight implicit steps of every node per frame (above) and as faces move now (middle);
below, eight times the difference of the pictures, dark where they differ. *Pixel*: the largest difference of any
pixel in any frame, of 255; a silhouette or an edge of a tooth that is off by a fraction of a pixel is enough for that,
so the share of pixels that differ by more than 8 stands beside it. *Flicker*: how much the pictures change from frame
to frame, in the mean, of 255, before and now. *Jolts*: the mean second difference of the vertices over time, alike.
"""

PHASES = """## Phases

Processor time of each phase, and how near it is to what this machine's memory can do (a triad of three arrays of 160
MB). A frame must at least read what it is made of and write what it is; its share of the bandwidth is those bytes over
its time. What is far below has work to do in the processor, not in memory. The live preview is of the first
updates of a drag.
"""

GROWTH = """## From 1,000 to 500,000 vertices

![Time against size](pictures/performance.png)

The default head, thinned out or split to every size. *Solved* are the nodes of the skin that is solved: only skin that
can move, and above 20,000 of its vertices a coarser skin, whose motion the others carry with their detail. *Grows* is
the slope of a straight line through the logarithms of the three largest sizes, where what is constant no longer
flatters: 1 is in proportion to the vertices. *Longest step* is the longest time at the largest size between two
moments at which a window draws its progress and sees Esc. The goals were n^1.1 for what comes with every frame, n^1.3
for what comes once, 6 GB and half a second. Steps that are longer are mostly single calls that cannot be split
(shortest ways along the skin, numbering edges), and the answers that a motion's basis is made of. Compression takes
more than its share at the largest size: its arrays are then larger than what a process keeps, and their memory comes
anew from the system. With the motion that comes before it, a frame grows by n^1.0.
"""

FIRST = """## The first pose

Processor time of a head's first pose: *new*, from its mesh and feature points on with nothing worked out before (the
goals were 1 s at 9,000 vertices and 2.5 s at 26,000); *kept*, the same face out of the user's cache folder, as when a
file is opened again (the goal was 0.3 s): until Blender shows it, as a sketch out of balances that are kept with it,
and how long the pose in balance takes that follows, for which its factors are worked out again. Each in a process of
its own; what Python loads is not counted. The goals of new heads are not reached, and that of kept ones on the default
head alone. Of a new head solving takes most: on `ict` the answers to muscles and FAPs alone take a second, five
factorisations half of one, and samples of teeth and eyeballs 0.3 s. Of a kept one reading takes all: its file, 107 MB
on `ict`, has a digest that is checked.
"""

DRAGS = """## A drag

Processor time from a changed choice to the mesh that Blender draws, with a look at whether the face is still the same:
the median of a drag of {steps} updates, and what 95 % of them stay below. The goals were 8 ms on the default head and
15 ms on `ict`. In passing, the skin's answer is foretold from balances that were found before, wherever that is within
0.2 mm by its own estimate: drags with a word, on the wheel, with a FAP and with muscles were 0.21 mm off at the worst
vertex, 0.03 mm in the median, and the pose at rest is exact. An update in which it has to be solved takes 15 to 40 ms
more. In one run with the version before, which solved wherever it doubted by 0.05 mm and read the whole mesh each time,
drags took 17 to 31 % less on the default head and 23 to 30 % less on `ict`. The goals are not reached. What is left is
spread: on the default head the plan and the search for the muscles take 2.4 ms, contact 2, the turns of the brows'
roots 1.5, Blender's own update of the mesh 0.5, and two dozen steps the rest.
"""

XPBD = """### Beside XPBD

Blender's experimental cloth on its XPBD solver node, which Blender 4.5 lacks, with a frame of the same ten seconds and
its older cloth in the same process of Blender {version}.
"""

THINNING = """### What the coarser skin changes

Poses of the default head with {vertices:,} vertices, solved on {coarse:,} nodes as a denser head would be, against
those solved on all {whole:,}, as shares of the largest displacement. Most of what is left is
between the nodes, where the cheek folds. On the same head with 122,209 vertices, 18,679 of whose 76,423 nodes are
solved, joy, surprise and anger are off by 7.1, 3.8 and 5.3 % at the worst vertex and 0.4, 0.3 and 0.4 % rms, measured
once; with springs along the sides of the coarser triangles, which do not stand for those of all vertices, it was 11.8,
8.7 and 12.4 %, and 1.0 to 1.1 % rms. One per cent at the worst vertex is not reached.
"""

FILES = """## Smaller results

Six emotions one after another (`risorius bake joy surprise fear anger sadness disgust --dynamic`, `risorius export
gltf`), every vertex of every frame within 0.1 mm. *Before*: a plain singular value decomposition, and keys with traces
of motion all over the head.

| | default head, before | now | ict, before | now |
| --- | ---: | ---: | ---: | ---: |
| shape keys | 23 | 17 | 29 | 21 |
| .blend, MB | 2.1 | 1.5 | 5.5 | 3.7 |
| .glb, MB | 7.0 | 4.9 | 17.6 | 11.3 |
| .glb without normals, MB | 3.4 | 2.1 | 8.3 | 4.6 |

With `--max-keys` the same motion has [fewer keys and a larger error](timeline.md#how-many-shape-keys).
"""


def drag_table(heads: Sequence[dict[str, Any]]) -> str:
    """A row for each head, a column for each drag."""
    kinds = list(heads[0]["drags"])
    rows = [
        [
            row["head"],
            f"{row['vertices']:,}",
            *(f"{row['drags'][kind]['median']:.1f}, {row['drags'][kind]['most']:.1f} ms" for kind in kinds),
        ]
        for row in heads
    ]
    return table(("head", "vertices", *kinds), rows)


def first_table(heads: Sequence[dict[str, Any]]) -> str:
    """A row for each head."""
    parts = ("read", "prepare", "pose")
    rows = []
    for row in heads:
        new, kept = sum(row[part] for part in parts), row["kept_read"] + row["kept_sketch"]
        figures = [*(row[part] for part in parts), new, kept, row["kept_pose"]]
        rows.append([row["head"].removesuffix(".npz"), f"{row['vertices']:,}", *(f"{each:.2f} s" for each in figures)])
    return table(
        ("head", "vertices", "read the mesh", "prepare", "pose", "new, in sum", "kept, shown", "its pose"), rows
    )


def xpbd_table(heads: Sequence[dict[str, Any]]) -> str:
    """A row for each head, or why there are none."""
    rows = []
    for row in heads:
        blender, own = row["blender"], row["seconds_per_frame"]
        told = blender["XPBD cloth"]
        node = told if isinstance(told, str) else f"{ms(told)} ms"
        figures = [f"{ms(own)} ms", f"{ms(blender['cloth'])} ms", node]
        rows.append([row["head"].removesuffix(".npz"), *figures, times(blender["cloth"], own), times(told, own)])
    return table(("head", "a frame here", "cloth", "XPBD", "× cloth", "× XPBD"), rows)


def thinning_table(found: dict[str, Any]) -> str:
    """A row for each emotion."""
    rows = [[word, *(f"{100 * share:.1f} %" for share in off.values())] for word, off in found["words"].items()]
    return table(("emotion", "worst vertex", "99 % of vertices within", "rms"), rows)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table of Markdown, numbers to the right."""
    lines = [list(head), ["---", *["---:"] * (len(head) - 1)], *map(list, rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def ms(seconds: float) -> str:
    """Milliseconds with two digits that count."""
    figure = 1e3 * seconds
    return f"{figure:,.0f}" if figure >= 10.0 else f"{figure:.1f}"


def films_table(films: dict[str, dict[str, float]]) -> str:
    """A row for each head."""
    titles = ("head", "vertex at most, mm", "pixel at most", "pixels over 8", "flicker", "jolts, mm")
    rows = [
        [
            name,
            f"{row['vertex_mm']:.2f}",
            f"{row['pixel']:.0f}",
            f"{100 * row['pixels_seen']:.2f} %",
            f"{row['flicker_before']:.3f}, {row['flicker_after']:.3f}",
            f"{row['jolt_before_mm']:.4f}, {row['jolt_after_mm']:.4f}",
        ]
        for name, row in films.items()
    ]
    return table(titles, rows)


def times(seconds: object, own: float) -> str:
    """How many times as long, or nothing."""
    return f"{seconds / own:.1f}" if isinstance(seconds, float) else "-"


def motion_table(heads: Sequence[dict[str, Any]]) -> str:
    """A row for each head."""
    rows = []
    for row in heads:
        own, blender, error = row["seconds_per_frame"], row["blender"], row["error"]
        share = row["vertices"] / blender["vertices"]
        rows.append(
            [
                row["head"].removesuffix(".npz").removesuffix(".obj"),
                f"{row['vertices']:,}",
                ms(own),
                times(blender["cloth"], own),
                times(blender["cloth"] * share, own),
                times(blender["soft body"], own),
                times(blender["XPBD cloth"], own),
                f"{100 * error['worst']:.2f} %",
                f"{100 * error['rms']:.2f} %",
            ]
        )
    titles = ("head", "vertices", "ms per frame", "× cloth", "per vertex", "× soft body", "× XPBD")
    return table((*titles, "error, worst", "rms"), rows)


def why_not(heads: Sequence[dict[str, Any]]) -> str:
    """Why solvers of Blender's were not measured, and in which Blender the others were."""
    versions = sorted({row["blender"]["version"] for row in heads})
    reasons = {f"{key}: {value}." for row in heads for key, value in row["blender"].items() if isinstance(value, str)}
    told = sorted(reason for reason in reasons if not reason.startswith("version"))
    return "\n".join([f"Measured in Blender {', '.join(versions)}.", *told]) + "\n"


def phase_table(heads: Sequence[dict[str, Any]]) -> str:
    """A row for each phase, of the default head and of the largest."""
    chosen = [heads[0], max(heads, key=lambda row: float(row["vertices"]))]
    rows = []
    for name in heads[0]["phases"]:
        line = [name]
        for row in chosen:
            seconds, moved = row["phases"][name]["seconds"], row["bytes"].get(name)
            line += [ms(seconds), "-" if moved is None else f"{100 * moved / seconds / row['bandwidth']:.1f} %"]
        rows.append(line)
    names = [row["head"].removesuffix(".npz") for row in chosen]
    titles = [f"{name}, {what}" for name in names for what in ("ms", "of bandwidth")]
    return table(("phase", *titles), rows) + f"\nThe memory of this machine: {heads[0]['bandwidth'] / 1e9:.0f} GB/s.\n"


def growth_table(sizes: Sequence[dict[str, Any]], powers: dict[str, dict[str, float]]) -> str:
    """A row for each phase, a column for each size."""
    rows = [["solved", *(f"{row['solved']:,}" for row in sizes), "", ""]]
    for name in sizes[0]["phases"]:
        phases = [row["phases"][name] for row in sizes]
        grown, last = f"n^{powers[name]['seconds']:.2f}", f"{phases[-1]['longest']:.1f} s"
        rows.append([f"{name}, ms", *(ms(phase["seconds"]) for phase in phases), grown, last])
    peaks = [max(phase["memory"] for phase in row["phases"].values()) for row in sizes]
    rows.append(["memory at most, MB", *(f"{peak:,.0f}" for peak in peaks), "", ""])
    return table(("vertices", *(f"{row['vertices']:,}" for row in sizes), "grows", "longest step"), rows)


def draw(sizes: Sequence[dict[str, Any]], path: Path) -> None:
    """Time against size, both on scales of powers."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 3.8), layout="constrained")
    counts = [row["vertices"] for row in sizes]
    titles = ("once, seconds", "each frame, seconds")
    for axes, names, title in zip(figure.subplots(1, 2), (ONCE, EACH), titles, strict=True):
        for name in names:
            axes.plot(counts, [row["phases"][name]["seconds"] for row in sizes], "o-", label=name, markersize=3)
        axes.set(xscale="log", yscale="log", xlabel="vertices", title=title)
        axes.grid(visible=True, which="major", alpha=0.3)
        axes.legend(fontsize=8)
    figure.savefig(path, dpi=90)


def lay_out(rows: Sequence[Path], path: Path) -> None:
    """The pictures of films, one head below the other."""
    from matplotlib.image import imsave

    imsave(path, np.concatenate([np.load(each) for each in rows]))


def main(argv: list[str]) -> None:
    """Write the page from what `growth`, `motion`, `films` and `first` wrote last, and `motion` in a newer Blender."""
    parser = argparse.ArgumentParser(prog="bench_speed.py page", description=__doc__)
    parser.add_argument("--figures", type=Path, default=OUT / "bench", help="the folder that those wrote to")
    folder = parser.parse_args(argv).figures
    heads = json.loads((folder / "motion.json").read_text())["heads"]
    growth = json.loads((folder / "growth.json").read_text())
    draw(growth["sizes"], PICTURE)
    films = json.loads((folder / "films.json").read_text())
    lay_out([folder / f"films_{name}.npy" for name in films], LAID_OVER)
    parts = [HEADING, MOTION, motion_table(heads), why_not(heads), GOALS, FILMS, films_table(films)]
    if (folder / "xpbd.json").is_file():
        newer = json.loads((folder / "xpbd.json").read_text())["heads"]
        parts[4:4] = [XPBD.format(version=newer[0]["blender"]["version"]), xpbd_table(newer)]
    drags = json.loads((folder / "preview.json").read_text())
    parts += [PHASES, phase_table(heads), DRAGS.format(steps=drags[0]["steps"]), drag_table(drags)]
    parts += [FIRST, first_table(json.loads((folder / "first.json").read_text())), GROWTH]
    parts += [growth_table(growth["sizes"], growth["exponents"]), THINNING.format(**growth["thinning"])]
    parts += [thinning_table(growth["thinning"]), FILES]
    PAGE.write_text("\n".join(parts))
    print(f"wrote {PAGE}, {PICTURE} and {LAID_OVER}")
