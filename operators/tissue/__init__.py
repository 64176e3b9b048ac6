"""What the skin of a face is made of: the bundled tissues, figures of one's own, presets of them."""
