"""How fast the product is, beside Blender's own cloth and soft body: printed by `bench_speed.py`.

solvers    a frame of the skin's solvers
preview    one update of the live preview (Blender)
playback   playing clips that are not baked (Blender)
redraw     one redraw of the panel in a file of many objects (Blender)
first      the first pose of a new head, and of one whose face is kept
growth     time and memory of each phase from 1,000 to 500,000 vertices
motion     a motion on every head, beside Blender's own solvers; how far it is off
films      films of before and after laid over one another (Blender)
xpbd       Blender's cloth on its XPBD solver node
machine    how fast memory is
page       docs/performance.md
"""
