"""The list of all that is done in a set: one JSON object a line, made from the records of the jobs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from ..errors import FormatError
from ..files import write_whole
from .jobs import Job
from .place import JobSet
from .records import RECORD, read_record

NAME = "manifest.jsonl"


def write_manifest(jobs: Iterable[Job], place: JobSet, name: str = NAME) -> Path:
    """Write the list of those jobs that are done, whole or not at all.

    A set's own manifest lists what earlier tables made there, too, after the jobs of this one; that of a shard its jobs
    alone.

    Raises
    ------
    FormatError : it cannot be written.
    """
    folders = [place.place_of(job) for job in jobs]
    if name == NAME:
        there = set(folders)
        folders += sorted(record.parent for record in place.folder.glob(f"*/{RECORD}") if record.parent not in there)
    lines = []
    for folder in folders:
        try:
            record = read_record(folder)
        except FormatError:
            continue  # damaged: the next run makes it again
        if record is not None:
            lines.append(json.dumps({**record.document(), "folder": folder.name}, ensure_ascii=False))
    path = place.folder / name
    write_whole(path, "".join(f"{line}\n" for line in lines))
    return path
