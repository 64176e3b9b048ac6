"""What a batch reads: tables of jobs, designs as files and as lines, records of what is done."""

from __future__ import annotations

import contextlib
import itertools
import json
from pathlib import Path

from risorius.batch.design import read_design, rows_of
from risorius.batch.jobs import Job
from risorius.batch.records import RECORD, Record, Written, damage, read_record, record_bytes
from risorius.batch.table import read_jobs
from risorius.errors import ParameterError, RisoriusError

from .attempts import Reader

#: Rows of a design that are made.
MADE = 40

CSV = """# a few clips
id,emotion,angle,activation,fap,text,seed,size,yaw,outputs,note
a,joy,,5,,,1,64,-20,"film still",first
b,,120,3,,,,128x64,10.5,labels,"two, words"
c,,,,take.fap,,,,,fap,
d,anger,,,,"Well, who is there?",7,,,film blend,
"""
TOML = """[defaults]
size = 64
outputs = ["still", "fap"]

[[jobs]]
id = "a"
emotion = "joy"
activation = 5.5

[[jobs]]
text = "Hello"
light = "soft"
skin_colour = "#c58c6e"
"""
DESIGN = """kind = "counterbalanced"
count = 12
draw = 3

[factors]
emotion = ["joy", "fear"]
activation = { least = 3, most = 7, steps = 3 }
yaw = { least = -30, most = 30 }

[constants]
size = 64
outputs = ["film", "labels"]
"""
LINES = {
    "grid.txt": b"emotion=joy,fear,anger activation=3..7/5 seed=0..99 outputs=film+labels repeats=2",
    "random.txt": b"emotion=joy,fear yaw=-30..30 seed=0..9999 kind=random count=20 draw=3",
    "balanced.txt": b"emotion=joy,fear activation=3,5 pitch=-9.5..9.5/3 kind=counterbalanced count=9",
}


def batch_readers() -> list[Reader]:
    """A reader for each."""
    record = Record(
        "a", {"emotion": "joy", "seed": 3}, "f" * 64, {}, {"clip.fap": Written(12, "0" * 64)}, {"clip.fap": "1" * 64},
        {"risorius": "0.2.0"}, 1.5, 1e9, 25, ("a remark",),
    )  # fmt: skip
    designs = {"design.toml": DESIGN.encode()}
    return [
        Reader("jobs", jobs, {"jobs.csv": CSV.encode(), "semicolons.csv": CSV.replace(",", ";").encode(),
                              "jobs.toml": TOML.encode()}),
        Reader("design", lambda path: design(str(path)), designs),
        Reader("design_line", lambda path: design(path.read_bytes().decode("utf-8", "replace")), LINES),
        Reader("record", recorded, {RECORD: record_bytes(record)}),
    ]  # fmt: skip


def jobs(path: Path) -> object:
    """A table of jobs; of each what it says, and by what it is known again. One wrong row does not hide the others."""
    (path.parent / "take.fap").write_bytes(b"# a stream")
    table = read_jobs(path)
    for problem in table.problems:
        assert len(str(problem)) < 2000, "a message that nobody reads"
        assert path.name in str(problem), f"a message that does not name the file: {problem}"
    return [_known(job) for job in table.jobs]


def _known(job: Job) -> object:
    """A job as it is written and shown."""
    said = json.dumps(job.said(), allow_nan=False)
    assert len({job.id, job.fingerprint()}) == 2
    with contextlib.suppress(OSError):
        job.digests()
    return job.values, json.loads(said)


def design(said: str) -> object:
    """The first rows of a design, as a table reads them."""
    found = read_design(said)
    if not 0 < found.row_count <= 1_000_000:
        raise ParameterError("rows", "must be some", found.row_count)
    return found.row_count, list(itertools.islice(rows_of(found), MADE))


def recorded(path: Path) -> object:
    """The record of a folder, written anew and looked up."""
    found = read_record(path.parent)
    if found is None:
        raise RisoriusError("no record")
    json.dumps(found.document(), allow_nan=False)
    return found, damage(path.parent, found)
