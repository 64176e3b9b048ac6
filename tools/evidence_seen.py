"""What `tools/evidence.py` says of pictures: heads by others are rendered, photographs and films are read.

    python tools/evidence_seen.py render     in an environment with Blender's `bpy` and the shared heads
    python tools/evidence_seen.py read       in one with `pip install -e .[track]` and scikit-image

The first step leaves pictures in out/evidence/others and films in out/track; the second downloads photographs that
packages ship (they stay in out/evidence), reads everything, and leaves out/evidence/seen.json.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from places import OUT

CACHE, FILMS = OUT / "evidence", OUT / "track"


def render(cache: Path) -> None:
    """Picture heads by others, and film emotions where they are not filmed."""
    from recognition.others import picture_others
    from tracking.films import film_head

    picture_others(cache / "others")
    for head in ("default", "ict"):
        if not (FILMS / "emotions" / f"{head}-0").is_dir():
            film_head(head, "emotions", FILMS)


def read(cache: Path) -> None:
    """Recognise what pictures show."""
    from recognition.photographs import gather_photographs
    from recognition.seen import read_films, read_others, read_photographs, write_seen

    photographs = gather_photographs(cache / "photographs")
    write_seen([*read_photographs(photographs), *read_others(cache / "others"), *read_films(FILMS / "emotions")], cache)


STEPS = {"render": render, "read": read}


def main() -> None:
    """Run one step."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=STEPS)
    STEPS[parser.parse_args().step](CACHE)


if __name__ == "__main__":
    main()
