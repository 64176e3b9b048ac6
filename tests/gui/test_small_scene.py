"""A small scene made in a real window, pointer and keys as a person uses them; each test goes on from the last.

Pictures of the stages are left in out/test-reports/scene/.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "scene"
HEIGHT = 900

#: Where the wheel shows a point, in pixels of the window from its upper left.
WHERE = """
from importlib import import_module
view = import_module("bl_ext.user_default.risorius.operators.wheel.view")
with in_viewport():
    region, wheel = bpy.context.region, view.wheel_of(bpy.context)
    x, y = wheel.pixel({angle}, {activation})
    result = [region.x + x, {height} - region.y - y]
"""
#: Names of the objects that show a preview now.
PREVIEWED = (
    "[o.name for o in bpy.data.objects for m in o.modifiers if m.name == 'Risorius Preview' and m.show_viewport]"
)
#: Places of the active face's vertices as the preview shows them.
SHOWN = "bpy.context.object.data.attributes['risorius_preview'].data"
PREVIEW = "bl_ext.user_default.risorius.operators.preview.live"
#: The head from the front, and where in the window its feature points are: name -> pixel from the upper left.
FROM_THE_FRONT = """
from bpy_extras.view3d_utils import location_3d_to_region_2d
kept_points = import_module("bl_ext.user_default.risorius.scene.points.kept")
seen_points = import_module("bl_ext.user_default.risorius.scene.points.seen")
with in_viewport():
    bpy.ops.view3d.view_axis(type="FRONT")
    bpy.ops.view3d.view_selected()
    region, view = bpy.context.region, bpy.context.region_data
    view.update()
    visible = seen_points.Visible.of(bpy.context.object, bpy.context.evaluated_depsgraph_get())
    pixels = {
        name: location_3d_to_region_2d(region, view, place)
        for name, place in visible.places(kept_points.read_kept(bpy.context.object)).items()
    }
    result = {name: [region.x + x, HEIGHT - region.y - y] for name, (x, y) in pixels.items()}
"""
#: Operators that listen to events now.
LISTENING = "[operator.bl_idname for operator in bpy.context.window_manager.windows[0].modal_operators]"


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test."""
    with Window(blender, settings, tmp_path_factory.mktemp("scene")) as opened:
        opened.ask(f"from importlib import import_module\nlive = import_module({PREVIEW!r})")
        yield opened
        opened.shot(PICTURES / "last.png")


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the scene is saved."""
    return tmp_path_factory.mktemp("saved")


def on_wheel(window: Window, angle: float, activation: float) -> tuple[int, int]:
    """The window's pixel of a point of the wheel."""
    x, y = window.ask(WHERE.format(angle=angle, activation=activation, height=HEIGHT))
    return round(x), round(y)


def test_one_button_gives_a_head_that_shows_joy(window: Window) -> None:
    window.ask(
        "with in_viewport():\n"
        "    for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)\n"
        "    viewport()[1].spaces.active.show_region_ui = True\n"
        "    bpy.ops.risorius.add_head('INVOKE_DEFAULT')\n"
        "    bpy.ops.ed.undo_push(message='begin')"
    )
    assert window.wait("bpy.context.object is not None and bpy.context.object.name") == "Risorius Head"
    assert window.wait("[m.name for m in bpy.context.object.modifiers]") == ["Risorius Preview"]
    window.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
    window.shot(PICTURES / "1-head.png")


def test_dragging_between_fear_and_sadness_shows_guilty(window: Window) -> None:
    start, end = on_wheel(window, 323.4, 5.4), on_wheel(window, 102.3, 4.0)
    window.ask(f"before = [tuple(place.vector) for place in {SHOWN}]")
    window.drag(start, end)
    emotion = "bpy.context.object.risorius.emotion"
    word, activation, angle = window.ask(f"e = {emotion}; result = [e.word, e.activation, e.angle * 57.29578]")
    assert word == "guilty"
    assert activation == pytest.approx(4.0, abs=0.25)
    assert angle == pytest.approx(102.3, abs=3.0)
    window.wait(f"max(abs(now.vector[2] - was[2]) for now, was in zip({SHOWN}, before)) > 2e-3")
    window.shot(PICTURES / "2-wheel.png")


def test_one_step_back_and_forth(window: Window) -> None:
    word = "bpy.context.object.risorius.emotion.word"
    window.click(*window.pixel_of("WINDOW", 0.6, 0.06))  # the pointer over the viewport, on nothing
    window.ask("bpy.context.view_layer.objects.active = bpy.data.objects['Risorius Head']")
    window.ask("bpy.data.objects['Risorius Head'].select_set(True)")
    assert window.ask(f"result = {word}") == "guilty"
    for _ in range(3):
        window.key("ctrl+z")
        if window.ask(f"result = {word}") == "joy":
            break
    assert window.ask(f"result = {word}") == "joy"
    assert window.wait("[m.name for m in bpy.context.object.modifiers]") == ["Risorius Preview"]
    for _ in range(3):
        window.key("ctrl+shift+z")
        if window.ask(f"result = {word}") == "guilty":
            break
    assert window.ask(f"result = {word}") == "guilty"


