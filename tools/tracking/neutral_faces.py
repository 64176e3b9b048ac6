"""Pictures of neutral heads from the front, of which the generic face is the mean. Needs Blender's `bpy`."""

from __future__ import annotations

from pathlib import Path

from faithful.heads import HEADS, load_face

from .films import SIZE, Filmed


def picture_neutral_heads(out: Path) -> Path:
    """Write a picture NAME/0001.png of every head of `faithful.heads` into a folder."""
    for name in HEADS:
        face = load_face(name)
        Filmed.of_head(name, face, width=SIZE, height=SIZE).film([face.vertices], 0, out / name)
    return out
