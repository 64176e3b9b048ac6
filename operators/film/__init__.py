"""Rendering a film of the face."""
