"""The list of all that is done in a set: one JSON object a line, made from the records of the jobs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from ..errors import FormatError
from ..files import write_whole
from .jobs import Job
from .place import JobSet
from .records import read_record

NAME = "manifest.jsonl"


def write_manifest(jobs: Iterable[Job], place: JobSet, name: str = NAME) -> Path:
    """Write the list of those jobs that are done, whole or not at all.

    Raises
    ------
    FormatError : it cannot be written.
    """
    lines = []
    for job in jobs:
        try:
            record = read_record(place.place_of(job))
        except FormatError:
            continue  # damaged: the next run makes it again
        if record is not None:
            lines.append(json.dumps({**record.document(), "folder": job.id}, ensure_ascii=False))
    path = place.folder / name
    write_whole(path, "".join(f"{line}\n" for line in lines))
    return path
