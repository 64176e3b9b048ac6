"""Pictures of heads by others in expressions of their own shapes, from several sides and in two lights. Needs `bpy`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from faithful.heads import heads_folder, load_face
from faithful.sitter import Sitter
from risorius.api import Face
from risorius.arrays import Floats
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.lettering import write_picture
from tracking.neutral_faces import bare_object, painted_object, read_mesh

#: Emotion -> shapes of ARKit's names, both sides, by the action units that FACS lists for it (units.csv; AU 2
#: browOuterUp, 7 eyeSquint, 9 noseSneer, 17 mouthShrugLower, 20 mouthStretch).
EXPRESSIONS: Mapping[str, Mapping[str, float]] = {
    "neutral": {},
    "joy": {"mouthSmile": 0.9, "cheekSquint": 0.8, "eyeSquint": 0.4},
    "sadness": {"browInnerUp": 0.9, "browDown": 0.3, "mouthFrown": 1.0, "mouthShrugLower": 0.4},
    "anger": {"browDown": 1.0, "eyeSquint": 0.7, "mouthPress": 1.0, "mouthShrugLower": 0.3},
    "fear": {
        "browInnerUp": 1.0, "browOuterUp": 0.6, "browDown": 0.3, "eyeWide": 1.0, "mouthStretch": 1.0, "jawOpen": 0.2,
    },
    "disgust": {"noseSneer": 1.0, "mouthUpperUp": 0.8, "browDown": 0.4, "mouthShrugLower": 0.5},
    "surprise": {"browInnerUp": 1.0, "browOuterUp": 1.0, "eyeWide": 0.8, "jawOpen": 0.6},
}  # fmt: skip

#: The same on jeeliz's heads, which have eleven shapes.
JEELIZ: Mapping[str, Mapping[str, float]] = {
    "neutral": {},
    "joy": {"smileLeft": 1.0, "smileRight": 1.0},
    "surprise": {"browLeftUp": 1.0, "browRightUp": 1.0, "mouthOpen": 0.7},
}

YAWS, LIGHTS = (0, 20, 35), ("Default", "rim.sl")
SIZE = 512


def picture_others(out: Path) -> None:
    """Write HEAD/EMOTION/YAW-LIGHT.png; heads that are there already are left."""
    for name, build in HEADS.items():
        if not (out / name).is_dir():
            obj, vertices, poses = build(name)
            _picture(obj, vertices, poses, out / name)


def _picture(obj: object, vertices: Floats, poses: Mapping[str, Floats], folder: Path) -> None:
    """Every expression from every side in both lights."""
    framing = framing_of(obj)  # type: ignore[arg-type]
    for light in LIGHTS:
        sitter = Sitter([obj], framing=framing, width=SIZE, height=SIZE, relight=_lit_by(light))
        for yaw in YAWS:
            shots = sitter.shots([vertices + change for change in poses.values()], float(np.radians(yaw)))
            for emotion, shot in zip(poses, shots, strict=True):
                path = folder / emotion / f"{yaw}-{light.removesuffix('.sl').lower()}.png"
                path.parent.mkdir(parents=True, exist_ok=True)
                write_picture(shot, path)


def _lit_by(light: str) -> Callable[[Any, object], None]:
    """What sets the studio light of a scene."""

    def relight(scene: Any, _framing: object) -> None:
        if light != LIGHTS[0]:
            scene.display.shading.studio_light = light

    return relight


def _made(shapes: Mapping[str, Floats], expressions: Mapping[str, Mapping[str, float]]) -> dict[str, Floats]:
    """Emotion -> (V, 3) change of a head's vertices; a shape without a side is both."""
    zero = np.zeros_like(next(iter(shapes.values())))
    made = {}
    for emotion, weights in expressions.items():
        made[emotion] = zero.copy()
        for name, weight in weights.items():
            for side in ("", "Left", "Right", "_L", "_R"):
                if f"{name}{side}" in shapes:
                    made[emotion] += weight * shapes[f"{name}{side}"]
    return made


def _makehuman(name: str) -> tuple[object, Floats, dict[str, Floats]]:
    """MakeHuman with the shapes that others drew."""
    face = load_face("makehuman")
    data = np.load(heads_folder() / "others" / "makehuman_arkit" / "makehuman_arkit_visemes.npz")
    shapes = dict(zip(data["names"].tolist(), data["deltas"].astype(np.float64), strict=True))
    return painted_object(name, face), face.vertices, _made(shapes, EXPRESSIONS)


def _ict(name: str) -> tuple[object, Floats, dict[str, Floats]]:
    """ICT's head with its scanned shapes; outer brows were not scanned."""
    face: Face = load_face("ict")
    shapes: dict[str, Floats] = {}
    for file in ("ict_expressions.npz", "ict_expressions_2.npz"):
        data = np.load(heads_folder() / file)
        for shape, skin in zip(data["names"].tolist(), data["displacement"].astype(np.float64), strict=True):
            shapes[shape] = np.zeros_like(face.vertices)
            shapes[shape][: len(skin)] = skin
    sitter = Sitter.of_head(name, face)
    return sitter._object, face.vertices, _made(shapes, EXPRESSIONS)


def _jeeliz(name: str) -> tuple[object, Floats, dict[str, Floats]]:
    """A head of eleven morphs."""
    path = heads_folder() / "others" / name / "shapes.npz"
    mesh, data = read_mesh(path), np.load(path)
    targets = data["targets"].astype(np.float64)
    changes = np.stack([targets[..., 0], -targets[..., 2], targets[..., 1]], axis=-1)
    shapes = dict(zip(data["names"].tolist(), changes, strict=True))
    return bare_object(name, mesh), mesh.vertices, _made(shapes, JEELIZ)


HEADS = {"makehuman": _makehuman, "ict": _ict, "jeeliz_human": _jeeliz, "jeeliz_boy": _jeeliz}
