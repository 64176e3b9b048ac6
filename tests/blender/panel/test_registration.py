"""Registering leaves nothing behind, and asks for nothing that may be missing."""

from __future__ import annotations

import importlib
import pkgutil
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import bpy
import pytest
import risorius
from bl_ui.space_toolsystem_toolbar import VIEW3D_PT_tools_active
from risorius import operators
from risorius.operators import changes, registration
from risorius.operators.classes import CLASSES

pytestmark = pytest.mark.smoke


def found() -> set[str]:
    """All that a registration can leave in Blender, but for what it draws."""
    names = {name for name in dir(bpy.types) if "RISORIUS" in name}
    for owner in (bpy.types.Object, bpy.types.Scene, bpy.types.WindowManager):
        names |= {f"{owner.__name__}.{p.identifier}" for p in owner.bl_rna.properties if "risorius" in p.identifier}
    names |= {f"ops.{name}" for name in dir(bpy.ops.risorius)}
    for event in (name for name in dir(bpy.app.handlers) if isinstance(getattr(bpy.app.handlers, name), list)):
        names |= {f"{event} {one.__name__}" for one in getattr(bpy.app.handlers, event) if is_ours(one)}
    names |= {f"menu {one.__name__}" for one in bpy.types.VIEW3D_MT_object._dyn_ui_initialize() if is_ours(one)}
    names |= {f"tool {tool}" for tool in map(str, VIEW3D_PT_tools_active._tools["OBJECT"]) if "risorius" in tool}
    for config in bpy.context.window_manager.keyconfigs:
        for keymap in config.keymaps:
            names |= {f"{keymap.name} {item.idname}" for item in keymap.keymap_items if "risorius" in item.idname}
    told = (changes._listeners, changes._time_listeners, changes._followers)
    return names | {f"told {one.__module__}" for listeners in told for one in listeners}


def is_ours(action: Any) -> bool:
    """Whether a function that Blender calls is one of Risorius."""
    return "risorius" in action.__module__


@pytest.fixture
def drawing(monkeypatch: pytest.MonkeyPatch) -> Iterator[set[Any]]:
    """Handles of what is being drawn; nothing is registered meanwhile."""
    handles: set[Any] = set()
    risorius.unregister()
    for space in (bpy.types.SpaceView3D, bpy.types.SpaceDopeSheetEditor):

        def add(*arguments: Any, add: Any = space.draw_handler_add) -> Any:
            handles.add(handle := add(*arguments))
            return handle

        def remove(handle: Any, region: str, remove: Any = space.draw_handler_remove) -> None:
            remove(handle, region)
            handles.remove(handle)

        monkeypatch.setattr(space, "draw_handler_add", add)
        monkeypatch.setattr(space, "draw_handler_remove", remove)
    yield handles
    monkeypatch.undo()
    risorius.register()


def test_registered_twice_leaves_blender_as_found(drawing: set[Any]) -> None:
    assert found() == set()
    risorius.register()
    there = found()
    for kind in ("RISORIUS_PT_main", "Object.risorius", "ops.bake_six", "menu _menu", "Dopesheet risorius.drag_clip"):
        assert kind in there
    assert len(drawing) == 4
    risorius.unregister()
    assert (found(), drawing) == (set(), set())
    risorius.register()
    assert found() == there
    risorius.unregister()


class RISORIUS_PT_broken(bpy.types.Panel):
    """A class that Blender refuses: it cannot draw."""


@pytest.mark.parametrize("position", range(len(CLASSES) + 1))
def test_a_class_that_blender_refuses_leaves_blender_as_found(
    position: int, drawing: set[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    classes = (*CLASSES[:position], RISORIUS_PT_broken, *CLASSES[position:])
    monkeypatch.setattr(registration, "CLASSES", classes)
    with pytest.raises(AttributeError, match="RISORIUS_PT_broken"):
        risorius.register()
    assert (found(), drawing) == (set(), set())


def test_whichever_step_fails_blender_is_left_as_found(drawing: set[Any], monkeypatch: pytest.MonkeyPatch) -> None:
    steps, allowed = 0, 0

    class Failing(ExitStack):
        """Takes a number of steps, and fails on the next one."""

        def callback(self, *arguments: Any, **keywords: Any) -> Any:
            nonlocal steps
            steps += 1
            super().callback(*arguments, **keywords)
            if steps > allowed:
                raise ZeroDivisionError(arguments)

    monkeypatch.setattr(registration, "ExitStack", Failing)
    for allowed in range(1 + len(CLASSES), 1000):
        steps = 0
        try:
            risorius.register()
        except ZeroDivisionError:
            assert (found(), drawing) == (set(), set()), f"after {allowed} steps"
        else:
            break
    assert allowed > len(CLASSES) + len(registration.ATTACHED)
    assert len(drawing) == 4
    risorius.unregister()
    assert (found(), drawing) == (set(), set())


def test_every_class_there_is_is_registered() -> None:
    there = set()
    for found_module in pkgutil.walk_packages(operators.__path__, f"{operators.__name__}."):
        module = importlib.import_module(found_module.name)
        there |= {one for name, one in vars(module).items() if name.startswith("RISORIUS_") and isinstance(one, type)}
    assert there == set(CLASSES)
    assert len(CLASSES) == len(set(CLASSES))


def test_every_class_has_a_name_and_a_tooltip(properties_of: Callable[[type], Any]) -> None:
    for cls in CLASSES:
        assert cls.__name__.startswith("RISORIUS_")
        assert cls.__doc__
        for prop in properties_of(cls):
            if prop.identifier in getattr(cls, "__annotations__", {}) and not prop.is_hidden:
                is_group = prop.type == "POINTER" and prop.fixed_type.identifier.startswith("RISORIUS_PG")
                assert is_group or prop.description, f"{cls.__name__}.{prop.identifier} has no tooltip"


@pytest.mark.slow
def test_registers_without_scipy_and_says_so() -> None:
    code = """
        import sys
        class Hidden:
            def find_spec(self, name, path=None, target=None):
                if name.partition(".")[0] == "scipy":
                    raise ModuleNotFoundError("No module named 'scipy'", name="scipy")
        sys.meta_path.insert(0, Hidden())
        import bpy, risorius
        risorius.register()
        from risorius.operators.requirements import has_scipy
        assert not has_scipy()
        bpy.ops.mesh.primitive_cube_add()
        assert bpy.context.object.risorius.emotion.word == "joy"
        assert not bpy.ops.risorius.bake_expression.poll()
        assert not bpy.ops.risorius.add_head.poll()
        assert not [name for name in sys.modules if name.startswith("scipy")]
        risorius.unregister()
        print("registered")
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=120, check=False
    )
    assert (done.returncode, "registered" in done.stdout) == (0, True), done.stderr


def test_command_line_is_registered(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius import cli

    seen = []
    monkeypatch.setattr(cli, "main", lambda argv: seen.append(argv) or 3)
    assert registration.run_command(["profile", "joy"]) == 3
    assert seen == [["profile", "joy"]]


@pytest.mark.slow
@pytest.mark.parametrize("left", ["", "risorius.unregister()"])
def test_python_ends_as_asked_after_a_registration(left: str) -> None:
    code = f"import bpy, risorius, sys\nrisorius.register()\n{left}\nsys.exit(3)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=120, check=False).returncode == 3
