"""How the probability of an emotion grows with activation: a drawing of lines, one small field per emotion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .sittings import EMOTIONS
from .verdicts import Judged, growth, mean_growth

#: Pixels: a field, the room around it, the room for its title.
WIDTH, HEIGHT, ROOM, TITLE = 210, 130, 34, 24
COLUMNS = 3

_ONE, _MEAN, _AXIS = 'fill="none" stroke="#b5bcc4"', 'fill="none" stroke="#b4482f" stroke-width="2.5"', "#5a6068"


def growth_chart(judged: Judged, heads: Sequence[str]) -> str:
    """An SVG: thin lines for heads, a thick one for their mean; activation 1 to 7 across, probability 0 to 1 up.

    Empty where no growth was pictured.
    """
    fields = {emotion: [growth(judged, head, emotion) for head in heads] for emotion in EMOTIONS}
    lines = {emotion: [line for line in found if len(line) > 1] for emotion, found in fields.items()}
    if not any(lines.values()):
        return ""
    rows = -(-len(EMOTIONS) // COLUMNS)
    wide, high = COLUMNS * (WIDTH + ROOM) + ROOM, rows * (HEIGHT + ROOM + TITLE)
    drawn = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" font-family="sans-serif">',
        f'<rect width="{wide}" height="{high}" fill="white"/>',
    ]
    for number, emotion in enumerate(EMOTIONS):
        left = ROOM + (number % COLUMNS) * (WIDTH + ROOM)
        top = TITLE + (number // COLUMNS) * (HEIGHT + ROOM + TITLE)
        drawn += _field(left, top, emotion, lines[emotion], mean_growth(judged, heads, emotion))
    return "\n".join([*drawn, "</svg>", ""])


def _field(
    left: int, top: int, title: str, lines: Sequence[Mapping[int, float]], mean: Mapping[int, float]
) -> list[str]:
    """One emotion: its frame, its scales, its lines."""
    across = [left + (how - 1) / 6 * WIDTH for how in range(1, 8)]
    drawn = [
        f'<text x="{left}" y="{top - 7}" font-size="14">{title}</text>',
        f'<rect x="{left}" y="{top}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="{_AXIS}"/>',
    ]
    for how, x in zip(range(1, 8), across, strict=True):
        place = f'x="{x:.0f}" y="{top + HEIGHT + 14}" font-size="10" text-anchor="middle"'
        drawn.append(f'<text {place} fill="{_AXIS}">{how}</text>')
    for share in (0.0, 0.5, 1.0):
        place = f'x="{left - 4}" y="{top + (1 - share) * HEIGHT + 3:.0f}" font-size="10" text-anchor="end"'
        drawn.append(f'<text {place} fill="{_AXIS}">{share:g}</text>')
    for line, style in [*((one, _ONE) for one in lines), (mean, _MEAN)]:
        points = " ".join(f"{across[how - 1]:.1f},{top + (1 - share) * HEIGHT:.1f}" for how, share in line.items())
        drawn.append(f'<polyline points="{points}" {style}/>')
    return drawn