def test_three_clips_are_laid_out(window: Window) -> None:
    for frame, word in ((1, "joy"), (40, "fear"), (80, "anger")):
        window.ask(
            f"bpy.context.scene.frame_set({frame})\n"
            "with in_viewport(): bpy.ops.risorius.add_clip()\n"
            f"bpy.context.object.risorius.emotion.word = {word!r}"
        )
    clips = window.ask("result = [[c.emotion.word, c.start] for c in bpy.context.object.risorius.timeline.clips]")
    assert clips == [["joy", 1], ["fear", 40], ["anger", 80]]
    window.shot(PICTURES / "3-clips.png")


def test_unbaked_clips_play(window: Window) -> None:
    shown = []
    for frame in (20, 58, 98):
        window.ask(f"bpy.context.scene.frame_set({frame})")
        window.wait(PREVIEWED)
        shown.append(
            window.ask("result = list(bpy.context.object.data.attributes['risorius_preview'].data[3000].vector)")
        )
    assert len({tuple(place) for place in shown}) == 3
    assert window.ask("result = bpy.context.object.data.shape_keys is None")


def test_a_bake_is_cancelled_by_escape_and_leaves_nothing(window: Window) -> None:
    window.ask("with in_viewport(): bpy.ops.risorius.bake_motion('INVOKE_DEFAULT')")
    window.click(*window.pixel_of("WINDOW", 0.6, 0.06))
    window.key("Escape")
    window.wait(
        "not any(op.bl_idname == 'RISORIUS_OT_bake_motion' for op in bpy.context.window_manager.windows[0]"
        ".modal_operators)"
    )
    assert window.ask("result = bpy.context.object.data.shape_keys is None")
    assert window.ask("result = len(bpy.data.actions)") == 0


def test_it_is_baked_and_plays_without_the_preview(window: Window) -> None:
    window.ask(
        "bpy.context.view_layer.objects.active = bpy.data.objects['Risorius Head']\n"
        "with in_viewport(): bpy.ops.risorius.bake_motion('INVOKE_DEFAULT')"
    )
    keys = window.wait(
        "(keys := bpy.context.object.data.shape_keys) is not None and keys.animation_data is not None"
        " and len(keys.key_blocks)"
    )
    assert keys > 2
    window.ask("bpy.context.scene.frame_set(20)")
    assert window.ask(f"result = {PREVIEWED}") == []
    moved = window.ask("result = max(k.value for k in bpy.context.object.data.shape_keys.key_blocks[1:])")
    assert moved > 0.1
    window.shot(PICTURES / "4-baked.png")


def test_saved_files_hold_no_preview_and_open_again(window: Window, work: Path) -> None:
    path = work / "scene.blend"
    window.ask("bpy.context.object.risorius.emotion.seed = 3")
    window.wait(PREVIEWED)
    window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={str(path)!r})")
    assert window.wait(PREVIEWED) == ["Risorius Head"]
    window.ask("bpy.context.window_manager.risorius.preview.show = False")
    window.ask(f"bpy.ops.wm.open_mainfile(filepath={str(path)!r})")
    assert window.ask("result = [m.name for m in bpy.data.objects['Risorius Head'].modifiers]") in (
        [],
        ["Risorius Creases"],
    )
    assert window.ask("result = 'risorius_preview' in bpy.data.objects['Risorius Head'].data.attributes") is False
    assert window.ask("result = len(bpy.data.objects['Risorius Head'].risorius.timeline.clips)") == 3


def test_the_film_is_rendered_beside_the_file(window: Window, work: Path) -> None:
    window.ask(
        "film = bpy.context.scene.risorius.film\n"
        "film.path, film.width, film.height, film.frames = '//film.mp4', 128, 128, 'SCENE'\n"
        "bpy.context.scene.frame_start, bpy.context.scene.frame_end = 10, 14\n"
        "bpy.context.view_layer.objects.active = bpy.data.objects['Risorius Head']\n"
        "with in_viewport(): bpy.ops.risorius.render_film('INVOKE_DEFAULT')"
    )
    window.eventually(lambda: (work / "film.mp4").exists() and (work / "film.mp4").stat().st_size > 1000)
    window.ask("film.model = '//face.glb'\nwith in_viewport(): bpy.ops.risorius.export_gltf()")
    assert (work / "face.glb").read_bytes()[:4] == b"glTF"


