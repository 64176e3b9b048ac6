"""What Risorius shows and reads while the user works.

live_face, preview        one face held ready; shown on top of the mesh
played                    a motion that is not baked, as it will be
held_faces                the faces that are held ready, and which are due to be shown
reading, belief_curves    a face read as Blender shows it; beliefs as F-curves
shown_rest                how a resting mesh shows under modifiers
"""
