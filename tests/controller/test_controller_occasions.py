"""When something outside a program happens: conditions on signals, occasions and their counts."""

from __future__ import annotations

import pytest

from rapidsim.controller.cell.conditions import ConditionError, read_condition
from rapidsim.controller.cell.due_occasions import DueOccasion, Occasions
from rapidsim.controller.cell.occasions import Occasion

LEVELS = {"a": 1.0, "b": 0.0, "g": 5.0}


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("a", True),
        ("b", False),
        ("not b", True),
        ("NOT a", False),
        ("g = 5", True),
        ("g <> 5", False),
        ("not g=5", False),
        ("g < 5", False),
        ("g <= 5", True),
        ("g > 5", False),
        ("g >= 5.", True),
        ("g > -1e1", True),
        ("g > .5", True),
        ("a and b", False),
        ("a AND not b", True),
        ("a and b and g", False),
        ("b or g = 5", True),
        ("b or g = 4", False),
        ("b or a or b", True),
        ("a and g = 5 and not b", True),
    ],
)
def test_a_condition_holds_for_the_values_of_its_signals(text: str, holds: bool) -> None:
    assert read_condition(text).holds(LEVELS.__getitem__) is holds


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a and b or g", "`a and b or g` joins with `and` and with `or`; use one of them"),
        ("", "`` is not a valid condition; expected e.g. "),
        ("a and", "`a and` is not a valid condition"),
        ("a =", "`a =` is not a valid condition"),
        ("1 = a", "`1 = a` is not a valid condition"),
        ("not", "`not` is not a valid condition"),
        ("a == 1", "`a == 1` is not a valid condition"),
    ],
)
def test_a_text_that_is_no_condition(text: str, message: str) -> None:
    with pytest.raises(ConditionError) as caught:
        read_condition(text)
    assert str(caught.value).startswith(message)


def test_a_condition_names_each_signal_once() -> None:
    assert read_condition("b and a and b = 1").signals() == ("b", "a")


def due(found: list[DueOccasion[Occasion]]) -> list[tuple[float, int]]:
    return [(one.time_s, one.occurrence) for one in found]


def followed(occasion: Occasion, count: int, start_s: float = 0.0) -> list[tuple[float, int]]:
    """Times and numbers at which an occasion of the clock acts."""
    found = list(Occasions([occasion]).begin(lambda _: 0.0, start_s))
    made = list[tuple[float, int]]()
    while found and len(made) < count:
        (one,) = found
        made.append((one.time_s, one.occurrence))
        after = one.following(one.time_s)
        found = [] if after is None else [after]
    return made


@pytest.mark.parametrize(
    ("occasion", "start_s", "times"),
    [
        (Occasion(at_s=2.0), 0.0, [(2.0, 1)]),
        (Occasion(at_s=2.0), 3.0, [(3.0, 1)]),
        (Occasion(), 3.0, [(3.0, 1)]),
        (Occasion(every_s=2.0), 0.0, [(2.0, 1), (4.0, 2), (6.0, 3), (8.0, 4)]),
        (Occasion(every_s=2.0), 1.0, [(3.0, 1), (5.0, 2), (7.0, 3), (9.0, 4)]),
        (Occasion(at_s=0.5, every_s=2.0), 0.0, [(0.5, 1), (2.5, 2), (4.5, 3), (6.5, 4)]),
        (Occasion(at_s=1.0, every_s=1.0, nth=(2, 5)), 0.0, [(2.0, 2), (5.0, 5)]),
        (Occasion(at_s=1.0, every_s=1.0, skip=(1, 2, 4)), 0.0, [(3.0, 3), (5.0, 5), (6.0, 6)]),
        (Occasion(at_s=1.0, nth=(1,)), 0.0, [(1.0, 1)]),
    ],
)
def test_the_clock_brings_an_occasion_at_its_times(
    occasion: Occasion, start_s: float, times: list[tuple[float, int]]
) -> None:
    made = followed(occasion, 4, start_s)
    assert made[: len(times)] == times
    assert len(made) == (4 if occasion.every_s and not occasion.nth else len(times))


def test_an_occurrence_that_never_acts_is_not_due() -> None:
    assert Occasion(nth=(2, 5)).first_that_acts(3) == 5
    assert Occasion(nth=(2, 5)).first_that_acts(6) is None
    assert Occasion(skip=(3, 4)).first_that_acts(3) == 5
    assert Occasion().first_that_acts(3) == 3
    when = read_condition("a")
    never = Occasions([Occasion(when=when, nth=(2,))])
    assert list(never.begin(lambda _: 1.0)) == []


def test_a_condition_acts_each_time_that_it_becomes_true() -> None:
    levels = {"a": 0.0, "b": 0.0}
    read = levels.__getitem__
    occasion = Occasion(when=read_condition("a and not b"), after_s=0.5, skip=(2,))
    occasions = Occasions([occasion, Occasion(when=read_condition("b"))])
    assert list(occasions.begin(read)) == []
    assert occasions.depends_on("A")
    assert not occasions.depends_on("c")

    def change(name: str, value: float, time_s: float) -> list[tuple[float, int]]:
        levels[name] = value
        return due(list(occasions.change(name.upper(), time_s, read)))

    assert change("a", 1.0, 1.0) == [(1.5, 1)]
    assert change("a", 2.0, 2.0) == []
    assert change("a", 0.0, 3.0) == []
    assert change("a", 1.0, 4.0) == []  # The second time is skipped.
    assert change("b", 1.0, 5.0) == [(5.0, 1)]
    assert change("b", 0.0, 6.0) == [(6.5, 3)]


def test_what_holds_at_the_start_acts_at_the_start() -> None:
    occasions = Occasions([Occasion(when=read_condition("a"), after_s=0.2)])
    assert due(list(occasions.begin(lambda _: 1.0, 3.0))) == [(3.2, 1)]
    assert due(list(occasions.change("a", 4.0, lambda _: 1.0))) == []


def test_what_is_added_is_removed_with_its_count() -> None:
    first = Occasion(when=read_condition("a"))
    occasions = Occasions([first])
    low, high = (lambda _: 0.0), (lambda _: 1.0)
    assert list(occasions.begin(low)) == []
    added = Occasion(when=read_condition("b"))
    assert due(list(occasions.add(added, high, 1.0))) == [(1.0, 1)]
    assert due(list(occasions.add(Occasion(), low, 2.0))) == [(2.0, 1)]
    assert occasions.depends_on("b")
    assert list(occasions.change("b", 3.0, low)) == []
    assert due(list(occasions.change("b", 4.0, high))) == [(4.0, 2)]
    assert due(list(occasions.change("a", 5.0, high))) == [(5.0, 1)]
    occasions.remove_added()
    assert not occasions.depends_on("b")
    assert list(occasions.change("b", 6.0, high)) == []
    assert list(occasions.change("a", 7.0, high)) == []
    assert due(list(occasions.add(added, high, 8.0))) == [(8.0, 1)]
