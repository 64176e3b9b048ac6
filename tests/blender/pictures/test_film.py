"""Films and contact sheets: files are written, show the face moving, and leave the user's scene alone."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import ParameterError, SceneError
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake import shape_keys
from risorius.scene.pictures import film, gpu_probe
from risorius.scene.pictures import look as look_module
from risorius.scene.pictures.contact_sheet import Exhibit, write_sheet
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.lettering import Text, read_picture, write_picture, write_text
from risorius.scene.pictures.look import Camera, Engine, Look, usable_engine
from risorius.scene.pictures.studio import studio

SMALL = Look(width=96, height=96)


def counted() -> dict[str, int]:
    """How many datablocks of each kind there are, without the picture that Blender keeps of any render."""
    names = ("objects", "scenes", "worlds", "cameras", "lights", "images", "curves", "meshes", "actions", "materials")
    counts = {name: len(getattr(bpy.data, name)) for name in names}
    counts["images"] -= sum(image.type == "RENDER_RESULT" for image in bpy.data.images)
    return counts


@pytest.fixture
def nodding(head: Any) -> Any:
    """A head with a shape key that rises 3 cm from frame 1 to frame 5, without any solver."""
    up = meshes.rest_vertices(head.data) + np.array([0.0, 0.0, 0.03])
    shape_keys.write_keys(head, "up", {"up": up})
    block = head.data.shape_keys.key_blocks["up"]
    for frame, value in ((1, 0.0), (5, 1.0)):
        block.value = value
        block.keyframe_insert("value", frame=frame)
    return head


def test_workbench_lights_from_one_side_or_as_blender_does(nodding: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    framing = framing_of(nodding)
    with studio([nodding], framing, SMALL) as scene:
        assert scene.display.shading.studio_light == "studio.sl"
    monkeypatch.setattr(look_module, "STUDIO_LIGHT", "taken away.sl")
    with studio([nodding], framing, SMALL) as scene:
        assert scene.display.shading.studio_light == "Default"


@pytest.mark.smoke
def test_a_film_is_written_and_the_scene_is_as_it_was(nodding: Any, tmp_path: Path) -> None:
    scene = bpy.context.scene
    scene.render.filepath, scene.render.resolution_x = "//mine", 123
    before, state = counted(), (scene.render.filepath, scene.render.resolution_x, scene.camera, scene.frame_current)
    path = tmp_path / "folder" / "film.mp4"
    result = run(film.render_film([nodding], path, start=1, end=5, look=SMALL, frames=tmp_path / "frames"))
    assert result.path == path
    assert path.read_bytes()[4:8] == b"ftyp"
    assert result.frame_count == 5
    first, middle, last = (read_picture(tmp_path / "frames" / f"{n:04d}.png") for n in (1, 3, 5))
    assert first.shape == (96, 96, 3)
    assert np.abs(first - middle).mean() > 0.002
    assert np.abs(first - last).mean() > 0.004
    assert counted() == before
    assert (scene.render.filepath, scene.render.resolution_x, scene.camera, scene.frame_current) == state
    movie = bpy.data.movieclips.load(str(path))
    assert (tuple(movie.size), movie.frame_duration) == ((96, 96), 5)


def greys_of(path: Path, frames: int, folder: Path) -> list[float]:
    """The mean grey of each frame of a film, as Blender's sequencer shows it."""
    scene = bpy.data.scenes.new("Player")
    editor = scene.sequence_editor_create()
    (editor.strips if hasattr(editor, "strips") else editor.sequences).new_movie("Film", str(path), 1, 1)
    scene.render.resolution_x = scene.render.resolution_y = 64
    scene.render.resolution_percentage, scene.view_settings.view_transform = 100, "Standard"
    scene.frame_start, scene.frame_end, scene.render.filepath = 1, frames, str(folder / "shown")
    bpy.ops.render.render(animation=True, scene=scene.name)
    return [float(read_picture(folder / f"shown{frame:04d}.png").mean()) for frame in range(1, frames + 1)]


