"""The timeline: a list of expressions, each with its own time.

ops, timing       operators on clips; presets for their times
clips             what these operators share
panel             the list of clips, and the times of the selected one
props             the clips: an emotion each, and when it shows
linked            the Emotion panel as the editor of the selected clip
titles, colours   what a clip is called, and its colour
bars              where clips lie in a timeline editor, and what of one is grabbed
drawing, drag     clips drawn there, and dragged
"""
