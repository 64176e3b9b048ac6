"""The face: the default head, feature points, parts that are objects of their own.

ops      add the default head, import and forget feature points
panel    the panel's top: which face, and its parts
props    what is stored of the face with its object, beside the feature points
six      one button: six emotions one after another on the timeline
"""
