"""Whether a file is complete, by what its own format says of its length: a full disk cuts files off without a word."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

#: The first bytes of a PNG file, and its last chunk.
PNG_BEGIN, PNG_END = b"\x89PNG\r\n\x1a\n", b"IEND\xaeB`\x82"
#: The frame with which Zstandard begins, and what a .blend that is not compressed begins with.
ZSTD, BLEND = b"\x28\xb5\x2f\xfd", b"BLENDER"
#: A .blend begins with this where it is compressed as gzip.
GZIP = b"\x1f\x8b"


def what_is_missing(path: Path) -> str | None:
    """Why a file is not complete; None where it is, as far as its format tells.

    Raises
    ------
    OSError : it cannot be read.
    """
    size = path.stat().st_size
    if size == 0:
        return "it is empty"
    check = CHECKS.get(path.suffix.lower())
    if check is None:
        return None
    with path.open("rb") as file:
        return check(file, size)


def _png(file: BinaryIO, size: int) -> str | None:
    """A PNG ends with its last chunk."""
    begin = file.read(len(PNG_BEGIN))
    file.seek(max(size - len(PNG_END), 0))
    return None if begin == PNG_BEGIN and file.read() == PNG_END else "it is cut off"


def _mp4(file: BinaryIO, size: int) -> str | None:
    """An MP4 is a row of boxes, each of which says how long it is; "moov" says where the frames are."""
    at, kinds = 0, set()
    while at < size:
        file.seek(at)
        head = file.read(16)
        if len(head) < 8:
            return "it is cut off"
        length = int.from_bytes(head[:4], "big")
        if length == 1:
            length = int.from_bytes(head[8:16], "big")
        if length == 0:
            length = size - at
        if length < 8:
            return "it is damaged"
        kinds.add(head[4:8])
        at += length
    if at != size:
        return "it is cut off"
    return None if {b"moov", b"mdat"} <= kinds else "it has no frames"


def _glb(file: BinaryIO, size: int) -> str | None:
    """A binary glTF says how long it is."""
    head = file.read(12)
    whole = head[:4] == b"glTF" and int.from_bytes(head[8:12], "little") == size
    return None if whole else "it is cut off"


def _blend(file: BinaryIO, size: int) -> str | None:
    """A .blend that is not compressed ends with its last block; Blender itself says when it cannot save."""
    begin = file.read(8)
    if not begin.startswith((ZSTD, BLEND, GZIP)):
        return "it is damaged"
    if begin.startswith(BLEND):
        file.seek(max(size - 64, 0))
        return None if b"ENDB" in file.read() else "it is cut off"
    return None


def _parquet(file: BinaryIO, size: int) -> str | None:
    """A Parquet file begins and ends with its name."""
    begin = file.read(4)
    file.seek(max(size - 4, 0))
    return None if begin == file.read() == b"PAR1" else "it is cut off"


CHECKS: dict[str, Callable[[BinaryIO, int], str | None]] = {
    ".png": _png,
    ".mp4": _mp4,
    ".glb": _glb,
    ".blend": _blend,
    ".parquet": _parquet,
}
