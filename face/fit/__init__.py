"""Feature points found on any head: the template is laid onto the mesh and its points are carried over."""
