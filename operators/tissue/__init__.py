"""What the skin of a face is made of: the bundled tissues, figures of one's own, presets of them.

ops      save figures as one of Blender's presets
panel    the panel of the tissue
props    the tissue chosen: a bundled one, or figures of its own
"""
