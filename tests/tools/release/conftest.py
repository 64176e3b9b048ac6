"""What is built once for all tests: the small zip, and the Python package."""

from __future__ import annotations

from pathlib import Path

import pytest
from release.python_package import build_python_package
from release.sources import BuildError, source_files
from release.zips import blender_extension_command, build_zip

#: Folders of the checkout that nobody installs.
NOT_INSTALLED = ("tests", "tools", "docs")


@pytest.fixture(scope="session")
def product() -> frozenset[str]:
    """Every file of the product, relative to the checkout: modules of the root, and all of the packages."""
    files = source_files()
    rooms = {name.as_posix() for name in files if len(name.parts) > 1 and name.parts[0] not in NOT_INSTALLED}
    modules = {name.name for name in files if len(name.parts) == 1 and name.suffix == ".py"} - {"setup.py"}
    return frozenset(rooms | modules | {"py.typed", "blender_manifest.toml"})


@pytest.fixture(scope="session")
def python_package(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The source distribution and the wheel that was built from it."""
    return build_python_package(tmp_path_factory.mktemp("python"))


@pytest.fixture(scope="session")
def small_zip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The extension without wheels, which has passed Blender's own check."""
    try:
        blender_extension_command()
    except BuildError as error:
        pytest.skip(str(error))
    return build_zip(tmp_path_factory.mktemp("zip") / "small.zip", [], platform=None, blender=None)
