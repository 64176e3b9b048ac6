"""How a face is pictured: engine, size, camera, background; and the render settings that this means."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

from ...errors import ParameterError, SceneError
from ..blender_types import RenderSettings, Scene
from .gpu_probe import REMEDY, can_draw

#: The light of Workbench: from one side with a dim one from the other, so that folds, nose and brows stand out.
STUDIO_LIGHT = "studio.sl"
#: Stops by which it is too dark for skin.
EXPOSURE = 0.85
#: How much of the background's light falls on the face.
AMBIENT = 0.35
#: Rays per pixel that Cycles takes, and for stills.
SAMPLES, FINE_SAMPLES = 16, 64
#: What Blender writes into pictures and films that differs from one time to the next, or tells of this computer.
STAMPS = (
    "camera", "date", "filename", "frame", "frame_range", "hostname", "lens", "marker", "memory", "render_time",
    "scene", "sequencer_strip", "time",
)  # fmt: skip


class Engine(StrEnum):
    """Who draws the picture."""

    WORKBENCH = "WORKBENCH"
    EEVEE = "EEVEE"
    CYCLES = "CYCLES"


class Camera(StrEnum):
    """Who looks: a portrait camera on the face, or the one of the user's scene, with all that is in it."""

    FACE = "FACE"
    SCENE = "SCENE"


@dataclass(frozen=True)
class Lighting:
    """The lights of a portrait.

    Attributes
    ----------
    strength : as a multiple of the usual.
    yaw : how far they are turned about the face to the subject's left, radians.
    ambient : how much of the background's light falls on the face, in Cycles and EEVEE.
    stays : in Workbench, whether the lights stay about the face when the camera goes around it, and have a yaw, as in
        Cycles and EEVEE; without, they go with the camera.
    """

    strength: float = 1.0
    yaw: float = 0.0
    ambient: float = AMBIENT
    stays: bool = False


#: Where nothing else is said.
USUAL_LIGHT = Lighting()


@dataclass(frozen=True)
class Look:
    """How a face is pictured.

    Attributes
    ----------
    engine : who draws it.
    width, height : pixels.
    yaw, pitch : how far the camera stands to the subject's left and above the face, radians.
    roll : how far it is turned clockwise about its line of sight, radians.
    lens : its focal length, mm, for a picture 24 mm high.
    distance : from the face, metres on a life-size face, in proportion on one of another size; None: so that the face
        fills the picture.
    background : linear RGB.
    camera : on the face, or the scene's own with its lights, world, objects and view settings.
    fine : for stills: twice the smoothing, and shading that shows every fold. Three times as long without a GPU.
    lighting : the lights of a portrait.
    samples : rays per pixel that Cycles takes; None: as is usual.
    backdrop : linear RGB that the picture has behind the face, whatever the exposure; None: `background` as exposed.
    """

    engine: Engine = Engine.WORKBENCH
    width: int = 512
    height: int = 512
    yaw: float = 0.17
    background: tuple[float, float, float] = (0.17, 0.18, 0.195)
    camera: Camera = Camera.FACE
    fine: bool = False
    pitch: float = 0.0
    roll: float = 0.0
    lens: float = 85.0
    distance: float | None = None
    lighting: Lighting = USUAL_LIGHT
    samples: int | None = None
    backdrop: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        for name in ("width", "height"):
            size = getattr(self, name)
            if not (16 <= size <= 8192 and size % 2 == 0):
                raise ParameterError(name, "must be an even number of pixels from 16 to 8192", size)


def usable_engine(wanted: Engine) -> tuple[Engine, str | None]:
    """The engine that can draw here, and a remark where it is another than `wanted`."""
    if wanted is not Engine.CYCLES and not can_draw():
        return Engine.CYCLES, REMEDY
    return wanted, None


def apply_look(scene: Scene, look: Look) -> None:
    """Give a scene the render settings of a look.

    Raises
    ------
    SceneError : the engine is not available.
    """
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = look.width, look.height, 100
    render.use_file_extension = render.use_overwrite = True
    render.use_compositing = render.use_sequencer = False
    unstamp(render)
    engine = _set_engine(scene, look)
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = _exposure(look) if engine is Engine.WORKBENCH else 0.0
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGB"
    scene.display.render_aa = "16" if look.fine else "5"
    shading = scene.display.shading
    shading.light, shading.color_type = "STUDIO", "MATERIAL"
    with suppress(TypeError):  # a user may have taken it away: Blender's own default stays
        shading.studio_light = STUDIO_LIGHT
    shading.show_cavity, shading.cavity_type = True, "BOTH" if look.fine else "SCREEN"
    shading.cavity_ridge_factor, shading.cavity_valley_factor = 0.4, 1.0
    shading.curvature_ridge_factor, shading.curvature_valley_factor = 0.2, 0.7
    shading.show_shadows, shading.show_specular_highlight = False, True


def unstamp(render: RenderSettings) -> None:
    """Leave out of pictures and films what differs from one time to the next: the same scene gives the same bytes."""
    for name in STAMPS:
        setattr(render, f"use_stamp_{name}", False)


def _exposure(look: Look) -> float:
    """Stops of a Workbench picture: its lights are always as strong."""
    return EXPOSURE + math.log2(max(look.lighting.strength, 1e-3))


def _set_engine(scene: Scene, look: Look) -> Engine:
    """Choose the render engine by what this Blender calls it, and say which it is."""
    engine, _ = usable_engine(look.engine)
    names = {
        Engine.WORKBENCH: ("BLENDER_WORKBENCH",),
        Engine.EEVEE: ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT"),
        Engine.CYCLES: ("CYCLES",),
    }[engine]
    for name in names:
        try:
            scene.render.engine = name
        except TypeError:
            continue
        break
    else:
        raise SceneError(engine.value.title(), "is not available in this Blender: choose another engine")
    if engine is Engine.CYCLES:
        scene.cycles.samples = look.samples or (FINE_SAMPLES if look.fine else SAMPLES)
        scene.cycles.use_denoising = True
    return engine
