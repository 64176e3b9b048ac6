"""The visible skin as a sheet: geometry only (`outer`), and split finely where the mesh is coarse (`fine`)."""
