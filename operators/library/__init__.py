"""The library: expressions and timelines as preset files, on any face.

ops         save and load presets
panel       the menu of presets, and what may be dropped on the viewport
exchange    between what is chosen for a face and what a preset file holds
spoken      the same of speech
"""
