"""A character of five objects under an armature and a parent, from an importer to a film, in a real window.

Pictures of the stages are left in out/test-reports/character/.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from places import ROOT
from window.driver import Window

PICTURES = ROOT / "out" / "test-reports" / "character"
HEIGHT = 900
OBJECTS = ["Body", "Eyes", "Lashes", "Teeth", "Tongue"]

#: The default head in five objects, as another program writes them: parented to a rig below an empty that is turned.
BUILD = """
import numpy as np
import math
from importlib import import_module
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
with in_viewport():
    bpy.ops.risorius.add_head()
whole = bpy.context.object
parts = np.array(import_module("bl_ext.user_default.risorius.scene.mesh").read_parts(whole.data))
places = [v.co.copy() for v in whole.data.vertices]
polygons = [list(p.vertices) for p in whole.data.polygons]
rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
root = bpy.data.objects.new("Character", None)
for obj in (rig, root): bpy.context.collection.objects.link(obj)
rig.parent, root.rotation_euler, root.location = root, (0.0, 0.0, math.radians(20.0)), (0.3, 0.2, 1.4)
with in_viewport():
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("head")
    bone.head, bone.tail = (0.0, 0.0, -0.1), (0.0, 0.0, 0.1)
    bpy.ops.object.mode_set(mode="OBJECT")
for name, kinds in {"Body": (0,), "Eyes": (1, 2), "Teeth": (3, 4), "Tongue": (5,), "Lashes": (6,)}.items():
    mine = [p for p in polygons if parts[p[0]] in kinds]
    used = sorted({v for p in mine for v in p})
    place = {v: i for i, v in enumerate(used)}
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([places[v] for v in used], [], [[place[v] for v in p] for p in mine])
    mesh.materials.append(bpy.data.materials.new(name))
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    obj.parent = rig
    obj.vertex_groups.new(name="head").add(range(len(used)), 1.0, "REPLACE")
    obj.modifiers.new("Armature", "ARMATURE").object = rig
bpy.data.objects.remove(whole)
with in_viewport():
    bpy.ops.export_scene.gltf(filepath={path!r}, export_format="GLB")
    bpy.ops.wm.read_homefile(use_empty=False)
"""

#: The file is imported as a person does it, its body selected and looked at from the front.
IMPORT = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
with in_viewport():
    bpy.ops.import_scene.gltf(filepath={path!r})
    body = bpy.data.objects["Body"]
    for obj in bpy.data.objects: obj.select_set(obj == body)
    bpy.context.view_layer.objects.active = body
    bpy.ops.view3d.view_selected()
    viewport()[1].spaces.active.show_region_ui = True
"""

#: What belongs to the user and is not to change: parents, places, modifiers and materials of every object.
USERS = """
result = sorted(
    [o.name, o.parent and o.parent.name, [list(row) for row in o.matrix_world], [m.name for m in o.modifiers
     if not m.name.startswith("Risorius")], [s.material and s.material.name for s in o.material_slots]]
    for o in bpy.data.objects if o.name in {names!r}
)
"""
MOVED = (
    "result = {o.name: sorted(k.name for k in o.data.shape_keys.key_blocks[1:])"
    " for o in bpy.data.objects if o.type == 'MESH' and o.data.shape_keys}"
)
WORDS = {"joy", "surprise", "fear", "anger", "sadness", "disgust"}


@pytest.fixture(scope="module")
def window(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Window]:
    """The window, open until the last test, with the character in it."""
    with Window(blender, settings, tmp_path_factory.mktemp("character")) as opened:
        yield opened
        opened.shot(PICTURES / "last.png")


