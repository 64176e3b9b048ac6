"""How far recordings of real people come through to the vertices: tables and the picture of docs/recordings.md.

    python tools/recording_evidence.py                 in an environment with Blender's `bpy` and the shared folder
    python tools/recording_evidence.py --only strip    the picture alone; `tables` alone needs no Blender

Each recording is played on each head, and its FAPs are read back from the vertices of every frame: some ten minutes.
"""

from __future__ import annotations

import argparse
import sys

from places import DOCS
from recorded.page import write_tables
from recorded.played import lateness, play
from recorded.takes import TAKES, read_take

HEADS = ("default", "ict", "makehuman")
PARTS = ("tables", "strip")
WITH = {"as it is": False, "with inertia": True}
PICTURED, PICTURE = "Live Link Face", DOCS / "pictures" / "recording.jpg"


def main(arguments: list[str]) -> None:
    """See above."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=PARTS, help="this part alone")
    only = parser.parse_args(arguments).only
    takes = [read_take(title) for title in TAKES]
    if only in (None, "tables"):
        played, late = {}, {}
        for take in takes:
            played[take.title] = [play(take, head) for head in HEADS]
            late[take.title] = {how: lateness(take, HEADS[0], inertia=inertia) for how, inertia in WITH.items()}
            print(f"{take.title}: played on {', '.join(HEADS)}", flush=True)
        write_tables(takes, played, late)
    if only in (None, "strip"):
        from recorded.strip import write_strip

        print(write_strip(next(take for take in takes if take.title == PICTURED), PICTURE))


if __name__ == "__main__":
    main(sys.argv[1:])
