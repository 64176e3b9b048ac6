"""A small drawing of a face that shows where a feature point lies: the template's own points, joined by lines."""

from __future__ import annotations

from collections.abc import Iterable

from .canvas import Canvas, Colour, Pixel

#: Lines of the drawing from point to point of the template, closed where the first name comes again.
LINES = (
    ("11.1", "11.3", "10.9", "10.7", "2.13", "2.11", "2.1", "2.12", "2.14", "10.8", "10.10", "11.2", "11.1"),
    ("4.1", "4.3", "4.5"),
    ("4.2", "4.4", "4.6"),
    ("3.11", "3.1", "3.7", "3.3", "3.11"),
    ("3.8", "3.2", "3.12", "3.4", "3.8"),
    ("8.4", "8.6", "8.9", "8.1", "8.10", "8.5", "8.3", "8.7", "8.2", "8.8", "8.4"),
    ("2.5", "2.7", "2.2", "2.6", "2.4"),
    ("9.6", "9.2", "9.4", "9.15", "9.5", "9.1", "9.7"),
)
#: The drawing's size, pixels at a scale of 1, and the margin inside it.
WIDTH, HEIGHT, MARGIN = 150.0, 200.0, 14.0
PAPER, LINE, DONE = (0.08, 0.08, 0.09, 0.82), (0.75, 0.75, 0.75, 1.0), (0.16, 0.78, 0.86, 1.0)
NOW: Colour = (1.0, 0.55, 0.1, 1.0)
#: Steps of a curve between two points.
STEPS = 6


def draw_diagram(canvas: Canvas, corner: Pixel, scale: float, now: str | None, done: Iterable[str]) -> None:
    """Draw it with its lower left corner there, `now` marked, `done` ticked off. The subject's left is on the right."""
    from ...face.mesh.template import TEMPLATE_POINTS

    used = {name for line in LINES for name in line}
    left = min(TEMPLATE_POINTS[name][0] for name in used)
    low = min(TEMPLATE_POINTS[name][1] for name in used)
    high = max(TEMPLATE_POINTS[name][1] for name in used)
    per_metre = scale * (HEIGHT - 2.0 * MARGIN) / (high - low)
    middle = corner[0] + scale * WIDTH / 2.0

    def pixel(name: str) -> Pixel:
        """Where a point of the template stands in the drawing."""
        place = TEMPLATE_POINTS[name]
        return middle + per_metre * float(place[0]), corner[1] + scale * MARGIN + per_metre * float(place[1] - low)

    assert left < 0.0
    canvas.box(corner, (corner[0] + scale * WIDTH, corner[1] + scale * HEIGHT), PAPER)
    for line in LINES:
        canvas.line(curve([pixel(name) for name in line]), 1.4 * scale, LINE)
    for name in done:
        canvas.disc(pixel(name), 3.5 * scale, DONE)
    if now is not None:
        canvas.disc(pixel(now), 8.0 * scale, (*NOW[:3], 0.35))
        canvas.disc(pixel(now), 4.5 * scale, NOW)


def curve(path: list[Pixel]) -> list[Pixel]:
    """A smooth curve through pixels (Catmull and Rom 1974); closed where its ends meet."""
    closed = path[0] == path[-1]
    before = path[-2] if closed else path[0]
    after = path[1] if closed else path[-1]
    knots = [before, *path, after]
    smooth = [path[0]]
    for a, b, c, d in zip(knots, knots[1:], knots[2:], knots[3:], strict=False):
        for step in range(1, STEPS + 1):
            t = step / STEPS
            smooth.append((_blend(a[0], b[0], c[0], d[0], t), _blend(a[1], b[1], c[1], d[1], t)))
    return smooth


def _blend(a: float, b: float, c: float, d: float, t: float) -> float:
    """Between b and c, with the slope of their neighbours."""
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
