"""Registering leaves nothing behind, and asks for nothing that may be missing."""

from __future__ import annotations

import subprocess
import sys
import textwrap

import bpy
import pytest
import risorius

pytestmark = pytest.mark.smoke


def found() -> set[str]:
    """All that a registration can leave in Blender."""
    names = {name for name in dir(bpy.types) if "RISORIUS" in name}
    for owner in (bpy.types.Object, bpy.types.Scene, bpy.types.WindowManager):
        names |= {f"{owner.__name__}.{p.identifier}" for p in owner.bl_rna.properties if "risorius" in p.identifier}
    return names | {f"ops.{name}" for name in dir(bpy.ops.risorius)}


def test_registered_twice_leaves_blender_as_found() -> None:
    there = found()
    assert "RISORIUS_PT_main" in there
    assert "Object.risorius" in there
    risorius.unregister()
    assert found() == set()
    risorius.register()
    assert found() == there


def test_every_class_has_a_name_and_a_tooltip() -> None:
    from risorius import operators

    for cls in operators._classes():
        assert cls.__name__.startswith("RISORIUS_")
        assert cls.__doc__
        for prop in cls.bl_rna.properties:
            if prop.identifier in getattr(cls, "__annotations__", {}) and not prop.is_hidden:
                is_group = prop.type == "POINTER" and prop.fixed_type.identifier.startswith("RISORIUS_PG")
                assert is_group or prop.description, f"{cls.__name__}.{prop.identifier} has no tooltip"


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
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=False)
    assert "registered" in done.stdout, done.stderr


def test_command_line_is_registered(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius import cli, operators

    seen = []
    monkeypatch.setattr(cli, "main", lambda argv: seen.append(argv) or 3)
    assert operators._run_command(["profile", "joy"]) == 3
    assert seen == [["profile", "joy"]]
