"""Speech: what is said, how, and the strips of the timeline that say it.

props          what is said and how, and the strips
strip_props    strips, their words, the words' sounds
strips         what strips say, and all of them as one motion of the mouth
heard          what is chosen, spoken or read
ops            bake it at once, with its sound on the sequencer
placing        a strip put there with its sound
sharing        sounds that copies of a face share, and that a face has left
strip_ops      strips added, pasted, removed, stretched
bars           strips in a timeline editor, and how they are dragged there
fitting        a strip's sound as long as the strip
word_ops       words split, joined, inserted, removed, pronounced; their sounds
panel          Speak
word_panel     the words of a strip and their sounds
"""
