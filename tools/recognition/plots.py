"""The pictures of docs/evidence.md."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from risorius.mpeg4 import Rule

from .poses import Measured
from .samples import Sample
from .shapes import LEAST, RELATIVE, Choice, Shape, own, score
from .verdicts import EMOTIONS, OTHERS, confusion

mpl.use("Agg")

DPI = 90


def draw_confusions(pairs: Mapping[str, tuple[np.ndarray, np.ndarray]], path: Path) -> None:
    """Confusion matrices side by side: title -> what was asked and what was said, (n,) each."""
    figure = Figure(figsize=(4.2 * len(pairs), 4.0), layout="constrained")
    for axes, (title, (asked, said)) in zip(figure.subplots(1, len(pairs)), pairs.items(), strict=True):
        _matrix(axes, 100.0 * confusion(asked, said))
        axes.set_title(title)
    _save(figure, path)


def _matrix(axes: Axes, percent: np.ndarray) -> None:
    """One confusion matrix, in per cent; nothing is written where nothing is."""
    axes.imshow(percent, cmap="Blues", vmin=0.0, vmax=100.0, aspect="auto")
    for (row, column), value in np.ndenumerate(percent):
        if value >= 0.5:
            axes.text(column, row, f"{value:.0f}", ha="center", va="center", color="white" if value > 55.0 else "black")
    axes.set_xticks(range(len(EMOTIONS) + len(OTHERS)), [*EMOTIONS, *OTHERS], rotation=45, ha="right")
    axes.set_yticks(range(len(EMOTIONS)), EMOTIONS)
    axes.set_xlabel("recognised")
    axes.set_ylabel("posed")


def draw_shapes(measured: Measured, path: Path) -> None:
    """How much each shape recognises over its width by the paper's rule; the product's choice is ringed."""
    figure = Figure(figsize=(5.5, 3.8), layout="constrained")
    axes, rule = figure.subplots(), Rule.PAPER
    for shape in Shape:
        best = [
            max(score(measured, Choice(shape, relative, least, rule))[0] for least in LEAST) for relative in RELATIVE
        ]
        axes.plot(RELATIVE, 100.0 * np.array(best), marker=".", label=shape.value)
    axes.plot(own(rule).relative, 100.0 * score(measured, own(rule))[0], "o", ms=12, mfc="none", mec="black")
    axes.set_xlabel("width as a share of the centre (best least width)")
    axes.set_ylabel("recognised, %")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    _save(figure, path)


def draw_samples(samples: Sequence[Sample], path: Path) -> None:
    """Robust beliefs over time, one panel per file."""
    figure = Figure(figsize=(3.1 * len(samples), 3.0), layout="constrained")
    panels = figure.subplots(1, len(samples), sharey=True)
    for axes, sample in zip(panels, samples, strict=True):
        believed = sample.believed[Rule.ROBUST]
        times = np.arange(len(believed)) / sample.fps
        for name, course in zip(EMOTIONS, believed.T, strict=True):
            axes.plot(times, course, label=name, lw=2.5 if name == sample.emotion else 1.0)
        axes.axvline(times[sample.strongest], color="grey", ls=":")
        axes.set_title(sample.name, fontsize=9)
        axes.set_xlabel("s")
    panels[0].set_ylabel("belief, robust rule")
    figure.legend(*panels[-1].get_legend_handles_labels(), loc="outside right center", fontsize=8)
    _save(figure, path)


def _save(figure: Figure, path: Path) -> None:
    """Write a picture without the time it was made at."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=DPI, metadata={"Software": None})
