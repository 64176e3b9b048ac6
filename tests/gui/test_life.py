"""Work, previews, clips and speech in a real window while others undo, disable the extension, open a file, press Esc.

Whatever is going on then, no operator, function or status text of ours is left, and nothing is half changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from window.driver import Window

#: What the other scripts are made of; the window knows it from the first test on.
WORDS = """
import sys

MODULE = "bl_ext.user_default.risorius"
status = [None]
status_text_set = bpy.types.WorkSpace.status_text_set


def noted(workspace, text):
    status[0] = text
    return status_text_set(workspace, text)


bpy.types.WorkSpace.status_text_set = noted


def part(name):
    return sys.modules[f"{MODULE}.{name}"]


def head():
    return bpy.data.objects.get("Risorius Head")


def act(operator, *given, **named):
    room, name = operator.split(".")
    with in_viewport():
        return getattr(getattr(bpy.ops, room), name)(*given, **named)


def running():
    "Our operators that hear the window's events."
    return [op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators if "RISORIUS" in op.bl_idname]


def timers():
    "Our functions that Blender would call after a while."
    waiting = (part("operators.preview.live")._answer, part("operators.read.live")._read)
    return [function.__qualname__ for function in waiting if bpy.app.timers.is_registered(function)]


def listeners():
    "Our functions among Blender's handlers."
    events = [getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)]
    ours = [f for event in events if isinstance(event, list) for f in event if f.__module__.startswith(MODULE)]
    return sorted(function.__qualname__ for function in ours)


def traces():
    "What there is of previews, and of scenes for passing work."
    left = [m.name for obj in bpy.data.objects for m in obj.modifiers if m.name.startswith("Risorius Preview")]
    left += [mesh.name for mesh in bpy.data.meshes if "risorius_preview" in mesh.attributes]
    left += [tree.name for tree in bpy.data.node_groups if tree.name.startswith("Risorius Preview")]
    return left + [scene.name for scene in bpy.data.scenes[1:]]


def shows():
    return any(m.name.startswith("Risorius Preview") and m.show_viewport for m in head().modifiers)


def preview(on):
    bpy.context.window_manager.risorius.preview.show = on


def content():
    "What a bake, an import or speech would change."
    keys, face = head().data.shape_keys, head().risorius
    return {
        "keys": [key.name for key in keys.key_blocks] if keys else [],
        "actions": sorted(action.name for action in bpy.data.actions),
        "clips": len(face.timeline.clips),
        "strips": len(face.speech.strips),
        "clip": face.recording.clip,
        "at": round(head().location.x, 3),
    }


def heard():
    editor = bpy.context.scene.sequence_editor
    return [] if editor is None else list(editor.strips if hasattr(editor, "strips") else editor.sequences)


def moved_then_back(x):
    "Two steps of undo: where the head is, and where it was moved to."
    act("ed.undo_push", message="begun")
    head().location.x = x
    act("ed.undo_push", message="moved")
"""
ROWS = [f"{n / 30:.4f},{n / 60:.3f}" for n in range(90)]
#: Seconds for what takes one or two on a computer that has nothing else to do.
SOON = 40.0
DISABLE = "bpy.ops.preferences.addon_disable(module=MODULE)"
ENABLE = "bpy.ops.preferences.addon_enable(module=MODULE)"
#: All of ours that may be left behind.
LEFT = "result = [running(), part('operators.held').held_now(), timers(), status[0], traces()]"
NOTHING = [[], 0, [], None, []]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording, and later the file that every test begins with."""
    made = tmp_path_factory.mktemp("life")
    (made / "take.csv").write_text("\n".join(["time,mouthSmileLeft", *ROWS]) + "\n", encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def opened(blender: Path, settings: Path, folder: Path) -> Iterator[Window]:
    """The window, open until the last test."""
    with Window(blender, settings, folder / "asked") as window:
        window.ask(WORDS)
        window.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        window.ask("preview(False); act('risorius.add_head')")
        window.ask("viewport()[1].spaces.active.show_region_ui = True")
        window.ask("head().risorius.emotion.word = 'joy'")
        window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={str(folder / 'start.blend')!r})")
        yield window


@pytest.fixture
def window(opened: Window, folder: Path) -> Window:
    """The window with the default head in it, and the preview off."""
    reopen(opened, folder)
    opened.ask("preview(False); status[0] = None")
    return opened


def reopen(window: Window, folder: Path) -> None:
    """Open the file anew."""
    window.ask(f"bpy.ops.wm.open_mainfile(filepath={str(folder / 'start.blend')!r})")


def until(window: Window, expression: str) -> None:
    """Wait for something that is a matter of seconds."""
    window.wait(expression, SOON)


def content(window: Window) -> dict[str, Any]:
    """What there is of bakes, clips and speech."""
    found: dict[str, Any] = window.ask("result = content()")
    return found


def disabled_and_enabled(window: Window, *, leaves: list[Any] = NOTHING) -> None:
    """Disable the extension, see that it is gone, and enable it again."""
    window.ask("before = listeners()")
    window.ask(DISABLE)
    try:
        assert window.ask("result = listeners()") == []
        assert window.ask(LEFT) == leaves
    finally:
        window.ask(ENABLE)
    assert window.ask("result = listeners() == before")


