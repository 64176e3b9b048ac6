"""Pictures of the panels on the default head."""

from __future__ import annotations

from .session import MIDDLE, PICTURES, QUALITY, Session

PREVIEW = "bl_ext.user_default.risorius.operators.preview.live"


def first(session: Session) -> None:
    """The first minute: the head, joyful, before anything is baked."""
    session.head()
    session.take("first-minute")


def wheel(session: Session) -> None:
    """The pointer has dragged the emotion to guilty."""
    session.head()
    session.run("bpy.context.object.risorius.emotion.word = 'guilty'")
    session.take("wheel", MIDDLE)


def timeline(session: Session) -> None:
    """Three clips, one selected."""
    session.head()
    for frame, word in ((1, "joy"), (45, "surprise"), (90, "disgust")):
        session.run(
            f"bpy.context.scene.frame_set({frame})\n"
            "bpy.ops.risorius.add_clip()\n"
            f"bpy.context.object.risorius.emotion.word = {word!r}"
        )
    session.take("timeline")


def muscles(session: Session) -> None:
    """Muscles of a smile from the side, and their sliders."""
    session.only_panels("emotion", "muscles")
    session.head()
    session.run(
        "window = bpy.context.window_manager.risorius\n"
        "window.show.muscles = window.muscles.busy_only = True\n"
        "bpy.ops.view3d.view_orbit(angle=0.5, type='ORBITRIGHT')"
    )
    session.take("muscles", MIDDLE)
    session.run("window.show.muscles = False\nwindow.show.strain = True")
    session.take("strain", MIDDLE)
    session.run("window.show.strain = False\nwindow.show.paths = True\nbpy.context.object.risorius.emotion.seed = 0")
    session.window.ask(f"from importlib import import_module\nlive = import_module({PREVIEW!r})")
    shown = "live.shown(bpy.context.object)"
    session.window.wait(f"{shown} is not None and {shown}.paths is not None")
    session.take("paths", MIDDLE)
    session.run("window.show.paths = False")


def baked(session: Session) -> None:
    """A baked expression at its apex."""
    session.head()
    session.run("bpy.context.object.risorius.emotion.word = 'surprise'\nbpy.ops.risorius.bake_expression()")
    session.run("bpy.context.scene.frame_set(30)")
    session.take("baked")


def reading(session: Session) -> None:
    """The Read panel, alone and open, on joy at its apex; and the plot of its animation."""
    session.only_panels("read", "read_faps", "read_features")
    session.head()
    session.run(
        "scene = bpy.context.scene\nscene.frame_end = 75\nscene.risorius.read.rule = 'robust'\n"
        "bpy.ops.risorius.bake_expression()\nscene.frame_set(20)"
    )
    session.take("reading", MIDDLE)
    session.window.ask(
        "with in_viewport():\n    bpy.ops.risorius.read_animation()\n"
        "    picture = bpy.data.images[f'{bpy.context.object.name} Beliefs']\n"
        f"path = {str(session.folder / 'reading-plot.jpg')!r}\n"
        "picture.filepath_raw, picture.file_format = path, 'JPEG'\n"
        f"picture.save(quality={QUALITY})"
    )
    (PICTURES / "reading-plot.jpg").write_bytes((session.folder / "reading-plot.jpg").read_bytes())
