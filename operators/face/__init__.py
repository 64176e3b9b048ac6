"""The face: the default head, feature points, six emotions by one button.

ops      add the default head, import and forget feature points
panel    the panel's top: which face
props    what is stored of the face with its object, beside the feature points
lips     what is sewn, and the button that cuts it open
six      one button: six emotions one after another on the timeline
"""
