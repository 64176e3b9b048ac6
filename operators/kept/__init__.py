"""Prepared faces that are kept for the next time: whether, where, and how they are cleared.

folder    where they are kept
ops       clears them
props     the setting, in Blender's preferences of Risorius
"""
