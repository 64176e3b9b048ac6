"""Six emotions with one button on every shared head, as importers bring it: what tears, follows, changes; and pictures.

    .venv-bpy-4.5/bin/python tools/characters.py [HEAD ...]

writes docs/characters.md and a contact sheet of each case to out/characters/: front above, three-quarter below, the
resting face first. Needs Blender's module; each case runs in a process of its own.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from places import DOCS, OUT, shared_folder

#: Heads with labelled parts, and heads by other people: name -> file below the shared heads.
LABELLED = {name: f"{name}.npz" for name in ("ict", "makehuman")}
PLAIN = {
    **{name: f"{name}.npz" for name in ("ict_narrow", "mediapipe", "makehuman_body")},
    "jeeliz_human": "others/jeeliz_human/base.obj",
    "jeeliz_boy": "others/jeeliz_boy/base.obj",
    "leeperrysmith": "others/leeperrysmith/leeperrysmith.obj",
    "menpo_james": "others/menpo_james/james.obj",
    "menpo_template": "others/menpo_james/template.ply",
    "mhr_head": "others/mhr/mhr_head.obj",
    "mhr_subject0": "others/mhr/subject0_head.obj",
    "mhr_subject1": "others/mhr/subject1_head.obj",
    "mhr_subject3": "others/mhr/subject3_head.obj",
    "mhr_body": "others/mhr/mhr_body.obj",
}
HEADS = LABELLED | PLAIN
#: How a head comes: as its file is, through a glTF file, through an OBJ file of flat shading, as several objects.
WAYS = ("file", "glTF", "OBJ", "objects")
#: Heads that are not tried in every way: one import differs little from another on a large scan.
WAYS_OF = dict.fromkeys(LABELLED, WAYS) | dict.fromkeys(PLAIN, ("file", "glTF"))
#: What labels of vertices make objects of their own, and how these are called.
OBJECTS = {"Eyes": (1, 2), "Teeth": (3, 8), "Tongue": (4,), "Eyelashes": (6,)}
WORDS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")
SIDE, YAWS = 300, (0.0, 0.6)
#: Vertices nearer than this are copies of one, share of the mesh; that is as near as importers write them.
ONE_PLACE = 1e-6


@dataclass
class Outcome:
    """What one case has shown."""

    head: str
    way: str
    vertices: int = 0
    copies: int = 0
    torn: float = float("nan")
    keys: int = 0
    others: int = 0
    follow: int = 0
    changed: int = 0
    seconds: float = 0.0
    said: str = ""


def one(head: str, way: str, sheet: Path) -> Outcome:
    """Try one case in this process."""
    import bpy
    import risorius

    risorius.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    obj = bring(head, way)
    from file_state import differences, file_state
    from risorius.operators.active import target_of

    outcome = Outcome(head, way, len(obj.data.vertices))
    others = [other for other in bpy.context.scene.objects if other.type == "MESH" and other != obj]
    outcome.others = len(others)
    before, begun = file_state(), time.monotonic()
    try:
        bpy.ops.risorius.bake_six()
    except RuntimeError as refused:
        outcome.said = " ".join(str(refused).split())[:200]
    outcome.seconds = time.monotonic() - begun
    found = differences(before, file_state())
    outcome.changed = len(found)
    print(*found, sep="\n", file=sys.stderr)
    keys = obj.data.shape_keys
    if keys is not None and not outcome.said:
        outcome.keys = sum(word in keys.key_blocks for word in WORDS)
        outcome.copies, outcome.torn = torn_seams(obj)
        target = target_of(obj)
        outcome.follow = len(target.companions) + len(target.left_behind)
        picture([obj, *others], sheet)
    return outcome


def bring(head: str, way: str) -> Any:
    """Put a head into the open file, select it, and return the object that bears the face."""
    import bpy

    path = shared_folder() / "heads" / HEADS[head]
    if path.suffix == ".npz":
        objects = from_arrays(head, path, apart=way == "objects")
    else:
        read = bpy.ops.wm.ply_import if path.suffix == ".ply" else bpy.ops.wm.obj_import
        read(filepath=str(path))
        objects = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    if way in ("glTF", "OBJ"):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / ("head.glb" if way == "glTF" else "head.obj"))
            for obj in objects if way == "OBJ" else []:
                obj.data.polygons.foreach_set("use_smooth", np.zeros(len(obj.data.polygons), dtype=bool))
            if way == "glTF":
                bpy.ops.export_scene.gltf(filepath=file, export_format="GLB")
            else:
                bpy.ops.wm.obj_export(filepath=file)
            for obj in objects:
                bpy.data.objects.remove(obj)
            if way == "glTF":
                bpy.ops.import_scene.gltf(filepath=file)
            else:
                bpy.ops.wm.obj_import(filepath=file)
        objects = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    chosen = max(objects, key=lambda obj: len(obj.data.vertices))
    for obj in bpy.context.scene.objects:
        obj.select_set(obj == chosen)
    bpy.context.view_layer.objects.active = chosen
    bpy.context.view_layer.update()
    return chosen


def from_arrays(name: str, path: Path, *, apart: bool) -> list[Any]:
    """Objects of a head in NumPy's format: one, or the skin and its labelled parts, under an empty."""
    import bpy
    from risorius.scene.mesh import new_mesh

    with np.load(path) as stored:
        data = dict(stored)
    ends = np.cumsum(data["face_sizes"])
    polygons = [data["loops"][end - size : end] for end, size in zip(ends, data["face_sizes"], strict=True)]
    labels = data["labels"] if apart else np.zeros(len(data["vertices"]), dtype=int)
    groups = {name: np.isin(labels, [0, 5, 7])} | {
        title: np.isin(labels, chosen) for title, chosen in OBJECTS.items() if apart
    }
    root = bpy.data.objects.new("Root", None)
    bpy.context.scene.collection.objects.link(root)
    made = []
    for title, inside in groups.items():
        number = np.cumsum(inside) - 1
        own = [number[polygon].tolist() for polygon in polygons if inside[polygon].all()]
        corners = np.concatenate([np.asarray(polygon) for polygon in own])
        mesh = new_mesh(title, data["vertices"][inside].astype(float), corners, np.array([len(p) for p in own]))
        if "uv" in data and not apart:
            layer: Any = mesh.uv_layers.new(name="UVMap")
            layer.data.foreach_set("uv", data["uv"].astype(np.float32).ravel())
        obj = bpy.data.objects.new(title, mesh)
        bpy.context.scene.collection.objects.link(obj)
        obj.parent = root
        made.append(obj)
    return made


