"""Baking an expression or a motion, and clearing it."""
