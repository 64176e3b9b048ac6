"""A job is made by one process at a time: whoever holds the lock on its file.

The system lets go of a lock when the process that holds it ends, however it ends, so no claim outlives its owner.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from typing import IO


class Claim(Enum):
    """Whether a job may be made now."""

    HELD = "held"
    TAKEN = "taken by another process"
    UNKNOWN = "this file system knows no locks"


#: What a file system says that has no locks, and what one says whose lock another holds.
NO_LOCKS = {errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL}
LOCKED = {errno.EACCES, errno.EAGAIN, errno.EDEADLK}

if sys.platform == "win32":
    import msvcrt

    def _lock(file: IO[bytes]) -> None:
        """Lock a file for this process, or raise OSError."""
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(file: IO[bytes]) -> None:
        """Lock a file for this process, or raise OSError."""
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextlib.contextmanager
def claimed(path: Path) -> Iterator[Claim]:
    """Hold the lock on a file, which is made for it, as long as the block lasts, where nobody else holds it.

    Raises
    ------
    OSError : the file cannot be made.
    """
    while True:
        file = path.open("ab")
        try:
            claim = _tried(file)
            if claim is not Claim.HELD or _is_still(file, path):
                break
        except BaseException:
            file.close()
            raise
        file.close()  # the last owner has just removed it: take the next one
    try:
        yield claim
    finally:
        if claim is Claim.HELD and sys.platform != "win32":
            _remove(path)  # while it is locked, so that nobody's newer file is removed
        file.close()
        if claim is not Claim.TAKEN and sys.platform == "win32":
            _remove(path)


def _tried(file: IO[bytes]) -> Claim:
    """Try to lock a file."""
    try:
        _lock(file)
    except OSError as error:
        if error.errno in LOCKED:
            return Claim.TAKEN
        if error.errno in NO_LOCKS:
            return Claim.UNKNOWN
        raise
    return Claim.HELD


def _is_still(file: IO[bytes], path: Path) -> bool:
    """Whether an open file is the one that stands under its name."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), path.stat())
    except FileNotFoundError:
        return False


def _remove(path: Path) -> None:
    """Remove a file that is not needed any more; one that stays does no harm."""
    with contextlib.suppress(OSError):
        path.unlink()
