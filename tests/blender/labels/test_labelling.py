"""Labels of a rendered motion: what every table says, checked against the pictures and the mesh itself."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import FormatError
from risorius.progress import run
from risorius.scene.bake import Target, shape_keys
from risorius.scene.bake.motion import CueMotion
from risorius.scene.jobs.labelling import Labels, begin
from risorius.scene.jobs.subjects import Subject
from risorius.scene.pictures.film import render_frames
from risorius.scene.pictures.look import Look

SMALL = Look(width=128, height=96, yaw=0.3)
CUE = api.Cue(api.expression("joy"), start=0.04, onset=0.04, apex=0.04, offset=0.04)
MOTION = CueMotion([CUE])


@pytest.fixture
def smiling(head: Any) -> Any:
    """A head that smiles at frame 4, by one shape key."""
    bpy.context.scene.render.fps = 25
    pose = api.default_face().pose(api.expression("joy").frame())
    shape_keys.write_keys(head, "joy", {"joy": np.asarray(pose.positions)})
    block = head.data.shape_keys.key_blocks["joy"]
    for frame, value in ((1, 0.0), (4, 1.0)):
        block.value = value
        block.keyframe_insert("value", frame=frame)
    return head


def rows(folder: Path, name: str) -> list[dict[str, str]]:
    """A table as text."""
    with (folder / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def figures(path: Path) -> Any:
    """(height, width) figures of a picture of 16 bits, as Blender reads it."""
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    flat = np.array(image.pixels[:]).reshape(height, width, 4)[::-1, :, 0]
    return np.rint(flat * 65535.0)


def labelled(head: Any, folder: Path, pictures: int = 3, *, frames: tuple[int, int] = (1, 4)) -> Path:
    """Labels of some frames of a head."""
    labelling = begin(Labels(folder / "labels", pictures), Subject(Target(head)), MOTION, start=1)
    run(render_frames([head], folder, start=frames[0], end=frames[1], look=SMALL, watch=labelling.look))
    return labelling.write(SMALL)


@pytest.mark.slow
def test_every_table_tells_every_frame(smiling: Any, tmp_path: Path) -> None:
    folder = labelled(smiling, tmp_path)
    frames = rows(folder, "frames")
    assert [row["frame"] for row in frames] == ["1", "2", "3", "4"]
    assert [row["time"] for row in frames] == ["0.000000", "0.040000", "0.080000", "0.120000"]
    assert [row["word"] for row in frames] == ["", "", "joy", "joy"]
    assert [row["picture"] for row in frames] == ["00001.png", "", "", "00004.png"]
    assert {row["frame"] for row in rows(folder, "camera")} == {"1", "2", "3", "4"}
    faps = rows(folder, "faps")
    pose = api.default_face().pose(api.expression("joy").frame())
    achieved = {int(row["fap"]): float(row["achieved"] or "nan") for row in faps if row["frame"] == "4"}
    np.testing.assert_allclose([achieved[n] for n in range(3, 69)], pose.achieved[2:], atol=0.1)
    smile = [row for row in rows(folder, "muscles") if row["muscle"] == "zygomaticus_major" and row["side"] == "left"]
    assert [float(row["contraction"]) > 0.2 for row in smile] == [False, False, True, True]
    units = [row for row in rows(folder, "action_units") if row["unit"] == "AU12" and row["frame"] == "4"]
    assert {row["side"] for row in units} == {"left", "right"}
    assert all(float(row["explained"]) > 0.2 for row in units)
    points = [row for row in rows(folder, "landmarks") if row["set"] == "mpeg4" and row["frame"] == "1"]
    assert len(points) == len(api.FEATURE_POINTS)


@pytest.mark.slow
def test_the_schema_names_every_column_of_every_table(smiling: Any, tmp_path: Path) -> None:
    folder = labelled(smiling, tmp_path, 0, frames=(1, 1))
    package = json.loads((folder / "datapackage.json").read_text(encoding="utf-8"))
    assert package["profile"] == "tabular-data-package"
    for resource in package["resources"]:
        assert resource["profile"] == "tabular-data-resource"  # that profile asks for it
        table = rows(folder, resource["name"])
        fields = resource["schema"]["fields"]
        assert [field["name"] for field in fields] == list(table[0])
        assert all(field["description"] for field in fields)
        assert len({tuple(row[name] for name in resource["schema"]["primaryKey"]) for row in table}) == len(table)
    card = json.loads((folder / "card.json").read_text(encoding="utf-8"))
    assert card["made_with"]["blender"] == bpy.app.version_string
    assert card["motion"]["cues"][0]["word"] == "joy"
    assert not (folder / "pictures").exists()


@pytest.mark.slow
def test_labels_are_the_same_bytes_again_and_replace_earlier_ones(smiling: Any, tmp_path: Path) -> None:
    folder = labelled(smiling, tmp_path)
    first = {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    again = labelled(smiling, tmp_path)
    assert {path.relative_to(again): path.read_bytes() for path in again.rglob("*") if path.is_file()} == first
    assert [path.name for path in tmp_path.iterdir() if path.is_dir()] == ["labels"]


def test_a_folder_with_something_else_is_refused(head: Any, tmp_path: Path) -> None:
    (tmp_path / "labels").mkdir()
    (tmp_path / "labels" / "thesis.txt").write_text("mine")
    with pytest.raises(FormatError, match="other files"):
        begin(Labels(tmp_path / "labels"), Subject(Target(head)), MOTION, start=1)
    assert [path.name for path in tmp_path.rglob("*")] == ["labels", "thesis.txt"]


@pytest.mark.slow
def test_a_point_lies_on_the_surface_that_its_pixel_shows(smiling: Any, tmp_path: Path) -> None:
    """Depth where a visible point falls is the point's own, as far as a pixel tells."""
    folder = labelled(smiling, tmp_path, 1, frames=(4, 4))
    depth = figures(folder / "pictures/depth/00004.png") * 1e-4
    seen = [row for row in rows(folder, "landmarks") if row["visible"] == "true" and row["facing"] == "true"]
    assert len(seen) > 40
    off = [abs(depth[int(float(row["y"])), int(float(row["x"]))] - float(row["camera_z"])) for row in seen]
    assert np.median(off) < 0.002


@pytest.mark.slow
def test_an_object_before_the_face_hides_it(smiling: Any, tmp_path: Path) -> None:
    verts = [(-1.0, -0.4, -1.0), (1.0, -0.4, -1.0), (1.0, -0.4, 1.0), (-1.0, -0.4, 1.0)]
    wall = bpy.data.meshes.new("Wall")
    wall.from_pydata(verts, [], [(0, 1, 2, 3)])
    other = bpy.data.objects.new("Wall", wall)
    bpy.context.scene.collection.objects.link(other)
    labelling = begin(Labels(tmp_path / "labels", 1), Subject(Target(smiling)), MOTION, start=1)
    run(render_frames([smiling, other], tmp_path, start=1, end=1, look=SMALL, watch=labelling.look))
    folder = labelling.write(SMALL)
    points = rows(folder, "landmarks")
    assert all(row["hidden"] == "true" for row in points if row["in_picture"] == "true")
    assert json.loads((folder / "card.json").read_text(encoding="utf-8"))["objects"] == [smiling.name, "Wall"]
