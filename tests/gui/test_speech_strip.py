"""Speech on the timeline in a real window: added, seen in the preview with the emotion, dragged and stretched by hand,
edited, each with one undo.

Pictures of the stages are left in out/test-reports/speech/.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "speech"
HEIGHT = 900
#: Seconds for the window to draw what was changed.
DRAWN = 0.7
HEAD = "bpy.data.objects['Risorius Head']"
STATE = f"""
speech = {HEAD}.risorius.speech
editor = bpy.context.scene.sequence_editor
strips = [] if editor is None else (editor.strips if hasattr(editor, "strips") else editor.sequences)
result = {{
    "strips": [[strip.start, round(strip.stretch, 3), [word.name for word in strip.words]] for strip in speech.strips],
    "sounds": [[int(strip.frame_final_start), int(strip.frame_final_duration)] for strip in strips],
}}
"""
#: The panels of speech come first, and the editor of properties shows the timeline, tall enough for pictures.
ROOM = """
for name in ("emotion", "variation", "timeline", "bake", "read_features", "read_faps", "read", "film"):
    bpy.utils.unregister_class(getattr(bpy.types, f"RISORIUS_PT_{name}"))
area = next(area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "PROPERTIES")
area.ui_type = "TIMELINE"
"""
#: The middle of the bar of the first speech, and its end, in pixels of the window from its upper left.
BAR = f"""
from importlib import import_module
drawing = import_module("bl_ext.user_default.risorius.operators.timeline.drawing")
window = bpy.context.window_manager.windows[0]
area = max((a for a in window.screen.areas if a.type == "DOPESHEET_EDITOR"), key=lambda a: a.height)
region = next(region for region in area.regions if region.type == "WINDOW")
with bpy.context.temp_override(window=window, area=area, region=region):
    bar = drawing.bars_of(bpy.context, region)[-1]
    ten = region.view2d.view_to_region(10, 0, clip=False)[0] - region.view2d.view_to_region(0, 0, clip=False)[0]
y = {HEIGHT} - region.y - (bar.low + bar.high) / 2
result = [region.x + (bar.corners[0] + bar.corners[3]) / 2, region.x + bar.corners[3], y, ten / 10]
"""


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the default head in it and Speak open."""
    with Window(blender, settings, tmp_path_factory.mktemp("speech") / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask("with in_viewport(): bpy.ops.risorius.add_head()")
        opened.ask("with in_viewport(): bpy.ops.view3d.view_axis(type='FRONT')")
        opened.ask("viewport()[1].spaces.active.show_region_ui = True")
        opened.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
        opened.ask(f"{HEAD}.risorius.speech.text = 'I did not see that coming.'")
        opened.ask(f"{HEAD}.risorius.emotion.word = 'surprise'")
        opened.ask(ROOM)
        opened.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Built')")
        yield opened
        opened.shot(PICTURES / "last.png")


def state(window: Window) -> dict[str, Any]:
    """What there is now."""
    found: dict[str, Any] = window.ask(STATE)
    return found


def bar(window: Window) -> tuple[tuple[int, int], tuple[int, int], float]:
    """Middle and end of the speech's bar, and pixels of a frame."""
    middle, end, y, frame = window.ask(BAR)
    return (round(middle), round(y)), (round(end), round(y)), frame


def test_it_is_added_with_its_sound(window: Window) -> None:
    window.ask("bpy.context.scene.frame_set(20)")
    window.ask("with in_viewport(): bpy.ops.risorius.add_speech()")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Added')")
    time.sleep(DRAWN)
    now = state(window)
    assert now["strips"] == [[20, 1.0, ["I", "did not", "see", "that", "coming"]]]
    assert now["sounds"][0][0] == 20
    assert window.ask("result = [bpy.context.scene.sync_mode, bpy.context.scene.use_audio_scrub]") == [
        "AUDIO_SYNC",
        True,
    ]
    window.shot(PICTURES / "1-added.png")


def test_scrubbing_shows_mouth_and_emotion_before_a_bake(window: Window) -> None:
    shown = []
    for frame in (24, 34, 44):
        window.ask(f"bpy.context.scene.frame_set({frame})")
        window.wait(f"'risorius_preview' in {HEAD}.data.attributes")
        time.sleep(DRAWN)
        shown.append(
            window.ask(f"result = [list(d.vector) for d in {HEAD}.data.attributes['risorius_preview'].data[::400]]")
        )
        window.shot(PICTURES / f"2-scrubbed-{frame}.png")
    assert shown[0] != shown[1] != shown[2]
    assert window.ask(f"result = {HEAD}.data.shape_keys is None")


def test_it_is_dragged_and_stretched_with_its_sound(window: Window) -> None:
    before = state(window)
    middle, end, frame = bar(window)
    window.drag(middle, (round(middle[0] + 15 * frame), middle[1]))
    time.sleep(DRAWN)
    moved = state(window)
    start = moved["strips"][0][0]
    assert 33 <= start <= 37
    assert moved["sounds"][0] == [start, before["sounds"][0][1]]
    middle, end, frame = bar(window)
    window.drag((end[0] - 1, end[1]), (round(end[0] + 20 * frame), end[1]))
    time.sleep(DRAWN)
    longer = state(window)
    assert longer["strips"][0][1] > 1.2
    assert longer["sounds"][0][1] > before["sounds"][0][1] + 10
    window.shot(PICTURES / "3-stretched.png")
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    time.sleep(DRAWN)
    assert state(window) == moved
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    time.sleep(DRAWN)
    assert state(window) == before


def test_words_are_edited_and_undone(window: Window) -> None:
    before = state(window)
    window.ask("with in_viewport(): bpy.ops.risorius.remove_word()")
    window.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Removed')")
    time.sleep(DRAWN)
    assert state(window)["strips"][0][2] == before["strips"][0][2][1:]
    window.shot(PICTURES / "4-removed.png")
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    time.sleep(DRAWN)
    assert state(window) == before
    assert "Traceback" not in window.log()
