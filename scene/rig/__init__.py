"""A character's own controls, its shape keys and bones: what they do to its face, and clips keyed on them.

baking        the way in: expressions or a motion onto the controls of a rig
rig           controls, what each does to the face, and what is left alone
channels      one number that can be keyed; its limits, its value at rest
rounds        values solved, looked at on the rig, and solved again for what is left
turns         turns of bones that are kept as quaternions, or as an axis and an angle
keys          the shape keys of a face as controls, measured on its meshes
driven        what drives shape keys as controls
bones         the bones and custom properties of armatures as controls
sampling      what moving a channel does to the face
rig_copy      a face with its rig as a copy, to move controls on
clips         the keyframes of a clip as actions of all that a rig keys
layers        how such a clip plays: on top of what plays already, and taken off again
destinations  what a bake may go to: new shape keys, or controls that are there
strips        a timeline's clips on a rig
kept          what is kept with a clip: what its bake has noted, and how far the rig follows
beside        clips on the rig and clips of new shape keys at the same frames, which add up
report        what a bake has to say for itself, as plain numbers and names
"""

from .baking import bake_expression_onto, bake_expressions_onto, bake_motion_onto
from .bones import bone_rig
from .clips import remove_rig_clips
from .keys import key_rig
from .rig import Rig

__all__ = [
    "Rig",
    "bake_expression_onto",
    "bake_expressions_onto",
    "bake_motion_onto",
    "bone_rig",
    "key_rig",
    "remove_rig_clips",
]
