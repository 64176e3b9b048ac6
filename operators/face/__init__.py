"""The face: the default head, feature points, parts that are objects of their own."""
