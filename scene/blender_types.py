"""What Risorius uses of Blender's own types: small protocols, for mypy alone.

Blender ships no types, and the published ones contradict it. So each protocol names the members that scene/ and
operators/ use, no others; a member that comes into use is added here, with the type that it has in every supported
Blender. What only some Blenders have is marked so, and code asks for it with `hasattr`.

No object is ever asked at run time whether it is one of these.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, Protocol, Self, TypeAlias, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

T_co = TypeVar("T_co", covariant=True)

#: A vector or colour of Blender's, as far as arrays can be made of it.
Numbers: TypeAlias = Sequence[float]

#: What one figure of all items is copied to and from.
Buffer: TypeAlias = NDArray[np.float32] | NDArray[np.int32] | NDArray[np.bool_]


class Items(Protocol[T_co]):
    """A collection of Blender's: by number and by name, and one attribute of all items at once."""

    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[T_co]: ...
    def __contains__(self, name: object) -> bool: ...
    @overload
    def __getitem__(self, key: int | str) -> T_co: ...
    @overload
    def __getitem__(self, key: slice[int | None, int | None, None]) -> Sequence[T_co]: ...
    def get(self, name: str) -> T_co | None: ...
    def find(self, name: str) -> int: ...
    def keys(self) -> Sequence[str]: ...
    def values(self) -> Sequence[T_co]: ...
    def foreach_get(self, attribute: str, flat: Buffer) -> None: ...
    def foreach_set(self, attribute: str, flat: Buffer) -> None: ...


class Growing(Items[T_co], Protocol[T_co]):
    """A collection that counts of new items are added to, such as a mesh's vertices."""

    def add(self, count: int) -> object: ...


class WithProperties(Protocol):
    """Anything that custom properties can be kept on."""

    def __getitem__(self, name: str) -> object: ...
    def __setitem__(self, name: str, value: object) -> None: ...
    def __delitem__(self, name: str) -> None: ...
    def __contains__(self, name: str) -> bool: ...
    def get(self, name: str, default: object = None) -> object: ...


class Datablock(WithProperties, Protocol):
    """`ID`: what is kept by name in a file."""

    name: str
    use_fake_user: bool

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


class Matrix(Protocol):
    """`mathutils.Matrix`."""

    def __iter__(self) -> Iterator[Numbers]: ...
    def __matmul__(self, place: Numbers) -> Numbers: ...
    def inverted(self) -> Matrix: ...
    def transposed(self) -> Matrix: ...
    def to_3x3(self) -> Matrix: ...


class SearchTree(Protocol):
    """`mathutils.bvhtree.BVHTree`: triangles to look places up on. Where nothing is found, all four are None."""

    def find_nearest(self, place: Numbers, reach: float = ...) -> tuple[Numbers | None, Numbers, int, float]: ...


# Meshes ---------------------------------------------------------------------------------------------------------------


class VertexGroup(Protocol):
    """A named group of an object's vertices, or a vertex's share in one."""

    name: str
    index: int
    group: int
    weight: float

    def add(self, vertices: Sequence[int], weight: float, how: str) -> None: ...


class MeshVertex(Protocol):
    """One vertex."""

    co: Numbers
    index: int
    groups: Sequence[VertexGroup]


class MeshPolygon(Protocol):
    """One polygon."""

    vertices: Sequence[int]


class Attribute(Protocol):
    """A layer of figures over a mesh's vertices, edges, corners or faces."""

    name: str
    domain: str
    data_type: str
    data: Items[object]


class Attributes(Items[Attribute], Protocol):
    """A mesh's attributes."""

    def new(self, name: str, type: str, domain: str) -> Attribute: ...
    def remove(self, attribute: Attribute) -> None: ...


class UVLayer(Protocol):
    """Coordinates on pictures, per corner."""

    name: str
    active_render: bool
    data: Items[object]


class UVLayers(Items[UVLayer], Protocol):
    """A mesh's layers of coordinates."""

    active: UVLayer | None

    def new(self, *, name: str) -> UVLayer | None: ...


class Materials(Items["Material | None"], Protocol):
    """Materials of a mesh or a curve, in their slots."""

    def append(self, material: Material) -> None: ...


class Mesh(Datablock, Protocol):
    """A mesh."""

    @property
    def vertices(self) -> Growing[MeshVertex]: ...
    @property
    def edges(self) -> Growing[object]: ...
    @property
    def loops(self) -> Growing[object]: ...
    @property
    def polygons(self) -> Growing[MeshPolygon]: ...
    @property
    def loop_triangles(self) -> Items[object]: ...
    @property
    def attributes(self) -> Attributes: ...
    @property
    def uv_layers(self) -> UVLayers: ...
    @property
    def materials(self) -> Materials: ...
    @property
    def shape_keys(self) -> Key | None: ...
    @property
    def is_editmode(self) -> bool: ...
    def update(self, *, calc_edges: bool = False) -> None: ...
    def validate(self) -> bool: ...


