"""What recognition says of pictures: photographs, renders of heads by others, films. Needs MediaPipe."""

from __future__ import annotations

import itertools
import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.errors import ModelError
from risorius.mpeg4.streams.capture import Landmarks
from risorius.track import Track, find_landmarks, open_pictures, track_landmarks
from tracking.known import BEFORE, EMOTIONS, TRUTH

from .photographs import Photograph

FILE = "seen.json"


@dataclass(frozen=True)
class Seen:
    """One picture or film.

    Attributes
    ----------
    kind : "photograph", "render" or "film". name : what it is called. shows : its expression.
    neutral : where the neutral face is from: "own", "guessed".
    paper, robust : verdicts; of a film, the runs of verdicts. beliefs : by the robust rule, with neutral's.
    """

    kind: str
    name: str
    shows: str
    neutral: str
    paper: str
    robust: str
    beliefs: dict[str, float]


def write_seen(found: Sequence[Seen], cache: Path) -> None:
    """Leave what was seen for the page."""
    (cache / FILE).write_text(json.dumps([asdict(each) for each in found], indent=1), encoding="utf-8")


def read_photographs(photographs: Sequence[Photograph]) -> Iterator[Seen]:
    """Each against the guessed neutral face; those in which no face is found are left out."""
    for each in photographs:
        landmarks = _landmarks(each.path)
        if landmarks is not None:
            yield _verdict("photograph", each.name, each.shows, "guessed", track_landmarks(landmarks))


def read_others(folder: Path) -> Iterator[Seen]:
    """Renders HEAD/EMOTION/SIDE.png, against the head's own neutral picture of that side and against the guess."""
    for head in sorted(path for path in folder.iterdir() if path.is_dir()):
        for neutral in sorted((head / "neutral").iterdir()):
            at_rest = _landmarks(neutral)
            for emotion in sorted(path.name for path in head.iterdir()):
                shown = _landmarks(head / emotion / neutral.name)
                if shown is None:
                    continue
                name = f"{head.name}, {neutral.stem}"
                yield _verdict("render", name, emotion, "guessed", track_landmarks(shown))
                if at_rest is not None:
                    both = Landmarks(np.array([0.0, 1.0]), np.concatenate([at_rest.positions, shown.positions]))
                    own = track_landmarks(both, neutral=(0.0, 0.5), smoothing="none")
                    yield _verdict("render", name, emotion, "own", own)


def read_films(folder: Path) -> Iterator[Seen]:
    """Films of the six emotions, each from rest and back: the runs of verdicts of each emotion's part."""
    for film in sorted(folder.iterdir()):
        told = np.load(film / TRUTH)
        fps, shown = float(told["fps"]), np.array(told["shown"].tolist())
        landmarks = find_landmarks(open_pictures([film], fps=fps))
        track = track_landmarks(landmarks, neutral=(0.0, (BEFORE - 0.5) / fps))
        found = track.recognise()
        paper = api.recognise_over_time(track.stream.frames, fps=fps)
        for word in EMOTIONS:
            part = np.flatnonzero(shown == word)
            by_paper, by_robust = (_runs([best[index] for index in part]) for best in (paper.best, found.best))
            yield Seen("film", film.name, word, "own", by_paper, by_robust, {})


def _landmarks(path: Path) -> Landmarks | None:
    """Landmarks of one picture; None where no face is found."""
    try:
        return find_landmarks(open_pictures([path]))
    except ModelError:
        return None


def _verdict(kind: str, name: str, shows: str, neutral: str, track: Track) -> Seen:
    """What the last frame of a track shows."""
    frame, sure = track.stream.frames[-1], track.confidence[-1]
    doubt = track.doubt if track.doubt.size else None
    robust = api.recognise(frame, rule="robust", confidence=sure, doubt=doubt)
    beliefs = {str(emotion): round(belief, 3) for emotion, belief in robust.items()}
    beliefs["neutral"] = round(robust.neutral or 0.0, 3)
    return Seen(kind, name, shows, neutral, str(api.recognise(frame).best), str(robust.best), beliefs)


def _runs(verdicts: Sequence[str | None]) -> str:
    """Verdicts one after another, each run once."""
    return ", ".join(str(name) for name, _ in itertools.groupby(verdicts))
