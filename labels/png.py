"""Pictures of figures as PNG, 8 or 16 bits each, without loss; the same figures give the same bytes."""

from __future__ import annotations

import struct
import zlib
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Pixels: TypeAlias = "NDArray[np.uint8] | NDArray[np.uint16]"

#: Kinds of colour: grey, and red, green, blue.
GREY, RGB = 0, 2
#: What is stored of each row: its difference from the one above.
UP = 2
LEVEL = 6


def png_bytes(pixels: Pixels) -> bytes:
    """A PNG of (height, width) or (height, width, 3) figures, first row at the top."""
    height, width = pixels.shape[:2]
    kind = GREY if pixels.ndim == 2 else RGB
    rows = np.ascontiguousarray(pixels.astype(pixels.dtype.newbyteorder(">"))).reshape(height, -1).view(np.uint8)
    above = np.vstack([np.zeros_like(rows[:1]), rows[:-1]])
    filtered = np.hstack([np.full((height, 1), UP, dtype=np.uint8), rows - above])
    header = struct.pack(">IIBBBBB", width, height, 8 * pixels.dtype.itemsize, kind, 0, 0, 0)
    body = zlib.compress(filtered.tobytes(), LEVEL)
    return b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", body) + _chunk(b"IEND", b"")


def _chunk(name: bytes, data: bytes) -> bytes:
    """One part of the file."""
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
