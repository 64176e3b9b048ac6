"""How well FAPs come back from pictures.

`known` streams; `films` of heads that show them, and `neutral_faces` from their `sides` (Blender); `figures`,
`emotions` and a `photograph`: what is read off them; `generic`, `trust_table`, `page`: what is written; `sheet`: what
it looks like (Blender).
"""
