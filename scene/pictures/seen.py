"""Whether a render shows a face at all: what hides it, and where the scene's camera loses it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

from ...errors import SceneError
from ...progress import Progress, Work
from ..blender_types import LayerCollection, Lens, Object, Scene
from .following import CarriedFace
from .framing import Framing

#: Frames that are looked at before a film; more of them tell no more.
LOOKS = 48
#: A face that is lower than this in the picture cannot be made out, pixels.
LEAST_PIXELS = 12


def hidden_by(obj: Object, scene: Scene) -> str | None:
    """What keeps an object out of a scene's renders, and the remedy, as the rest of a sentence; None: nothing does."""
    if obj.hide_render:
        return "is hidden from renders: turn on its camera icon in the Outliner"
    if scene.render.engine != "BLENDER_WORKBENCH" and not obj.visible_camera:
        return "is hidden from cameras: turn on Camera in Object Properties > Visibility > Ray Visibility"
    reasons = list(_ways_to(obj, scene.view_layers[0].layer_collection))
    return None if None in reasons or not reasons else reasons[0]


def _ways_to(obj: Object, layer: LayerCollection, above: str | None = None) -> Iterator[str | None]:
    """What hides an object in each collection that it is in."""
    name = layer.collection.name
    hidden = above
    if layer.collection.hide_render:
        hidden = f"is in the collection {name}, which is hidden from renders: turn on its camera icon in the Outliner"
    if obj.name in layer.collection.objects:
        excluded = f"is in the collection {name}, which is excluded from the view layer: check its box in the Outliner"
        yield hidden or (excluded if layer.exclude else None)
    for child in layer.children:
        yield from _ways_to(obj, child, hidden)


def refuse_hidden(objects: Sequence[Object], scene: Scene) -> tuple[str, ...]:
    """Refuse a face that renders do not show.

    Returns
    -------
    Remarks on its other objects that they do not show.

    Raises
    ------
    SceneError : with what hides the head, and the remedy.
    """
    head, *others = objects
    reason = hidden_by(head, scene)
    if reason is not None:
        raise SceneError(head.name, reason)
    found = ((other, hidden_by(other, scene)) for other in others)
    return tuple(f"{other.name} {why}" for other, why in found if why is not None)


def look_ahead(obj: Object, scene: Scene, start: int, end: int, *, camera: bool) -> Work[tuple[str, ...]]:
    """Look at some frames of a film before it is rendered.

    Parameters
    ----------
    camera : whether the scene's camera may lose the face; else only what hides it is looked for.

    Returns
    -------
    Remarks: at which frames nothing of the face will be seen, and the remedy.

    Raises
    ------
    SceneError : the face is hidden at all of them.
    """
    frames = list(range(start, end + 1, max(1, (end - start + 1) // LOOKS)))
    hidden, lost = [], []
    face = CarriedFace(obj)
    for number, frame in enumerate(frames):
        yield Progress(number / len(frames), f"Looking at frame {frame}")
        scene.frame_set(frame)
        depsgraph = scene.view_layers[0].depsgraph
        if obj.evaluated_get(depsgraph).hide_render:
            hidden.append(frame)
        elif camera and not _sees(scene, face.framing(depsgraph)):
            lost.append(frame)
    if len(hidden) == len(frames):
        raise SceneError(obj.name, f"is hidden from renders by its animation in frames {_spans(hidden, frames)}")
    said = []
    if hidden:
        said.append(f"{obj.name} is hidden from renders by its animation in frames {_spans(hidden, frames)}")
    if lost:
        assert scene.camera is not None
        said.append(
            f"{obj.name} is not in the picture of {scene.camera.name} in frames {_spans(lost, frames)}: "
            "aim the camera at the face, or set Camera to Portrait"
        )
    return tuple(said)


def _sees(scene: Scene, framing: Framing) -> bool:
    """Whether any part of a face is in the picture of the scene's camera, and large enough to be made out."""
    assert scene.camera is not None
    camera = scene.camera.evaluated_get(scene.view_layers[0].depsgraph)
    lens = cast("Lens", camera.data)
    if lens.type == "PANO":  # sees all around
        return True
    places = [(0.0, 0.0), (0.0, 0.3), (0.0, -0.3), (0.25, 0.0), (-0.25, 0.0)]
    seen = [world_to_camera_view(scene, camera, Vector(framing.point(left, up, 0.0).tolist())) for left, up in places]
    _, top, bottom = (place.y for place in seen[:3])
    inside = any(
        0.0 <= place.x <= 1.0 and 0.0 <= place.y <= 1.0 and lens.clip_start < place.z < lens.clip_end for place in seen
    )
    return inside and abs(top - bottom) * scene.render.resolution_y >= LEAST_PIXELS


def _spans(some: Sequence[int], frames: Sequence[int]) -> str:
    """Frames as spans, where those that were looked at follow one another."""
    place = {frame: number for number, frame in enumerate(frames)}
    spans: list[list[int]] = []
    for frame in some:
        if spans and place[frame] == place[spans[-1][-1]] + 1:
            spans[-1].append(frame)
        else:
            spans.append([frame])
    return ", ".join(str(span[0]) if len(span) == 1 else f"{span[0]} to {span[-1]}" for span in spans)
