"""The live preview: the face shows what is chosen while it is being chosen."""
