"""What operators use of Blender's types beyond what `scene.blender_types` names: the user's choices, and windows.

Like those, these are protocols for mypy alone. The classes that Risorius' own derive from are in `blender_classes`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..scene import blender_types as scene_types
from ..scene.blender_types import Items, Numbers

if TYPE_CHECKING:
    from .props import RISORIUS_PG_object, RISORIUS_PG_scene, RISORIUS_PG_window

T_co = TypeVar("T_co", covariant=True)


# What the user chooses ------------------------------------------------------------------------------------------------


class Entries(Items[T_co], Protocol[T_co]):
    """A collection of property groups, as a `CollectionProperty` holds it."""

    def add(self) -> T_co: ...
    def remove(self, index: int) -> None: ...
    def move(self, index: int, to: int) -> None: ...
    def clear(self) -> None: ...


class Object(scene_types.Object, Protocol):
    """An object, with what is chosen for it."""

    @property
    def risorius(self) -> RISORIUS_PG_object: ...
    @property
    def users_scene(self) -> Sequence[Scene]: ...


class Scene(scene_types.Scene, Protocol):
    """A scene, with what is chosen for it."""

    @property
    def risorius(self) -> RISORIUS_PG_scene: ...


class Property(Protocol):
    """A property as Blender knows it."""

    @property
    def identifier(self) -> str: ...
    @property
    def is_readonly(self) -> bool: ...


class Structure(Protocol):
    """What Blender knows of a class."""

    @property
    def properties(self) -> Items[Property]: ...


# Windows --------------------------------------------------------------------------------------------------------------


class WidgetColours(Protocol):
    """Colours of one kind of button."""

    @property
    def inner(self) -> Numbers: ...
    @property
    def text(self) -> Numbers: ...


class InterfaceColours(Protocol):
    """Colours of buttons and menus."""

    @property
    def wcol_menu_back(self) -> WidgetColours: ...
    @property
    def wcol_menu_item(self) -> WidgetColours: ...


class Theme(Protocol):
    """The user's theme."""

    @property
    def user_interface(self) -> InterfaceColours: ...


class System(Protocol):
    """Preferences of the system."""

    @property
    def ui_scale(self) -> float: ...


class OwnPreferences(Protocol):
    """What the user has set for Risorius."""

    @property
    def keep_faces(self) -> bool: ...


class Addon(Protocol):
    """An add-on that is enabled; its preferences are of Risorius where it is that one."""

    @property
    def preferences(self) -> OwnPreferences | None: ...


class Preferences(Protocol):
    """What the user prefers."""

    @property
    def addons(self) -> Mapping[str, Addon]: ...
    @property
    def system(self) -> System: ...
    @property
    def themes(self) -> Sequence[Theme]: ...


class KeyMapItem(Protocol):
    """What a key does."""

    @property
    def properties(self) -> OperatorProperties: ...


class KeyMapItems(Items[KeyMapItem], Protocol):
    """What the keys of a keymap do."""

    def new(self, operator: str, key: str, value: str, **how: bool) -> KeyMapItem: ...
    def remove(self, item: KeyMapItem) -> None: ...


class KeyMap(Protocol):
    """The keys of one kind of region, editor or gizmo."""

    @property
    def keymap_items(self) -> KeyMapItems: ...


class KeyMaps(Items[KeyMap], Protocol):
    """All keymaps of a configuration."""

    def new(self, name: str, *, space_type: str = "EMPTY", region_type: str = "WINDOW") -> KeyMap: ...
    def remove(self, keymap: KeyMap) -> None: ...


class KeyConfig(Protocol):
    """A configuration of keys."""

    @property
    def keymaps(self) -> KeyMaps: ...


class KeyConfigs(Protocol):
    """Blender's keys, those of add-ons, and all with what the user has changed."""

    @property
    def addon(self) -> KeyConfig | None: ...
    @property
    def default(self) -> KeyConfig | None: ...
    @property
    def user(self) -> KeyConfig | None: ...


