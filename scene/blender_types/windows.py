"""Windows, and what the user works on in them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from .animation import Datablock
from .collections import Items, Matrix, Numbers
from .nodes import Image
from .objects import Collection, Depsgraph, Object
from .scenes import Scene, ViewLayer


class View2D(Protocol):
    """Where a region looks, of an editor with two axes."""

    def view_to_region(self, x: float, y: float, *, clip: bool = True) -> tuple[int, int]: ...
    def region_to_view(self, x: float, y: float) -> tuple[float, float]: ...


class Region(Protocol):
    """A region of an area."""

    type: str
    x: int
    y: int
    width: int
    height: int
    view2d: View2D

    def tag_redraw(self) -> None: ...
    def as_pointer(self) -> int: ...


class RegionView3D(Protocol):
    """Where a 3D viewport looks."""

    view_location: Numbers
    view_distance: float
    view_rotation: object
    view_matrix: Matrix
    is_perspective: bool


class Overlay(Protocol):
    """What an editor draws over the scene."""

    show_overlays: bool


class FileParams(Protocol):
    """What a file browser shows and has chosen."""

    directory: bytes
    filename: str


class Space(Protocol):
    """An editor. From `overlay` on: members of some kinds only."""

    type: str
    overlay: Overlay
    region_3d: RegionView3D
    region_quadviews: Sequence[RegionView3D]
    show_gizmo: bool
    show_gizmo_navigate: bool
    mode: str
    image: Image
    params: FileParams | None


class Spaces(Items[Space], Protocol):
    """The editors that an area has been, the one it is now among them."""

    active: Space


class Area(Protocol):
    """An area of a window: one editor."""

    type: str
    ui_type: str
    regions: Items[Region]
    spaces: Spaces

    def tag_redraw(self) -> None: ...
    def header_text_set(self, text: str | None) -> None: ...


class Screen(Protocol):
    """The areas of a window."""

    areas: Items[Area]
    is_animation_playing: bool


class WorkSpace(Protocol):
    """A workspace."""

    def status_text_set(self, text: str | None) -> None: ...


class Window(Protocol):
    """A window."""

    scene: Scene
    screen: Screen
    workspace: WorkSpace

    def cursor_modal_set(self, cursor: str) -> None: ...
    def cursor_modal_restore(self) -> None: ...


class WindowManager(Datablock, Protocol):
    """All windows."""

    windows: Items[Window]

    def progress_begin(self, low: float, high: float) -> None: ...
    def progress_update(self, value: float) -> None: ...
    def progress_end(self) -> None: ...


class Context(Protocol):
    """What the user works on now. Read-only here, so that operators may say more exactly what they find in it."""

    @property
    def object(self) -> Object | None: ...
    @property
    def scene(self) -> Scene: ...
    @property
    def collection(self) -> Collection: ...
    @property
    def view_layer(self) -> ViewLayer: ...
    @property
    def visible_objects(self) -> Sequence[Object]: ...
    @property
    def window(self) -> Window | None: ...
    @property
    def window_manager(self) -> WindowManager: ...
    @property
    def workspace(self) -> WorkSpace | None: ...
    @property
    def area(self) -> Area | None: ...
    @property
    def region(self) -> Region | None: ...
    @property
    def region_data(self) -> RegionView3D | None: ...
    @property
    def space_data(self) -> Space | None: ...
    @property
    def mode(self) -> str: ...
    def evaluated_depsgraph_get(self) -> Depsgraph: ...


class Event(Protocol):
    """A key, the mouse or a timer."""

    type: str
    value: str
    ctrl: bool
    shift: bool
    alt: bool
    mouse_x: int
    mouse_y: int
    mouse_region_x: int
    mouse_region_y: int
