"""The template that is laid onto a mesh (`template`), with its mouth open (`open_mouth`), and as a picture of its
parts (`picture`).
"""