def escaped(window: Window, folder: Path) -> None:
    window.key("Escape")


def undone(window: Window, folder: Path) -> None:
    window.ask("act('ed.undo')")
    until(window, "not running()")
    assert content(window)["at"] == 0.0
    window.ask("act('ed.redo')")


def disabled(window: Window, folder: Path) -> None:
    disabled_and_enabled(window)


def other_file(window: Window, folder: Path) -> None:
    reopen(window, folder)
    window.ask("moved_then_back(0.5)")


ENDINGS = {"bake_motion": (escaped, undone, disabled, other_file), "bake_recording": (escaped, disabled)}


@pytest.mark.parametrize(
    ("work", "end"),
    [(work, end) for work, ends in ENDINGS.items() for end in ends],
    ids=lambda part: part if isinstance(part, str) else part.__name__,
)
def test_work_that_is_ended_leaves_nothing(
    window: Window, folder: Path, work: str, end: Callable[[Window, Path], None]
) -> None:
    """Between its steps, on an event of the window."""
    window.ask("moved_then_back(0.5)")
    before = content(window)
    told = f", filepath={str(folder / 'take.csv')!r}" if work == "bake_recording" else ""
    window.ask(f"act('risorius.{work}', 'INVOKE_DEFAULT'{told})")
    until(window, "bool(running()) and status[0] is not None and '%' in status[0]")
    end(window, folder)
    until(window, "not running()")
    assert window.ask(LEFT) == NOTHING
    assert content(window) == before


def test_a_preview_goes_and_comes_with_the_extension(window: Window) -> None:
    previewed(window)
    disabled_and_enabled(window)
    previewed(window, "fear")


def previewed(window: Window, word: str = "surprise") -> None:
    """Turn the preview on, and let it show an expression."""
    window.ask(f"preview(True); head().risorius.emotion.word = {word!r}")
    until(window, "shows() and not timers()")


def test_disabling_while_a_face_is_prepared_frees_the_status_bar(window: Window) -> None:
    window.ask("part('scene.faces').forget_faces(); bpy.ops.risorius.clear_kept_faces()")
    window.ask("preview(True); head().risorius.emotion.word = 'anger'")
    until(window, "status[0] is not None and 'Preparing' in status[0]")
    disabled_and_enabled(window)


def test_a_preview_outlives_undo_and_goes_with_its_object(window: Window) -> None:
    previewed(window)
    window.ask("moved_then_back(0.5)")
    window.ask("act('ed.undo')")
    until(window, "shows() and not timers()")
    assert content(window)["at"] == 0.0
    window.ask("bpy.data.objects.remove(head())")
    until(window, "not traces()")
    assert window.ask(LEFT) == NOTHING


def test_a_preview_is_as_before_after_a_save_that_fails(window: Window, folder: Path) -> None:
    previewed(window)
    window.ask("act('risorius.add_clip')")
    until(window, "shows() and not timers()")
    before = content(window)
    said = window.ask(f"""
try:
    bpy.ops.wm.save_as_mainfile(filepath={str(folder / "no such folder" / "a.blend")!r}, copy=True)
except RuntimeError as refusal:
    result = str(refusal)
""")
    assert "Cannot open file" in said
    until(window, "shows() and not timers()")
    assert content(window) == before


def test_clips_that_play_unbaked_stop_with_the_extension(window: Window) -> None:
    window.ask("preview(True); act('risorius.add_clip')")
    window.ask("bpy.context.scene.frame_end = 60; act('screen.animation_play')")
    until(window, "shows()")
    disabled_and_enabled(window)
    frame = window.ask("result = bpy.context.scene.frame_current")
    until(window, f"bpy.context.scene.frame_current != {frame}")
    window.ask("act('screen.animation_cancel', restore_frame=False)")
    assert content(window)["clips"] == 1


def test_speech_that_is_previewed_outlives_its_sound_and_undo(window: Window) -> None:
    window.ask("preview(True); head().risorius.speech.text = 'Pat my map.'; bpy.context.scene.frame_set(1)")
    window.ask("act('risorius.add_speech'); act('ed.undo_push', message='Said')")
    window.ask("bpy.context.scene.frame_set(12)")
    until(window, "shows()")
    assert window.ask("result = len(heard())") == 1
    window.ask("""
editor = bpy.context.scene.sequence_editor
(editor.strips if hasattr(editor, "strips") else editor.sequences).remove(heard()[0])
act("ed.undo_push", message="Removed its sound")
head().risorius.speech.strips[0].mute = True
act("ed.undo_push", message="Muted")
bpy.context.scene.frame_set(13)
""")
    until(window, "shows()")
    window.ask("act('ed.undo'); act('ed.undo')")
    assert window.ask("result = [len(heard()), head().risorius.speech.strips[0].mute]") == [1, False]
    window.ask("bpy.context.scene.frame_set(12)")
    until(window, "shows()")
    disabled_and_enabled(window)
    assert content(window)["strips"] == 1


def test_blender_did_not_complain(opened: Window) -> None:
    assert "Traceback" not in opened.log(), opened.log()[-3000:]
