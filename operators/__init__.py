"""Everything that Blender registers: a folder per feature, most with ops.py, panel.py and props.py.

classes, registration      what Blender is given, and how it is taken back
saved_by                   which version saved a file, and that a later one did
props                      the properties that Risorius adds to objects, scenes and the window
base, sidebar              what all operators and all panels share
held                       what operators hold that go on between events
left_over                  what a save or an undo step has kept of work that went on
active, changes            the face that it is all about, and who is told when it is to show something else
session                    what is known of the faces of the open file
requirements               SciPy, which this Blender may lack
names, translations        lists of names for panels; the interface in other languages
gizmo_keys                 keymaps of gizmos, put in order
screen                     status bars, and editors that are drawn anew
blender_events             what is done after another frame, saving, undo, another file
blender_types, annotated   Blender's types and properties, as mypy is to see them
blender_classes            Blender's classes that ours derive from, as mypy is to see them

Features, in the order of the sidebar:

face, followers, parts,    which face, what belongs to it, where its feature points are
  points
emotion, wheel, preview    which emotion, pointed at, shown at once
muscles, tissue, show      muscles by hand, what skin is made of, what happens under it
timeline, library          expressions in time; kept as files
speech                     what a face says
recording                  what trackers saw, and FAPs over time
bake, film, shapes         made of it: keys, films, shapes for engines
read                       what a face shows
kept                       prepared faces, kept for the next time

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
