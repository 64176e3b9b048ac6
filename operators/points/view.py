"""A 3D viewport under the mouse: pixels of it to rays of the world and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from bpy_extras import view3d_utils
from mathutils import Vector

from ...arrays import Floats
from ...scene.blender_types import Area, Event, Region, RegionView3D, Space
from ...scene.points.bound import Surface
from ...scene.points.seen import Visible
from ..blender_types import Context, Object


@dataclass(frozen=True)
class Viewport:
    """The main region of a 3D viewport."""

    region: Region
    space: Space

    @classmethod
    def of(cls, context: Context) -> Viewport | None:
        """The viewport of the context's area, whichever of its regions the pointer is in; None elsewhere."""
        area = context.area
        if area is None or area.type != "VIEW_3D":
            return None
        region = next((region for region in area.regions if region.type == "WINDOW"), None)
        return None if region is None else cls(region, area.spaces.active)

    @property
    def view(self) -> RegionView3D:
        """Where it looks."""
        return self.space.region_3d

    def draws_over(self, obj: Object) -> bool:
        """Whether something may be drawn over an object: it is visible in Object mode, and overlays are, too."""
        return obj.mode == "OBJECT" and obj.visible_get() and self.space.overlay.show_overlays

    def pixel(self, event: Event) -> tuple[float, float] | None:
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


def hit_near(
    visible: Visible, viewport: Viewport, pixel: tuple[float, float], surface: Surface, miss: float
) -> Floats | None:
    """(3,) the place of the resting surface under a pixel, or under one as near to it as `miss`; None beside that."""
    for far in np.linspace(0.0, miss, 5):
        for turn in np.linspace(0.0, 2.0 * np.pi, 13 if far > 0.0 else 2)[:-1]:
            beside = (pixel[0] + far * float(np.cos(turn)), pixel[1] + far * float(np.sin(turn)))
            place = visible.hit(*viewport.ray(beside), surface)
            if place is not None:
                return place
    return None


def is_covered(area: Area, event: Event) -> bool:
    """Whether the mouse is over sidebar, toolbar or header that lie over the viewport."""
    for region in area.regions:
        inside = (
            region.x <= event.mouse_x < region.x + region.width and region.y <= event.mouse_y < region.y + region.height
        )
        if region.type != "WINDOW" and inside and min(region.width, region.height) > 1:
            return True
    return False
