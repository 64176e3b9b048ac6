"""How fast the product is, beside Blender's own cloth and soft body: printed by `bench_speed.py`.

solvers    a frame of the skin's solvers
preview    one update of the live preview (Blender)
redraw     one redraw of the panel in a file of many objects (Blender)
"""
