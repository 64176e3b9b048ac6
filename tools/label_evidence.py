"""Where MediaPipe's landmarks lie on heads, and how well labels agree with what it sees.

    python tools/label_evidence.py pictures    in an environment with Blender's `bpy` and the shared heads
    python tools/label_evidence.py places      in one with `pip install -e .[track]`; writes a table
                                               of presets/capture

Pictures lie in out/labels.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from places import OUT

LABELS = OUT / "labels"


def picture(out: Path) -> None:
    """Picture neutral heads."""
    from labelled.pictures import picture_heads

    print(picture_heads(out / "neutral"))


def measure(out: Path) -> None:
    """Write where landmarks lie on the template."""
    from labelled.places import write_places

    write_places(out / "neutral")


STEPS = {"pictures": picture, "places": measure}


def main(argv: list[str] | None = None) -> int:
    """Run one step."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("step", choices=STEPS)
    parser.add_argument("--out", type=Path, default=LABELS, help="where the pictures are (default: out/labels)")
    arguments = parser.parse_args(argv)
    STEPS[arguments.step](arguments.out)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
