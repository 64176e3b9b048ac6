"""Rendering a film of the face.

ops      render a film, export a model
panel    the panel that renders a film
props    how a film is rendered and a model exported
"""
