"""What a recording may leave open, as fields of the operators that import it; shown where they apply to the file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TypedDict

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ...errors import RisoriusError
from ..annotated import Annotated
from ..blender_types import Object, UILayout

#: Fields that only the files of trackers have, in the order in which they are drawn.
OF_TRACKERS = ("rate", "start", "face", "neutral", "flip")


class Told(TypedDict):
    """The fields of a tracker's file, as `api.read_recording` wants them."""

    rate: float | None
    start: str | None
    face: int | None
    neutral: int | None
    flip: tuple[str, ...]
    steady: bool


class RecordingFields:
    """Mix into operators that import recordings. What is not set is as the file says."""

    rate: Annotated[
        float,
        FloatProperty(
            name="Rate",
            description="Frames per second of the recording. 0: as its times, timecodes or frame numbers show",
            default=0.0,
            min=0.0,
            soft_max=120.0,
            precision=3,
            options={"SKIP_SAVE"},
        ),
    ]
    start: Annotated[
        str,
        StringProperty(
            name="Start At",
            description="Where in the recording to start: seconds of its own times, or a timecode. Empty: the first "
            "row",
            options={"SKIP_SAVE"},
        ),
    ]
    face: Annotated[
        int,
        IntProperty(
            name="Face Number",
            description="Which face of a recording of several faces, by its number or its place in a frame. -1: the "
            "only one",
            default=-1,
            min=-1,
            options={"SKIP_SAVE"},
        ),
    ]
    neutral: Annotated[
        int,
        IntProperty(
            name="Neutral Frame",
            description="Frame of the recording, from 0, in which the face is neutral: what shows there is subtracted "
            "from every frame. -1: as the tracker says",
            default=-1,
            min=-1,
            options={"SKIP_SAVE"},
        ),
    ]
    flip: Annotated[
        set[str],
        EnumProperty(
            name="Flip",
            description="Turns that the recording has the other way round",
            items=(
                ("yaw", "Head Yaw", "Turn the head to the other side"),
                ("pitch", "Head Pitch", "Turn the head down instead of up"),
                ("roll", "Head Roll", "Tilt the head to the other shoulder"),
                ("eye_yaw", "Eye Yaw", "Turn the eyes to the other side"),
                ("eye_pitch", "Eye Pitch", "Turn the eyes down instead of up"),
            ),
            options={"ENUM_FLAG", "SKIP_SAVE"},
        ),
    ]
    with_timeline: Annotated[
        bool,
        BoolProperty(
            name="With Timeline",
            description="Show the clips of the timeline in what the recording does not know: motions that its tracker "
            "cannot see, and times in which it lost the face",
            default=True,
            options={"SKIP_SAVE"},
        ),
    ]

    steady: Annotated[
        bool,
        BoolProperty(
            name="Steady",
            description="Take out the trembling of a tracker. Blinks and closing lips keep their time and their edge",
            default=False,
            options={"SKIP_SAVE"},
        ),
    ]
    inertia: Annotated[
        bool,
        BoolProperty(
            name="Inertia",
            description="Add the inertia of skin and jaw, for streams that were computed without any. Turn off for "
            "recordings: a recorded face has moved with its own, and lips and lids would come late",
            default=False,
            options={"SKIP_SAVE"},
        ),
    ]

    def told(self) -> Told:
        """What is set, for `api.read_recording`."""
        return {
            "rate": float(self.rate) or None,
            "start": str(self.start).strip() or None,
            "face": None if self.face < 0 else int(self.face),
            "neutral": None if self.neutral < 0 else int(self.neutral),
            "flip": tuple(sorted(self.flip)),
            "steady": bool(self.steady),
        }

    def draw_fields(self, layout: UILayout, path: Path, obj: Object | None) -> None:
        """Those that apply to a file and a face."""
        layout.use_property_split, layout.use_property_decorate = True, False
        if leaves_open(path):
            for name in OF_TRACKERS:
                (layout.column() if name == "flip" else layout).prop(self, name)
        if obj is None:
            return
        if obj.risorius.timeline.clips:
            layout.prop(self, "with_timeline")
        layout.prop(self, "steady")
        layout.prop(self, "inertia")
        layout.prop(obj.risorius.bake, "onto")


def leaves_open(path: Path) -> bool:
    """Whether a file is a tracker's, and may leave things open; not one that cannot be read."""
    try:
        state = path.stat()
    except OSError:
        return False
    return path.is_file() and _leaves_open(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=8)
def _leaves_open(path: Path, changed: int, size: int) -> bool:
    """As `leaves_open`, looked at once for each state of a file: panels are drawn often."""
    from ...face.tracked.opening import states_all

    try:
        return not states_all(path)
    except RisoriusError:
        return False
