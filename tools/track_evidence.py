"""How well `risorius track` reads FAPs: films of known streams are made, tracked and compared.

    python tools/track_evidence.py films     in an environment with Blender's `bpy` and the shared heads
    python tools/track_evidence.py read      in one with `pip install -e .[track]` and scikit-image (for its photograph)
    python tools/track_evidence.py sheet     in the first again

The first step leaves pictures in out/track; the second reads them, writes the generic face, how people differ from it
and the trust in each FAP (presets/capture/generic_face.csv, people.csv, camera_faps.csv) and the tables of
docs/tracking.md; the third its picture. `people` writes the first two tables alone.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from places import DOCS, OUT

FILMS = OUT / "track"

HEADS = ("default", "ict")
NEUTRAL = "neutral"


def make_films(out: Path) -> None:
    """Film the known stream on each head from every side, and picture all heads neutral."""
    from tracking.films import film_head
    from tracking.known import STREAMS
    from tracking.neutral_faces import picture_neutral_heads

    picture_neutral_heads(out / NEUTRAL)
    for kind in STREAMS:
        for head in HEADS:
            print(*film_head(head, kind, out), sep="\n", flush=True)


def read_films(out: Path) -> None:
    """Track the films, and write what was found."""
    from tracking.emotions import read_emotions
    from tracking.figures import read_film
    from tracking.generic import write_people
    from tracking.page import write_tables
    from tracking.photograph import read_photograph
    from tracking.trust_table import write_trust

    write_people(out / NEUTRAL)
    films = [read_film(folder) for folder in sorted((out / "faps").iterdir())]
    trust = write_trust(films)
    emotions = [read_emotions(folder) for folder in sorted((out / "emotions").iterdir())]
    write_tables(films, trust, emotions, read_photograph(out))


def picture_what_was_read(out: Path) -> None:
    """Show the emotions of one head played on another."""
    from tracking.sheet import write_sheet

    print(write_sheet(out / "emotions" / "ict-0", DOCS / "pictures" / "tracking.jpg"))


def read_people(out: Path) -> None:
    """Picture all heads neutral where they are not, and write how people differ."""
    from tracking.generic import write_people

    write_people(out / NEUTRAL)


STEPS = {"films": make_films, "people": read_people, "read": read_films, "sheet": picture_what_was_read}


def main(argv: list[str] | None = None) -> int:
    """Run one step."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=STEPS)
    parser.add_argument("--out", type=Path, default=FILMS, help="where the pictures are (default: out/track)")
    arguments = parser.parse_args(argv)
    STEPS[arguments.step](arguments.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
