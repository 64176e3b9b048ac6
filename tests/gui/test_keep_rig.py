"""A head with 52 keys that other people drew, baked to these keys in a real window; undone, cancelled, taken off.

Pictures of the stages are left in out/test-reports/keep-rig/.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT, shared_folder
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "keep-rig"
#: Seconds for the window to draw what was changed.
DRAWN = 0.5

#: The head with its keys and points, as an importer leaves it, looked at from the front.
BUILD = """
import json
import numpy as np
from importlib import import_module
data, keys = np.load({mesh!r}), np.load({keys!r}, allow_pickle=True)
ends = np.cumsum(data["face_sizes"])
mesh = bpy.data.meshes.new("Amira")
faces = [data["loops"][e - n:e].tolist() for e, n in zip(ends, data["face_sizes"])]
mesh.from_pydata(data["vertices"].tolist(), [], faces)
mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
obj = bpy.data.objects.new("Amira", mesh)
bpy.context.scene.collection.objects.link(obj)
obj.shape_key_add(name="Basis")
for name, delta in zip(keys["names"], keys["deltas"]):
    key = obj.shape_key_add(name=str(name), from_mix=False)
    key.value = 0.0
    key.data.foreach_set("co", (data["vertices"] + delta).astype(np.float32).ravel())
bpy.context.view_layer.objects.active = obj
obj.select_set(True)
kept = import_module("bl_ext.user_default.risorius.scene.points.stored")
kept.store_points(obj, {{name: int(vertex) for name, vertex in json.load(open({points!r}))["points"].items()}})
with in_viewport():
    bpy.ops.view3d.view_axis(type="FRONT")
    bpy.ops.view3d.view_selected()
    viewport()[1].spaces.active.show_region_ui = True
bpy.context.window_manager.risorius.preview.show = False
bpy.context.window_manager.risorius.wheel.show = False
"""

#: The panels of this story, open, and nothing else.
ONLY = """
kinds = {c.__name__: c for c in bpy.types.Panel.__subclasses__() if c.__name__.startswith("RISORIUS_PT_")}
for name, cls in kinds.items():
    if cls.is_registered and getattr(cls, "bl_parent_id", "") and name not in ("RISORIUS_PT_bake",):
        bpy.utils.unregister_class(cls)
viewport()[2]["UI"].active_panel_category = "Risorius"
"""

#: Names of the keys, those that show, and what animates them.
STATE = """
keys = bpy.data.objects["Amira"].data.shape_keys
playing = keys.animation_data
result = {
    "names": [key.name for key in keys.key_blocks],
    "shown": {key.name: round(key.value, 4) for key in list(keys.key_blocks)[1:] if abs(key.value) > 1e-4},
    "actions": sorted(action.name for action in bpy.data.actions),
    "strips": [[t.name, [s.name for s in t.strips]] for t in playing.nla_tracks] if playing else [],
    "onto": bpy.data.objects["Amira"].risorius.bake.onto,
}
"""


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the head in it."""
    heads, folder = shared_folder() / "heads", tmp_path_factory.mktemp("rig")
    sources = {
        "mesh": heads / "makehuman.npz",
        "keys": heads / "others" / "makehuman_arkit" / "makehuman_arkit_visemes.npz",
        "points": heads / "makehuman.fp.json",
    }
    missing = [str(path) for path in sources.values() if not path.is_file()]
    if missing:
        pytest.skip(f"not there: {', '.join(missing)}")
    lent = {}
    for name, path in sources.items():
        lent[name] = str(folder / path.name)
        Path(lent[name]).write_bytes(path.read_bytes())
    with Window(blender, settings, folder / "asked") as opened:
        opened.ask("for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)")
        opened.ask(BUILD.format(**lent))
        opened.ask(ONLY)
        opened.ask("with in_viewport(): bpy.ops.ed.undo_push(message='Built')")
        yield opened
        opened.shot(PICTURES / "last.png")


def state(window: Window) -> dict[str, Any]:
    """The keys now."""
    found: dict[str, Any] = window.ask(STATE)
    return found


def bake(window: Window, name: str) -> None:
    """Press a button that bakes, and wait."""
    window.ask(f"with in_viewport(): bpy.ops.risorius.{name}('INVOKE_DEFAULT')")
    window.wait(f"not any('{name}' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)")


def test_who_has_many_keys_is_asked_whether_to_bake_to_them(window: Window) -> None:
    assert state(window)["onto"] == "NEW"
    window.shot(PICTURES / "1-asked.png")


def test_one_button_moves_the_keys_that_are_there(window: Window) -> None:
    before = state(window)
    window.ask("bpy.data.objects['Amira'].risorius.bake.onto = 'KEYS'")
    bake(window, "bake_expression")
    after = state(window)
    assert after["names"] == before["names"]
    assert after["actions"] == ["Amira joy"]
    assert len(after["shown"]) > 5, "the playhead is where the expression is full"
    window.shot(PICTURES / "2-joy.png")


def test_one_undo_takes_the_bake_back(window: Window) -> None:
    window.ask("with in_viewport(): bpy.ops.ed.undo()")
    undone = state(window)
    assert undone["actions"] == []
    assert undone["strips"] == []
    assert undone["shown"] == {}
    assert len(undone["names"]) > 50


def test_escape_leaves_everything_as_it_was(window: Window) -> None:
    window.ask("bpy.data.objects['Amira'].risorius.bake.onto = 'KEYS'")
    before = state(window)
    window.ask("with in_viewport(): bpy.ops.risorius.bake_motion('INVOKE_DEFAULT')")
    running = "any('bake_motion' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"
    assert window.wait(running)
    window.key("Escape")
    window.wait(f"not {running}")
    assert state(window) == before


def test_six_emotions_come_one_after_another_and_are_taken_off_again(window: Window) -> None:
    before = state(window)
    bake(window, "bake_six")
    after = state(window)
    assert after["names"] == before["names"]
    assert [len(strips) for _, strips in after["strips"]] == [6]
    for number, word in enumerate(("joy", "surprise", "fear", "anger", "sadness", "disgust"), start=3):
        window.ask(
            f"action = bpy.data.actions['Amira {word}']\n"
            "bpy.context.scene.frame_set(round(sum(action.frame_range) / 2.0))"
        )
        time.sleep(DRAWN)
        window.shot(PICTURES / f"{number}-{word}.png")
        assert len(state(window)["shown"]) > 5, word
    window.ask("with in_viewport(): bpy.ops.risorius.clear(clip='joy', on_rig=True)")
    assert [len(strips) for _, strips in state(window)["strips"]] == [5]
    window.ask("with in_viewport(): bpy.ops.risorius.clear()")
    cleared = state(window)
    assert cleared == before
    window.shot(PICTURES / "9-cleared.png")


def test_it_is_saved_and_opened_as_it_was(window: Window, tmp_path_factory: pytest.TempPathFactory) -> None:
    bake(window, "bake_expression")
    before = state(window)
    path = str(tmp_path_factory.mktemp("saved") / "rig.blend")
    window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={path!r})")
    window.ask(f"bpy.ops.wm.open_mainfile(filepath={path!r})")
    window.wait("'Amira' in bpy.data.objects and bpy.context.window_manager.windows[0].screen is not None")
    assert state(window) == before
    assert json.loads(window.ask("result = bpy.data.actions['Amira joy']['risorius_rig_followed']"))["explained"] > 0.8


def test_blender_did_not_complain(window: Window) -> None:
    assert "Traceback" not in window.log(), window.log()[-3000:]
