"""The visible skin as a sheet: geometry only (`outer`), split finely where the mesh is coarse (`fine`), thinned out
where it is dense (`coarse`), lines on it (`lines`)."""
