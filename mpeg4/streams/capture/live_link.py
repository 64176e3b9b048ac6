"""ARKit blend shapes in CSV: Live Link Face's recordings, and any table with columns of ARKit's names.

Live Link Face writes ``Timecode`` (HH:MM:SS:FF.fraction), ``BlendShapeCount``, the 52 blend shapes in PascalCase and
nine rotations. Units and signs of the rotations stand in presets/capture/live_link.toml, their evidence in
docs/formats.md; versions of the app and ways to hold the phone differ.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ....arrays import Bools, Floats
from ....errors import FormatError
from ....tables import TomlTable, read_toml
from ...standard import FAP_COUNT
from .faces import one_face
from .rotation import in_radians
from .row_names import says_unseen, tells_of_a_row
from .samples import Samples
from .scores import faps_of_scores, unread_words
from .shape_names import means_nothing, shape_named
from .shapes import CAPTURE_PRESETS, fap_frame
from .stamps import table_times
from .table_file import TableFile

#: How many blend shapes a row of Live Link Face has.
COUNT = "BlendShapeCount"


def holds_arkit(table: TableFile) -> bool:
    """Whether a CSV has columns of ARKit's blend shapes."""
    return any(shape_named(name) is not None for name in table.columns)


def read_arkit(
    table: TableFile,
    *,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
    preset: Path | None = None,
) -> Samples:
    """The samples of a table of ARKit blend shapes.

    Parameters
    ----------
    rate, start : see `times.placed` and `times.Times.since_first`. face : see `faces.one_face`.
    preset : the table of rotations; by default presets/capture/live_link.toml.

    Raises
    ------
    FormatError : no column of a blend shape; a score that is none; a timecode that is none; times that do not rise.
    """
    table = one_face(table, face)
    rotations = read_toml(preset or CAPTURE_PRESETS / "live_link.toml")
    turns, silent = rotations.tables("rotations"), {name.lower() for name in rotations.texts("silent")}
    silent |= {name.lower() for name in turns}
    shapes = [name for name in table.columns if shape_named(name) is not None]
    others = [
        name
        for name in table.columns
        if name not in shapes and name.lower() not in silent and not tells_of_a_row(name) and not means_nothing(name)
    ]
    if not shapes:
        raise FormatError(table.path, "has no column of an ARKit blend shape, such as jawOpen", line=1)
    frames, assumed, unread = faps_of_scores(table.several(shapes), table.refusal, per_cent=table.per_cent)
    angles, in_degrees = in_radians(table.several(turns), table.refusal)
    turned_frames = faps_of_turns(angles, len(table.rows), turns)
    frames = np.where(np.isnan(frames), turned_frames, frames)
    frames[_faceless(table)] = np.nan
    times = table_times(table, rate)
    said = (*times.assumed, *assumed, *in_degrees, *unread_words([*others, *unread]))
    return Samples.at_times(replace(times, assumed=said), frames[times.rows], start=start)


def _faceless(table: TableFile) -> Bools:
    """(T,) rows in which the app saw no face: it counts no blend shapes in them, or says so."""
    unseen = [any(says_unseen(name, cell) for name, cell in zip(table.columns, row, strict=True)) for row in table.rows]
    uncounted = table.numbers(COUNT) <= 0.0 if COUNT in table else False
    return np.asarray(np.array(unseen, dtype=np.bool_) | uncounted)


def faps_of_turns(columns: Mapping[str, Floats], count: int, turns: Mapping[str, TomlTable] | None = None) -> Floats:
    """(T, 68) FAPs of columns of rotations (T,), named as in the preset, in any case; NaN elsewhere."""
    rows = live_link_turns() if turns is None else turns
    known = {name.lower(): values for name, values in columns.items()}
    frames = np.full((count, FAP_COUNT), np.nan)
    for name, row in rows.items():
        if name.lower() in known:
            gains = fap_frame(row)
            for place in np.flatnonzero(~np.isnan(gains)):
                frames[:, place] = known[name.lower()] * gains[place]
    return frames


def live_link_turns() -> Mapping[str, TomlTable]:
    """The rows of presets/capture/live_link.toml."""
    return read_toml(CAPTURE_PRESETS / "live_link.toml").tables("rotations")
