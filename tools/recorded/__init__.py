"""How far recordings of real people come through to the vertices.

`takes`: which recordings; `played`: what heads make of them, read back; `page`: what is written; `strip`: what it looks
like (Blender).
"""
