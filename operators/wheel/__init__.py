"""The emotion wheel: a picture in a corner of the viewport to point at an emotion."""
