"""The emotion: word, variant, activation.

ops            operators for the emotion
panel          the panel where the emotion is chosen
props          the emotion chosen for a face
profile        from the chosen emotion to what the solver takes
performance    what is laid out in time for a face, baked or not
"""
