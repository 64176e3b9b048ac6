"""The template bent onto a head, and its points carried over.

fitted        the whole fit, ever softer
target        what the template is bent onto
bend, ears    the cage's nodes moved; where the ears are
carry         points on the mesh
proportions   where points on smooth skin lie by a face's proportions
painted_brows  brows that are painted
confidence    how sure each point is
"""
