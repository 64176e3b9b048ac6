"""A real Blender window for tests and pictures.

driver    the window from outside: pointer, keyboard, questions
served    what answers inside Blender
"""
