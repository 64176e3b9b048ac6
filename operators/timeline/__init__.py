"""The timeline: a list of expressions, each with its own time."""
