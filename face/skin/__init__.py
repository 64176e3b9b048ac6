"""The visible skin as a sheet: geometry only (`outer`), split finely where the mesh is coarse (`fine`), thinned out
where it is `dense` (`coarse`) with springs that stand for all of its own (`stiffness`), lines on it (`lines`)."""
