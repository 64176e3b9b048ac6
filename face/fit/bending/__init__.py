"""The template bent onto a head, and its points carried over.

fitted        the whole fit, ever softer
target        what the template is bent onto
bend, ears    the cage's nodes moved; where the ears are
carry         points on the mesh
proportions   where points on smooth skin lie by a face's proportions
brow_lines, painted_brows,   brows that show: where they are sought, painted ones, pieces of their own
  modelled_brows
confidence    how sure each point is
"""
