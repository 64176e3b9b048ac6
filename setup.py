"""What pyproject.toml cannot say where the repository is the package: its folders, and where the version stands."""

import tomllib
from pathlib import Path

from setuptools import find_packages, setup

NOT_INSTALLED = ("tests", "tools", "docs", "build", "dist", "out")

script = Path(__file__)
manifest = tomllib.loads(script.with_name("blender_manifest.toml").read_text(encoding="utf-8"))
folders = find_packages(exclude=[pattern for name in NOT_INSTALLED for pattern in (name, f"{name}.*")])
setup(
    version=manifest["version"],
    packages=["risorius", *(f"risorius.{folder}" for folder in folders)],
    script_name=script.name,  # setuptools leaves it out of the package by this name
)
