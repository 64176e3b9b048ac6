"""Risorius: an emotion word and an activation become a moving face, for Blender and for Python.

The layers, each knowing only those above it:

- ``errors``, ``files``, ``tables``, ``resources``, ``arrays``, ``polygons``, ``progress`` the ground: errors, files,
  tables, where they lie, polygons as arrays, how far long work is;
- ``mpeg4`` the standard's face animation parameters and the emotion model; ``physics`` skin, muscles, solvers;
- ``face`` one particular face: its parts, feature points, muscles, and the way from parameters to contractions;
- ``speech`` what is said and when, as motion of a mouth, and what feeling adds;
- ``labels`` the truth beside a picture of a face: landmarks, areas, depth and all that drives it, as tables;
- ``api`` the public interface, arrays in and out, without Blender: what scripts and the command line use;
- ``scene`` Blender's meshes, shape keys, actions and renders to arrays and back; registers nothing;
- ``track`` films and cameras to parameters, in plain Python;
- ``batch`` many clips from a table, each whole or not at all, over ``api`` and ``scene``;
- ``cli`` the command line over ``api``, ``scene``, ``track`` and ``batch``;
- ``operators`` everything Blender registers: operators, panels, properties.

``presets`` holds the tables that a user may copy and edit.

Importing this package loads neither Blender nor SciPy, so that it serves plain Python as well as Blender.
"""

from __future__ import annotations


def register() -> None:
    """Register everything with Blender. May follow `unregister` any number of times."""
    from . import operators

    operators.register()


def unregister() -> None:
    """Take everything back out of Blender, leaving it as `register` found it."""
    from . import operators

    operators.unregister()
