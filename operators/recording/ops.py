"""Operators that ask for a recording, and that import it; by menu, or by dropping a file on the viewport."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
from bpy.props import StringProperty

from ...arrays import Floats
from ...errors import FormatError
from ...face.tracked.formats import READABLE
from ...mpeg4 import fap, sequence_at
from ...progress import Progress, Work, part_of
from ...scene.bake.baking import BakeResult
from ...scene.bake.motion import FapMotion, at_rate
from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Event
from ...scene.points.found import Finding
from ..active import active_object
from ..annotated import Annotated
from ..bake.ops import BakeOperator
from ..bake.work import stream_work
from ..blender_classes import ImportHelper, Operator
from ..blender_types import Context, Object, Scene
from ..emotion.performance import performance_of
from .fields import OF_TRACKERS, RecordingFields, leaves_open

#: The share of reading a file in the whole.
READING = 0.1
#: FAPs that are named one by one.
LISTED = 4


class RecordingImport(RecordingFields, BakeOperator):
    """What importing and asking for it share."""

    title = "Importing the recording"

    filepath: Annotated[
        str, StringProperty(name="File", description="Recording to import", subtype="FILE_PATH", options={"SKIP_SAVE"})
    ]
    _said: tuple[str, ...] = ()

    @property
    def path(self) -> Path:
        """The file."""
        return Path(bpy.path.abspath(self.filepath))

    def show_apex(self, context: Context) -> None:
        """Stay at the frame: it is where the motion begins."""

    def finish(self, context: Context, result: BakeResult | Finding) -> str:
        """Say what the file left open, and what was written; keep it for the panel."""
        if not isinstance(result, Finding):
            for line in self._said:
                self.report({"WARNING"}, f"{self.path.name}: {line}")
            self.report({"INFO"}, f"{self.path.name}: {_motion_line(self.inertia)}")
            kept = active_object(context).risorius.recording
            kept.clip, kept.said = result.clip, "\n".join(self._said)
        return super().finish(context, result)

    def baking(self, context: Context) -> Work[BakeResult]:
        """Read the file, then show it at the scene's rate, from the current frame on."""
        from ... import api

        obj, scene, path = active_object(context), context.scene, self.path
        yield Progress(0.0, f"Reading {path.name}")
        recording = api.read_recording(path, **self.told())
        count, fps = len(recording.stream.frames), recording.stream.fps
        if count == 0:
            raise FormatError(path, "contains no frames")
        under = self._under(obj, scene, np.arange(count) / fps)
        frames, bridged = recording.played(under)
        self._said = (*recording.assumed, *bridged, *_from_timeline(recording.stream.frames, under))
        motion = FapMotion(at_rate(frames, fps, scene_fps(scene)), inertia=self.inertia)
        work = stream_work(obj, scene, motion, clip=path.stem, start=float(scene.frame_current))
        return (yield from part_of(work, READING, 1.0))

    def _under(self, obj: Object, scene: Scene, seconds: Floats) -> Floats | None:
        """(T, 68) FAPs of the timeline at (T,) seconds from the current frame on; None without clips."""
        if not (self.with_timeline and obj.risorius.timeline.clips):
            return None
        performance = performance_of(obj, scene)
        if not performance.cues:
            return None
        return sequence_at(
            performance.cues, seconds + (scene.frame_current - performance.first_frame) / performance.fps
        )


def _motion_line(inertia: bool) -> str:
    """How a recording was shown."""
    return "skin and jaw follow with inertia" if inertia else "each frame is shown as it is, without added inertia"


def _from_timeline(frames: Floats, under: Floats | None) -> list[str]:
    """What of the timeline shows because a recording never states it."""
    if under is None:
        return []
    numbers = 1 + np.flatnonzero(np.isnan(frames).all(axis=0) & ~np.isnan(under).all(axis=0))
    if not len(numbers):
        return []
    names = ", ".join(fap(int(number)).name for number in numbers[:LISTED])
    more = f" and {len(numbers) - LISTED} more" if len(numbers) > LISTED else ""
    return [f"from the timeline, as the recording does not have them: {names}{more}"]


class RISORIUS_OT_bake_recording(RecordingImport, Operator):
    """Bake a recording on the face, starting at the current frame"""

    bl_idname = "risorius.bake_recording"
    bl_label = "Bake Recording"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    def draw(self, context: Context) -> None:
        """What applies to the file."""
        self.draw_fields(self.layout, self.path, context.object)


class RISORIUS_OT_import_fap(RecordingImport, ImportHelper, Operator):
    """Import a recording of a face, starting at the current frame: MPEG-4 FAPs (.fap, .fba, .json, .csv), or the file \
of a tracker (Live Link Face, OpenFace, MediaPipe, Audio2Face ...)"""

    bl_idname = "risorius.import_fap"
    bl_label = "Import Recording"
    bl_options = {"REGISTER"}

    filename_ext = READABLE[0]
    filter_glob: Annotated[
        str, StringProperty(default=";".join(f"*{ending}" for ending in READABLE), options={"HIDDEN"})
    ]

    _was_asked_for = False

    def draw(self, context: Context) -> None:
        """What applies to the file that is chosen."""
        self.draw_fields(self.layout, _chosen(context) or self.path, context.object)

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the file or, where one was dropped that leaves something open, for that."""
        self._was_asked_for = not bpy.app.background and context.window is not None
        if not self.filepath:
            return ImportHelper.invoke(self, context, event)
        obj = context.object
        if self._was_asked_for and (leaves_open(self.path) or (obj is not None and obj.risorius.timeline.clips)):
            return context.window_manager.invoke_props_dialog(self)
        return self.execute(context)

    def run(self, context: Context) -> str:
        """Run straight through; where the user was asked, between events like any bake, which is undone in one step."""
        if not self._was_asked_for:
            return super().run(context)
        fields = {name: getattr(self, name) for name in (*OF_TRACKERS, "with_timeline", "steady", "inertia")}
        bpy.ops.risorius.bake_recording("INVOKE_DEFAULT", filepath=self.filepath, **fields)
        return f"Importing {self.path.name}"


def _chosen(context: Context) -> Path | None:
    """The file that is chosen in the file browser around, or None where there is none."""
    space = context.space_data
    chosen = space.params if space is not None and space.type == "FILE_BROWSER" else None
    return None if chosen is None else Path(bpy.path.abspath(chosen.directory.decode())) / chosen.filename
