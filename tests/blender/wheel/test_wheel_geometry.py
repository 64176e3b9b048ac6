"""The emotion wheel in pixels: where words are, what is under a pixel, where there is room. No window is needed."""

from __future__ import annotations

import itertools
import math

import pytest
import risorius.api as api
from risorius.operators.wheel.geometry import SMALLEST_RADIUS, Box, Corner, Wheel, free_box, placed, under
from risorius.operators.wheel.places import CENTRE, between, labels, nearest_word, places, spots

pytestmark = pytest.mark.smoke

WHEEL = Wheel((200.0, 300.0), 140.0)


def size(word: str) -> tuple[float, float]:
    """Of a label, about as a font has it."""
    return 6.0 * len(word), 11.0


@pytest.mark.parametrize("angle", [0.0, 70.3, 180.0, 323.4, 359.9])
@pytest.mark.parametrize("activation", [1.0, 3.3, 7.0])
def test_a_point_is_found_where_it_is_drawn(angle: float, activation: float) -> None:
    assert WHEEL.point(WHEEL.pixel(angle, activation)) == pytest.approx((angle, activation))


def test_beyond_the_rim_and_at_the_centre_the_activation_stays_on_the_scale() -> None:
    assert WHEEL.point((200.0, 800.0)) == pytest.approx((90.0, 7.0))
    assert WHEEL.point(WHEEL.centre)[1] == pytest.approx(1.0)


def test_angles_turn_counter_clockwise_from_the_right() -> None:
    """As in the paper: joy to the right, surprise to the left, fear and sadness above, anger below."""
    where = {name: (x - 200.0, y - 300.0) for name, (x, y) in spots(WHEEL).items()}
    assert where["joy"][0] > 0 > where["surprise"][0]
    assert min(where["fear"][1], where["sadness"][1]) > 0 > max(where["anger"][1], where["joy"][1])
    assert where["fear"][0] > where["guilty"][0] > where["sadness"][0]


def test_every_word_is_shown_once_where_its_figures_say() -> None:
    spot = spots(WHEEL)
    for name, word in api.WORDS.items():
        if word.activation is None:
            assert name not in spot or spot[name] == WHEEL.centre
        elif name in spot:
            assert math.dist(spot[name], WHEEL.centre) == pytest.approx(140.0 * word.activation / 7.0)
            if word.angle is not None:
                assert WHEEL.point(spot[name])[0] == pytest.approx(word.angle)
        else:  # another word of the same meaning is there
            twin = next(place for place in places().values() if place.word == word.category)
            assert (twin.angle, twin.activation) == (word.angle, word.activation)
    assert {name for name, place in places().items() if place.is_archetype} == {str(a) for a in api.Archetype}
    assert len({(round(x, 3), round(y, 3)) for x, y in spot.values()}) == len(spot)


def test_every_word_can_be_pointed_at() -> None:
    for name, spot in spots(WHEEL).items():
        assert nearest_word(WHEEL, spot, 5.0) == name


def test_a_word_far_away_is_not_meant() -> None:
    assert nearest_word(WHEEL, WHEEL.pixel(20.0, 5.0), 6.0) is None
    assert nearest_word(WHEEL, WHEEL.pixel(102.3, 4.2), 6.0) == "guilty"
    assert nearest_word(WHEEL, WHEEL.pixel(96.0, 4.0), 6.0) is None
    assert nearest_word(WHEEL, WHEEL.pixel(250.0, 0.5), 6.0) == CENTRE


def test_directions_are_told_by_their_neighbours() -> None:
    assert between(90.0) == "between fear and sadness"
    assert between(20.0) == "between joy and fear"
    assert between(181.3) == "disgust"


@pytest.mark.parametrize("radius", [60.0, 90.0, 140.0, 280.0])
def test_labels_cover_nothing_and_stay_in_the_wheel(radius: float) -> None:
    wheel = Wheel((500.0, 500.0), radius)
    written = labels(wheel, size=size, gap=6.0, rim=14.0)
    for (_, one), (_, other) in itertools.combinations(written.items(), 2):
        assert not one.overlaps(other)
    for name, box in written.items():
        assert all(not box.contains(spot) for word, spot in spots(wheel).items() if word != name)
        assert math.dist((box.left, box.low), wheel.centre) <= radius + 14.0
        assert math.dist((box.right, box.high), wheel.centre) <= radius + 14.0


def test_a_larger_wheel_has_more_labels_and_the_archetypes_always() -> None:
    archetypes = {str(a) for a in api.Archetype}
    small, large = (
        labels(Wheel((500.0, 500.0), radius), size=size, gap=6.0, rim=14.0, always=archetypes)
        for radius in (50.0, 300.0)
    )
    assert archetypes <= set(small) < set(large)
    assert not any(one.overlaps(other) for one, other in itertools.combinations(small.values(), 2))
    assert len(large) >= 0.9 * len(places())


def test_labels_keep_off_what_they_are_told_to_avoid() -> None:
    box = labels(WHEEL, size=size, gap=6.0, rim=14.0)["guilty"]
    written = labels(WHEEL, size=size, gap=6.0, rim=14.0, avoid=[box])
    assert not any(other.overlaps(box) for other in written.values())


@pytest.mark.parametrize("corner", list(Corner))
def test_the_wheel_lies_in_its_corner_clear_of_what_covers_the_viewport(corner: Corner) -> None:
    covers = [Box(950.0, 0.0, 1200.0, 800.0), Box(0.0, 0.0, 50.0, 800.0), Box(0.0, 760.0, 1200.0, 800.0)]
    free = free_box(1200.0, 800.0, covers)
    assert (free.left, free.low, free.right, free.high) == (50.0, 0.0, 950.0, 760.0)
    wheel = placed(free, corner, radius=140.0, margin=20.0, foot=40.0)
    assert wheel is not None
    assert wheel.radius == 140.0
    x, y = wheel.centre
    assert x in (50.0 + 160.0, 950.0 - 160.0)
    assert (x < 500.0) == corner.value.endswith("LEFT")
    assert (y < 380.0) == corner.value.startswith("BOTTOM")
    assert y - 140.0 - 40.0 >= free.low
    assert y + 140.0 <= free.high


def test_a_wheel_at_the_pointer_has_its_point_there_and_stays_to_be_seen() -> None:
    free = Box(50.0, 0.0, 950.0, 760.0)
    wheel = under(free, (500.0, 400.0), 90.0, 3.5, radius=140.0, margin=20.0)
    assert wheel.pixel(90.0, 3.5) == pytest.approx((500.0, 400.0))
    for pixel in ((55.0, 5.0), (945.0, 755.0)):
        x, y = under(free, pixel, 90.0, 3.5, radius=140.0, margin=20.0).centre
        assert free.left + 160.0 <= x <= free.right - 160.0
        assert free.low + 160.0 <= y <= free.high - 160.0


def test_a_small_viewport_has_a_small_wheel_and_a_tiny_one_none() -> None:
    small = placed(Box(0.0, 0.0, 300.0, 250.0), Corner.BOTTOM_LEFT, radius=140.0, margin=20.0, foot=40.0)
    assert small is not None
    assert SMALLEST_RADIUS <= small.radius < 100.0
    assert placed(Box(0.0, 0.0, 100.0, 120.0), Corner.BOTTOM_LEFT, radius=140.0, margin=20.0, foot=40.0) is None
    assert placed(Box(0.0, 0.0, -5.0, 120.0), Corner.BOTTOM_LEFT, radius=140.0, margin=20.0, foot=40.0) is None
