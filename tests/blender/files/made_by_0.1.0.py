"""How the files of 0.1.0 beside this were made, by 0.1.0 itself, in Blender 4.2 and 4.5.

    PYTHONPATH=FOLDER python made_by_0.1.0.py OUTPUT TOOLS

FOLDER holds the sources of 0.1.0 as `risorius`, TOOLS is the folder of `saved_state`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import bpy
import numpy as np
import risorius
from risorius import api
from risorius.mpeg4.preset_file import write_preset
from risorius.operators.library.exchange import expression_of, timeline_of

OUT = Path(sys.argv[1]).resolve()
sys.path.insert(0, sys.argv[2])


def main() -> None:
    """Three faces in one file, with the files beside it."""
    from saved_state import saved_state

    OUT.mkdir(parents=True, exist_ok=True)
    risorius.register()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    frames = np.round(api.envelope(api.expression("surprise"), onset=0.4, apex=0.2, offset=0.4, fps=25.0))
    api.write_fap(OUT / "stream.fap", api.FapStream(frames, fps=25.0, name="kept"))
    api.write_fba(OUT / "stream.fba", api.FapStream(frames, fps=25.0, name="kept"))
    strips = face_of_strips()
    face_of_motions()
    face_of_parts()
    for obj in bpy.data.objects:
        obj.hide_set(False)
    write_preset(OUT / "timeline.toml", timeline_of(strips, bpy.context.scene))
    write_preset(OUT / "expression.toml", expression_of(strips))
    state = json.dumps(saved_state(), indent=1, ensure_ascii=False)
    (OUT / "saved.state.json").write_text(state + "\n", encoding="utf-8")
    bpy.ops.wm.save_as_mainfile(filepath=str(OUT / "saved.blend"), compress=True)


def face_of_strips() -> bpy.types.Object:
    """Clips baked as strips, one of them changed since; settings other than by default; a key of the user's."""
    head = small_head("Strips", 0.15)
    bpy.ops.risorius.find_points()
    head.shape_key_add(name="Basis")
    head.shape_key_add(name="My Key").data[5].co.x += 0.001
    head["mine"] = 3
    chosen, timeline = head.risorius, head.risorius.timeline
    add_clips(head, ("fear", 1), ("sadness", 40), ("joy", 80))
    timeline.active = 1
    timeline.clips[1].peak, timeline.clips[1].name = 0.5, "the sad one"
    timeline.clips[2].mute = True
    timeline.clips[2].ramp = timeline.clips[2].bl_rna.properties["ramp"].enum_items[-1].identifier
    bpy.ops.risorius.bake_strips()
    timeline.clips[0].onset, timeline.linked = 0.75, False
    chosen.emotion.by, chosen.emotion.angle, chosen.emotion.activation, chosen.emotion.seed = "WHEEL", 1.25, 4.5, 7
    chosen.emotion.drive = "exact"
    chosen.tissue.kind = chosen.tissue.bl_rna.properties["kind"].enum_items[1].identifier
    for prop in timeline.variation.bl_rna.properties:
        if prop.type in ("FLOAT", "INT"):
            setattr(timeline.variation, prop.identifier, 0.5 if prop.type == "FLOAT" else 11)
    for name, contraction in (("zygomaticus_major_l", 0.4), ("frontalis_med_r", 0.25)):
        item = chosen.muscles.by_hand.add()
        item.name, item.contraction = name, contraction
    return head


def face_of_motions() -> None:
    """A motion with markers and wrinkles, and a stream of FAPs."""
    head = small_head("Motion", 0.15)
    head.risorius.bake.creases, head.risorius.bake.clip = True, "mine"
    add_clips(head, ("anger", 1), ("disgust", 30))
    bpy.ops.risorius.bake_motion()
    bpy.context.scene.frame_set(101)
    bpy.ops.risorius.import_fap(filepath=str(OUT / "stream.fap"))
    bpy.context.scene.frame_set(1)


def face_of_parts() -> None:
    """Eyes as objects of their own, an expression, and shape keys for engines."""
    head = small_head("Parts", 0.2)
    left, right = (cut_out(head, loose, name) for name, loose in eyes_of(head).items())
    alone(head)
    bpy.ops.risorius.find_points()
    head.risorius.face.eyeball_l, head.risorius.face.eyeball_r = left, right
    head.risorius.emotion.word = "surprise"
    bpy.ops.risorius.bake_expression()
    shapes = bpy.context.scene.risorius.shapes
    shapes.names = shapes.bl_rna.properties["names"].enum_items[1].identifier
    bpy.ops.risorius.make_shapes()
    head.risorius.emotion.word = "worried"


def small_head(name: str, ratio: float) -> bpy.types.Object:
    """The default head with a share of its vertices and without points."""
    bpy.ops.risorius.add_head()
    head = bpy.context.object
    head.name = name
    bpy.ops.risorius.forget_points()
    head.modifiers.new("Fewer", "DECIMATE").ratio = ratio
    bpy.ops.object.modifier_apply(modifier="Fewer")
    alone(head)
    return head


def alone(obj: bpy.types.Object) -> None:
    """The one that operators work on, and the only mesh in sight."""
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    for other in bpy.data.objects:
        other.hide_set(other != obj)


def add_clips(head: bpy.types.Object, *clips: tuple[str, int]) -> None:
    """Words and the frames at which they begin."""
    for word, start in clips:
        head.risorius.emotion.word = word
        bpy.ops.risorius.add_clip()
        head.risorius.timeline.clips[-1].start = start


def eyes_of(head: bpy.types.Object) -> dict[str, np.ndarray]:
    """The places of the vertices of both eyeballs: the loose pieces as deep as wide beside the middle, left first."""
    leads = list(range(len(head.data.vertices)))

    def lead(index: int) -> int:
        while leads[index] != index:
            index = leads[index]
        return index

    for edge in head.data.edges:
        leads[lead(edge.vertices[0])] = lead(edge.vertices[1])
    pieces = np.array([lead(index) for index in leads])
    places = np.array([vertex.co for vertex in head.data.vertices])
    found = {}
    for piece in set(pieces):
        own = places[pieces == piece]
        across = own.mean(axis=0)[0]
        if abs(abs(across) - 0.031) < 0.006 and np.ptp(own, axis=0).min() > 0.02 and np.ptp(own, axis=0).max() < 0.034:
            found["Left Eye" if across > 0.0 else "Right Eye"] = own
    return dict(sorted(found.items()))


def cut_out(head: bpy.types.Object, places: np.ndarray, name: str) -> bpy.types.Object:
    """Vertices at these places as an object of their own."""
    alone(head)
    wanted = {tuple(np.round(place, 6)) for place in places}
    for item in (*head.data.polygons, *head.data.edges):
        item.select = False
    for vertex in head.data.vertices:
        vertex.select = tuple(np.round(np.array(vertex.co), 6)) in wanted
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="VERT")
    bpy.ops.mesh.separate(type="SELECTED")
    bpy.ops.object.mode_set(mode="OBJECT")
    made = next(obj for obj in bpy.context.selected_objects if obj != head)
    made.name = name
    return made


if __name__ == "__main__":
    main()
