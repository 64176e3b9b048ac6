"""Frames gathered one after another, and the tables that they become."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Floats, Ints
from ..face.products.efforts import Efforts, explaining_units, unit_names
from ..mpeg4 import FAPS, recognise
from .felt import COLUMNS as FELT
from .felt import Felt, columns_of
from .frames import CAMERA_COLUMNS, COLUMNS, Frame
from .marks import COLUMNS as MARKS
from .marks import KEY as MARKS_KEY
from .tables import Column, Kind, Table, Values, stacked

TIME = (
    Column("frame", Kind.INTEGER, "frame of the timeline"),
    Column("step", Kind.INTEGER, "frame of the video, from 0"),
    Column("time", Kind.NUMBER, "from the first frame of the video", "s", 6),
    Column("picture", Kind.TEXT, "names of pictures of this frame: pictures/KIND/NAME; empty where there are none"),
    Column("depth_step", Kind.NUMBER, "what 1 in a picture of depth stands for", "m", 6),
)
READ = (
    Column(
        "recognised",
        Kind.TEXT,
        "archetype that the FAPs achieved are most like, or neutral, by the robust rule: read back, not asked for",
    ),
)
JAW = (
    Column("jaw_opening", Kind.NUMBER, "angle by which the mandible is opened", "degree", 4),
    Column("jaw_left", Kind.NUMBER, "slide of the mandible to the subject's left", "mm", 4),
    Column("jaw_forward", Kind.NUMBER, "slide of the mandible forward", "mm", 4),
)
FRAME = Column("frame", Kind.INTEGER, "frame of the timeline, as in the table frames")
FAP = (
    FRAME,
    Column("fap", Kind.INTEGER, "number of the FAP"),
    Column("name", Kind.TEXT, "name of the FAP"),
    Column("asked", Kind.NUMBER, "as asked; empty where the request is silent", "FAP unit", 3),
    Column("goal", Kind.NUMBER, "what the plan of the face makes of it; empty where it knows nothing", "FAP unit", 3),
    Column(
        "achieved",
        Kind.NUMBER,
        "measured on the mesh of this frame, undivided; empty where it cannot be",
        "FAP unit",
        3,
    ),
)
UNIT = (
    FRAME,
    Column("unit", Kind.TEXT, "action unit of FACS, or a unit of Risorius' own (docs/labels.md)"),
    Column("side", Kind.TEXT, "left or right of the subject; empty where the unit has no sides"),
    Column("planned", Kind.NUMBER, "amount in the plan: 1 is a strong action; empty in drives that plan none", "", 4),
    Column("explained", Kind.NUMBER, "amount in the mixture that explains the FAPs achieved", "", 4),
)
MUSCLE = (
    FRAME,
    Column("muscle", Kind.TEXT, "muscle, movement of a lid, or jaw_open"),
    Column("side", Kind.TEXT, "left or right of the subject; empty where it has no sides"),
    Column("contraction", Kind.NUMBER, "0 relaxed to 1 fully contracted", "", 5),
)
SIDES = {"l": "left", "r": "right"}


@dataclass(eq=False)
class Record:
    """What has been seen of a motion so far.

    Attributes
    ----------
    felt, efforts : of every step of the motion. start : frame of its first step. fps : frames per second.
    """

    felt: Felt
    efforts: Efforts
    start: int
    fps: float
    _frames: list[Mapping[str, object]] = field(default_factory=list)
    _cameras: list[Mapping[str, object]] = field(default_factory=list)
    _marks: list[Mapping[str, Values]] = field(default_factory=list)
    _measured: list[Floats] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self._frames)

    def add(self, number: int, frame: Frame, *, picture: str = "", depth_step: float = np.nan) -> None:
        """Take in one frame of the timeline."""
        step = self._step(number)
        angle, left, forward = self.efforts.jaw[step]
        self._frames.append(
            {
                "frame": number,
                "step": len(self._frames),
                "time": (number - self.start) / self.fps,
                "picture": picture,
                "depth_step": depth_step,
                "jaw_opening": float(np.degrees(angle)),
                "jaw_left": 1e3 * float(left),
                "jaw_forward": 1e3 * float(forward),
                **self.felt.at(step),
                "recognised": _recognised(frame.measured),
                **frame.row(),
            }
        )
        self._cameras.append({"frame": number, **frame.camera()})
        marks = frame.landmarks()
        self._marks.append({"frame": np.full(len(marks["index"]), number), **marks})
        self._measured.append(frame.measured)

    def _step(self, number: int) -> int:
        """The step of the motion that a frame shows: the first before it begins, the last after its end."""
        return int(np.clip(number - self.start, 0, len(self.efforts.asked) - 1))

    def tables(self) -> list[Table]:
        """All tables."""
        frame_columns = (*TIME, *FELT, *READ, *JAW, *COLUMNS)
        numbers = np.array([row["frame"] for row in self._frames], dtype=np.int64)
        steps = np.array([self._step(number) for number in numbers.tolist()])
        measured = np.array(self._measured)
        return [
            Table("frames", "one frame", frame_columns, ("frame",), columns_of(self._frames, frame_columns)),
            self._camera_table(),
            self._faps(numbers, steps, measured),
            self._units(numbers, steps, measured),
            self._muscles(numbers, steps),
            Table("landmarks", "one landmark in one frame", MARKS, MARKS_KEY, stacked(self._marks)),
        ]

    def _camera_table(self) -> Table:
        values = columns_of(self._cameras, CAMERA_COLUMNS)
        return Table("camera", "the camera of one frame", CAMERA_COLUMNS, ("frame",), values)

    def _faps(self, numbers: Ints, steps: Ints, measured: Floats) -> Table:
        low = [fap for fap in FAPS.values() if not fap.high_level]
        rows = [fap.number - 1 for fap in low]
        values: dict[str, Values] = {
            "frame": np.repeat(numbers, len(low)),
            "fap": np.tile([fap.number for fap in low], len(numbers)),
            "name": [fap.name for fap in low] * len(numbers),
            "asked": self.efforts.asked[steps][:, rows].ravel(),
            "goal": self.efforts.goals[steps][:, rows].ravel(),
            "achieved": measured[:, rows].ravel(),
        }
        return Table("faps", "one FAP in one frame", FAP, ("frame", "fap"), values)

    def _units(self, numbers: Ints, steps: Ints, measured: Floats) -> Table:
        names = unit_names()
        explained = explaining_units(measured)
        values = {
            **_named(numbers, names, "unit"),
            "planned": np.stack([self.efforts.units[name][steps] for name in names], axis=1).ravel(),
            "explained": np.stack([explained[name] for name in names], axis=1).ravel(),
        }
        return Table("action_units", "one action unit in one frame", UNIT, ("frame", "unit", "side"), values)

    def _muscles(self, numbers: Ints, steps: Ints) -> Table:
        names = tuple(self.efforts.contractions)
        contractions = np.stack([self.efforts.contractions[name][steps] for name in names], axis=1)
        values = {**_named(numbers, names, "muscle"), "contraction": contractions.ravel()}
        return Table("muscles", "one muscle in one frame", MUSCLE, ("frame", "muscle", "side"), values)


def _recognised(measured: Floats) -> str:
    """What a face shows, read off its FAPs (68,); "" where too few could be measured."""
    best = recognise(measured, rule="robust").best
    return "" if best is None else str(best)


def _named(numbers: Ints, names: tuple[str, ...], what: str) -> dict[str, Values]:
    """Columns of frames, names and sides."""
    plain = [name.rpartition("_") if name[-2:] in ("_l", "_r") else (name, "", "") for name in names]
    return {
        "frame": np.repeat(numbers, len(names)),
        what: [name for name, _, _ in plain] * len(numbers),
        "side": [SIDES.get(side, "") for _, _, side in plain] * len(numbers),
    }
