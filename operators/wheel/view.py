"""Where the wheel is in a viewport, and whether it is there at all."""

from __future__ import annotations

from functools import lru_cache

from ...scene.blender_types import Area, Region, Space
from ...scene.points.kept import has_points
from ..blender_types import Context
from ..points.canvas import text_width
from .geometry import Box, Corner, Pixel, Wheel, free_box, placed
from .places import labels, places

#: Pixels at a scale of 1: around the wheel, below it for its caption, from its outermost ring to its rim, and letters.
MARGIN, FOOT, RIM, LETTERS, LARGE_LETTERS = 26.0, 40.0, 14.0, 10.5, 12.5
#: Radius in pixels at a scale of 1 below which letters are smaller, and how much smaller they get at most.
FULL_RADIUS, SMALLEST_LETTERS = 110.0, 0.8
#: Letters of the rings' numbers, and the direction in which they stand: there are no words.
NUMBERS, NUMBERED = 9.0, 265.0
#: Pixels at a scale of 1 between a word's place and its label.
GAP = 6.0
#: Regions that may lie over the viewport along one of its sides.
COVERS = {"UI", "TOOLS", "HEADER", "TOOL_HEADER", "ASSET_SHELF", "ASSET_SHELF_HEADER"}
#: Pixels at a scale of 1 that Blender's own things take: axes and buttons at the right, text at the top.
AXES, TEXT = 90.0, 60.0


def scale_of(context: Context) -> float:
    """Pixels of the screen for one of the interface."""
    return float(context.preferences.system.ui_scale)


def no_face_reason(context: Context) -> str | None:
    """Why there is nothing to choose an emotion for in the context's viewport, or None."""
    obj, space = context.object, context.space_data
    if space is None or space.type != "VIEW_3D":
        return "The emotion wheel is in the 3D viewport"
    if obj is None or obj.type != "MESH" or not has_points(obj):
        return "The active object is not a face with feature points"
    if obj.mode != "OBJECT" or not obj.is_editable:
        return f"{obj.name}: is not in Object mode, or linked from another file"
    return None


def reason_hidden(context: Context) -> str | None:
    """Why there is no wheel in the context's viewport, or None."""
    if not context.window_manager.risorius.wheel.show:
        return "The emotion wheel is hidden: show it in the Emotion panel"
    reason = no_face_reason(context)
    if reason is None and context.space_data is not None and not context.space_data.show_gizmo:
        return "The viewport's gizmos are hidden: turn them on"
    return reason


def wheel_of(context: Context) -> Wheel | None:
    """The wheel in the context's region; None where there is none."""
    area, region, space = context.area, context.region, context.space_data
    if reason_hidden(context) is not None or area is None or space is None or region is None or region.type != "WINDOW":
        return None
    quarters = space.region_quadviews
    if len(quarters) > 0 and context.region_data != quarters[-1]:
        return None  # in a quad view only the last of the four, the user's own
    state, scale = context.window_manager.risorius.wheel, scale_of(context)
    return placed(
        free_of(area, region, space, Corner(state.corner), scale),
        Corner(state.corner),
        radius=state.size / 2.0 * scale,
        margin=MARGIN * scale,
        foot=FOOT * scale,
    )


def free_of(area: Area, region: Region, space: Space, corner: Corner, scale: float) -> Box:
    """What is to be seen of a viewport's region, and has room for a wheel in this corner."""
    covers = [
        Box(other.x - region.x, other.y - region.y, other.x - region.x + other.width, other.y - region.y + other.height)
        for other in area.regions
        if other.type in COVERS and other.width > 1 and other.height > 1
    ]
    free = free_box(region.width, region.height, covers)
    if corner is Corner.TOP_RIGHT and space.show_gizmo_navigate:
        return Box(free.left, free.low, free.right - AXES * scale, free.high)
    if corner is Corner.TOP_LEFT and space.overlay.show_overlays:
        return Box(free.left, free.low, free.right, free.high - TEXT * scale)
    return free


def letters(wheel: Wheel, word: str, scale: float) -> float:
    """Size of a word's letters, pixels; a small wheel has smaller ones."""
    usual = (LARGE_LETTERS if places()[word].is_archetype else LETTERS) * scale
    return usual * min(1.0, max(SMALLEST_LETTERS, wheel.radius / (FULL_RADIUS * scale)))


def numbers_of(wheel: Wheel, scale: float) -> dict[int, Box]:
    """Activation -> where its ring is numbered; empty where the rings are too close."""
    size = NUMBERS * scale
    if wheel.ring(1.0) < 1.1 * size:
        return {}
    spots = {activation: wheel.pixel(NUMBERED, activation) for activation in range(1, 8)}
    half = 0.3 * size
    return {activation: Box(x - half, y - half, x + half, y + half) for activation, (x, y) in spots.items()}


@lru_cache(maxsize=8)
def labels_of(wheel: Wheel, scale: float) -> dict[str, Box]:
    """Word -> where it is written."""

    def size(word: str) -> tuple[float, float]:
        """Width and height of a label."""
        high = letters(wheel, word, scale)
        return text_width(word.capitalize(), high), high

    archetypes = {name for name, place in places().items() if place.is_archetype}
    avoid = numbers_of(wheel, scale).values()
    return labels(wheel, size=size, gap=GAP * scale, rim=RIM * scale, always=archetypes, avoid=avoid)


def label_at(wheel: Wheel, pixel: Pixel, scale: float) -> str | None:
    """The word whose label is under a pixel."""
    return next((word for word, box in labels_of(wheel, scale).items() if box.contains(pixel)), None)