@pytest.mark.smoke
@pytest.mark.parametrize("greys", [[0.6], [0.2, 0.5, 0.8]], ids=["one", "three"])
def test_every_picture_is_in_the_film(greys: list[float], tmp_path: Path) -> None:
    """Frame n of the film shows picture n, to the last: however a Blender counts the length of a strip."""
    pictures = [tmp_path / f"{number:04d}.png" for number in range(1, len(greys) + 1)]
    for picture, grey in zip(pictures, greys, strict=True):
        write_picture(np.full((64, 64, 3), grey), picture)
    path = film.encode(pictures, tmp_path / "film.mp4", look=Look(width=64, height=64))
    assert greys_of(path, len(greys), tmp_path) == pytest.approx(greys, abs=0.03)


@pytest.mark.smoke
def test_the_operator_films_the_clip(nodding: Any, tmp_path: Path) -> None:
    bpy.context.scene.frame_end = 2
    chosen = bpy.context.scene.risorius.film
    chosen.path, chosen.width, chosen.height = str(tmp_path / "film"), 64, 64
    assert bpy.ops.risorius.render_film() == {"FINISHED"}
    assert (tmp_path / "film.mp4").stat().st_size > 0


def test_beside_a_file_that_was_never_saved_is_the_home_folder(tmp_path: Path) -> None:
    from risorius.operators.film.ops import film_path

    chosen = bpy.context.scene.risorius.film
    chosen.path = "//a film"
    assert film_path(chosen) == Path.home() / "a film.mp4"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    assert film_path(bpy.context.scene.risorius.film) == tmp_path / "a film.mp4"


def test_pictures_alone_and_both(nodding: Any, tmp_path: Path) -> None:
    chosen = bpy.context.scene.risorius.film
    chosen.path, chosen.width, chosen.height = str(tmp_path / "film.mp4"), 96, 64
    chosen.output, chosen.frames = "PNG", "SCENE"
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 3, 4
    assert bpy.ops.risorius.render_film() == {"FINISHED"}
    assert not (tmp_path / "film.mp4").exists()
    assert sorted(path.name for path in (tmp_path / "film").iterdir()) == ["0003.png", "0004.png"]
    assert read_picture(tmp_path / "film" / "0003.png").shape == (64, 96, 3)
    chosen.output = "BOTH"
    assert bpy.ops.risorius.render_film() == {"FINISHED"}
    assert (tmp_path / "film.mp4").stat().st_size > 0


def test_the_scenes_own_camera_shows_the_whole_scene(nodding: Any, tmp_path: Path) -> None:
    look = Look(width=64, height=64, camera=Camera.SCENE)
    with pytest.raises(SceneError, match="has no camera"):
        run(film.render_film([nodding], None, start=1, end=1, look=look, frames=tmp_path))
    camera = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    camera.location, camera.rotation_euler = (5.0, -1.0, 0.0), (np.pi / 2.0, 0.0, 0.0)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    before = counted()
    run(film.render_film([nodding], None, start=1, end=1, look=look, frames=tmp_path / "away"))
    empty = read_picture(tmp_path / "away" / "0001.png")
    bpy.ops.mesh.primitive_cube_add(location=(5.0, 2.0, 0.0))
    run(film.render_film([nodding], None, start=1, end=1, look=look, frames=tmp_path / "cube"))
    assert np.abs(read_picture(tmp_path / "cube" / "0001.png") - empty).mean() > 0.02
    assert {**counted(), "objects": 0, "meshes": 0} == {**before, "objects": 0, "meshes": 0}


@pytest.mark.slow
def test_a_face_that_nothing_moves_is_baked_before_it_is_filmed(head: Any, tmp_path: Path) -> None:
    chosen = bpy.context.scene.risorius.film
    chosen.path, chosen.width, chosen.height = str(tmp_path / "film.mp4"), 64, 64
    head.risorius.bake.onset = head.risorius.bake.apex = head.risorius.bake.offset = 0.1
    assert bpy.ops.risorius.render_film() == {"FINISHED"}
    assert shape_keys.has_own(head)
    movie = bpy.data.movieclips.load(str(tmp_path / "film.mp4"))
    assert movie.frame_duration == 9