class ShapeKey(Protocol):
    """One shape key."""

    name: str
    value: float
    slider_min: float
    slider_max: float
    mute: bool
    vertex_group: str
    relative_key: ShapeKey
    data: Items[object]


class Key(Datablock, Protocol):
    """The shape keys of a mesh."""

    use_relative: bool
    key_blocks: Items[ShapeKey]
    reference_key: ShapeKey


# Objects --------------------------------------------------------------------------------------------------------------


class Modifier(Protocol):
    """A modifier; those of nodes have a group."""

    name: str
    type: str
    show_viewport: bool
    show_render: bool
    show_in_editmode: bool
    show_expanded: bool
    node_group: NodeTree | None


class Modifiers(Items[Modifier], Protocol):
    """An object's modifiers."""

    def new(self, name: str, type: str) -> Modifier: ...
    def remove(self, modifier: Modifier) -> None: ...
    def move(self, from_index: int, to_index: int) -> None: ...


class PropertyLook(Protocol):
    """How a custom property shows."""

    def update(self, **settings: object) -> None: ...


class Object(Datablock, Protocol):
    """An object. `data` is a mesh only where `type` is "MESH": ask first (`refusals.refuse_unreadable` does)."""

    data: Mesh
    parent: Object | None
    location: Numbers
    matrix_world: Matrix
    add_rest_position_attribute: bool
    show_only_shape_key: bool

    @property
    def type(self) -> str: ...
    @property
    def mode(self) -> str: ...
    @property
    def dimensions(self) -> Numbers: ...
    @property
    def bound_box(self) -> Sequence[Numbers]: ...
    @property
    def is_editable(self) -> bool: ...
    @property
    def modifiers(self) -> Modifiers: ...
    @property
    def vertex_groups(self) -> Items[VertexGroup]: ...
    def select_set(self, state: bool) -> None: ...
    def visible_get(self) -> bool: ...
    def shape_key_add(self, *, name: str, from_mix: bool) -> ShapeKey: ...
    def shape_key_remove(self, key: ShapeKey) -> None: ...
    def shape_key_clear(self) -> None: ...
    def keyframe_insert(self, data_path: str, *, frame: float, group: str) -> bool: ...
    def id_properties_ui(self, name: str) -> PropertyLook: ...
    def evaluated_get(self, depsgraph: Depsgraph) -> Object: ...
    def to_mesh(self) -> Mesh: ...
    def to_mesh_clear(self) -> None: ...
    def ray_cast(self, origin: Numbers, direction: Numbers) -> tuple[bool, Numbers, Numbers, int]: ...
    def closest_point_on_mesh(self, origin: Numbers) -> tuple[bool, Numbers, Numbers, int]: ...


class Objects(Items[Object], Protocol):
    """Objects of a collection."""

    def link(self, obj: Object) -> None: ...


class Collections(Items["Collection"], Protocol):
    """Collections in a collection."""

    def link(self, collection: Collection) -> None: ...


class Collection(Datablock, Protocol):
    """A collection of objects."""

    objects: Objects
    children: Collections


# Animation ------------------------------------------------------------------------------------------------------------


class Keyframe(Protocol):
    """One keyframe."""

    co: Numbers
    interpolation: str
    handle_left_type: str
    handle_right_type: str


class FCurve(Protocol):
    """One animated figure."""

    data_path: str
    keyframe_points: Growing[Keyframe]

    def update(self) -> None: ...
    def evaluate(self, frame: float) -> float: ...


class FCurves(Protocol):
    """F-curves of one thing in an action; found by the path of what they move."""

    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[FCurve]: ...
    def new(self, data_path: str) -> FCurve: ...
    def find(self, data_path: str) -> FCurve | None: ...
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

    def new(self) -> NlaTrack: ...
    def remove(self, track: NlaTrack) -> None: ...


class AnimData(Protocol):
    """What animates a datablock."""

    action: Action | None
    action_slot: Slot | None  # from Blender 4.4 on
    use_tweak_mode: bool
    use_nla: bool
    nla_tracks: NlaTracks


# Nodes, materials, pictures -------------------------------------------------------------------------------------------


class NodeSocket(Protocol):
    """An input or output of a node."""

    name: str
    type: str
    identifier: str
    default_value: object


class Node(Protocol):
    """A node. From `node_tree` on: members of some kinds only."""

    name: str
    type: str
    bl_idname: str
    location: Numbers
    hide: bool
    inputs: Items[NodeSocket]
    outputs: Items[NodeSocket]
    node_tree: NodeTree | None
    image: Image | None
    extension: str
    uv_map: str
    data_type: str
    blend_type: str


class Nodes(Items[Node], Protocol):
    """Nodes of a tree."""

    active: Node | None

    def new(self, kind: str) -> Node: ...
    def remove(self, node: Node) -> None: ...


class NodeLink(Protocol):
    """A link between nodes."""

    from_node: Node
    to_node: Node


class NodeLinks(Items[NodeLink], Protocol):
    """Links of a tree."""

    def new(self, one: NodeSocket, other: NodeSocket) -> NodeLink: ...


