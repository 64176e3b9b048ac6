"""The emotion wheel: a picture in a corner of the viewport to point at an emotion.

geometry, places      the wheel in pixels, and what lies where on it; without Blender
picture, caption      how it is drawn, and what is written below
choice                what is chosen on it, read and written on a face
dragging, ops         following a hand; operators for it, and keys
view, props, panel    where it is and how large
gizmo                 the wheel in every viewport
pick                  the wheel at the pointer
"""
