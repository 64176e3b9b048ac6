"""The text of docs/evidence.md from what was measured."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import risorius.api as api
from risorius.arrays import Bools, Floats
from risorius.mpeg4 import Rule

from .faces import FACES
from .halves import halves_section
from .poses import SHARES, Measured, Series
from .samples import Sample
from .scans import STRENGTHS, combinations, shown, units
from .seen_page import seen_section
from .shapes import CHOICES, Choice, Shape, best_of, held_out, own, score
from .verdicts import EMOTIONS, NOTHING, OTHERS, Way, all_verdicts, confusion, correct
from .words import kind, meanings, rankings

Table = list[str]

#: Profiles recognised less often than this are named.
NAMED_BELOW = 0.95

HEADING = """# How well emotions are recognised

Written by `make evidence` (`tools/evidence.py`); do not edit.

`api.recognise` turns FAPs into beliefs in the six archetypes by section 5 of the first paper: a membership per FAP,
their product per profile (8), the best variant of an emotion (9), the most believed emotion (11). This is the *paper*
rule. The *robust* rule takes the geometric mean over all FAPs that were measured: those that a profile does not ask for
count against it if they move, the more the less the face moves as a whole. It takes a profile at any strength, knows
anger with a shut mouth beside those of Table 5 (`presets/profiles_beside.csv`), and *neutral* is a verdict: the three
places of the face that moved most are still near rest. `api.recognise_features` uses only the 15 distances of Table 3.
One part of the paper's rule is ours: figure 6, the shape of the membership, is illegible in the paper, so it was chosen
on faces (below).

Figures are per cent of correct results among the six emotions; chance is 17 %. *Least* is the emotion with the lowest
figure.

**These figures are a round trip.** The faces are posed by Risorius from the same profiles that are then recognised, on
meshes without noise, and measured with known feature points against a known neutral face. The figures show how much of
a profile survives anatomy, not how well the emotions of people are recognised. The scans below are closer to that.
"""

POSED = """
## Posed faces

Each of the 25 profiles of Table 5 at {shares} of its archetype's own activation (limited to 1..7), with new draws
within its ranges on each of {faces} faces: the default head, ICT, MakeHuman and six identities
({counts}).
*Natural* and *exact* are the drives with the word known; *untold* is the natural drive with the FAPs only, without the
word.
"""

FEATURES = """
Features are distances only. On an anatomical face, fear moves the mouth corners apart and opens the eyes wide. Variant
2 of joy asks for the same distances and nothing else, so the open jaw and the raised brows of fear do not count against
it.
"""

SHAPES = """
## The shape of the membership

Triangle, trapezoid, normal curve and bell, with and without a flat top over the printed range. Each falls to 1/2 within
one width: the largest of half the range, a share of its centre, and a least width. {count} choices were compared on the
natural poses above.

![Shapes](pictures/evidence-shapes.png)

The widths of each shape were chosen on all these poses, with *least* as tie-breaker. Nothing was chosen on the scans.

*In use* is the normal curve with widths 1 and 80. It was chosen for the paper's rule. There, a wider bell is correct
slightly more often overall, but clearly less often for the worst emotion. The robust rule takes the same curve, so that
the memberships of both rules are the same.

| rule | shape | best share of the centre | least width | right | least | scans right |
|---|---|---|---|---|---|---|
"""

HELD_OUT = """
These figures are optimistic, because shape and widths were chosen on the poses that they are reported on. So in the
next table, shape and widths are chosen on one half and tested on the other: on other faces, or on other variants (even
and odd; all emotions remain as classes, but sadness and disgust have only an even variant). *Risorius* is the choice in
use, tested on that same half. It is not independent of it: it was chosen on other draws of the same profiles on the
same faces.

| rule | halves of | chosen | on that half | on the other half | Risorius, other half |
|---|---|---|---|---|---|
"""

WORDS = """
## Words

`api.recognise_words` (robust rule) on the natural poses of every word that has a profile, one draw on each face, among
all {count} words whose profiles differ. Words of one category are the same profile at different strengths; a face that
cannot show the strength shows the other word. *kind* counts the archetype, or the two archetypes, of the word only.

