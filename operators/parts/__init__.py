"""Parts of the face's mesh: told apart, shown as colours, corrected by vertex groups.

ops        tell parts apart, correct one by a vertex group, forget them
panel      the panel of parts
props      what is shown and set of them
overlay    parts drawn over the mesh as colours
"""