class Timer(Protocol):
    """What wakes a modal operator."""


class WindowManager(scene_types.WindowManager, Protocol):
    """All windows, with how things are shown in them."""

    @property
    def risorius(self) -> RISORIUS_PG_window: ...
    @property
    def keyconfigs(self) -> KeyConfigs: ...
    def modal_handler_add(self, operator: object) -> bool: ...
    def event_timer_add(self, step: float, *, window: scene_types.Window | None) -> Timer: ...
    def event_timer_remove(self, timer: Timer) -> None: ...
    def invoke_props_dialog(self, operator: object) -> set[str]: ...
    def invoke_confirm(self, operator: object, event: scene_types.Event) -> set[str]: ...


class Context(scene_types.Context, Protocol):
    """What the user works on now, and where."""

    @property
    def object(self) -> Object | None: ...
    @property
    def scene(self) -> Scene: ...
    @property
    def window_manager(self) -> WindowManager: ...
    @property
    def preferences(self) -> Preferences: ...
    def temp_override(self, *, region: scene_types.Region) -> AbstractContextManager[None]: ...


# Panels ---------------------------------------------------------------------------------------------------------------


class OperatorProperties(Protocol):
    """What an operator is to be given: any of its properties may be set."""

    def __getattr__(self, name: str) -> str | int | float | bool: ...
    def __setattr__(self, name: str, value: object) -> None: ...


class UILayout(Protocol):
    """A place in a panel or menu."""

    active: bool
    alert: bool
    alignment: str
    enabled: bool
    operator_context: str
    scale_y: float
    use_property_decorate: bool
    use_property_split: bool

    def box(self) -> UILayout: ...
    def column(self, *, align: bool = False) -> UILayout: ...
    def row(self, *, align: bool = False) -> UILayout: ...
    def split(self, *, factor: float = 0.0, align: bool = False) -> UILayout: ...
    def separator(self) -> None: ...
    def label(self, *, text: str = "", icon: str = "NONE", icon_value: int = 0) -> None: ...
    def menu(self, menu: str, *, text: str = ..., icon: str = "NONE") -> None: ...
    def popover(self, panel: str, *, text: str = ..., icon: str = "NONE") -> None: ...
    def progress(self, *, factor: float, text: str = "", type: str = "BAR") -> None: ...
    def operator(
        self, operator: str, *, text: str = ..., icon: str = "NONE", emboss: bool = True
    ) -> OperatorProperties: ...
    def prop(
        self,
        data: object,
        property: str,
        *,
        text: str = ...,
        icon: str = "NONE",
        emboss: bool = True,
        expand: bool = False,
        placeholder: str = "",
        slider: bool = False,
        toggle: bool = False,
    ) -> None: ...
    def prop_search(self, data: object, property: str, within: object, collection: str, *, text: str = ...) -> None: ...
    def template_list(
        self, kind: str, name: str, data: object, property: str, active: object, index: str, *, rows: int = 5
    ) -> None: ...


# Drawing --------------------------------------------------------------------------------------------------------------


class Shader(Protocol):
    """A shader of the graphics card."""

    def uniform_float(self, name: str, value: float | Sequence[float]) -> None: ...


class Batch(Protocol):
    """Figures that are on the graphics card."""

    def draw(self, shader: Shader) -> None: ...


class Preview(Protocol):
    """An icon of Risorius' own."""

    icon_size: tuple[int, int]
    icon_pixels_float: Sequence[float]

    @property
    def icon_id(self) -> int: ...


class Previews(Protocol):
    """Icons of Risorius' own, by name."""

    def __contains__(self, name: object) -> bool: ...
    def __getitem__(self, name: str) -> Preview: ...
    def __iter__(self) -> Iterator[str]: ...
    def new(self, name: str) -> Preview: ...


#: Corners of triangles as they are handed to the graphics card.
Corners = NDArray[np.int32]
