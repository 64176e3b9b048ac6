"""Blender's own Rigify face rig, old and new, on the default head: the six emotions on its bones, on one contact sheet.

    .venv-bpy-4.5/bin/python tools/rigify_face.py [old] [new]

writes out/rigify/NAME.png, above each expression as the muscles make it and below it on the bones, front and
three-quarter; and prints how near the bones come. Needs Blender's module.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from places import OUT

WORDS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")
#: Joints of Rigify's sample face, left side: the feature point each belongs on.
JOINTS = {
    ("lip.T.L", "head"): "8.1",
    ("lip.T.L", "tail"): "8.5",
    ("lip.T.L.001", "tail"): "8.3",
    ("lip.B.L", "head"): "8.2",
    ("lip.B.L", "tail"): "8.7",
    ("jaw", "tail"): "2.1",
    ("chin.001", "head"): "2.10",
    ("nose.001", "tail"): "9.3",
    ("nose.004", "head"): "9.15",
    ("nose.L", "tail"): "9.1",
    ("lid.B.L", "head"): "3.11",
    ("lid.T.L", "head"): "3.7",
    ("lid.T.L.001", "tail"): "3.1",
    ("lid.B.L.001", "tail"): "3.3",
    ("brow.T.L.003", "head"): "4.1",
    ("brow.T.L.002", "head"): "4.3",
    ("brow.T.L.001", "head"): "4.5",
    ("cheek.B.L", "tail"): "5.1",
    ("cheek.T.L", "tail"): "5.3",
    ("jaw.L", "tail"): "2.13",
    ("ear.L.003", "tail"): "10.5",
    ("ear.L.001", "tail"): "10.1",
    ("ear.L", "head"): "10.7",
    ("forehead.L.002", "head"): "11.3",
    ("teeth.T", "head"): "9.10",
    ("teeth.B", "head"): "9.11",
    ("tongue", "head"): "6.1",
}
#: Feature points of the left and those of the right.
MIRRORED = {"8.3": "8.4", "8.5": "8.6", "8.7": "8.8", "9.1": "9.2", "3.11": "3.8", "3.7": "3.12", "3.1": "3.2"} | {
    "3.3": "3.4", "4.1": "4.2", "4.3": "4.4", "4.5": "4.6", "5.1": "5.2", "5.3": "5.4", "2.13": "2.14"
} | {"10.5": "10.6", "10.1": "10.2", "10.7": "10.8", "11.3": "11.2"}  # fmt: skip
#: Joints that go with the head alone take what is farther from all bones than this, metres, by the same falloff.
FALLOFF, BACKGROUND = 0.011, 0.05
#: Brows have the mean weights of so many vertices of the skin.
NEAR = 6
#: Rounds in which weights are smoothed along the skin.
SMOOTHED = 6
#: Bones that deform nothing in Rigify's old face although users bind eyes and teeth to them.
RIGID = {
    "old": {1: "MCH-eye.L", 2: "MCH-eye.R", 3: "ORG-teeth.T", 4: "ORG-teeth.B", "head": "ORG-face"},
    "new": {1: "DEF-eye.L", 2: "DEF-eye.R", 3: "DEF-teeth.T", 4: "DEF-teeth.B", "head": "ORG-face"},
}
#: Parts of the head's mesh.
SKIN, TONGUE, BROWS = 0, 5, 6
SIDE, YAWS = 300, (0.0, 0.6)


def rigged_head(kind: str) -> tuple[Any, Any]:
    """The default head in the open file, bound to Rigify's old or new face rig; the head and the rig."""
    import bpy

    enable_rigify()
    from rigify import generate
    from risorius.scene.head import add_default_head

    head = add_default_head()
    metarig = fitted_metarig(head)
    if kind == "new":
        bpy.ops.object.mode_set(mode="POSE")
        metarig.data.bones.active = metarig.data.bones["face"]
        with quiet():
            bpy.ops.pose.rigify_upgrade_face()
        bpy.ops.object.mode_set(mode="OBJECT")
    with quiet():
        generate.generate_rig(bpy.context, metarig)
    rig = bpy.context.view_layer.objects.active
    metarig.hide_set(True)
    bind(head, rig, RIGID[kind])
    return head, rig


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Rigify tells a lot."""
    with contextlib.redirect_stdout(io.StringIO()):
        yield


def enable_rigify() -> None:
    """Turn Blender's add-on on."""
    import addon_utils

    with quiet():
        addon_utils.enable("rigify", default_set=True)


