"""Fixtures for tests inside Blender (the bpy module): a registered extension, an empty file, a head."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest

if importlib.util.find_spec("bpy") is None:
    collect_ignore_glob = ["test_*.py", "*/test_*.py"]
else:
    import bpy
    import risorius.api

ended: list[int] = []


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(exitstatus: int) -> None:
    """Keep how the session ended."""
    ended.append(int(exitstatus))


@pytest.hookimpl(trylast=True)
def pytest_unconfigure() -> None:
    """Leave at once: Blender's module, leaving in its own order, may wait forever for its thread of sounds.

    Everything is reported by now, and the exit code is the session's.
    """
    if ended and "bpy" in sys.modules:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(ended[0])


@pytest.fixture(scope="session")
def _registered() -> Iterator[None]:
    """The extension, registered once for all tests."""
    risorius.register()
    yield
    risorius.unregister()


@pytest.fixture(autouse=True)
def empty_file(_registered: None) -> None:
    """Every test starts from an empty file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


@pytest.fixture
def properties_of() -> Callable[[type], Any]:
    """A registered class -> its properties, which Blender keeps elsewhere for operators."""

    def found(cls: Any) -> Any:
        if not issubclass(cls, bpy.types.Operator):
            return cls.bl_rna.properties
        room, _, name = cls.bl_idname.partition(".")
        return getattr(getattr(bpy.ops, room), name).get_rna_type().properties

    return found


@pytest.fixture(scope="session")
def built_head() -> Any:
    """The default head's mesh, built once; half of what adding it takes."""
    return risorius.api.build_default_head()


@pytest.fixture
def head(built_head: Any) -> Any:
    """The default head, selected and active."""
    from risorius.scene.head import add_default_head

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(risorius.api, "build_default_head", lambda: built_head)
        return add_default_head()


@pytest.fixture
def cube() -> Any:
    """A small mesh without feature points, selected and active."""
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object
