"""How a face is pictured: engine, size, camera, background; and the render settings that this means."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from enum import StrEnum

from ...errors import ParameterError, SceneError
from ..blender_types import Scene
from .gpu_probe import REMEDY, can_draw

#: The light of Workbench: from one side with a dim one from the other, so that folds, nose and brows stand out.
STUDIO_LIGHT = "studio.sl"
#: Stops by which it is too dark for skin.
EXPOSURE = 0.85


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
class Look:
    """How a face is pictured.

    Attributes
    ----------
    engine : who draws it.
    width, height : pixels.
    yaw : how far the camera stands to the subject's left, radians.
    background : linear RGB.
    camera : on the face, or the scene's own with its lights, world, objects and view settings.
    fine : for stills: twice the smoothing, and shading that shows every fold. Three times as long without a GPU.
    """

    engine: Engine = Engine.WORKBENCH
    width: int = 512
    height: int = 512
    yaw: float = 0.17
    background: tuple[float, float, float] = (0.17, 0.18, 0.195)
    camera: Camera = Camera.FACE
    fine: bool = False

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
    engine = _set_engine(scene, look)
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure = EXPOSURE if engine is Engine.WORKBENCH else 0.0
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
        scene.cycles.samples = 64 if look.fine else 16
        scene.cycles.use_denoising = True
    return engine
