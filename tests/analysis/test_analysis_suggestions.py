"""Which known name is suggested."""

from rapidsim.analysis.suggestions import closest


def test_the_nearest_is_suggested_and_the_first_of_equals() -> None:
    assert closest("coutn", ["Contour", "count", "court"]) == "count"
    assert closest("part1", ["part2", "part3"]) == "part2"
    assert closest("entirely", ["different"]) is None
