"""Prepared faces of jobs: out of a folder, and kept there for the next time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ...progress import run
from .. import faces


@contextmanager
def kept_in(folder: Callable[[], Path | None]) -> Iterator[list[str]]:
    """Around a job: its faces come out of a folder, and those that it posed are kept there at its end.

    Where the user has set a folder in Blender, or that there is to be none, that counts. Yields a list, which holds at
    the end why faces could not be kept.
    """
    troubles = list[str]()
    with faces.kept_where_unset(folder):
        yield troubles
        troubles += run(faces.keep_posed_steps())