def torn_seams(obj: Any) -> tuple[int, float]:
    """How many vertices have copies, and how far copies part in any expression, as a share of the mesh.

    Surfaces that face each other, as lips that touch, are no copies.
    """
    from risorius.scene.mesh import key_vertices, rest_vertices

    rest = rest_vertices(obj.data)
    size = float(np.linalg.norm(np.ptp(rest, axis=0)))
    flat = np.zeros(3 * len(rest), dtype=np.float32)
    obj.data.vertices.foreach_get("normal", flat)
    normals = flat.reshape(-1, 3)
    _, place = np.unique(np.round(rest / (ONE_PLACE * size)).astype(np.int64), axis=0, return_inverse=True)
    order = np.argsort(place.ravel(), kind="stable")
    same = np.flatnonzero(np.diff(place.ravel()[order]) == 0)
    first, second = order[same], order[same + 1]
    alike = (normals[first] * normals[second]).sum(axis=1) > -0.5
    first, second = first[alike], second[alike]
    apart = [0.0]
    for word in WORDS:
        moved = key_vertices(obj.data.shape_keys.key_blocks[word]) - rest
        apart.append(float(np.linalg.norm(moved[first] - moved[second], axis=1).max(initial=0.0)))
    return len(first), max(apart) / size


def picture(objects: list[Any], path: Path) -> None:
    """The contact sheet of a baked face: at rest and each emotion, seen from the front and from its left."""
    from risorius.scene.jobs.painting import paint_parts
    from risorius.scene.pictures.framing import framing_of
    from risorius.scene.pictures.lettering import read_picture, write_picture
    from risorius.scene.pictures.look import Look
    from risorius.scene.pictures.studio import render_frame, studio

    keyed = [obj.data.shape_keys for obj in objects if obj.data.shape_keys is not None]
    for keys in keyed:
        keys.animation_data_clear()
    if not objects[0].data.materials and len(objects) == 1:
        paint_parts(objects[0])
    rows = []
    for yaw in YAWS:
        with (
            tempfile.TemporaryDirectory() as folder,
            studio(objects, framing_of(objects[0]), Look(width=SIDE, height=SIDE, yaw=yaw)) as scene,
        ):
            seen = []
            for number, word in enumerate(("", *WORDS)):
                for keys in keyed:
                    for key in keys.key_blocks[1:]:
                        key.value = float(key.name == word)
                seen.append(read_picture(render_frame(scene, number + 1, Path(folder))))
            rows.append(np.concatenate(seen, axis=1))
    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.concatenate(rows, axis=0), path)