"""

SCANS = """
## Scanned expressions

Scanned shapes of one person (ICT FaceKit), transferred to that head and to six identities, combined into the action
units that FACS lists for each emotion, at {strengths} of full strength, {people} faces per combination. No scan shows
AU {missing}. Combinations with these action units are shown without them, so they are not what FACS lists.{unshown} AU
25 is a slightly open jaw here. AU 23 and 24 share a scan.

Sources: *FACS table* is Ekman and Friesen 1978 as quoted by mpr-online 4, 3; *EMFACS-like* is the list of open_dbm;
*prototype* is the Investigator's Guide as quoted in slides; *library* is Greta's facelibrary. The table gives the
correct results out of {people}, and the most frequent other result of the paper's and the robust rule.

The robust rule loses weak anger with an open mouth or a raised lip, of which the angers of Table 5 say nothing or
little: {anger} are right. Its smiles and sadnesses are right at half strength as at full.

| emotion | source | AUs | no scan for | {ways} | paper, other | robust, other |
|---|---|---|---|{dashes}|---|---|
"""

SAMPLES = """
## Sample streams

FAP files of other programs that are named after an emotion. They show their authors' idea of it, on other faces. The
table gives the result for the frame with the largest FAPs and for the mean belief over all frames, with that belief.
Masked FAPs are unknown; in the columns *at rest* they are 0.

![Beliefs over time](pictures/evidence-samples.png)

