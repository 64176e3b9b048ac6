"""A face in a real window: prepared once and kept, ready when its file is opened again, played before it is baked.

Pictures of the stages are left in out/test-reports/kept_face/.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "kept_face"
#: Seconds for the window to draw what was changed.
DRAWN = 0.7

MODULE = "bl_ext.user_default.risorius"
FACES = f"__import__('sys').modules['{MODULE}.operators.session'].session().previews.faces"
FOLDER = f"__import__('sys').modules['{MODULE}.operators.kept.folder'].kept_folder()"
HEAD = "bpy.data.objects['Risorius Head']"
SHOWS = f"any(m.name.startswith('Risorius Preview') and m.show_viewport for m in {HEAD}.modifiers)"
KEPT = f"len(list({FOLDER}.glob('*.face')))"


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the default head in it."""
    with Window(blender, settings, tmp_path_factory.mktemp("kept") / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask("with in_viewport(): bpy.ops.risorius.add_head()")
        opened.ask("viewport()[1].spaces.active.show_region_ui = True")
        opened.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
        yield opened
        opened.shot(PICTURES / "last.png")


def test_once_shown_it_is_kept(window: Window) -> None:
    window.ask(f"{HEAD}.risorius.emotion.word = 'surprise'")
    window.wait(SHOWS)
    window.wait(f"{KEPT} == 1 and not {FACES}.has_more")
    time.sleep(DRAWN)
    window.shot(PICTURES / "1-shown.png")


def test_opened_again_it_comes_out_of_its_file(window: Window) -> None:
    path = window.folder.parent / "face.blend"
    window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={str(path)!r})")
    window.ask(f"__import__('sys').modules['{MODULE}.scene.faces'].forget_faces()")
    window.ask(f"bpy.ops.wm.open_mainfile(filepath={str(path)!r})")
    window.ask(f"{HEAD}.risorius.emotion.word = 'joy'")
    window.wait(SHOWS)
    window.wait(f"all(face._face.is_from_file for face in {FACES}._faces.values()) and bool({FACES}.uids)")
    time.sleep(DRAWN)
    window.shot(PICTURES / "2-opened.png")


def test_a_clip_plays_with_blinks_before_it_is_baked(window: Window) -> None:
    window.ask(f"{HEAD}.risorius.timeline.variation.blinks = 40.0")
    window.ask("bpy.context.scene.frame_set(1)")
    window.ask("with in_viewport(): bpy.ops.risorius.add_clip()")
    window.ask("with in_viewport(): bpy.ops.screen.animation_play()")
    window.wait(f"any(face._played and not face._motion for face in {FACES}._faces.values())")
    window.ask("with in_viewport(): bpy.ops.screen.animation_cancel(restore_frame=False)")
    window.ask("bpy.context.scene.frame_set(15)")
    window.wait(SHOWS)
    time.sleep(DRAWN)
    window.shot(PICTURES / "3-played.png")
    assert window.ask(f"result = {HEAD}.data.shape_keys is None")


def test_the_preferences_turn_it_off_and_clear_it(window: Window) -> None:
    window.ask(f"bpy.context.preferences.addons['{MODULE}'].preferences.keep_faces = False")
    where = f"__import__('sys').modules['{MODULE}.operators.kept.folder'].folder_to_use()"
    assert window.ask(f"result = {where} is None")
    window.ask("bpy.ops.risorius.clear_kept_faces()")
    assert window.ask(f"result = {KEPT}") == 0
    window.ask("bpy.ops.screen.userpref_show('INVOKE_DEFAULT')")
    window.ask("bpy.context.preferences.active_section = 'ADDONS'")
    window.ask("bpy.context.window_manager.addon_search = 'Risorius'")
    window.ask(f"bpy.ops.preferences.addon_expand(module='{MODULE}')")
    time.sleep(DRAWN)
    window.shot(PICTURES / "4-preferences.png")


def test_blender_did_not_complain(window: Window) -> None:
    assert "Traceback" not in window.log(), window.log()[-3000:]