def test_two_faces_keep_their_previews_when_the_file_is_saved(window: Window, work: Path) -> None:
    window.ask(
        "for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)\n"
        "bpy.context.window_manager.risorius.preview.show = True\n"
        "with in_viewport():\n"
        "    for word in ('joy', 'surprise'):\n"
        "        bpy.ops.risorius.add_head()\n"
        "        bpy.context.object.risorius.emotion.word = word"
    )
    window.wait(f"len({PREVIEWED}) == 2")
    window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={str(work / 'two.blend')!r})")
    window.wait(f"len({PREVIEWED}) == 2")
    window.shot(PICTURES / "5-two.png")


def test_a_muscle_slider_moves_the_face(window: Window) -> None:
    window.ask(
        "import_module('bl_ext.user_default.risorius.operators.muscles.props').list_muscles()\n"
        "sliders = bpy.context.window_manager.risorius.muscles.names\n"
        "places = bpy.context.object.data.attributes['risorius_preview'].data\n"
        "was = [tuple(place.vector) for place in places]\n"
        "sliders['jaw_open'].contraction = 0.0"
    )
    window.wait(
        "max(abs(place.vector[2] - before[2]) for place, before in"
        " zip(bpy.context.object.data.attributes['risorius_preview'].data, was)) > 0.005"
    )
    assert window.ask("result = [entry.name for entry in bpy.context.object.risorius.muscles.by_hand]") == ["jaw_open"]


def test_clicking_is_cancelled_and_leaves_the_window_as_it_was(window: Window) -> None:
    window.ask(
        "for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)\n"
        "bpy.context.window_manager.risorius.preview.show = False\n"
        "with in_viewport(): bpy.ops.risorius.add_head()\n"
        "points = bpy.context.window_manager.risorius.points\n"
        "points.show, bpy.context.window_manager.risorius.wheel.show = True, False"
    )
    pixels = window.ask(f"HEIGHT = {HEIGHT}\n{FROM_THE_FRONT}")
    window.ask("bpy.ops.risorius.forget_points()")
    window.ask("with in_viewport(): bpy.ops.risorius.click_points('INVOKE_DEFAULT')")
    assert window.ask(f"result = {LISTENING}") == ["RISORIUS_OT_click_points"]
    assert window.ask("result = points.show") is False
    window.click(*map(round, pixels["3.7"]))
    window.shot(PICTURES / "6-clicking.png")
    window.key("Escape")
    window.wait(f"not {LISTENING}")
    assert window.ask("result = points.show") is True
    assert window.ask("result = kept_points.has_points(bpy.context.object)") is False


def test_four_clicks_and_their_counterparts_find_the_face(window: Window) -> None:
    window.ask("with in_viewport(): bpy.ops.risorius.add_head()")
    pixels = window.ask(FROM_THE_FRONT)
    window.ask("true = {n: list(p) for n, p in visible.places(kept_points.read_kept(bpy.context.object)).items()}")
    window.ask("bpy.ops.risorius.forget_points()")
    window.ask("with in_viewport(): bpy.ops.risorius.click_points('INVOKE_DEFAULT')")
    window.click(*map(round, pixels["9.3"]))  # where the corner of the eye is asked for: taken back
    window.key("BackSpace")
    for name in ("3.7", "8.3", "9.3", "2.1"):
        window.click(*map(round, pixels[name]))
    window.wait(f"kept_points.has_points(bpy.context.object) and not {LISTENING}")
    off = window.ask(
        "found = seen_points.Visible.of(bpy.context.object, bpy.context.evaluated_depsgraph_get()).places("
        "kept_points.read_kept(bpy.context.object))\n"
        "result = {n: max(abs(a - b) for a, b in zip(found[n], place)) for n, place in true.items() if n in found}"
    )
    assert len(off) > 40
    assert max(off[name] for name in ("3.7", "3.12", "8.3", "8.4", "9.3")) < 0.004
    window.shot(PICTURES / "7-clicked.png")


def test_a_deleted_face_leaves_nothing_of_its_preview(window: Window) -> None:
    window.ask(
        "bpy.context.window_manager.risorius.preview.show = True\n"
        "with in_viewport(): bpy.ops.risorius.add_head()\n"
        "kept = bpy.context.object.data\n"
        "kept.use_fake_user = True"
    )
    window.wait("[m.name for m in bpy.context.object.modifiers if m.name == 'Risorius Preview']")
    window.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
    window.wait("'risorius_preview' not in kept.attributes")
    window.wait("not any(tree.name.startswith('Risorius Preview') for tree in bpy.data.node_groups)")


def test_blender_did_not_complain(window: Window) -> None:
    assert "Traceback" not in window.log(), window.log()[-3000:]
