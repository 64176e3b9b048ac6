"""Dataclasses that hold arrays: they compare and hash without raising, wherever in the package they are."""

from __future__ import annotations

import pkgutil
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from importlib import import_module
from importlib.util import find_spec
from inspect import isabstract
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import risorius

#: What a Python without Blender, or without the tracker's libraries, may lack.
FOREIGN = {
    "bmesh",
    "bpy",
    "bpy_extras",
    "bl_ui",
    "bl_operators",
    "blf",
    "gpu",
    "gpu_extras",
    "mathutils",
    "mediapipe",
    "cv2",
}
#: Beside the package in a checkout, or run by other programs.
NOT_PRODUCT = {"tests", "tools", "docs", "build", "dist", "out", "setup", "__main__"}


def modules(package: ModuleType = risorius) -> Iterator[ModuleType]:
    """Every module of a package that can be imported here."""
    yield package
    for found in pkgutil.iter_modules(package.__path__):
        if found.name in NOT_PRODUCT:
            continue
        try:
            module = import_module(f"{package.__name__}.{found.name}")
        except ModuleNotFoundError as missing:
            if str(missing.name).partition(".")[0] not in FOREIGN:
                raise
            continue
        if found.ispkg:
            yield from modules(module)
        else:
            yield module


def holds_arrays(cls: type) -> bool:
    """Whether a field is an array, or has arrays in it, by what its annotation names."""
    words = re.findall(r"\w+", " ".join(str(field.type) for field in fields(cls)))
    namespace = vars(import_module(cls.__module__))
    return any("ndarray" in word or "NDArray" in word or "ndarray" in repr(namespace.get(word)) for word in words)


def array_dataclasses() -> list[type]:
    """Dataclasses of the package that hold arrays."""
    found = {value for module in modules() for value in vars(module).values() if isinstance(value, type)}
    ours = [cls for cls in found if is_dataclass(cls) and cls.__module__.startswith("risorius.")]
    made_of = (cls for cls in ours if holds_arrays(cls) and not isabstract(cls))
    return sorted(made_of, key=lambda cls: (cls.__module__, cls.__name__))


CLASSES = array_dataclasses()


def made(cls: type) -> Any:
    """An instance with an array of its own in every field, without the checks of its constructor."""
    instance = object.__new__(cls)
    for field in fields(cls):
        object.__setattr__(instance, field.name, np.array([1.0, 2.0]))
    return instance


def test_they_are_found() -> None:
    names = {cls.__name__ for cls in CLASSES}
    assert {"FapStream", "Pose", "EdgeMaterial", "Region"} & names
    assert len(CLASSES) > 40
    if find_spec("bpy") is not None:
        assert {"Piece", "FaceSource", "Framing", "Curve"} <= names


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: f"{cls.__module__.removeprefix('risorius.')}.{cls.__name__}")
def test_one_compares_and_hashes_without_raising(cls: type) -> None:
    one, other = made(cls), made(cls)
    assert bool(one == one)
    assert bool(one == other) in (True, False)
    assert bool(one != other) is not bool(one == other)
    if cls.__hash__ is not None:
        assert hash(one) == hash(one)
