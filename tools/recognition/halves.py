"""The robust rule on two halves of the evidence: the one that its constants were chosen on, and the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .poses import Measured
from .scans import shown

#: Faces, people and heads that the constants were chosen on; all others are the other half.
CHOSEN_ON = frozenset({"makehuman", "jeeliz_human", "ict identity 1", "ict identity 3", "ict identity 5"})

TEXT = """
### The constants of the robust rule

How much a face moves, how much motion that no profile asks for counts against a profile, and what still is rest were
chosen among 64 choices on one half of the faces, people and heads on this page (MakeHuman, one head of jeelizWeboji,
three identities), without the photographs and films. Those with less than 95 % of some posed emotion were left out. Of
the best three, which differ by .002 in the mean of the figures below, it is the one that keeps the feeling of a face
that speaks. Chosen on the other half, another choice would be .008 better there. Shapes of the same name are the same
on both halves, and anger with a shut mouth was worked out on all of these heads.

| half | posed, natural: right / least | scans | with every scan | heads by others, own neutral | guessed |
|---|---|---|---|---|---|
"""


def halves_section(
    natural: Measured, by_natural: np.ndarray, scans: Measured, by_scans: np.ndarray, seen: Sequence[Mapping[str, Any]]
) -> list[str]:
    """Lines of the page. `by_natural`, `by_scans`: verdicts of the robust rule, (n,)."""
    whole = np.isin(scans.variants, [index for index, each in enumerate(shown()) if not each.missing()])
    lines = [TEXT.rstrip("\n")]
    for name, inside in (("chosen on", True), ("the other", False)):
        posed = (np.isin(natural.faces, list(CHOSEN_ON))) == inside
        people = (np.isin(scans.faces, list(CHOSEN_ON))) == inside
        right = by_natural == natural.asked
        least = min(right[posed & (natural.asked == emotion)].mean() for emotion in np.unique(natural.asked))
        found = by_scans == scans.asked
        shares = [found[people].mean(), found[people & whole].mean()]
        shares += [_pictures(seen, neutral, inside=inside) for neutral in ("own", "guessed")]
        figures = " | ".join("–" if np.isnan(share) else f"{100.0 * share:.0f} %" for share in shares)
        lines.append(f"| {name} | {100.0 * right[posed].mean():.1f} / {100.0 * least:.1f} | {figures} |")
    return lines


def _pictures(seen: Sequence[Mapping[str, Any]], neutral: str, *, inside: bool) -> float:
    """The share of renders of one half that the robust rule names rightly; NaN where there are none."""
    right = [
        each["robust"] == each["shows"]
        for each in seen
        if each["kind"] == "render"
        and each["neutral"] == neutral
        and (each["name"].split(",")[0] in CHOSEN_ON) == inside
    ]
    return float(np.mean(right)) if right else float("nan")
