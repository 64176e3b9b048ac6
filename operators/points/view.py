"""A 3D viewport under the mouse: pixels of it to rays of the world and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from bpy_extras import view3d_utils
from mathutils import Vector

from ...arrays import Floats


@dataclass(frozen=True)
class Viewport:
    """The main region of a 3D viewport."""

    region: Any
    view: Any

    @classmethod
    def of(cls, context: Any) -> Viewport | None:
        """The viewport of the context's area, whichever of its regions the pointer is in; None elsewhere."""
        area = context.area
        if area is None or area.type != "VIEW_3D":
            return None
        region = next((region for region in area.regions if region.type == "WINDOW"), None)
        return None if region is None else cls(region, area.spaces.active.region_3d)

    def pixel(self, event: Any) -> tuple[float, float] | None:
        """The pixel of the mouse; None outside the region."""
        x, y = event.mouse_x - self.region.x, event.mouse_y - self.region.y
        return (x, y) if 0 <= x < self.region.width and 0 <= y < self.region.height else None

    def ray(self, pixel: tuple[float, float]) -> tuple[Floats, Floats]:
        """Origin (3,) and direction (3,) in the world of what lies under a pixel."""
        origin = view3d_utils.region_2d_to_origin_3d(self.region, self.view, pixel)
        direction = view3d_utils.region_2d_to_vector_3d(self.region, self.view, pixel)
        return np.array(origin, dtype=np.float64), np.array(direction, dtype=np.float64)

    def on_screen(self, place: Floats) -> tuple[float, float] | None:
        """The pixel of a place of the world; None behind the viewer."""
        pixel = view3d_utils.location_3d_to_region_2d(self.region, self.view, Vector(place))
        return None if pixel is None else (float(pixel[0]), float(pixel[1]))

    def eye(self) -> tuple[Floats | None, Floats]:
        """Where it is looked at from, None without perspective; and the direction to the viewer."""
        back = np.array(self.view.view_matrix.inverted(), dtype=np.float64)
        return (back[:3, 3] if self.view.is_perspective else None), back[:3, 2]