class NodeInterface(Protocol):
    """The sockets of a group."""

    def new_socket(self, name: str, *, in_out: str, socket_type: str) -> NodeSocket: ...


class NodeTree(Datablock, Protocol):
    """Nodes and their links."""

    bl_idname: str
    is_modifier: bool
    nodes: Nodes
    links: NodeLinks
    interface: NodeInterface


class Material(Datablock, Protocol):
    """A material."""

    use_nodes: bool
    diffuse_color: Numbers
    roughness: float

    @property
    def node_tree(self) -> NodeTree | None: ...


class World(Datablock, Protocol):
    """A world."""

    use_nodes: bool
    color: Numbers

    @property
    def node_tree(self) -> NodeTree | None: ...


class Pixels(Protocol):
    """All figures of a picture, row by row from below, four a pixel."""

    def foreach_get(self, flat: NDArray[np.float32]) -> None: ...
    def foreach_set(self, flat: NDArray[np.float32]) -> None: ...


class Image(Datablock, Protocol):
    """A picture."""

    size: Sequence[int]
    pixels: Pixels
    filepath_raw: str
    file_format: str

    def scale(self, width: int, height: int) -> None: ...
    def update(self) -> None: ...
    def pack(self) -> None: ...
    def save(self) -> None: ...


# Scenes ---------------------------------------------------------------------------------------------------------------


class ImageSettings(Protocol):
    """How pictures are written."""

    media_type: str  # from Blender 5.0 on
    file_format: str
    color_mode: str


class FFmpegSettings(Protocol):
    """How films are written."""

    format: str
    codec: str
    constant_rate_factor: str
    ffmpeg_preset: str


class RenderSettings(Protocol):
    """How a scene is rendered."""

    engine: str
    fps: int
    fps_base: float
    filepath: str
    resolution_x: int
    resolution_y: int
    resolution_percentage: int
    use_compositing: bool
    use_sequencer: bool
    use_file_extension: bool
    use_overwrite: bool
    use_simplify: bool
    simplify_subdivision: int
    image_settings: ImageSettings
    ffmpeg: FFmpegSettings

    def frame_path(self, *, frame: int) -> str: ...


class Shading(Protocol):
    """How Workbench shades."""

    light: str
    color_type: str
    show_cavity: bool
    cavity_type: str
    cavity_ridge_factor: float
    cavity_valley_factor: float
    curvature_ridge_factor: float
    curvature_valley_factor: float
    show_shadows: bool
    show_specular_highlight: bool


class Display(Protocol):
    """How Workbench renders a scene."""

    render_aa: str
    shading: Shading


class ViewSettings(Protocol):
    """How a scene's colours become those of the screen."""

    view_transform: str
    look: str
    exposure: float
    gamma: float


class UnitSettings(Protocol):
    """A scene's units."""

    scale_length: float


class Cycles(Protocol):
    """Settings of Cycles."""

    samples: int
    use_denoising: bool


class Cursor(Protocol):
    """The 3D cursor."""

    location: Numbers


class StripElements(Items[object], Protocol):
    """The pictures of a strip."""

    def append(self, filename: str) -> object: ...


class ImageStrip(Protocol):
    """A strip of pictures."""

    elements: StripElements


class SequenceStrips(Items[object], Protocol):
    """Strips of the video sequencer."""

    def new_image(self, name: str, path: str, channel: int, start: int) -> ImageStrip: ...


class SequenceEditor(Protocol):
    """The video sequencer of a scene."""

    strips: SequenceStrips  # from Blender 4.4 on
    sequences: SequenceStrips  # before


class LayerObjects(Items[Object], Protocol):
    """Objects of a view layer."""

    active: Object | None


class ViewLayer(Protocol):
    """What of a scene shows."""

    objects: LayerObjects
    depsgraph: Depsgraph

    def update(self) -> None: ...


class Scene(Datablock, Protocol):
    """A scene."""

    camera: Object | None
    world: World | None
    frame_start: int
    frame_end: int
    frame_preview_start: int
    frame_preview_end: int
    use_preview_range: bool
    render: RenderSettings
    display: Display
    view_settings: ViewSettings
    unit_settings: UnitSettings
    cycles: Cycles
    cursor: Cursor

    @property
    def collection(self) -> Collection: ...
    @property
    def objects(self) -> Items[Object]: ...
    @property
    def view_layers(self) -> Items[ViewLayer]: ...
    @property
    def frame_current(self) -> int: ...
    @property
    def frame_subframe(self) -> float: ...
    @property
    def frame_current_final(self) -> float: ...
    def frame_set(self, frame: int, *, subframe: float = 0.0) -> None: ...
    def sequence_editor_create(self) -> SequenceEditor: ...


class DepsgraphUpdate(Protocol):
    """One thing that was evaluated anew."""

    id: EvaluatedDatablock


class EvaluatedDatablock(Datablock, Protocol):
    """A datablock as evaluated."""

    original: Datablock


class Depsgraph(Protocol):
    """Everything as modifiers, keys and drivers make it."""

    updates: Items[DepsgraphUpdate]


# Windows --------------------------------------------------------------------------------------------------------------


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
