"""Sounds in time become FAPs of mouth, jaw and tongue.

parts      the parts of the mouth, what a viseme asks of each, and the figures of presets/speech/articulation.toml
blending   neighbouring sounds share a part: dominance
closures   what must be reached: lips for p b m, lip and teeth for f v
talking    the whole: frames of FAPs
"""

from .talking import SPOKEN, articulate, articulate_steps, spoken_frames, viseme_shares

__all__ = ["SPOKEN", "articulate", "articulate_steps", "spoken_frames", "viseme_shares"]
