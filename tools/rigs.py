"""How far a character's own shape keys follow the muscles: figures in docs/rigs.md, contact sheets in out/rigs/.

    .venv-bpy-4.5/bin/python tools/rigs.py [--only HEAD] [--no-take] [--sheets]

HEAD is the beginning of a head's name. With --only nothing is written to the page, and the figures are printed.
"""

from __future__ import annotations

import argparse
import sys

from places import OUT
from rigging.heads import KEYED_HEADS, keyed_head
from rigging.measuring import Followed, followed
from rigging.page import write_page
from rigging.sheet import write_sheet
from rigging.take import Take, take_on

#: The heads that a take is put on.
TAKEN = ("makehuman, 52 drawn",)


def main() -> int:
    """Measure, picture, write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="HEAD", default="", help="heads whose names begin so")
    parser.add_argument("--no-take", action="store_true", help="leave out the take of a minute")
    parser.add_argument("--sheets", action="store_true", help="contact sheets, too; needs Blender's module")
    chosen = parser.parse_args()
    emotions: list[Followed] = []
    takes: list[Take] = []
    for name in (name for name in KEYED_HEADS if name.startswith(chosen.only)):
        head = keyed_head(name)
        for row in followed(head):
            print(row)
            emotions.append(row)
        if chosen.sheets:
            write_sheet(head, OUT / "rigs" / f"{name.replace(', ', '-').replace(' ', '-')}.png")
        if name in TAKEN and not chosen.no_take:
            takes.append(take_on(head))
            print(takes[-1])
    if not chosen.only and not chosen.no_take:
        write_page(emotions, takes)
    return 0


if __name__ == "__main__":
    sys.exit(main())
