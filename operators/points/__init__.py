"""Feature points of a face: found, clicked, seen, dragged, listed, exported.

ops                 find, look at, put back, hold on to an edited mesh, export
click, clicks,      the few clicked points that tell where a face is; those clicked so far; their picture
  click_drawing
drag                one point along the surface, its counterpart with it
first               a button that needs feature points finds them itself
question, show      points that were found are shown, and doubtful ones asked about
joined              points of a face that was joined into another object
topologies,         meshes whose points need not be searched; their list
  topologies_panel
panel, diagram      points listed; a diagram of where each lies
props               how points are shown and corrected
reasons             why a button is grey
overlay, hover      points drawn over the face, and the one under the mouse
look, view          the viewport turned to the face; its pixels to rays of the world and back
canvas              flat shapes and text, drawn in one go
"""
