"""What Blender does to a file while faces show previews: another frame, saving, undo, another file."""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ...scene.fingerprint import uid_of
from ...scene.live import preview
from ..active import all_objects, object_of
from ..blender_events import Handler, act_on
from ..blender_types import Scene
from ..changes import listen, listen_to_time
from ..session import begin_session, session
from . import live


def _after_frame(scene: Scene, *_: object) -> None:
    """Another frame: what is baked plays by itself, what is not is shown as it is laid out."""
    if not live.is_on() or bpy.app.is_job_running("RENDER"):
        return
    previews, active = session().previews, bpy.context.object
    previews.due.clear()
    if active is not None and live.held(active) is None:
        live.ask_to_play(active)
    for uid in previews.faces.uids:
        obj, face = object_of(uid), previews.faces.get(uid)
        if obj is not None and face is not None:
            live.play_or_rest(obj, face, scene)


def _after_update(*_: object) -> None:
    """Objects came or went: what is left of the preview of one that is gone goes, too."""
    previews, count = session().previews, len(bpy.data.objects)
    if count == previews.object_count or not previews.faces.uids:
        return
    previews.object_count = count
    gone = [uid for uid in previews.faces.uids if object_of(uid) is None]
    for uid in gone:
        previews.faces.forget(uid)
        previews.shown.pop(uid, None)
    if gone:
        preview.remove_unused()


def _before_undo(*_: object) -> None:
    """Remember who shows a preview."""
    showing = (uid_of(obj) for obj in all_objects() if obj.type == "MESH" and preview.is_shown(obj))
    session().previews.hidden = frozenset(showing)


def _before_save(*_: object) -> None:
    """Nothing of a preview goes into a file."""
    _before_undo()
    preview.remove_all()


def _after_save(*_: object) -> None:
    """Show again who did before, whether the file could be saved or not."""
    for obj in all_objects():
        if uid_of(obj) in session().previews.hidden:
            live.ask_again(obj)


def _after_undo(*_: object) -> None:
    """The file is another one now: those who showed a preview show it as it is now, the others themselves."""
    if not live.is_on():
        preview.remove_all()
        return
    for obj in all_objects():
        if uid_of(obj) in session().previews.hidden:
            live.ask_again(obj)
        elif obj.type == "MESH" and preview.is_shown(obj):
            preview.rest([obj])


def _after_load(*_: object) -> None:
    """Another file: nothing of the last one is known, and what a crash has left in this one goes."""
    live.end()
    begin_session()


def handlers() -> tuple[tuple[list[Handler], Handler], ...]:
    """Blender's events, and what is done then."""
    on = bpy.app.handlers
    return (
        (on.frame_change_post, _after_frame),
        (on.depsgraph_update_post, _after_update),
        (on.save_pre, _before_save),
        (on.save_post, _after_save),
        (on.save_post_fail, _after_save),
        (on.undo_pre, _before_undo),
        (on.redo_pre, _before_undo),
        (on.undo_post, _after_undo),
        (on.redo_post, _after_undo),
        (on.load_post, _after_load),
    )


def attach(undo: ExitStack) -> None:
    """Listen until undone, which clears up; a Blender without a window shows no preview."""
    undo.callback(_clear_up)
    listen(live.ask, undo)
    listen_to_time(live.replay, undo)
    if not bpy.app.background:
        for event, action in handlers():
            act_on(event, action, undo)


def _clear_up() -> None:
    """Nothing is due any more, and nothing shows."""
    if hasattr(bpy.data, "objects"):
        live.end()
    begin_session()
