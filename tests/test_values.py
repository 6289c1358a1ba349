"""The quick frozen classes of `rapidsim.values` do what those of `dataclasses` do."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import math
import pickle
from collections.abc import Callable
from dataclasses import field, fields, replace
from typing import Any

import pytest

from rapidsim import values


def _classes(dataclass: Callable[..., Any]) -> tuple[type[Any], ...]:
    """The same classes, made by one way or the other."""

    @dataclass(frozen=True, slots=True)
    class Base:
        a: int
        b: float = 2.0

    @dataclass(frozen=True, slots=True)
    class Derived(Base):
        c: list[int] = field(default_factory=list)
        d: str = field(default="d", compare=False, repr=False)
        e: float = field(init=False)
        f: int = field(init=False, default=6)

        def __post_init__(self) -> None:
            object.__setattr__(self, "e", self.a * self.b)

    @dataclass(frozen=True, slots=True, eq=False, repr=False)
    class Plain:
        a: object

        def __repr__(self) -> str:
            return f"<{self.a}>"

    @dataclass(frozen=True, slots=True)
    class Nothing:
        pass

    @dataclass(frozen=True, slots=True)
    class Own:
        a: float

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Own) and abs(self.a - other.a) < 1.0

        def __hash__(self) -> int:
            return 7

    return Base, Derived, Plain, Nothing, Own


QUICK = _classes(values.value_class)
STANDARD = _classes(dataclasses.dataclass)
VALUES: tuple[tuple[int, tuple[Any, ...], dict[str, Any]], ...] = (
    (0, (1,), {}),
    (0, (1, math.nan), {}),
    (0, (1,), {"b": 3.0}),
    (1, (1,), {}),
    (1, (1, 2.0, [3]), {"d": "else"}),
    (2, ("x",), {}),
    (3, (), {}),
    (4, (1.5,), {}),
    (0, (), {}),
    (0, (1, 2.0, 3), {}),
    (1, (1,), {"e": 1.0}),
    (1, (1,), {"g": 1.0}),
)


def _told(classes: tuple[type[Any], ...], which: int, given: tuple[Any, ...], named: Any) -> object:
    """All that can be seen of a value, without the names of places in memory."""
    kind = classes[which]
    try:
        value = kind(*given, **named)
    except TypeError as error:
        return str(error)
    seen: list[object] = [repr(value), [getattr(value, one.name) for one in fields(value)]]
    if math.nan not in given:
        # From Python 3.13 on, standard ones with the same NaN differ; ours are equal, as tuples.
        seen.append(value == kind(*given, **named))
        seen.append(value == replace(value) if kind is not classes[2] else None)
    seen.append(value != classes[0](0) and value != object())
    seen.append(_error(lambda: hash(value) * 0))
    for one in fields(value):
        seen.append(_error(lambda one=one: setattr(value, one.name, 2)))  # type: ignore[misc]
        seen.append(_error(lambda one=one: delattr(value, one.name)))  # type: ignore[misc]
    # Of other names Python 3.11 says something that is about its own inside.
    seen.append(_error(lambda: setattr(value, "new", 2)) is not None)
    seen.append([getattr(copy.copy(value), one.name) for one in fields(value)])
    seen.append((str(inspect.signature(kind)), kind.__match_args__, kind.__slots__))
    seen.append([(one.name, one.type, one.compare, one.repr, one.init) for one in fields(kind)])
    return seen


def _error(work: Callable[[], object]) -> object:
    try:
        return work()
    except (AttributeError, TypeError) as error:
        return type(error), str(error)


@pytest.mark.parametrize(("which", "given", "named"), VALUES)
def test_a_quick_class_is_a_frozen_dataclass(
    which: int, given: tuple[Any, ...], named: dict[str, Any]
) -> None:
    expected = _told(STANDARD, which, given, named)
    assert repr(_told(QUICK, which, given, named)) == repr(expected)


@values.value_class(frozen=True, slots=True)
class Kept:
    """Found by its name, as what goes to another process must be."""

    a: int
    b: tuple[int, ...] = ()


def test_it_can_be_sent_to_another_process() -> None:
    assert pickle.loads(pickle.dumps(Kept(1, (2, 3)))) == Kept(1, (2, 3))


def test_it_knows_itself_within_itself() -> None:
    kept: list[object] = []
    kept.append(Kept(1, kept))  # type: ignore[arg-type]
    assert repr(kept[0]) == "Kept(a=1, b=[...])"
