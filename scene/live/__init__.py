"""What Risorius shows and reads while the user works.

live_face, preview        one face held ready; shown on top of the mesh
reading, belief_curves    a face read as Blender shows it; beliefs as F-curves
shown_rest                how a resting mesh shows under modifiers
"""
