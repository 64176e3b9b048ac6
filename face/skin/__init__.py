"""The visible skin as a sheet: geometry only (`outer`), split finely where the mesh is coarse (`fine`), lines on it
(`lines`)."""
