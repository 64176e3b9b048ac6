"""Traces in shape keys: displacements too small to be seen, taken out of what is exported.

The skin's response to a muscle fades with distance and never quite ends. glTF lists only the vertices that a morph
target moves, so a trace at the back of the head costs as much as the smile.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

import numpy as np

from .blender_types import Key
from .mesh import key_vertices, write_key_vertices

#: Share of the farthest that any of the keys moves a vertex: 0.005 mm of 20 mm.
TRACE = 2.5e-4


def clear_traces(datablocks: Iterable[Key], names: Collection[str]) -> None:
    """Put vertices that the named shape keys of a face hardly move exactly where the reference key has them."""
    moved = [
        (block, key_vertices(keys.reference_key), key_vertices(block))
        for keys in datablocks
        for block in keys.key_blocks
        if block.name in names and block.relative_key == keys.reference_key
    ]
    lengths = [np.linalg.norm(shape - rest, axis=1) for _, rest, shape in moved]
    least = TRACE * max((float(each.max(initial=0.0)) for each in lengths), default=0.0)
    for (block, rest, shape), length in zip(moved, lengths, strict=True):
        if ((length > 0.0) & (length <= least)).any():
            write_key_vertices(block, np.where((length > least)[:, None], shape, rest))
