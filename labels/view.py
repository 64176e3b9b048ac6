"""A camera as it takes one picture: where places of the world fall in it.

Pixels are counted from the upper left corner of the picture, x to the right and y down; the middle of the first pixel
is at (0.5, 0.5). The camera's own axes are x to the right of the picture, y down, z away from the camera.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats


@dataclass(frozen=True, eq=False)
class View:
    """One picture's camera, without distortion.

    Attributes
    ----------
    width, height : pixels.
    intrinsics : (3, 3) "K": places before the camera to pixels. Without perspective, its first two rows take metres to
        pixels.
    rotation, shift : (3, 3), (3,) world to camera: ``rotation @ place + shift``, metres.
    perspective : whether what is farther away looks smaller.
    near, far : metres; what is nearer or farther is not drawn.
    lens, sensor : focal length, and width and height of the sensor, millimetres; NaN without perspective.
    """

    width: int
    height: int
    intrinsics: Floats
    rotation: Floats
    shift: Floats
    perspective: bool = True
    near: float = 0.0
    far: float = np.inf
    lens: float = np.nan
    sensor: tuple[float, float] = (np.nan, np.nan)

    def before(self, places: Floats) -> Floats:
        """(n, 3) places of the world in the camera's axes, metres."""
        turned: Floats = places @ self.rotation.T + self.shift
        return turned

    def pixels(self, before: Floats) -> Floats:
        """(n, 2) where places (n, 3) in the camera's axes fall in the picture; NaN behind the camera.

        Examples
        --------
        >>> view = api.View(640, 480, np.array([[500, 0, 320], [0, 500, 240], [0, 0, 1.0]]), np.eye(3), np.zeros(3))
        >>> view.pixels(np.array([[0.0, 0.0, 2.0], [0.2, -0.1, 1.0]])).tolist()
        [[320.0, 240.0], [420.0, 190.0]]
        """
        if not self.perspective:
            flat: Floats = before[:, :2] @ self.intrinsics[:2, :2].T + self.intrinsics[:2, 2]
            return flat
        depth = np.where(before[:, 2:] > 0.0, before[:, 2:], np.nan)
        seen: Floats = (before / depth) @ self.intrinsics[:2].T
        return seen

    def within(self, pixels: Floats) -> Bools:
        """(n,) which places (n, 2) lie in the picture."""
        x, y = pixels.T
        return np.asarray((x >= 0.0) & (x < self.width) & (y >= 0.0) & (y < self.height))

    def toward(self, before: Floats) -> Floats:
        """(n, 3) unit vectors along which the camera sees places (n, 3), both in its axes."""
        if not self.perspective:
            return np.broadcast_to(np.array([0.0, 0.0, 1.0]), before.shape)
        way: Floats = before / np.maximum(np.linalg.norm(before, axis=1, keepdims=True), np.finfo(float).tiny)
        return way
