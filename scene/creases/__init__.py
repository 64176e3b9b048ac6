"""Wrinkles: attributes and modifier on a mesh (`marks`), and the node groups that measure and draw them (`nodes`)."""
