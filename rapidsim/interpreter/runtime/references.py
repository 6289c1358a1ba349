"""References that are not whole variables: array elements, record components, and absent ones.

A routine reads and writes the `value` of a reference without knowing its kind. An array
needs no reference object: the list is the reference.
"""

from __future__ import annotations

from typing import Any, NoReturn

from rapidsim.language.error_numbers import ERR_NOTPRES, rapid_error
from rapidsim.language.reference import Reference

_new = tuple.__new__


def not_present(name: str) -> NoReturn:
    """Raise the error for reading an absent optional parameter."""
    raise rapid_error(ERR_NOTPRES, f"the optional argument {name} is used but was not given")


class Absent:
    """The value of an absent optional parameter; every use of it is an error."""

    __slots__ = ()

    @property
    def value(self) -> NoReturn:
        """Raise the error for reading it."""
        not_present("of this routine")

    @value.setter
    def value(self, value: object) -> None:
        not_present("of this routine")

    def __getitem__(self, index: object) -> NoReturn:
        """Raise the error for using it as an array."""
        not_present("of this routine")

    def __setitem__(self, index: object, value: object) -> None:
        """Raise the error for writing to it as an array."""
        not_present("of this routine")

    def __len__(self) -> int:
        """Raise the error for reading its size."""
        not_present("of this routine")

    def __repr__(self) -> str:
        """For debuggers."""
        return "ABSENT"


ABSENT = Absent()


def position_of(name: str) -> str:
    """Name of the Python variable with an element's index, next to the one with its array."""
    return f"_{name}_at"


class Element:
    """An element of an array, with the index checked when the reference is created."""

    __slots__ = ("_array", "_index")

    def __init__(self, array: list[Any], index: int) -> None:
        """Refer to `array[index]`, counted from 0."""
        self._array = array
        self._index = index

    @property
    def value(self) -> Any:
        """The element."""
        return self._array[self._index]

    @value.setter
    def value(self, value: object) -> None:
        self._array[self._index] = value


class ComponentReference:
    """A component of a record that is itself behind a reference."""

    __slots__ = ("_path", "_record")

    def __init__(self, record: Reference[Any], path: tuple[int, ...]) -> None:
        """Refer to a component by indices, counted from 0, one per nesting level."""
        self._record = record
        self._path = path

    @property
    def value(self) -> Any:
        """The component."""
        value = self._record.value
        for position in self._path:
            value = value[position]
        return value

    @value.setter
    def value(self, value: object) -> None:
        self._record.value = with_component(self._record.value, self._path, value)


def with_component(record: Any, path: tuple[int, ...], value: object) -> Any:
    """Return the record with one component, at any depth, replaced."""
    position = path[0]
    if len(path) > 1:
        value = with_component(record[position], path[1:], value)
    return _new(type(record), (*record[:position], value, *record[position + 1 :]))