| file | FAPs | frame | named | rule | strongest frame | mean over time | strongest, at rest | mean, at rest |
|---|---|---|---|---|---|---|---|---|
"""


@dataclass(frozen=True)
class Figures:
    """All that the page is written from.

    Attributes
    ----------
    posed : natural, exact and untold poses of archetypes.
    words : poses of words.
    scans : combinations of scans; see `gather_scans`.
    samples : sample files.
    seen : pictures and films; empty where none were read.
    """

    posed: Mapping[Series, Measured]
    words: Measured
    scans: Measured
    samples: Sequence[Sample]
    seen: Sequence[Mapping[str, Any]] = ()


def page(figures: Figures) -> str:
    """docs/evidence.md."""
    said = {series: all_verdicts(measured) for series, measured in figures.posed.items()}
    natural, scans, robust = figures.posed[Series.NATURAL], figures.scans, Way.FAPS_ROBUST
    parts = [
        HEADING,
        *_posed(figures.posed, said),
        *_shapes(figures.posed[Series.NATURAL], figures.scans),
        *_words(figures.words),
        *_scans(figures.scans),
        *halves_section(natural, said[Series.NATURAL][robust], scans, all_verdicts(scans)[robust], figures.seen),
        *_neutral(),
        *seen_section(figures.seen),
        *_samples(figures.samples),
    ]
    return re.sub("\n{3,}", "\n\n", "\n".join(parts)) + "\n"


def percent(share: float) -> str:
    """A share as per cent; whole only where it is whole."""
    return f"{100.0 * share:.1f}".removesuffix(".0")


def _row(cells: Iterable[object]) -> str:
    """A row of a table."""
    return f"| {' | '.join(str(cell) for cell in cells)} |"


def _head(*names: object) -> Table:
    """The head of a table."""
    return [_row(names), "|" + "---|" * len(names)]


def _posed(posed: Mapping[Series, Measured], said: Mapping[Series, Mapping[Way, np.ndarray]]) -> Table:
    """Everything about posed archetypes."""
    counts = "; ".join(
        f"{each}: {len(measured.faps)} poses, {_draws(measured)} draws each" for each, measured in posed.items()
    )
    natural = posed[Series.NATURAL]
    lines = [
        POSED.format(shares=", ".join(f"{share:g}" for share in SHARES), faces=len(FACES), counts=counts),
        *_head("drive", *(f"{way}: right / least" for way in Way)),
    ]
    for series, measured in posed.items():
        pairs = [correct(measured.asked, said[series][way]) for way in Way]
        lines.append(_row([series, *(f"{percent(right)} / {percent(least)}" for right, least in pairs)]))
    lines += [FEATURES, "![Confusions](pictures/evidence-confusion.png)", ""]
    for way in (Way.FAPS_PAPER, Way.FAPS_ROBUST):
        lines += ["", f"Natural drive, {way} rule, per cent: rows are posed, columns are recognised.", ""]
        lines += _head("", *EMOTIONS, *OTHERS)
        shares = confusion(natural.asked, said[Series.NATURAL][way])
        lines += [_row([name, *map(percent, row)]) for name, row in zip(EMOTIONS, shares, strict=True)]
    lines += ["", "### By activation and by face, natural drive", "", *_head("", *Way)]
    for share in SHARES:
        lines.append(_by(f"activation × {share:g}", natural, said[Series.NATURAL], natural.shares == share))
    for name in np.unique(natural.faces):
        lines.append(_by(str(name), natural, said[Series.NATURAL], natural.faces == name))
    return [*lines, *_confused(posed, said)]


def _draws(measured: Measured) -> int:
    """How often each profile was drawn at each activation, on all faces together."""
    first = [column == column[0] for column in (measured.asked, measured.variants, measured.shares)]
    return int(np.logical_and.reduce(first).sum())


def _by(name: str, measured: Measured, said: Mapping[Way, np.ndarray], chosen: Bools) -> str:
    """A row of right verdicts on some poses."""
    return _row([name, *(percent(float((said[way] == measured.asked)[chosen].mean())) for way in Way)])


def _confused(posed: Mapping[Series, Measured], said: Mapping[Series, Mapping[Way, np.ndarray]]) -> Table:
    """Profiles that are often missed, and for what they are taken."""
    lines = ["", "### Confusions", ""]
    lines += [f"Profiles that are recognised in less than {percent(NAMED_BELOW)} % of the poses.", ""]
    lines += _head("drive", "rule", "profile", "right", "confused with")
    for series, measured in posed.items():
        for way in (Way.FAPS_PAPER, Way.FAPS_ROBUST):
            for name in EMOTIONS:
                for variant in np.unique(measured.variants[measured.asked == name]):
                    verdicts = said[series][way][(measured.asked == name) & (measured.variants == variant)]
                    right = float((verdicts == name).mean())
                    if right < NAMED_BELOW:
                        profile = f"{name} {variant}"
                        lines.append(_row([series, way.rule, profile, percent(right), _others(verdicts, name)]))
    return lines


def _others(verdicts: np.ndarray, name: str, most: int = 2) -> str:
    """The commonest wrong verdicts with their shares in per cent."""
    wrong = Counter(verdicts[verdicts != name].tolist()).most_common(most)
    return ", ".join(f"{other} {100.0 * count / len(verdicts):.0f} %" for other, count in wrong) or "–"


def _shapes(natural: Measured, scans: Measured) -> Table:
    """Shapes and widths, picked on everything and on halves."""
    lines = [SHAPES.format(count=len(CHOICES)).rstrip("\n")]
    for shape in Shape:
        choice, found = best_of(natural, [each for each in CHOICES if each.shape is shape])
        lines.append(_choice(choice, found, scans, ""))
    lines += [_choice(own(rule), score(natural, own(rule)), scans, " (in use)") for rule in Rule]
    lines.append(HELD_OUT.rstrip("\n"))
    for trial in held_out(natural):
        name = f"{trial.choice.shape}, {trial.choice.relative:g}, {trial.choice.least:g}"
        pairs = (trial.chosen, trial.held_out, trial.own_held_out)
        lines.append(_row([trial.choice.rule, trial.split, name, *(" / ".join(map(percent, pair)) for pair in pairs)]))
    return lines


def _choice(choice: Choice, found: tuple[float, float], scans: Measured, note: str) -> str:
    """A row on one choice."""
    figures = (percent(found[0]), percent(found[1]), percent(score(scans, choice)[0]))
    return _row([choice.rule, f"{choice.shape}{note}", f"{choice.relative:g}", f"{choice.least:g}", *figures])


def _words(measured: Measured) -> Table:
    """Words among words."""
    same, ranked = meanings(), rankings(measured)
    lines = [WORDS.format(count=len(set(same.values()))).rstrip("\n"), ""]
    lines += _head("word", "first", "in first three", "kind first", "confused with")
    every = np.array([_word_scores(same[word], ranks) for word, ranks in zip(measured.asked, ranked, strict=True)])
    lines.append(_row(["**all**", *map(percent, every.mean(axis=0)), ""]))
    for word in dict.fromkeys(measured.asked.tolist()):
        if same[word] == word:
            chosen = np.flatnonzero(measured.asked == word)
            firsts = np.array([ranked[index][0] for index in chosen])
            lines.append(_row([word, *map(percent, every[chosen].mean(axis=0)), _others(firsts, word)]))
    return lines


def _word_scores(word: str, ranks: Sequence[str]) -> tuple[bool, bool, bool]:
    """Whether the word is first, among the first three, and of the first word's kind."""
    return ranks[0] == word, word in ranks[:3], kind(ranks[0]) == kind(word)


