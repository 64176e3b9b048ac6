"""Files written whole or not at all, and read with errors that name the file and the remedy; a folder for the while."""

from __future__ import annotations

import contextlib
import errno
import os
import re
import select
import stat
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path

from .errors import FormatError, RisoriusError
from .resources import PRESETS, STANDARD

#: Bytes of the largest file that is read: more than any of use has.
LARGEST_FILE = 1 << 30
#: Seconds until something is written to a pipe.
PATIENCE = 10.0
#: Bytes read at once of what does not tell its size.
AT_ONCE = 1 << 22


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write a file, replacing an older one only once the new one is complete; text as UTF-8, lines end as they stand.

    Raises
    ------
    FormatError : the file cannot be written; an older one is as it was.
    """
    file, draft = Path(path), None
    try:
        data = content.encode("utf-8") if isinstance(content, str) else content
        draft = _draft_of(file)
        draft.write_bytes(data)
        os.replace(draft, file)
    except (OSError, ValueError) as error:
        if draft is not None:
            with contextlib.suppress(OSError, ValueError):  # what keeps it from being written may keep it from going
                draft.unlink()
        if isinstance(error, OSError):
            problem = f"cannot be written ({error.strerror}): choose a folder you may write to"
        else:  # a name that is empty or has a null character; letters that are none, in the name or the text
            problem = f"cannot be written ({error}): choose another name"
        raise FormatError(file, problem) from error


def _draft_of(file: Path) -> Path:
    """Where a file is written until it is whole: beside it, under a name that no neighbour and no process shares.

    Not with_suffix: a name without an extension, or with two, must not collide with a neighbour. A name that is almost
    as long as systems take is cut.
    """
    name = file.name
    if len(os.fsencode(name)) > LONGEST_BYTES:
        name = f"{name[:LONGEST_CUT]}-{zlib.crc32(os.fsencode(name)):08x}"
    return file.with_name(f".{name}.{os.getpid()}.draft")


@contextlib.contextmanager
def scratch_folder() -> Iterator[Path]:
    """A folder for what is needed for a while; it is gone afterwards.

    Raises
    ------
    RisoriusError : there is no folder for temporary files that can be written to.
    """
    try:
        folder = tempfile.TemporaryDirectory(prefix="risorius-", ignore_cleanup_errors=True)
    except OSError as error:
        remedy = "set TMPDIR (Windows: TEMP) to a folder that you may write to, or make room on its disk"
        raise RisoriusError(f"temporary files: cannot be written ({error.strerror or error}): {remedy}") from error
    with folder as name:
        yield Path(name)


def read_bytes(path: str | Path) -> bytes:
    """The bytes of a file.

    Raises
    ------
    FormatError : it cannot be read, or is larger than any file of use.
    """
    file = Path(path)
    try:
        with open(file, "rb", opener=_opened_at_once) as source:
            size = os.fstat(source.fileno()).st_size
            _wait_for_writer(source.fileno())
            pieces, left = list[bytes](), LARGEST_FILE + 1
            # A pipe or a device tells no size, and may never end.
            while size <= LARGEST_FILE and left and (piece := source.read(min(left, max(size + 1, AT_ONCE)))):
                pieces.append(piece)
                left -= len(piece)
    except (OSError, ValueError) as error:  # ValueError: a path with a null character
        remedy = "give a file that you may read"
        with contextlib.suppress(OSError, ValueError, RuntimeError):  # RuntimeError: links that lead in a circle
            own = any(file.resolve().is_relative_to(tables) for tables in (PRESETS, STANDARD))
            remedy = "install Risorius again" if own else remedy
        reason = error.strerror if isinstance(error, OSError) else error
        raise FormatError(file, f"cannot be read ({reason}): {remedy}") from error
    if size > LARGEST_FILE or not left:
        raise FormatError(file, f"is larger than {LARGEST_FILE >> 30} GiB: cut it into parts")
    return pieces[0] if len(pieces) == 1 else b"".join(pieces)


def _opened_at_once(path: str, flags: int) -> int:
    """Open a file; a pipe without waiting for whoever writes to it."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _wait_for_writer(descriptor: int) -> None:
    """Of a pipe, wait until something is written to it, or it is at its end; then read on as of any file.

    Raises
    ------
    OSError : nobody writes to it.
    """
    if not hasattr(os, "O_NONBLOCK"):
        return
    if stat.S_ISFIFO(os.fstat(descriptor).st_mode) and not select.select([descriptor], [], [], PATIENCE)[0]:
        raise OSError(errno.ETIMEDOUT, "it is a pipe to which nobody writes")
    os.set_blocking(descriptor, True)


#: Names that Windows gives to devices, whatever ending stands behind them.
DEVICES = {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
#: Letters of a name that every file system takes, with its ending and what is put before it, and its bytes as UTF-8.
LONGEST_NAME, LONGEST_BYTES = 100, 200
#: Letters of a longer name that stay in that of its draft.
LONGEST_CUT = 24


def safe_stem(name: str, otherwise: str) -> str:
    """A file's name without its ending, of what a user calls it: one that every system takes."""
    stem = re.sub(r"[^\w\- ]", "_", name)[:LONGEST_NAME]
    stem = stem.encode()[:LONGEST_BYTES].decode(errors="ignore").strip() or otherwise
    return f"{stem}_" if stem.casefold() in DEVICES else stem
