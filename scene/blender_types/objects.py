"""Objects, their modifiers, collections of them, and how they are evaluated."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from .animation import Datablock, WithProperties
from .collections import Items, Matrix, Numbers
from .meshes import Mesh, ShapeKey, VertexGroup
from .nodes import Material, NodeTree


class Setting(Protocol):
    """One setting of something, as Blender describes it."""

    @property
    def is_readonly(self) -> bool: ...
    @property
    def default(self) -> float: ...  # of a number
    @property
    def default_array(self) -> Numbers: ...  # of several
    @property
    def identifier(self) -> str: ...
    @property
    def type(self) -> str: ...


class Settings(Protocol):
    """All settings of a kind of thing."""

    @property
    def properties(self) -> Items[Setting]: ...


class WithPointers(Protocol):
    """Anything with settings of which some point to objects."""

    @property
    def bl_rna(self) -> Settings: ...


class Constraint(WithPointers, Protocol):
    """A constraint of a bone or an object; those that limit have `owner_space`, and limits for each axis."""

    type: str
    mute: bool
    influence: float
    owner_space: str


class BoneCollection(Protocol):
    """A collection of an armature's bones."""

    @property
    def is_visible_effectively(self) -> bool: ...


class Bone(Protocol):
    """A bone of an armature. Blender has `hide` here for the pose up to 4.5."""

    name: str
    hide: bool
    hide_select: bool

    @property
    def use_connect(self) -> bool: ...
    @property
    def collections(self) -> Sequence[BoneCollection]: ...


class PoseBone(WithProperties, Protocol):
    """A bone as it is posed. Blender has `hide` here from 5.0 on."""

    name: str
    hide: bool
    rotation_mode: str
    lock_location: Sequence[bool]
    lock_rotation: Sequence[bool]
    lock_scale: Sequence[bool]

    @property
    def bone(self) -> Bone: ...
    @property
    def parent(self) -> PoseBone | None: ...
    @property
    def constraints(self) -> Items[Constraint]: ...


class Pose(Protocol):
    """The posed bones of an armature."""

    @property
    def bones(self) -> Items[PoseBone]: ...


class Modifier(Protocol):
    """A modifier; those of nodes have a group."""

    name: str
    type: str
    show_viewport: bool
    show_render: bool
    show_in_editmode: bool
    show_expanded: bool
    object: Object | None  # of an armature
    node_group: NodeTree | None

    @property
    def bl_rna(self) -> Settings: ...


class Modifiers(Items[Modifier], Protocol):
    """An object's modifiers."""

    active: Modifier | None

    def new(self, name: str, type: str) -> Modifier: ...
    def remove(self, modifier: Modifier) -> None: ...
    def move(self, from_index: int, to_index: int) -> None: ...


class MaterialSlot(Protocol):
    """A material of an object, from itself or from its mesh."""

    material: Material | None


class Object(Datablock, Protocol):
    """An object. `data` is a mesh only where `type` is "MESH": ask first (`refusals.refuse_unreadable` does)."""

    data: Mesh
    parent: Object | None
    rotation_mode: str
    matrix_parent_inverse: Matrix
    location: Numbers
    matrix_world: Matrix
    add_rest_position_attribute: bool
    hide_render: bool
    hide_viewport: bool
    active_shape_key_index: int
    visible_camera: bool
    show_instancer_for_render: bool
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
    def material_slots(self) -> Items[MaterialSlot]: ...
    @property
    def active_shape_key(self) -> ShapeKey | None: ...
    @property
    def modifiers(self) -> Modifiers: ...
    @property
    def constraints(self) -> Items[Constraint]: ...
    @property
    def users_collection(self) -> Sequence[Collection]: ...
    @property
    def vertex_groups(self) -> Items[VertexGroup]: ...
    @property
    def pose(self) -> Pose | None: ...  # of an armature
    def select_set(self, state: bool) -> None: ...
    def visible_get(self) -> bool: ...
    def shape_key_add(self, *, name: str, from_mix: bool) -> ShapeKey: ...
    def shape_key_remove(self, key: ShapeKey) -> None: ...
    def shape_key_clear(self) -> None: ...
    def keyframe_insert(self, data_path: str, *, frame: float, group: str) -> bool: ...
    def evaluated_get(self, depsgraph: Depsgraph) -> Object: ...
    def to_mesh(self) -> Mesh: ...
    def to_mesh_clear(self) -> None: ...
    def ray_cast(self, origin: Numbers, direction: Numbers) -> tuple[bool, Numbers, Numbers, int]: ...
    def calc_matrix_camera(
        self, depsgraph: Depsgraph, *, x: int, y: int, scale_x: float, scale_y: float
    ) -> Matrix: ...  # of a camera
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
    hide_render: bool
    hide_viewport: bool


class LayerCollection(Protocol):
    """A collection as a view layer has it."""

    exclude: bool
    holdout: bool
    indirect_only: bool

    @property
    def collection(self) -> Collection: ...
    @property
    def children(self) -> Items[LayerCollection]: ...


class Lens(Protocol):
    """The data of a camera."""

    type: str
    clip_start: float
    clip_end: float
    lens: float
    sensor_width: float
    sensor_height: float


class DepsgraphUpdate(Protocol):
    """One thing that was evaluated anew."""

    id: EvaluatedDatablock


class EvaluatedDatablock(Datablock, Protocol):
    """A datablock as evaluated."""

    original: Datablock


class Instance(Protocol):
    """One object as it shows at one place."""

    object: Object
    matrix_world: Matrix
    show_self: bool
    is_instance: bool


class Depsgraph(Protocol):
    """Everything as modifiers, keys and drivers make it."""

    updates: Items[DepsgraphUpdate]
    object_instances: Items[Instance]
