"""What happens under the skin, drawn over the face: muscles, strain, paths.

overlay    muscles, strain and paths drawn in the viewport
colours    of contraction, strain and time
props      what is drawn
"""
