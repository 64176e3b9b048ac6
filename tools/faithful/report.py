"""The figures as a page of Markdown tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .baselines import ZONE_RADIUS
from .figures import Requests

Explained = Mapping[str, float]

#: A shape falls by at least this much to be named in the table of mechanisms.
FALL = 0.01

PICTURES = """## Pictures

The command writes contact sheets to `out/faithful/`. HEAD-emotions.png and HEAD-words.png show the six emotions and the
fourteen words of the first paper's Table 6 at their apex, in front and three-quarter view, with the natural drive.
HEAD-scans-1.png and so on show the expressions beside the result of the exact drive, and the distance between both in
colour.
"""

HEADING = f"""# How faithful the faces are

Written by `make bench-faithful ARGS="--page docs/faithful.md"` (`tools/bench_faithful.py`); do not edit.

**Explained variance**: the FAPs of an expression are measured, the neutral face is posed from these alone (exact
drive), and 1 − Σ|posed − expression|² / Σ|expression|² over the skin is the share that is reproduced. The expressions
are the scanned shapes of the ICT FaceKit that FAPs can describe, one of each mirrored pair. Other identities use the
same motions. The muscle table was calibrated on these same shapes, so new actions are reproduced less well
([muscles](muscles.md)).

For comparison, the last columns show methods that use feature points only. *zones*: raised-cosine zones of
{ZONE_RADIUS * 1e3:.0f} mm round each point with shared overlaps, as in players of FAP streams. *spline*: the
biharmonic (thin-plate) spline through all points; points without FAP stay at rest. *points*: this skin without
muscles, jaw and lids (`drive="points"`).
"""


@dataclass(frozen=True)
class Results:
    """All that was measured; what was not is empty. Explained variances are by shape."""

    scans: Mapping[str, Explained]
    baselines: Mapping[str, Explained]
    drives: Mapping[str, Explained]
    without: Mapping[str, Explained]
    drawings: Explained
    requests: Mapping[str, Requests]


def page(results: Results) -> str:
    """The whole page."""
    parts = [HEADING]
    if results.scans:
        parts.append("## Per shape and head\n\n" + _per_shape({**results.scans, **results.baselines}))
    if results.without:
        parts.append(_mechanisms(results))
    if results.drawings:
        parts.append(_drawings(results.drawings))
    if results.requests:
        parts.append(_requests(results.requests))
    return "\n".join([*parts, PICTURES])


def summary(explained: Explained) -> tuple[float, float, float]:
    """Median, mean and least."""
    values = np.array(list(explained.values()))
    return float(np.median(values)), float(values.mean()), float(values.min())


def _number(value: float, decimals: int = 2) -> str:
    """A figure with a proper minus sign."""
    return f"{value:.{decimals}f}".replace("-", "−")


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _per_shape(columns: Mapping[str, Explained]) -> str:
    """One row per shape, one column per head or way of moving it."""
    shapes = list(next(iter(columns.values())))
    rows = [[shape, *(_number(explained[shape]) for explained in columns.values())] for shape in shapes]
    for place, name in enumerate(("median", "mean", "least")):
        rows.append([f"**{name}**", *(_number(summary(explained)[place], 3) for explained in columns.values())])
    return table(["", *(name.replace("identity-", "id ") for name in columns)], rows)


def _mechanisms(results: Results) -> str:
    """One row per mechanism left out, nothing refitted."""
    whole = results.scans["ict"]
    rows = []
    for name, explained in {"nothing": whole, **results.without, **results.drives}.items():
        median, mean, least = summary(explained)
        changes = sorted((explained[shape] - whole[shape], shape) for shape in whole)
        falls = ", ".join(f"{shape} {_number(change)}" for change, shape in changes[:3] if change <= -FALL)
        rows.append([name, _number(median, 3), _number(mean, 3), _number(least), falls])
    introduction = "## Per mechanism left out\n\nOn the scanned head. The other mechanisms are not fitted again.\n\n"
    return introduction + table(["left out", "median", "mean", "least", "falls most"], rows)


def _drawings(explained: Explained) -> str:
    """MakeHuman's face units."""
    median, mean, _ = summary(explained)
    rows = [[name, _number(value)] for name, value in explained.items()]
    introduction = (
        "## MakeHuman's face units\n\nThese are drawn by hand and lack the motion of neighbouring parts that scans show"
        " (lids, inner brow). So they\ncheck transfer to another head, not correctness. One of each mirrored pair, if"
        " it moves a feature point.\n"
        f"Median {median:.3f}, mean {mean:.3f}.\n\n"
    )
    return introduction + table(["unit", "explained"], rows)


def _requests(requests: Mapping[str, Requests]) -> str:
    """Exact and natural errors per head."""
    kinds = list(next(iter(requests.values())).natural)
    exact = [[head, *(f"{100 * share:.2f} %" for share in found.exact)] for head, found in requests.items()]
    natural = [
        [head, *(f"{100 * found.natural[kind][0]:.0f} %, {100 * found.natural[kind][1]:.0f} %" for kind in kinds)]
        for head, found in requests.items()
    ]
    return (
        "## Requests\n\nErrors are shares of the request, or of 100 units if the request is smaller. Exact drive,"
        " the 25 profiles of Table 5:\n\n"
        + table(["head", "median", "95 %", "largest"], exact)
        + "\nNatural drive, the 25"
        " profiles of Table 5 and the fourteen words of Table 6 (with known emotion): median error, and the\nshare of"
        " requests met within 10 %. *In the range*: inside the FAP's anatomical range (`ranges.csv`). *In its\n"
        "unchanged part*: where requests pass unchanged.\n\n" + table(["head", *kinds], natural)
    )
