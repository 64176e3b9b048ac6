"""Baking an expression or a motion, and clearing it.

ops          bake, and clear what was baked
work         the bakes: an expression, a motion, a strip for each clip, a stream
panel        the panel that bakes
baked        what has been baked, in the panel
props        when, under what name and to what an expression is baked
destination  where a bake goes: new shape keys, or the keys or bones that the character already has
settings     what a bake now would be made of, as digests: a baked clip whose note says otherwise is stale
"""
