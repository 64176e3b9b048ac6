"""Baking an expression or a motion, and clearing it.

ops         bake, and clear what was baked
work        the three bakes: an expression, a motion, a strip for each clip
panel       the panel that bakes
props       when and under what name an expression is baked
settings    what a bake now would be made of, as digests: a baked clip whose note says otherwise is stale
"""