def feature_points(head: Any) -> dict[str, Any]:
    """Name -> place (3,) of the feature points of a head."""
    from risorius.scene.mesh import mesh_vertices
    from risorius.scene.points.stored import stored_points

    vertices = mesh_vertices(head.data)
    return {n: vertices[p] if isinstance(p, int) else np.asarray(p) for n, p in stored_points(head).items()}


def fitted_metarig(head: Any) -> Any:
    """Rigify's sample of a face, its joints warped to where the feature points of the head are."""
    import bpy
    from rigify.rigs.faces import super_face
    from risorius.scene.mesh import mesh_vertices, read_parts
    from scipy.interpolate import RBFInterpolator

    points, vertices, parts = feature_points(head), mesh_vertices(head.data), read_parts(head.data)
    data = bpy.data.armatures.new("metarig")
    metarig = bpy.data.objects.new("metarig", data)
    bpy.context.collection.objects.link(metarig)
    bpy.context.view_layer.objects.active = metarig
    bpy.ops.object.mode_set(mode="EDIT")
    super_face.create_sample(metarig)
    joints: Any = data.edit_bones
    pairs = [(np.array(getattr(joints[bone], end)), points[name]) for (bone, end), name in JOINTS.items()]
    pairs += [
        (np.array(getattr(joints[bone.replace(".L", ".R")], end)), points[MIRRORED[name]])
        for (bone, end), name in JOINTS.items()
        if name in MIRRORED
    ]
    for side, part in (("L", 1), ("R", 2)):
        ball = vertices[parts == part]
        pairs.append((np.array(joints[f"eye.{side}"].head), (ball.min(axis=0) + ball.max(axis=0)) / 2.0))
    before, after = (np.array(ends) for ends in zip(*pairs, strict=True))
    warp = RBFInterpolator(before, after, kernel="thin_plate_spline")
    ends = {bone.name: warp(np.array([bone.head, bone.tail])) for bone in joints}
    for bone in joints:
        bone.head, bone.tail = ends[bone.name]
    bpy.ops.object.mode_set(mode="OBJECT")
    return metarig


