"""Windows, and what the user works on in them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from .animation import Datablock
from .collections import Items
from .objects import Collection, Depsgraph, Object
from .scenes import Scene, ViewLayer


class Region(Protocol):
    """A region of an area."""

    type: str
    x: int
    y: int
    width: int
    height: int

    def tag_redraw(self) -> None: ...
    def as_pointer(self) -> int: ...


class Area(Protocol):
    """An area of a window: one editor."""

    type: str
    ui_type: str
    regions: Items[Region]

    def tag_redraw(self) -> None: ...
    def header_text_set(self, text: str | None) -> None: ...


class Screen(Protocol):
    """The areas of a window."""

    areas: Items[Area]


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
