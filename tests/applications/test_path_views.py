"""Pictures of the paths of a comparison: what is drawn where its coordinates say."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.applications.diff.path_views import path_views

_VALUE = st.floats(-3000.0, 3000.0).map(lambda value: round(value, 1))
_POINT = st.tuples(_VALUE, _VALUE, _VALUE)
_TEXT = re.compile(r'<text x="([-\d.]+)" y="([-\d.]+)" text-anchor="(\w+)">([-\d.e+]+)</text>')


@given(st.lists(_POINT, min_size=1, max_size=6), st.lists(_POINT, max_size=6))
def test_both_paths_are_drawn_at_their_coordinates(
    before: list[tuple[float, float, float]], after: list[tuple[float, float, float]]
) -> None:
    views = path_views(before, after).split("<figure>")[1:]
    assert len(views) == 2
    for view, up in zip(views, (1, 2), strict=True):
        width, height = map(float, re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', view)[0])
        texts = _TEXT.findall(view)
        # Where a coordinate is written, its line is.
        across = {float(value): float(x) for x, _, anchor, value in texts if anchor == "middle"}
        upward = {float(value): float(y) - 4 for _, y, anchor, value in texts if anchor == "end"}
        lines = re.findall(r'<polyline class="(old|new)" points="([^"]*)"/>', view)
        assert [name for name, _ in lines] == ["old", "new"]
        for (_, places), path in zip(lines, (before, after), strict=True):
            drawn = [tuple(map(float, place.split(","))) for place in places.split()]
            assert len(drawn) == len(path)
            for (x, y), point in zip(drawn, path, strict=True):
                assert 0.0 <= x <= width
                assert 0.0 <= y <= height
                for coordinates, place, value in ((across, x, point[0]), (upward, y, point[up])):
                    if len(coordinates) > 1:
                        (one, at), (other, there) = list(coordinates.items())[:2]
                        scale = (there - at) / (other - one)
                        assert place == pytest.approx(at + scale * (value - one), abs=0.4)


def test_lines_are_at_round_coordinates_in_one_scale() -> None:
    page = path_views([(1000.0, -200.0, 50.0), (1330.0, 200.0, 50.0)], [])
    above, side = page.split("<figure>")[1:]
    values = [float(value) for *_, anchor, value in _TEXT.findall(above) if anchor == "middle"]
    assert values == [1000.0, 1100.0, 1200.0, 1300.0]
    places = [
        [float(x) for x, _, anchor, _ in _TEXT.findall(view) if anchor == "middle"]
        for view in (above, side)
    ]
    assert places[0] == places[1]
    steps = {round(after - before, 1) for before, after in pairwise(places[0])}
    assert max(steps) - min(steps) <= 0.11


def test_without_points_there_is_no_picture() -> None:
    assert path_views([], []) == ""
