"""Initial values of data without an initializer: zero, FALSE, "", component by component."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.language import types
from rapidsim.language.data import ClockState, Signal
from rapidsim.language.types import Alias, ArrayOf, Atomic, Record, Type

_ATOMS: dict[str, object] = {
    "num": 0.0,
    "dnum": 0.0,
    "bool": False,
    "switch": False,
    "string": "",
    "rawbytes": b"",
    "clock": ClockState(),
    **{signal.name: Signal("") for signal in types.SIGNALS},
}


def initial_value(of: Type) -> object:
    """Value of data of a type that were declared without one.

    Records are tuples; arrays are new nested lists, whose immutable elements share one value.
    Opaque types start as None, as does a device that is not open.

    Raises:
        ValueError: If an array has an open dimension; only parameters have those.
    """
    match of:
        case Atomic(name=name):
            return _ATOMS.get(name)
        case Alias(of=base):
            return initial_value(base)
        case Record(components=components, python=python):
            return tuple.__new__(python, [initial_value(part.type) for part in components])
        case ArrayOf(element=element, dimensions=dimensions):
            sizes = [size for size in dimensions if size is not None]
            if len(sizes) < len(dimensions):
                raise ValueError(f"an array of type {of.name} has no size of its own")
            return _rows(sizes, initial_value(element))
        case _:
            raise ValueError(f"{of} is not a type of data")


def _rows(sizes: Sequence[int], element: object) -> list[object]:
    size, *inner = sizes
    return [_rows(inner, element) for _ in range(size)] if inner else [element] * size