def _scans(scans: Measured) -> Table:
    """Combinations of scans."""
    said = all_verdicts(scans)
    angry = scans.asked == "anger"
    missing = [number for number, unit in units().items() if not unit.shape]
    unshown = [str(each) for each in combinations() if not each.weights()]
    lines = [
        SCANS.format(
            strengths=", ".join(f"{strength:g}" for strength in STRENGTHS),
            people=int((scans.variants == 0).sum()),
            missing=", ".join(map(str, missing)),
            unshown=f"\nA combination of AU {', '.join(unshown)} alone is left out." if unshown else "",
            ways=" | ".join(Way),
            anger=f"{int((said[Way.FAPS_ROBUST] == scans.asked)[angry].sum())} of {int(angry.sum())}",
            dashes="|".join(["---"] * len(Way)),
        ).rstrip("\n")
    ]
    for index, each in enumerate(shown()):
        here = scans.variants == index
        counts = [int((said[way][here] == each.emotion).sum()) for way in Way]
        others = [_others(said[way][here], each.emotion, most=1) for way in (Way.FAPS_PAPER, Way.FAPS_ROBUST)]
        without = ", ".join(map(str, each.missing())) or "–"
        lines.append(_row([each.emotion, each.source, each, without, *counts, *others]))
    whole = np.isin(scans.variants, [index for index, each in enumerate(shown()) if not each.missing()])
    chosen_rows: dict[str, Bools] = {"all": np.ones(len(whole), dtype=np.bool_), "with every scan": whole}
    for name, chosen in chosen_rows.items():
        shares = [f"{percent(float((said[way] == scans.asked)[chosen].mean()))} %" for way in Way]
        lines.append(_row([f"**{name}**", "", "", "", *shares, "", ""]))
    return lines


def _neutral() -> Table:
    """What is believed of a face at rest."""
    lines = ["", "## The neutral face", "", "Beliefs for a frame of zeros. The paper has no class for it:", ""]
    lines += _head("rule", *EMOTIONS, "neutral")
    for rule in Rule:
        beliefs = api.recognise(np.zeros(68), rule=rule)
        rest = "–" if beliefs.neutral is None else f"{beliefs.neutral:.3f}"
        lines.append(_row([rule, *(f"{belief:.3f}" for belief in beliefs.values()), rest]))
    return lines


def _samples(samples: Sequence[Sample]) -> Table:
    """Sample files."""
    lines = [SAMPLES.rstrip("\n")]
    for sample in samples:
        for rule in Rule:
            found: list[str] = []
            for believed in (sample.believed[rule], sample.at_rest[rule]):
                found += [_verdict(course, sample) for course in (believed[sample.strongest], believed.mean(axis=0))]
            lines.append(_row([sample.name, sample.stated, sample.strongest, sample.emotion, rule, *found]))
    return lines


def _verdict(believed: Floats, sample: Sample) -> str:
    """The most believed emotion and its belief, bold where it is the one the file is named after."""
    if not believed.max() > 0.0:
        return NOTHING
    name = EMOTIONS[int(believed.argmax())]
    return f"{f'**{name}**' if name == sample.emotion else name} {believed.max():.2g}"
