"""The tables of docs/tracking.md, between its marks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import risorius.api as api
from places import DOCS
from risorius.track import CameraFap, Track
from risorius.track.tracking import LEAST

from .emotions import RULES, Recognised
from .figures import FilmFigures
from .known import EMOTIONS

PAGE = DOCS / "tracking.md"
START, END = "<!-- measured: {} -->", "<!-- end of {} -->"


def write_tables(
    films: Sequence[FilmFigures], trust: Sequence[CameraFap], emotions: Sequence[Recognised], photograph: Track
) -> None:
    """Write what was measured into the page."""
    text = PAGE.read_text(encoding="utf-8")
    for name, lines in (
        ("films", _films(films, trust)),
        ("faps", _faps(films, trust)),
        ("emotions", _emotions(emotions)),
        ("photograph", _photograph(photograph)),
    ):
        start, end = START.format(name), END.format(name)
        before, rest = text.split(start)
        _, after = rest.split(end)
        text = before + "\n".join([start, "", *lines, "", end]) + after
    PAGE.write_text(text, encoding="utf-8")


def _films(films: Sequence[FilmFigures], trust: Sequence[CameraFap]) -> list[str]:
    """A row per film: the median over the FAPs that are not masked."""
    rows = [
        "| video | frames | face lost | median correlation | median slope | median error, share of range "
        "| neutral frames found correctly |",
        "|---|---|---|---|---|---|---|",
    ]
    kept = [row.number - 1 for row in trust if row.trust >= LEAST]
    for film in films:
        fits = [np.nanmedian(figure[kept]) for figure in (film.correlation, film.slope, film.error / film.span)]
        rows.append(
            f"| {_title(film.name)} | {film.frames} | {film.lost} | {fits[0]:.2f} | {fits[1]:.2f} "
            f"| {100 * fits[2]:.0f} % | {100 * film.own_neutral:.0f} % |"
        )
    return rows


def _faps(films: Sequence[FilmFigures], trust: Sequence[CameraFap]) -> list[str]:
    """A row per FAP: correlation in each film, error, and what the camera can tell."""
    names = [_title(film.name) for film in films]
    rows = [
        f"| FAP | {' | '.join(names)} | slope | error | range | jitter | trust | |",
        "|---|" + "---|" * (len(films) + 6),
    ]
    for row in trust:
        column = row.number - 1
        cells = [_number(film.correlation[column], 2) for film in films]
        cells += [_number(_mean([film.slope[column] for film in films]), 2)]
        cells += [
            _number(_mean([getattr(film, what)[column] for film in films]), 0)
            for what in ("error", "span", "trembling")
        ]
        note = row.reason or ("" if row.trust >= LEAST else "masked")
        note = f"masked; {note}" if row.reason and row.trust < LEAST else note
        rows.append(f"| {row.number} {api.fap(row.number).name} | {' | '.join(cells)} | {row.trust:.2f} | {note} |")
    return rows


def _emotions(films: Sequence[Recognised]) -> list[str]:
    """What each emotion was taken for, a row per film and rule: the camera's verdict, the mesh's where it differs."""
    rows = ["| video | rule | " + " | ".join(EMOTIONS) + " | correct: camera, mesh |", "|---|---|" + "---|" * 7]
    for film in films:
        for rule in RULES:
            camera, mesh = film.camera[rule], film.mesh[rule]
            right = [sum(found[word] == word for word in EMOTIONS) for found in (camera, mesh)]
            cells = [camera[w] if camera[w] == mesh[w] else f"{camera[w]} (mesh: {mesh[w]})" for w in EMOTIONS]
            rows.append(f"| {_title(film.name)} | {rule} | {' | '.join(cells)} | {right[0]}, {right[1]} of 6 |")
    return rows


def _photograph(track: Track) -> list[str]:
    """What the photograph says, and the beliefs that follow."""
    frame = track.stream.frames[0]
    told = (4, 6, 7, 12, 13, 19, 20, 33, 34, 41, 42, 51, 59, 60)
    rows = ["| FAP | value |", "|---|---|"]
    rows += [f"| {n} {api.fap(n).name} | {_number(frame[n - 1], 0)} |" for n in told]
    names = [*map(str, api.ARCHETYPES), api.NEUTRAL]
    rows += ["", "| rule | " + " | ".join(names) + " |", "|---|" + "---|" * 7]
    robust = api.recognise(frame, rule="robust", confidence=track.confidence[0], doubt=track.doubt)
    for rule, beliefs in (("robust", robust), ("paper", api.recognise(frame))):
        cells = [f"{belief:.3f}" for belief in beliefs.values()]
        rows.append(f"| {rule} | {' | '.join([*cells, _number(beliefs.neutral or np.nan, 3)])} |")
    return rows


def _title(name: str) -> str:
    """Head and side of a film: "ict-20" as "ict, 20°"."""
    return name.replace("-", ", ") + "°"


def _mean(values: Sequence[float]) -> float:
    """The mean of what is known."""
    known = [value for value in values if np.isfinite(value)]
    return float(np.mean(known)) if known else float("nan")


def _number(value: float, digits: int) -> str:
    """A figure, or a dash where there is none."""
    return f"{value:.{digits}f}" if np.isfinite(value) else "–"
