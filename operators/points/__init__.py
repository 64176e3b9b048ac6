"""Feature points of a face: found, clicked, seen, dragged, listed, exported."""
