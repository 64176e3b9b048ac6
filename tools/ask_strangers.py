"""Tell what outside judges see in rendered faces. `make strangers` installs them first.

    make strangers                                          three heads, the six at their own activation, two sides
    make strangers ARGS="--heads all --activations own 7"   the six identities too, and as strong as it gets
    make strangers ARGS="--growth 1 2 3 4 5 6 7"            growth, from the front
    make strangers ARGS="--words all"                       all words
    make strangers ARGS="--whole"                           all that docs/strangers.md tells, and the page anew

Without --whole the page and its sheets go to out/strangers/, or where --page says. The whole takes about as long as 500
poses and 600 pictures do, some 20 minutes on a quiet machine.

Poses, pictures and what was said of them are kept in out/strangers/ by what is in them: after a stop it goes on where
it was, and only what has changed is made anew. Several runs on different heads may go on at once; a last one over all
heads then tells all. The shared heads are looked for where RISORIUS_SHARED says (default: ../shared). Needs a Python
that has bpy.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import risorius.api as api
from faithful.heads import HEADS, load_face
from places import DOCS, OUT
from risorius.errors import RisoriusError
from strangers.chart import growth_chart
from strangers.judges import JUDGES, NoJudgeError, ask, commands
from strangers.page import MEAN, Findings, page
from strangers.portraits import picture
from strangers.poses import Poses
from strangers.sheets import write_sheets
from strangers.sittings import ASIDE, EMOTIONS, OWN, SCAN, Sitting, by_head, scans_are_there, sittings, whole_evening
from strangers.verdicts import Judged, mean_said

KEPT = OUT / "strangers"

#: Name of the drawing of growth.
CHART = "strangers-growth.svg"

#: The heads that are pictured unless others are named.
DEFAULT_HEADS = ("default", "ict", "makehuman")


def main(arguments: Sequence[str]) -> int:
    """The command line of the module; returns the exit code."""
    given = _given(arguments)
    try:
        commands()
        files = _pictured(_asked(given))
        heard = ask(list(files.values()), KEPT / "said.json")
    except (RisoriusError, NoJudgeError) as error:
        print(f"strangers: {error}", file=sys.stderr)
        return 1
    by_judge = {judge: {sitting: heard[judge][file.name] for sitting, file in files.items()} for judge in JUDGES}
    mean = {sitting: mean_said(by_judge[judge][sitting] for judge in JUDGES) for sitting in files}
    path = given.page or (DOCS / "strangers.md" if given.whole else KEPT / "page.md")
    _write_page(path, {MEAN: mean} | by_judge, files)
    print(f"wrote {path}")
    return 0


def _asked(given: argparse.Namespace) -> list[Sitting]:
    """What the command line wants pictured."""
    heads = list(HEADS) if given.heads == ["all"] else given.heads
    if given.whole:
        return [sitting for sitting in whole_evening() if sitting.head in (heads or HEADS)]
    words = list(api.WORDS) if given.words == ["all"] else given.words
    control = not given.no_control and scans_are_there()
    asked = sittings(heads or DEFAULT_HEADS, words, given.activations, given.turned, control=control)
    growing = sittings(heads or DEFAULT_HEADS, words, given.growth, [0], control=False) if given.growth else []
    return list(dict.fromkeys([*asked, *growing]))


def _write_page(path: Path, by_judge: Mapping[str, Judged], files: Mapping[Sitting, Path]) -> None:
    """The page; its sheets and its chart beside it, or in docs/pictures for the documentation's."""
    path = path.resolve()
    folder = DOCS / "pictures" if path.parent == DOCS.resolve() else path.parent
    folder.mkdir(parents=True, exist_ok=True)
    heads = list(by_head(sitting for sitting in files if sitting.how != SCAN))
    sheets = write_sheets(by_judge[MEAN], files, heads, folder)
    chart = growth_chart(by_judge[MEAN], heads)
    if chart:
        (folder / CHART).write_text(chart, encoding="utf-8")
    beside = folder.relative_to(path.parent)
    told = [replace(sheet, file=(beside / sheet.file).as_posix()) for sheet in sheets]
    findings = Findings(heads, by_judge, told, (beside / CHART).as_posix() if chart else None)
    path.write_text(page(findings), encoding="utf-8")


def _given(arguments: Sequence[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    strengths = (OWN, *map(str, range(1, 8)))
    parser.add_argument("--heads", nargs="+", choices=(*HEADS, "all"), default=[])
    parser.add_argument("--words", nargs="+", choices=(*api.WORDS, "all"), default=list(EMOTIONS), metavar="WORD")
    parser.add_argument("--activations", nargs="+", choices=strengths, default=[OWN])
    about = "activations that are pictured from the front alone"
    parser.add_argument("--growth", nargs="+", choices=strengths, default=[], help=about)
    parser.add_argument("--turned", nargs="+", type=int, default=[0, ASIDE], help="degrees to the subject's left")
    parser.add_argument("--no-control", action="store_true", help="leave the scanned actions out")
    parser.add_argument("--whole", action="store_true", help="all that docs/strangers.md tells (of --heads)")
    parser.add_argument("--page", type=Path, help="where to write it (default: out/strangers/page.md)")
    return parser.parse_args(arguments)


def _pictured(asked: Sequence[Sitting]) -> dict[Sitting, Path]:
    """Sitting -> its picture, head by head."""
    files: dict[Sitting, Path] = {}
    for head, mine in by_head(asked).items():
        begun, face = time.monotonic(), load_face(head)
        files |= picture(head, face, mine, Poses(face, KEPT / "poses"), KEPT / "pictures")
        print(f"{head}: {len(mine)} pictures, {time.monotonic() - begun:.0f} s", flush=True)
    return files


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
