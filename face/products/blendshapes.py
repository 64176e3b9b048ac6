"""Shape keys that engines and trackers know by name, made by posing the muscles of one face."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAP_COUNT
from ...mpeg4.streams.capture import CaptureShape, KeyShape, load_key_names, load_shapes
from ...progress import Progress, Work, run
from ..drive.request import Drive
from ..face import Face
from ..pose import Pose
from ..unmet import unmet_lines

#: A shape that moves a life-size face less than this, metres, moves nothing.
STILL = 1e-5


class Shapes(dict[str, Floats]):
    """Name -> (V, 3) positions at full strength; `unmet`: name -> why, of shapes that ask for what does not show."""

    def __init__(self) -> None:
        super().__init__()
        self.unmet: dict[str, str] = {}


def arkit_shapes(face: Face, names: str | Path = "arkit") -> Shapes:
    """Shape keys of a face, by name.

    Parameters
    ----------
    names : "arkit" for the 52 of ARKit, another preset of key names ("oculus_visemes", "ict_facekit"), or a TOML file
        of your own (docs/formats.md).

    Returns
    -------
    name -> (V, 3) positions at full strength, in the face's coordinates. The key's displacement is what differs from
    ``face.vertices``; displacements of several keys add up, as in any engine. `unmet` of the mapping names the shapes
    that ask for what does not show on this face, and why.

    Raises
    ------
    FormatError : a table of names that breaks a rule.
    ParameterError : a shape of muscles that this face has not.

    Examples
    --------
    >>> face = api.default_face()
    >>> shapes = api.arkit_shapes(face, "oculus_visemes")
    >>> shapes["viseme_aa"].shape == face.vertices.shape
    True
    """
    return run(arkit_shape_steps(face, load_key_names(names)))


def arkit_shape_steps(face: Face, keys: Mapping[str, KeyShape]) -> Work[Shapes]:
    """`arkit_shapes` as a generator, for callers that show progress."""
    yield Progress(0.0, "Placing the muscles")
    poser = _ShapePoser(face)
    shapes = Shapes()
    for name, key in keys.items():
        yield Progress(0.1 + 0.9 * len(shapes) / len(keys), f"Posing {name}")
        moved = sum(
            (share * poser.moved(shape, key.natural) for shape, share in key.parts), np.zeros_like(face.vertices)
        )
        shapes[name] = face.vertices + moved
        why = dict.fromkeys(why for shape, _ in key.parts for why in poser.unmet[shape.name, key.natural])
        if why:
            shapes.unmet[name] = "; ".join(why)
    return shapes


class _ShapePoser:
    """Displacements of blend shapes on one face, each posed once."""

    def __init__(self, face: Face) -> None:
        self.face = face
        self.rest = face.pose(np.full(FAP_COUNT, np.nan), drive=Drive.MUSCLES).positions
        self.done: dict[tuple[str, bool], Floats] = {}
        self.unmet: dict[tuple[str, bool], tuple[str, ...]] = {}

    def moved(self, shape: CaptureShape, natural: bool) -> Floats:
        """(V, 3) displacement of a shape at full strength."""
        key = (shape.name, natural)
        if key not in self.done:
            moved, pose = self._moved(shape, natural)
            self.done[key], self.unmet[key] = moved, unmet_lines(pose.unmet)
            if shape.contractions and not np.abs(moved).max() > STILL * self.face.scale:
                self.unmet[key] = (f"its muscles ({', '.join(shape.contractions)}) move nothing",)
        return self.done[key]

    def _moved(self, shape: CaptureShape, natural: bool) -> tuple[Floats, Pose]:
        """See `moved`: muscles as they are given, measured FAPs met exactly, a correction over what it corrects."""
        if shape.contractions:
            silent = np.full(FAP_COUNT, np.nan)
            pose = self.face.pose(silent, drive=Drive.MUSCLES, contractions=shape.contractions)
            return pose.positions - self.rest, pose
        if shape.over is None:
            pose = self.face.pose(shape.frame, drive=Drive.NATURAL if natural else Drive.EXACT)
            return pose.positions - self.face.vertices, pose
        below = load_shapes()[shape.over]
        both = np.where(np.isnan(shape.frame), below.frame, np.nan_to_num(below.frame) + shape.frame)
        pose = self.face.pose(both, drive=Drive.EXACT)
        return pose.positions - self.face.vertices - self.moved(below, False), pose
