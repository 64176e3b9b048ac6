"""Everything that Blender registers: a folder per feature, each with ops.py, panel.py and props.py.

classes, registration    what Blender is given, and how it is taken back
base, sidebar            what all operators and all panels share
active, changes          the face that it is all about, and who is told when it is to show something else

Parts that know nothing of Blender (`wheel.geometry`, `timeline.bars`) can be imported without it.
"""

from __future__ import annotations


def register() -> None:
    """Give Blender everything; all of it or, on an error, nothing."""
    from . import registration

    registration.register()


def unregister() -> None:
    """Take everything back."""
    from . import registration

    registration.unregister()
