"""Values derived from a path or its timing, computed when they are needed.

They are stored like those of a `cached_property`, but of the large ones, which long paths have, the
most recent alone: a run of a million moves stores what its paths consist of, and not also what only
their planning needs.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sized
from typing import Any, Final, Generic, TypeVar, overload
from weakref import ref

import numpy as np

_LARGE = 1024
"""Number of elements from which on a value is large."""
_MOST = 32
"""Maximum number of large values that are stored."""

Value = TypeVar("Value")
_stored: Final[deque[tuple[ref[object], str]]] = deque()
"""Owner and name of each large value, the oldest first."""


class derived_value(Generic[Value]):  # noqa: N801 - a decorator, as `property` is
    """Property of an immutable object that is computed once, and again if it has been dropped."""

    def __init__(self, compute: Callable[[Any], Value]) -> None:
        """Compute the value by a function of the object."""
        self._compute, self.__doc__ = compute, compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        """Store values in the objects under the name of the property, which is found first."""
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> derived_value[Value]: ...
    @overload
    def __get__(self, instance: object, owner: type) -> Value: ...

    def __get__(self, instance: object | None, owner: type) -> Value | derived_value[Value]:
        """Compute and store the value, which is not stored."""
        if instance is None:
            return self
        value = vars(instance)[self._name] = self._compute(instance)
        size = value.size if isinstance(value, np.ndarray) else _length(value)
        if size >= _LARGE:
            _stored.append((ref(instance), self._name))
            if len(_stored) > _MOST:
                _drop(*_stored.popleft())
        return value


def _length(value: object) -> int:
    return len(value) if isinstance(value, Sized) else 0


def _drop(owner: ref[object], name: str) -> None:
    instance = owner()
    if instance is not None:
        vars(instance).pop(name, None)
