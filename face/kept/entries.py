"""A folder of things that were worked out, one file each: checked whenever it is read, bounded, safe to delete.

A file begins with a mark, the digest of all that follows, and the length of its description; arrays come after that,
each where the description says. A file that is damaged, of another kind or of something else is as good as none. What
cannot be written is not kept, and all goes on without it.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from secrets import token_hex
from typing import Any

import numpy as np

from ...progress import Progress, Work
from .frozen import Frozen, NotPlainError, thawed

#: What a file of this kind begins with; another number for another kind.
MARK = b"Risorius kept 1\n"
DIGEST, LENGTH = 32, 8
SUFFIX = ".face"

#: Where arrays begin, in bytes, a multiple of this; so much is written at once.
ALIGNED, AT_ONCE = 64, 1 << 22

#: A folder holds no more than this, bytes; what was not used for longest goes.
MOST = 1 << 30

TEXT = "Keeping the prepared face"


class Entries:
    """Things kept in a folder by their keys (names of 64 hexadecimal digits)."""

    def __init__(self, folder: Path, most: int = MOST) -> None:
        self.folder, self.most = folder, most
        self.trouble = ""
        """Why the last thing could not be kept, in words; or nothing."""

    def read(self, key: str) -> Any:
        """The thing of a key; None where there is none that can be trusted."""
        path = self._path(key)
        try:
            content = np.fromfile(path, dtype=np.uint8)
            begin = len(MARK) + DIGEST
            mark, digest = content[: len(MARK)].tobytes(), content[len(MARK) : begin].tobytes()
            if mark != MARK or digest != sha256(content[begin:].data).digest():
                return None
            arrays = begin + LENGTH + int.from_bytes(content[begin : begin + LENGTH].tobytes(), "little")
            told = json.loads(content[begin + LENGTH : arrays].tobytes())
            if told["key"] != key:
                return None
            places = told["places"]

            def array(number: int, dtype: np.dtype[Any], shape: list[int]) -> Any:
                size = dtype.itemsize * math.prod(shape)
                return content[places[number] : places[number] + size].view(dtype).reshape(shape)

            thing = thawed(told["root"], told["nodes"], array)
        except (OSError, MemoryError, ValueError, TypeError, LookupError, AttributeError, ImportError, RecursionError):
            return None
        self._used(path)
        return thing

    def write(self, key: str, thing: object) -> Work[bool]:
        """Keep a thing, bit by bit; whether it is kept now. What was kept of that key stays until all is written."""
        self.trouble = ""
        try:
            frozen = Frozen(thing)
            places, size = _places(frozen.arrays)
            told = {"key": key, "root": frozen.root, "nodes": frozen.nodes, "places": places}
            head = json.dumps(told, separators=(",", ":")).encode()
            # Places are counted from the beginning of the file, whose description tells them: it gets room to spare.
            room = -(-(len(MARK) + DIGEST + LENGTH + len(head) + 12 * len(places)) // ALIGNED) * ALIGNED
            told["places"] = [room + place for place in places]
            head = json.dumps(told, separators=(",", ":")).encode().ljust(room - len(MARK) - DIGEST - LENGTH)
            if room + size > self.most:
                self.trouble = "the face is too large"
                return False
            return (yield from self._write(self._path(key), head, frozen.arrays))
        except NotPlainError as reason:
            self.trouble = str(reason)
        except OSError as reason:
            self.trouble = reason.strerror or str(reason)
        return False

    def _write(self, path: Path, head: bytes, arrays: Sequence[Any]) -> Work[bool]:
        """Write a file and put it in its place."""
        self.folder.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(f".{os.getpid()}-{token_hex(4)}.part")  # of another computer the number may be the same
        digest = sha256()
        try:
            with part.open("wb") as file:
                file.write(MARK + bytes(DIGEST))
                for piece, share in _pieces(head, arrays):
                    digest.update(piece)
                    file.write(piece)
                    yield Progress(share, TEXT)
                file.seek(len(MARK))
                file.write(digest.digest())
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
        self._make_room(path)
        return True

    def size(self) -> int:
        """How much is kept, bytes."""
        return sum(size for _, size, _ in self._files())

    def clear(self) -> int:
        """Delete all that is kept; returns how many files there were.

        Raises
        ------
        OSError : one cannot be deleted.
        """
        files = [*self._files(), *self._files(".part")]
        for _, _, path in files:
            path.unlink(missing_ok=True)
        return len(files)

    def _make_room(self, newest: Path) -> None:
        """Delete what was not used for longest, until no more is kept than may be."""
        files = sorted(self._files())
        size = sum(size for _, size, _ in files)
        for _, own, path in files:
            if size <= self.most:
                return
            if path != newest:
                path.unlink(missing_ok=True)
                size -= own

    def _files(self, suffix: str = SUFFIX) -> list[tuple[int, int, Path]]:
        """When each file was last used, its size, and where it is; other files in the folder are nobody's business."""
        found = []
        with suppress(OSError):
            for path in self.folder.iterdir():
                if path.suffix == suffix and len(path.name.split(".")[0]) == 2 * DIGEST:
                    with suppress(FileNotFoundError):  # another Blender has deleted it meanwhile
                        state = path.stat()
                        found.append((state.st_mtime_ns, state.st_size, path))
        return found

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}{SUFFIX}"

    def _used(self, path: Path) -> None:
        """Note that a file was used now, where that can be noted."""
        with suppress(OSError):
            os.utime(path)


def _places(arrays: Sequence[Any]) -> tuple[list[int], int]:
    """Where each array begins after the description, and how long all are, bytes."""
    places, size = [], 0
    for array in arrays:
        places.append(size)
        size += -(-array.nbytes // ALIGNED) * ALIGNED
    return places, size


def _pieces(head: bytes, arrays: Sequence[Any]) -> Iterator[tuple[bytes, float]]:
    """What a file holds after its digest, piece by piece, and the share that is written with each."""
    total = sum(array.nbytes for array in arrays) + len(head)
    yield len(head).to_bytes(LENGTH, "little") + head, len(head) / total
    done = len(head)
    for array in arrays:
        content = array.reshape(-1).view(np.uint8)
        for first in range(0, len(content), AT_ONCE):
            yield content[first : first + AT_ONCE].tobytes(), min(1.0, (done + first) / total)
        done += len(content)
        yield bytes(-len(content) % ALIGNED), done / total