def page(outcomes: list[Outcome]) -> str:
    """docs/characters.md."""
    lines = [
        "# Characters as they come",
        "",
        "*Bake Six Emotions* on every shared head, as its file is, through a glTF or OBJ file, and as several objects.",
        "Written by `tools/characters.py`, which also draws a contact sheet of each case in `out/characters/`.",
        "",
        "- **copies**: pairs of vertices at one place, as importers leave them at seams.",
        "- **torn**: the largest distance between two copies in any expression, as a share of the mesh.",
        "  A hair of a lash and the lid that it stands on are such a pair, too: on the ICT head they part by 0.2 mm.",
        "- **follow**: objects beside the head that follow the face or are named as staying behind, of all there are.",
        "- **changed**: places in the file that are not Risorius' own and differ afterwards: keys, actions, drivers,",
        "  modifiers, parents, materials, ranges and all else.",
        "",
        "| head | comes as | vertices | emotions | copies | torn | follow | changed | seconds |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for one in outcomes:
        torn = "" if np.isnan(one.torn) else f"{one.torn:.0e}" if one.torn else "0"
        follow = f"{one.follow} of {one.others}" if one.others else ""
        lines.append(
            f"| {one.head} | {one.way} | {one.vertices:,} | {one.keys} of {len(WORDS)} | {one.copies:,} | {torn} "
            f"| {follow} | {one.changed} | {one.seconds:.0f} |"
        )
    refused = [one for one in outcomes if one.said]
    if refused:
        lines += ["", "Refused:", "", *(f"- {one.head}, {one.way}: {one.said}" for one in refused)]
    return "\n".join(lines) + "\n"


def run(head: str, way: str) -> Outcome:
    """Try one case in a process of its own."""
    sheet = OUT / "characters" / f"{head}_{way}.png"
    command = [sys.executable, __file__, "--one", head, way, str(sheet)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    except subprocess.TimeoutExpired:
        return Outcome(head, way, said="did not end within ten minutes")
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if not lines:
        return Outcome(head, way, said=(done.stderr.strip().splitlines() or ["ended without a word"])[-1])
    return Outcome(**json.loads(lines[-1]))


def main() -> int:
    """Run the cases asked for; 0 where all emotions are baked, nothing is torn and nothing changed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("heads", nargs="*", help=f"of {', '.join(HEADS)} (default: all, and the page is written)")
    parser.add_argument("--jobs", type=int, default=2, help="processes at once")
    parser.add_argument("--one", nargs=3, metavar=("HEAD", "WAY", "SHEET"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        outcome = one(given.one[0], given.one[1], Path(given.one[2]))
        print("\n" + json.dumps(asdict(outcome)), flush=True)
        os._exit(0)  # Blender's module may wait forever when it leaves in its own order
    cases = [(head, way) for head in given.heads or HEADS for way in WAYS_OF[head]]
    with ThreadPoolExecutor(given.jobs) as pool:
        outcomes = []
        for outcome in pool.map(lambda case: run(*case), cases):
            print(json.dumps(asdict(outcome)), flush=True)
            outcomes.append(outcome)
    if not given.heads:
        (DOCS / "characters.md").write_text(page(outcomes), encoding="utf-8")
    return int(any(one.keys < len(WORDS) or one.torn > ONE_PLACE or one.changed for one in outcomes))


if __name__ == "__main__":
    sys.exit(main())
