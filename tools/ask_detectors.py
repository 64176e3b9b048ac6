"""Ask detectors that others made what they see in rendered faces of which the truth is known: docs/detectors.md.

    python tools/ask_detectors.py render     in an environment with Blender's `bpy` and the shared heads
    python tools/ask_detectors.py read       in one with `pip install -e .[track]`; fetches MediaPipe's model by pip
    python tools/ask_detectors.py page       in the first again; asks the judges of `make strangers`, too

What is there already in out/detectors/, and films in out/track/, is left: delete the folders after a change of faces.
With --small, some pictures of one head from the front and no films: the page is out/detectors/small.md then.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence

import numpy as np
from detectors.figures import both_sides, film_follows, named
from detectors.page import Findings, page
from detectors.points68 import Points
from detectors.stills import EMOTIONS, REST, Still, actions, few, stills
from places import DOCS, OUT
from risorius.arrays import Floats
from risorius.errors import RisoriusError

KEPT = OUT / "detectors"
PICTURES, READ = KEPT / "pictures", KEPT / "read.json"
SMALL = KEPT / "small.md"
FILMS, FILMS_READ = OUT / "track" / "emotions", KEPT / "films.json"

#: Heads that are filmed.
FILMED = ("default", "ict")


def render(asked: Sequence[Still], filmed: Sequence[str]) -> None:
    """Picture stills, and film emotions where they are not filmed; keep the true FAPs."""
    from detectors.pictures import picture_all
    from tracking.films import film_head

    picture_all(asked, PICTURES)
    for head in filmed:
        if not (FILMS / f"{head}-0").is_dir():
            film_head(head, "emotions", FILMS.parent)


def read(asked: Sequence[Still], filmed: Sequence[str]) -> None:
    """Let MediaPipe read them."""
    from detectors.reading import fetch_model, read_all, read_films

    model = fetch_model(KEPT)
    read_all(asked, PICTURES, model, READ)
    if filmed:
        read_films(FILMS, model, FILMS_READ)


def write(wanted: Sequence[Still], filmed: Sequence[str]) -> None:
    """Ask the judges of emotions and the finders of landmarks, and write the page and its picture."""
    from detectors.sheet import write_sheet

    asked = [still for still in wanted if (PICTURES / still.file).is_file()]
    read = json.loads(READ.read_text(encoding="utf-8"))
    truth = json.loads((PICTURES / "truth.json").read_text(encoding="utf-8"))
    seen = {still: read[still.file] for still in asked if read.get(still.file)}
    scores = {still: both_sides(each["shapes"]) for still, each in seen.items()}
    faps = {still: _frame(each["faps"]) for still, each in seen.items() if each["faps"]}
    robust = {still: each["verdict"] for still, each in seen.items() if "verdict" in each}
    verdicts = {"MediaPipe, robust rule": robust} | _judged(asked)
    true = {still: _frame(truth[still.file]) for still in asked}
    lost, films = len(asked) - len(seen), _films() if filmed else {}
    text = page(Findings(scores, faps, true, verdicts, len(asked), lost, films, _points(asked)))
    if not filmed:
        SMALL.write_text(text, encoding="utf-8")
        print(SMALL)
        return
    (DOCS / "detectors.md").write_text(text, encoding="utf-8")
    print(write_sheet(scores, PICTURES, DOCS / "pictures" / "detectors.jpg"))


def _films() -> dict[str, dict[str, float]]:
    """Film -> action unit -> how its blend shape follows."""
    read = json.loads(FILMS_READ.read_text(encoding="utf-8")) if FILMS_READ.is_file() else {}
    return {
        f"{name.replace('-', ', ')}°": {
            unit: film_follows(film["shapes"], np.array(film["truth"]), action) for unit, action in actions().items()
        }
        for name, film in read.items()
    }


def _frame(values: list[float | None]) -> Floats:
    """(68,) FAPs, NaN where unknown."""
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)


def _judged(asked: Sequence[Still]) -> dict[str, dict[Still, str]]:
    """Judge -> still -> what it names, of emotions and rest; none where the judges are not installed."""
    from strangers.judges import JUDGES, NoJudgeError, ask

    files = {still: PICTURES / still.file for still in asked if still.shows in (*EMOTIONS, REST)}
    try:
        heard = ask(list(files.values()), KEPT / "said.json")
    except NoJudgeError as missing:
        print(f"no judges of emotions: {missing}", file=sys.stderr)
        return {}
    return {judge: {still: named(heard[judge][file.name]) for still, file in files.items()} for judge in JUDGES}


def _points(asked: Sequence[Still]) -> dict[str, Points]:
    """Finder -> its 68 landmarks; none where the finders are not installed."""
    from detectors.points68 import ask_points
    from strangers.judges import NoJudgeError

    try:
        return ask_points(asked, PICTURES, KEPT / "points.json")
    except NoJudgeError as missing:
        print(f"no finders of landmarks: {missing}", file=sys.stderr)
        return {}


STEPS = {"render": render, "read": read, "page": write}


def main() -> None:
    """Run one step."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=STEPS)
    parser.add_argument("--small", action="store_true", help="a few pictures, to try it all in minutes")
    arguments = parser.parse_args()
    try:
        STEPS[arguments.step](few() if arguments.small else stills(), () if arguments.small else FILMED)
    except RisoriusError as error:
        raise SystemExit(f"{error}") from None


if __name__ == "__main__":
    main()
