"""What a face's poses and motions become in Blender: shape keys, actions and strips.

baking                      the way in: one expression or a motion
target, timing              where a bake goes, and when it happens
writing                     shape keys and a clip written on all objects of a face, and taken away
performance, strips         several expressions; a timeline
motion, speech_motion       what a motion bake simulates; what is said, as such
compress, compress_long     a motion as few shapes times weights; one of which some frames were posed
gathered, fewest, local     its frames as they come; the fewest shapes; shapes that move a part each
shape_keys, action, notes   Risorius' own keys; clips as actions; what a bake notes on them
tracks                      how clips play: as the keys' action, or on NLA tracks beside one another
remarks                     what an animator should know about a bake
"""

from .baking import BakeResult, bake_expression, bake_motion, joined
from .target import Target
from .timing import ClipTiming, scene_fps
from .writing import clear

__all__ = ["BakeResult", "ClipTiming", "Target", "bake_expression", "bake_motion", "clear", "joined", "scene_fps"]
