"""Scenes: how they are rendered, what of them shows."""

from __future__ import annotations

from typing import Protocol

from .animation import Datablock
from .collections import Items, Numbers
from .nodes import World
from .objects import Collection, Depsgraph, LayerCollection, Object


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
    audio_codec: str


class RenderSettings(Protocol):
    """How a scene is rendered."""

    engine: str
    fps: int
    fps_base: float
    filepath: str
    resolution_x: int
    resolution_y: int
    resolution_percentage: int
    pixel_aspect_x: float
    pixel_aspect_y: float
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
    studio_light: str
    studiolight_rotate_z: float
    use_world_space_lighting: bool


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


class PackedFile(Protocol):
    """What a file held, in the .blend."""

    @property
    def data(self) -> bytes: ...


class Sound(Datablock, Protocol):
    """A sound."""

    filepath: str

    @property
    def packed_file(self) -> PackedFile | None: ...
    def pack(self) -> None: ...


class SequencerStrip(Protocol):
    """A strip of the video sequencer, as one of sound. Its times have other names by version: see `scene.sounds`."""

    name: str
    channel: int
    sound: Sound
    mute: bool
    volume: float
    pan: float

    @property
    def type(self) -> str: ...
    def get(self, name: str) -> object: ...
    def __setitem__(self, name: str, value: object) -> None: ...


class SequenceStrips(Items[SequencerStrip], Protocol):
    """Strips of the video sequencer."""

    def new_image(self, name: str, path: str, channel: int, start: int) -> ImageStrip: ...
    def new_sound(self, name: str, path: str, channel: int, start: int) -> SequencerStrip: ...
    def remove(self, strip: SequencerStrip) -> None: ...


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
    layer_collection: LayerCollection

    def update(self) -> None: ...


class SceneMarker(Protocol):
    """A marker on a scene's timeline; one with a camera switches to it."""

    name: str
    frame: int
    camera: Object | None


class SceneMarkers(Items[SceneMarker], Protocol):
    """Markers on a scene's timeline."""

    def new(self, name: str, *, frame: int) -> SceneMarker: ...


class Scene(Datablock, Protocol):
    """A scene."""

    camera: Object | None
    world: World | None
    frame_start: int
    frame_end: int
    frame_preview_start: int
    frame_preview_end: int
    use_preview_range: bool
    sync_mode: str
    use_audio_scrub: bool
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
    def sequence_editor(self) -> SequenceEditor | None: ...
    @property
    def timeline_markers(self) -> SceneMarkers: ...
    @property
    def frame_current(self) -> int: ...
    @property
    def frame_subframe(self) -> float: ...
    @property
    def frame_current_final(self) -> float: ...
    def frame_set(self, frame: int, *, subframe: float = 0.0) -> None: ...
    def sequence_editor_create(self) -> SequenceEditor: ...