@pytest.mark.slow
def test_a_cancelled_film_takes_its_bake_away_again(head: Any, tmp_path: Path) -> None:
    from risorius.operators.film.ops import RISORIUS_OT_render_film

    chosen = bpy.context.scene.risorius.film
    chosen.path, chosen.width, chosen.height = str(tmp_path / "film.mp4"), 64, 64
    head.risorius.bake.onset = head.risorius.bake.apex = head.risorius.bake.offset = 0.1
    work = RISORIUS_OT_render_film.work(None, bpy.context)
    while not shape_keys.has_own(head):
        next(work)
    next(work)
    work.close()
    assert head.data.shape_keys is None
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.smoke
def test_unwritable_output_is_refused_before_rendering(
    head: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocked = tmp_path / "a file"
    blocked.write_text("")
    monkeypatch.setattr(film, "render_frames", lambda *_, **__: pytest.fail("rendered"))
    for path in (blocked / "film.mp4", tmp_path):
        with pytest.raises(SceneError, match=r"cannot be written .*choose a folder you may write to"):
            run(film.render_film([head], path, start=1, end=2))
    bpy.context.scene.risorius.film.path = " "
    with pytest.raises(RuntimeError, match="choose one"):
        bpy.ops.risorius.render_film()
    if os.geteuid() != 0:
        tmp_path.chmod(0o500)
        with pytest.raises(SceneError, match="cannot be written"):
            film.refuse_unwritable_output(tmp_path / "film.mp4")


def test_a_cancelled_film_leaves_no_trace_and_the_old_film(nodding: Any, tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    path.write_text("the old film")
    before = counted()
    work = film.render_film([nodding], path, start=1, end=5, look=SMALL)
    next(work)
    assert counted() != before
    work.close()
    assert counted() == before
    assert path.read_text() == "the old film"
    assert [p.name for p in tmp_path.iterdir()] == ["film.mp4"]


def test_without_egl_cycles_draws_and_it_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.scene.pictures import look

    monkeypatch.setattr(look, "can_draw", lambda: False)
    assert usable_engine(Engine.WORKBENCH) == (Engine.CYCLES, gpu_probe.REMEDY)
    assert usable_engine(Engine.EEVEE)[0] is Engine.CYCLES
    assert usable_engine(Engine.CYCLES) == (Engine.CYCLES, None)


def test_odd_sizes_are_refused() -> None:
    with pytest.raises(ParameterError, match="even number of pixels"):
        Look(width=101)


def test_the_face_is_framed_whatever_its_pose(head: Any) -> None:
    upright = framing_of(head)
    np.testing.assert_allclose(upright.left, [1.0, 0.0, 0.0], atol=0.05)
    np.testing.assert_allclose(upright.forward, [0.0, -1.0, 0.0], atol=0.05)
    head.rotation_euler, head.location, head.scale = (0.0, 0.0, np.pi / 2), (3.0, 0.0, 0.0), (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    turned = framing_of(head)
    np.testing.assert_allclose(turned.left, [0.0, 1.0, 0.0], atol=0.05)
    np.testing.assert_allclose(turned.forward, [1.0, 0.0, 0.0], atol=0.05)
    assert turned.height == pytest.approx(2.0 * upright.height, rel=1e-3)
    assert abs(turned.centre[0] - 3.0) < 0.3


def test_letters_are_black_on_white(tmp_path: Path) -> None:
    before = counted()
    texts = [Text(("Joy", "F12"), 10.0, 30.0, 20.0), Text(("7",), 190.0, 30.0, 20.0, right=True)]
    pixels = write_text(texts, 200, 80, tmp_path)
    assert pixels.shape == (80, 200, 3)
    assert pixels[:, 60:150].min() > 0.95
    assert pixels[10:35, 10:50].min() < 0.1
    assert pixels[40:70, 10:50].min() < 0.1
    assert pixels[10:35, 170:190].min() < 0.1
    assert pixels[40:70, 150:].min() > 0.95
    assert counted() == before


@pytest.mark.slow
def test_a_sheet_holds_the_pictures(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    exhibits = []
    for number in range(4):
        picture = write_picture(np.full((64, 320, 3), rng.integers(0, 255, 3) / 255.0), tmp_path / f"{number}.png")
        exhibits.append(Exhibit(f"word {number}", "activation 4.0", picture, {"F3 open_jaw": (10.0 * number, np.nan)}))
    sheet = read_picture(write_sheet(exhibits, tmp_path / "sheet.png"))
    for exhibit in exhibits:
        colour = read_picture(exhibit.picture)[0, 0]
        assert (np.abs(sheet - colour).max(axis=2) < 0.01).sum() >= 64 * 320
