"""Where MediaPipe's landmarks lie on heads, measured, and how well labels agree with what MediaPipe sees.

pictures    neutral heads from several sides, with the place on the head that every pixel shows (Blender)
check       how far MediaPipe sees them from where labels have them
places      landmarks seen in them, as places on the template: presets/capture/mediapipe_places.csv
"""
