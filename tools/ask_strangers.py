"""Write docs/strangers.md: what outside judges see in rendered faces. `make strangers` installs them first.

    make strangers                                          three heads, six emotions at their own activation, the front
    make strangers ARGS="--heads all --activations own 7"   the six identities too, and as strong as it gets
    make strangers ARGS="--activations own 1 2 3 4 5 6 7"   growth
    make strangers ARGS="--turned 0 20 --words all"         from the side too, and all words
    make strangers ARGS="--page out/strangers/page.md"      the page elsewhere, its sheets beside it

Pictures and what was said of them are kept in out/strangers/ by what is in them: only new poses are rendered. The
shared heads are looked for where RISORIUS_SHARED says (default: ../shared). Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import risorius.api as api
from faithful.heads import HEADS, load_face
from places import DOCS, OUT
from risorius.errors import RisoriusError
from strangers.judges import JUDGES, NoJudgeError, ask, commands
from strangers.page import MEAN, Findings, page
from strangers.portraits import picture
from strangers.sheets import write_sheets
from strangers.sittings import EMOTIONS, OWN, Sitting, by_head, posed, scans_are_there, sittings
from strangers.verdicts import mean_said

KEPT = OUT / "strangers"

#: The heads that are pictured unless others are named.
DEFAULT_HEADS = ("default", "ict", "makehuman")


def main(arguments: Sequence[str]) -> int:
    """The command line of the module; returns the exit code."""
    given = _given(arguments)
    words = list(api.WORDS) if given.words == ["all"] else given.words
    heads = list(HEADS) if given.heads == ["all"] else given.heads
    try:
        commands()
        control = not given.no_control and scans_are_there()
        files = _pictured(sittings(heads, words, given.activations, given.turned, control=control))
        heard = ask(list(files.values()), KEPT / "said.json")
    except (RisoriusError, NoJudgeError) as error:
        print(f"strangers: {error}", file=sys.stderr)
        return 1
    by_judge = {judge: {sitting: heard[judge][file.name] for sitting, file in files.items()} for judge in JUDGES}
    mean = {sitting: mean_said(by_judge[judge][sitting] for judge in JUDGES) for sitting in files}
    folder = DOCS / "pictures" if given.page == DOCS / "strangers.md" else given.page.parent
    folder.mkdir(parents=True, exist_ok=True)
    sheets = write_sheets(mean, files, heads, folder)
    beside = {title: (folder / name).relative_to(given.page.parent).as_posix() for title, name in sheets.items()}
    given.page.write_text(page(Findings(heads, {MEAN: mean} | by_judge, beside)), encoding="utf-8")
    print(f"wrote {given.page}")
    return 0


def _given(arguments: Sequence[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    strengths = (OWN, *map(str, range(1, 8)))
    parser.add_argument("--heads", nargs="+", choices=(*HEADS, "all"), default=list(DEFAULT_HEADS))
    parser.add_argument("--words", nargs="+", choices=(*api.WORDS, "all"), default=list(EMOTIONS), metavar="WORD")
    parser.add_argument("--activations", nargs="+", choices=strengths, default=[OWN])
    parser.add_argument("--turned", nargs="+", type=int, default=[0], help="degrees to the subject's left")
    parser.add_argument("--no-control", action="store_true", help="leave the scanned actions out")
    parser.add_argument("--page", type=Path, default=DOCS / "strangers.md")
    return parser.parse_args(arguments)


def _pictured(asked: Sequence[Sitting]) -> dict[Sitting, Path]:
    """Sitting -> its picture, head by head."""
    files: dict[Sitting, Path] = {}
    for head, mine in by_head(asked).items():
        begun, face = time.monotonic(), load_face(head)
        files |= picture(head, face, [(sitting, posed(face, sitting)) for sitting in mine], KEPT / "pictures")
        print(f"{head}: {len(mine)} pictures, {time.monotonic() - begun:.0f} s", flush=True)
    return files


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
