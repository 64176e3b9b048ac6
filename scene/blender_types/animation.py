"""Datablocks, and what animates them: actions, F-curves, strips and tracks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, Protocol, Self, overload

from .collections import Growing, Items, Numbers


class WithProperties(Protocol):
    """Anything that custom properties can be kept on."""

    def __getitem__(self, name: str) -> object: ...
    def __setitem__(self, name: str, value: object) -> None: ...
    def __delitem__(self, name: str) -> None: ...
    def __contains__(self, name: str) -> bool: ...
    def get(self, name: str, default: object = None) -> object: ...
    def items(self) -> Sequence[tuple[str, object]]: ...
    def id_properties_ui(self, name: str) -> PropertyLook: ...


class PropertyLook(Protocol):
    """How a custom property shows."""

    def update(self, **settings: object) -> None: ...
    def as_dict(self) -> Mapping[str, object]: ...


class Datablock(WithProperties, Protocol):
    """`ID`: what is kept by name in a file."""

    name: str
    use_fake_user: bool

    @property
    def id_type(self) -> str: ...
    @property
    def library(self) -> object | None: ...
    @property
    def override_library(self) -> object | None: ...
    @property
    def users(self) -> int: ...
    @property
    def session_uid(self) -> int: ...
    @property
    def animation_data(self) -> AnimData | None: ...
    def animation_data_create(self) -> AnimData: ...
    def animation_data_clear(self) -> None: ...
    def copy(self) -> Self: ...
    def update_tag(self) -> None: ...
    def path_resolve(self, path: str) -> WithProperties: ...


class Keyframe(Protocol):
    """One keyframe."""

    co: Numbers
    interpolation: str
    handle_left_type: str
    handle_right_type: str


class Keyframes(Growing[Keyframe], Protocol):
    """The keyframes of an F-curve."""

    def insert(self, frame: float, value: float, *, options: set[str]) -> Keyframe: ...
    def remove(self, keyframe: Keyframe, *, fast: bool = False) -> None: ...


class FCurve(Protocol):
    """One animated figure."""

    data_path: str
    array_index: int
    lock: bool
    keyframe_points: Keyframes

    def update(self) -> None: ...


class FCurves(Protocol):
    """F-curves of one thing in an action; found by the path of what they move."""

    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[FCurve]: ...
    def new(self, data_path: str, *, index: int = 0) -> FCurve: ...
    def find(self, data_path: str, *, index: int = 0) -> FCurve | None: ...
    def remove(self, fcurve: FCurve) -> None: ...


class Marker(Protocol):
    """A marker."""

    name: str
    frame: int


class Markers(Items[Marker], Protocol):
    """Markers of an action."""

    def new(self, name: str) -> Marker: ...
    def remove(self, marker: Marker) -> None: ...


class Slot(Protocol):
    """What in an action belongs to one kind of thing, from Blender 4.4 on."""

    target_id_type: str

    def users(self) -> Sequence[Datablock]: ...


class Slots(Items[Slot], Protocol):
    """An action's slots."""

    def new(self, *, id_type: str, name: str) -> Slot: ...
    def remove(self, slot: Slot) -> None: ...


class ChannelBag(Protocol):
    """The F-curves of one slot."""

    fcurves: FCurves


class KeyframeStrip(Protocol):
    """A strip of a layer: F-curves, slot by slot."""

    channelbags: Items[ChannelBag]

    @overload
    def channelbag(self, slot: Slot | None) -> ChannelBag | None: ...
    @overload
    def channelbag(self, slot: Slot | None, *, ensure: Literal[True]) -> ChannelBag: ...


class KeyframeStrips(Items[KeyframeStrip], Protocol):
    """Strips of a layer."""

    def new(self, *, type: str) -> KeyframeStrip: ...


class ActionLayer(Protocol):
    """A layer of an action."""

    strips: KeyframeStrips


class ActionLayers(Items[ActionLayer], Protocol):
    """An action's layers."""

    def new(self, name: str) -> ActionLayer: ...


class Action(Datablock, Protocol):
    """An action. Blender has `fcurves` and `id_root` up to 4.5, `slots` and `layers` from 4.4 on: see `fcurves`."""

    id_root: str
    fcurves: FCurves
    slots: Slots
    layers: ActionLayers
    frame_start: float
    frame_end: float
    use_frame_range: bool

    @property
    def frame_range(self) -> Numbers: ...
    @property
    def pose_markers(self) -> Markers: ...


class NlaStrip(Protocol):
    """A strip of the non-linear animation editor."""

    name: str
    action: Action | None
    frame_start: float
    frame_end: float
    extrapolation: str
    blend_type: str
    action_slot: Slot | None  # from Blender 4.4 on


class NlaStrips(Items[NlaStrip], Protocol):
    """Strips of a track."""

    def new(self, name: str, start: int, action: Action) -> NlaStrip: ...
    def remove(self, strip: NlaStrip) -> None: ...


class NlaTrack(Protocol):
    """A track of the non-linear animation editor."""

    name: str
    strips: NlaStrips
    mute: bool
    is_solo: bool


class NlaTracks(Items[NlaTrack], Protocol):
    """Tracks of one thing."""

    active: NlaTrack | None

    def new(self) -> NlaTrack: ...
    def remove(self, track: NlaTrack) -> None: ...


class DriverTarget(Protocol):
    """What a driver reads: a property of a datablock."""

    id_type: str
    id: Datablock | None
    data_path: str
    bone_target: str
    transform_type: str


class DriverVariable(Protocol):
    """A variable of a driver."""

    type: str

    @property
    def targets(self) -> Sequence[DriverTarget]: ...


class DriverVariables(Items[DriverVariable], Protocol):
    """The variables of a driver."""

    def new(self) -> DriverVariable: ...


class Driver(Protocol):
    """What gives a property its value."""

    type: str

    @property
    def is_valid(self) -> bool: ...
    @property
    def variables(self) -> DriverVariables: ...


class DriverCurve(FCurve, Protocol):
    """A driver with its curve."""

    @property
    def driver(self) -> Driver: ...


class Drivers(Items[DriverCurve], Protocol):
    """The drivers of a datablock."""

    def remove(self, driver: DriverCurve) -> None: ...


class AnimData(Protocol):
    """What animates a datablock."""

    action: Action | None
    action_slot: Slot | None  # from Blender 4.4 on
    use_tweak_mode: bool
    use_nla: bool
    nla_tracks: NlaTracks

    @property
    def drivers(self) -> Drivers: ...
