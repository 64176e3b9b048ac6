"""What a file seems to be that is no stream and no recording of a face, in words for people, with the remedy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .row_names import plain_name

#: What binary files begin with, at a byte, and what they are.
BEGINNINGS: tuple[tuple[int, bytes, str], ...] = (
    (4, b"ftyp", "a video (track it: risorius track)"),
    (0, b"\x1aE\xdf\xa3", "a video (track it: risorius track)"),
    (0, b"RIFF", "a video or a sound (track a video: risorius track)"),
    (0, b"\x89PNG", "an image (track it: risorius track)"),
    (0, b"\xff\xd8\xff", "an image (track it: risorius track)"),
    (0, b"glTF", "a glTF model"),
    (0, b"Kaydara FBX", "an FBX model (export the recording as a table instead)"),
    (0, b"BLENDER", "a Blender file"),
    (0, b"PK\x03\x04", "a zip archive or a spreadsheet (unpack it, or save the spreadsheet as CSV)"),
    (0, b"\x93NUMPY", "an array of NumPy (it does not say what its columns are)"),
    (0, b"\x1f\x8b", "a compressed file (unpack it)"),
    (0, b"SQLite", "a database"),
    (0, b"%PDF", "a PDF document"),
)

#: Names that tell what a table or JSON file is of, as parts of plain names.
TELLING: tuple[tuple[tuple[str, ...], str], ...] = (
    (("ctrlexpressions", "ctrll", "ctrlr"), "controls of a MetaHuman rig"),
    (("phoneme", "mouthcue", "mouthcues"), "timings of speech (lips: risorius say)"),
    (("leftwrist", "rightwrist", "leftshoulder", "poselandmarks", "hips"), "the motion of a body"),
    (("handlandmarks", "indexfinger", "lefthand"), "the motion of hands"),
    (("valence", "dominantemotion"), "emotions, and no motion of a face"),
    (("meshes", "accessors"), "a glTF model"),
    (("joy", "fun", "sorrow"), "expressions of a VRM character, which are no single motions"),
)

SHOWN = 8


def what_it_seems(names: Sequence[str]) -> str:
    """What a file with these names seems to be."""
    plain = {plain_name(name) for name in names}
    for parts, told in TELLING:
        if any(part == name or (len(part) > 5 and part in name) for part in parts for name in plain):
            return f"it seems to hold {told}"
    shown = ", ".join(name for name in names[:SHOWN] if name) or "nothing"
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"it has {shown}{more}"


def names_in(document: Any) -> list[str]:
    """The names at the top of a JSON document, or of its first frame."""
    if isinstance(document, list):
        document = next((entry for entry in document if isinstance(entry, dict)), {})
    return [str(name) for name in document] if isinstance(document, Mapping) else []


def what_begins_so(data: bytes) -> str | None:
    """What a binary file is; None where that is not known."""
    found = (told for place, beginning, told in BEGINNINGS if data[place : place + len(beginning)] == beginning)
    return next(found, None)