def bind(head: Any, rig: Any, rigid: dict[Any, str]) -> None:
    """Bind a head to a rig: skin to the deforming bones that are near along the skin, other parts to one bone each.

    Blender's own automatic weights find no solution for bones that lie in the skin.
    """
    from risorius.scene.mesh import read_parts

    parts = read_parts(head.data)
    assert parts is not None
    for name in rigid.values():
        rig.data.bones[name].use_deform = True
    weights = skin_weights(head, rig, set(rigid.values()), parts)
    weights = {name: np.where(np.isin(parts, [1, 2, 3, 4]), 0.0, own) for name, own in weights.items()}
    for part, name in rigid.items():
        if part == "head":
            weights[name] = np.where(np.isin(parts, [1, 2, 3, 4]), 0.0, 1.0 - sum(weights.values()))
        else:
            weights[name] = (parts == part).astype(float)
    for name, own in weights.items():
        group = head.vertex_groups.new(name=name)
        for vertex in np.flatnonzero(own > 1e-3):
            group.add([int(vertex)], float(own[vertex]), "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig


def skin_weights(head: Any, rig: Any, apart: set[str], parts: Any) -> dict[str, Any]:
    """Deforming bone -> (V,) weights that fall off with the distance along the skin; brows have those below them."""
    from risorius.scene.mesh import edge_vertices, mesh_vertices
    from scipy import sparse
    from scipy.sparse.csgraph import dijkstra
    from scipy.spatial import cKDTree

    vertices, edges = mesh_vertices(head.data), edge_vertices(head.data)
    length = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
    graph = sparse.coo_array((length, edges.T), shape=(len(vertices),) * 2).tocsr()
    bones = [bone for bone in rig.data.bones if bone.use_deform and bone.name not in apart]
    nearness = []
    for bone in bones:
        along = np.linspace(np.array(bone.head_local), np.array(bone.tail_local), 9)
        own = np.flatnonzero(parts == (TONGUE if "tongue" in bone.name else SKIN))
        seeds = own[np.unique(np.linalg.norm(vertices[own, None] - along, axis=2).argmin(axis=0))]
        distance = dijkstra(graph, directed=False, indices=seeds, min_only=True)
        nearness.append(np.exp(-((distance / FALLOFF) ** 2)))
    shares = np.array(nearness)
    shares /= shares.sum(axis=0) + BACKGROUND
    mean = graph.astype(bool).astype(float)
    mean = mean + mean.T
    mean = sparse.diags_array(1.0 / np.maximum(np.asarray(mean.sum(axis=1)).ravel(), 1.0)) @ mean
    for _ in range(SMOOTHED):
        shares = (shares + (mean @ shares.T).T) / 2.0
    skin, brows = np.flatnonzero(parts == SKIN), np.flatnonzero(parts == BROWS)
    below = skin[cKDTree(vertices[skin]).query(vertices[brows], k=NEAR)[1]]
    shares[:, brows] = shares[:, below].mean(axis=2)
    return {bone.name: own for bone, own in zip(bones, shares, strict=True)}


def one(kind: str, sheet: Path) -> dict[str, Any]:
    """Bake the six emotions onto one rig, draw the sheet, and tell how near they come."""
    import bpy
    import risorius
    from risorius import api
    from risorius.progress import run
    from risorius.scene.bake import ClipTiming, Target
    from risorius.scene.faces import face_of, read_face
    from risorius.scene.rig import bone_rig
    from risorius.scene.rig.baking import Expression, Onto, bake_expressions_onto

    risorius.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    head, rig = rigged_head(kind)
    source = read_face(head)
    face = face_of(source)
    begun = time.monotonic()
    run(bone_rig(source))
    told: dict[str, Any] = {"rig": kind, "bones": len(rig.pose.bones), "sampling": time.monotonic() - begun}
    emotions = {word: api.expression(word) for word in WORDS}
    poses = [face.pose(e.frame(), emotion=e.weights).positions for e in emotions.values()]
    timing = [ClipTiming(0.2, 0.2, 0.2, start=1.0 + 30.0 * number) for number in range(len(WORDS))]
    asked = [
        Expression(word, each.frame(), when, emotion=each.weights)
        for (word, each), when in zip(emotions.items(), timing, strict=True)
    ]
    begun = time.monotonic()
    results = run(bake_expressions_onto(Target(head), asked, bone_rig, onto=Onto(symmetric=True)))
    told["baking"] = time.monotonic() - begun
    for result in results:
        assert result.followed is not None
        off = 1000.0 * float(result.followed.off.max())
        told[result.clip] = {"explained": result.followed.explained, "off_mm": off}
        print(*result.remarks, sep="\n", file=sys.stderr)
    picture(head, source.vertices, poses, sheet)
    return told


def picture(head: Any, rest: Any, poses: list[Any], path: Path) -> None:
    """Rest and six emotions: by the muscles, and on the bones below; from the front, then from the left."""
    import bpy
    from risorius.scene.mesh import keys_of, write_key_vertices
    from risorius.scene.pictures.framing import framing_of
    from risorius.scene.pictures.lettering import read_picture, write_picture
    from risorius.scene.pictures.look import Look
    from risorius.scene.pictures.studio import render_frame, studio

    framing = framing_of(head)
    shown = head.copy()
    shown.data = head.data.copy()
    shown.modifiers.clear()
    bpy.context.collection.objects.link(shown)
    keys_of(shown)
    for number, pose in enumerate([rest, *poses]):
        key = shown.shape_key_add(name=str(number), from_mix=False)
        write_key_vertices(key, pose)
    rows = []
    for yaw in YAWS:
        for obj in (shown, head):
            seen = []
            with (
                tempfile.TemporaryDirectory() as folder,
                studio([obj], framing, Look(width=SIDE, height=SIDE, yaw=yaw)) as scene,
            ):
                for number in range(len(poses) + 1):
                    for key in shown.data.shape_keys.key_blocks[1:]:
                        key.value = float(key.name == str(number))
                    frame = 1 if number == 0 else round(30 * (number - 1) + 1 + 0.3 * bpy.context.scene.render.fps)
                    seen.append(read_picture(render_frame(scene, frame, Path(folder))))
            rows.append(np.concatenate(seen, axis=1))
    path.parent.mkdir(parents=True, exist_ok=True)
    write_picture(np.concatenate(rows, axis=0), path)


def main() -> None:
    """Each rig in a process of its own: Blender's module holds one file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rigs", nargs="*", choices=["old", "new"], default=["old", "new"])
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.here:
        print(json.dumps(one(arguments.rigs[0], OUT / "rigify" / f"{arguments.rigs[0]}.png")), flush=True)
        os._exit(0)
    for kind in arguments.rigs:
        command = [sys.executable, __file__, "--here", kind]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
        print(done.stdout.splitlines()[-1])


if __name__ == "__main__":
    main()
