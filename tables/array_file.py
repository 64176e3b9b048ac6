"""Arrays in .npz files."""

from __future__ import annotations

import io
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import FormatError
from ..files import LARGEST_FILE, read_bytes

#: What a damaged archive makes Python's own readers raise: of ZIP, of its compression, of a header that is evaluated.
DAMAGE = (
    ValueError, TypeError, LookupError, OSError, EOFError, MemoryError, OverflowError, SyntaxError, RecursionError,
    NotImplementedError, RuntimeError, AttributeError, zipfile.BadZipFile, zlib.error,
)  # fmt: skip


def read_arrays(path: str | Path, *names: str) -> dict[str, npt.NDArray[Any]]:
    """Those of the named arrays that an .npz file has; nothing in it is run, and none is larger than a file may be.

    Raises
    ------
    FormatError : it cannot be read, or is not such a file.
    """
    data = io.BytesIO(read_bytes(path))
    try:
        with zipfile.ZipFile(data) as archive:
            sizes = {entry.filename: entry.file_size for entry in archive.infolist()}
            if sum(sizes.get(f"{name}.npy", 0) for name in names) > LARGEST_FILE:
                raise ValueError("its arrays are larger than any of use")
        with np.load(data, allow_pickle=False) as arrays:
            found = {name: np.asarray(arrays[name]) for name in names if f"{name}.npy" in sizes}
    except DAMAGE as error:
        raise FormatError(path, f"is not an .npz file of plain arrays ({str(error)[:200]}): export it again") from error
    return found
