"""The verb of Face Animation Tables: tables."""

from __future__ import annotations

import argparse
from pathlib import Path

from .options import Verbs, add_face, face_to_pose, verb
from .progress import when_slow
from .result import Result, UsageError


def add_table_verb(verbs: Verbs) -> None:
    """Add tables to the verbs."""
    tables = verb(verbs, "tables", _tables)
    add_face(tables)
    tables.add_argument(
        "--out", type=Path, required=True, help="the file to write: .json, or .wrl or .txt for BIFS nodes"
    )
    tables.add_argument("--steps", type=int, default=4, help="intervals on either side of 0 (default: 4)")
    tables.add_argument("--faps", type=int, nargs="+", help="FAP numbers (default: all)")
    about = "still: other points keep their place (default); free: they follow skin and jaw"
    tables.add_argument("--others", choices=("still", "free"), default="still", help=about)


def _tables(arguments: argparse.Namespace) -> Result:
    """Write Face Animation Tables: the effect of every FAP on every vertex, for players without muscles."""
    from .. import api

    suffix = arguments.out.suffix.lower()
    writers = {
        ".json": api.write_animation_tables,
        ".wrl": api.write_face_def_tables,
        ".txt": api.write_face_def_tables,
    }
    if suffix not in writers:
        raise UsageError(f"--out must end in {', '.join(writers)}")
    options = {"faps": arguments.faps} if arguments.faps else {}
    with face_to_pose(arguments) as face:
        tables = api.face_animation_tables(
            face, steps=arguments.steps, others=arguments.others, progress=when_slow(), **options
        )
    writers[suffix](arguments.out, tables)
    rows = {
        number: {
            "name": api.fap(number).name,
            "vertices": len(table.vertices),
            "rms_mm": 1e3 * table.error.rms if table.error else None,
            "largest_mm": 1e3 * table.error.largest if table.error else None,
        }
        for number, table in tables.tables.items()
    }
    lines = [f"{len(rows)} tables of {len(tables.vertices)} vertices; error between borders, rms and largest:"]
    lines += [
        f"F{number:<3} {row['name']:<24} {row['vertices']:6d} vertices {row['rms_mm']:7.3f} {row['largest_mm']:7.3f} mm"
        for number, row in rows.items()
    ]
    return Result({"out": arguments.out, "tables": rows}, [*lines, f"wrote {arguments.out}"])
