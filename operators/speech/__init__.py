"""Speech: what is said, how, and the clip that says it.

props    what is said and how
ops      bake it, with its sound on the sequencer
panel    Speak
"""
