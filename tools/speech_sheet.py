"""The contact sheet of the visemes on three heads, docs/pictures/visemes.jpg; needs Blender's module.

.venv-bpy-4.5/bin/python tools/speech_sheet.py [--heads default ict makehuman] [--emotion WORD]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import risorius.api as api
from faithful.heads import load_face
from faithful.sheet import Cell
from places import DOCS
from risorius.arrays import Floats
from risorius.speech.phonemes import phonemes
from strangers.portraits import sitter_of
from strangers.sheets import write_jpeg

SHEET = DOCS / "pictures" / "visemes.jpg"
#: A sound for each of the fourteen visemes of the standard.
SOUNDS = ("p", "f", "θ", "t", "k", "tʃ", "s", "n", "ɹ", "ɑ", "ɛ", "ɪ", "ɒ", "ʊ")
#: Seconds that a sound is held, and at what rate its middle is found.
HELD, FPS = 0.6, 10.0
#: The part of a picture about the mouth: rows and columns as shares.
CUT = (0.42, 0.97, 0.2, 0.8)


def spoken(face: api.Face, symbol: str, emotion: api.Profile | None) -> Floats:
    """Positions (V, 3) in the middle of a sound that is held."""
    said = api.Utterance((api.Sound(0.2, 0.2 + HELD, phonemes()[symbol], symbol),), 1.0)
    saying = api.say(said, emotion=emotion, fps=FPS)
    middle = round(said.sounds[0].middle * FPS)
    frames, felt = saying.stream.frames[middle : middle + 1], saying.emotions[middle : middle + 1]
    (positions,) = face.simulation(frames, FPS, emotions=felt, planned=True, integrator="balance")
    return np.asarray(positions)


def cut(picture: Floats) -> Floats:
    """The part about the mouth."""
    height, width = picture.shape[:2]
    top, bottom, left, right = CUT
    return picture[int(top * height) : int(bottom * height), int(left * width) : int(right * width), :3]


def main(argv: list[str] | None = None) -> int:
    """Picture every viseme on every head."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--heads", nargs="+", default=["default", "ict", "makehuman"])
    parser.add_argument("--emotion", help="what is felt meanwhile")
    parser.add_argument("--out", type=Path, default=SHEET)
    arguments = parser.parse_args(argv)
    emotion = None if arguments.emotion is None else api.expression(arguments.emotion)
    rows = []
    for head in arguments.heads:
        face = load_face(head)
        shots = sitter_of(head, face).shots([spoken(face, symbol, emotion) for symbol in SOUNDS], 0.0)
        rows.append([cut(shot) for shot in shots])
    cells = [
        Cell(f"{number} {' '.join(api.VISEMES[number].phonemes)}", "", [row[number - 1] for row in rows])
        for number in range(1, len(SOUNDS) + 1)
    ]
    write_jpeg(cells, arguments.out, "Visemes 1 to 14 on " + ", ".join(arguments.heads), columns=5)
    print(f"wrote {arguments.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