@pytest.fixture(scope="module")
def work(window: Window, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the character's file and of what is made of it."""
    folder = tmp_path_factory.mktemp("work")
    path = str(folder / "character.glb")
    window.ask(BUILD.replace("{path!r}", repr(path)))
    window.ask(IMPORT.replace("{path!r}", repr(path)))
    window.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")
    return folder


@pytest.fixture(scope="module")
def before(window: Window, work: Path) -> list[object]:
    """What belongs to the user, as it was imported."""
    assert work.is_dir()
    return users(window)


def users(window: Window) -> list[object]:
    """What belongs to the user now."""
    found: list[object] = window.ask(USERS.format(names=[*OBJECTS, "Rig", "Character"]))
    assert len(found) == 7
    return found


def test_one_button_bakes_six_emotions_on_every_object_that_moves(window: Window, before: list[object]) -> None:
    window.ask("with in_viewport(): bpy.ops.risorius.bake_six('INVOKE_DEFAULT')")
    window.wait(
        "bpy.data.objects['Body'].data.shape_keys is not None and not any("
        "'bake_six' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"
    )
    moved = window.ask(MOVED)
    assert set(moved["Body"]) >= WORDS
    assert {"Lashes", "Teeth"} <= set(moved)
    listed = window.ask("result = sorted(r.object.name for r in bpy.data.objects['Body'].risorius.face.followers)")
    assert listed == ["Eyes", "Lashes", "Teeth", "Tongue"]
    assert users(window) == before
    window.shot(PICTURES / "1-six.png")


def test_the_wheel_moves_the_whole_character(window: Window, before: list[object]) -> None:
    window.ask(
        "bpy.context.view_layer.objects.active = bpy.data.objects['Body']\n"
        "bpy.context.window_manager.risorius.preview.show = True\n"
        "bpy.data.objects['Body'].risorius.emotion.word = 'surprise'"
    )
    shown = (
        "sorted(o.name for o in bpy.data.objects for m in o.modifiers"
        " if m.name == 'Risorius Preview' and m.show_viewport)"
    )
    previewed = window.wait(shown)
    assert {"Body", "Lashes", "Teeth"} <= set(previewed)
    window.shot(PICTURES / "2-wheel.png")
    window.ask("bpy.context.window_manager.risorius.preview.show = False")
    assert users(window) == before


def test_an_expression_is_baked_beside_the_six(window: Window, before: list[object]) -> None:
    window.ask("with in_viewport(): bpy.ops.risorius.bake_expression('INVOKE_DEFAULT')")
    window.wait(
        "not any('bake_expression' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"
    )
    assert set(window.ask(MOVED)["Body"]) >= WORDS
    assert users(window) == before


def test_film_and_gltf_take_every_object_along(window: Window, work: Path) -> None:
    window.ask(f"bpy.ops.wm.save_as_mainfile(filepath={str(work / 'character.blend')!r})")
    window.ask(
        "film = bpy.context.scene.risorius.film\n"
        "film.path, film.width, film.height, film.frames = '//film.mp4', 128, 128, 'SCENE'\n"
        "bpy.context.scene.frame_start, bpy.context.scene.frame_end = 10, 14\n"
        "bpy.context.view_layer.objects.active = bpy.data.objects['Body']\n"
        "with in_viewport(): bpy.ops.risorius.render_film('INVOKE_DEFAULT')"
    )
    window.eventually(lambda: (work / "film.mp4").exists() and (work / "film.mp4").stat().st_size > 1000)
    window.ask("film.model = '//face.glb'\nwith in_viewport(): bpy.ops.risorius.export_gltf()")
    data = (work / "face.glb").read_bytes()
    described = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    assert set(OBJECTS) <= {node["name"] for node in described["nodes"]}
    assert "skins" in described


def test_it_opens_again_as_it_was(window: Window, work: Path, before: list[object]) -> None:
    window.ask(f"bpy.ops.wm.open_mainfile(filepath={str(work / 'character.blend')!r})")
    window.wait("'Body' in bpy.data.objects and bpy.context.window_manager.windows[0].screen is not None")
    assert users(window) == before
    assert set(window.ask(MOVED)["Body"]) >= WORDS
    assert len(window.ask("result = [r.object.name for r in bpy.data.objects['Body'].risorius.face.followers]")) == 4


def test_blender_did_not_complain(window: Window) -> None:
    assert "Traceback" not in window.log(), window.log()[-3000:]
