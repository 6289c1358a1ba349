"""Immutable values that are quick to define.

`dataclasses` compiles the source of six functions for each frozen class, and two hundred classes
are defined before the first line of a program is read: that took a third of the check of a small
file. Here only the constructor is compiled; the other methods of a frozen dataclass are written
once, below.
"""

from __future__ import annotations

import dataclasses
from operator import attrgetter
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any

__all__ = ["value_class"]

if TYPE_CHECKING:
    from collections.abc import Callable
    from dataclasses import dataclass as value_class
else:

    def value_class(*, frozen=False, slots=False, eq=True, repr=True, **others):
        """Replace `dataclasses.dataclass`; frozen classes with slots are defined quickly."""
        if others or not (frozen and slots):
            return dataclasses.dataclass(frozen=frozen, slots=slots, eq=eq, repr=repr, **others)
        return lambda cls: _value_class(cls, eq=eq, repr=repr)


def _value_class(cls: type[Any], *, eq: bool, repr: bool) -> type[Any]:
    """Return the class with slots and the methods of a frozen dataclass that it does not define."""
    own = vars(cls)
    made: Any = dataclasses.dataclass(init=False, eq=False, repr=False, slots=True)(cls)
    fields = dataclasses.fields(made)
    methods: dict[str, Any] = {
        "__getstate__": _state,
        "__setstate__": _take_state,
        "__init__": _constructor(made, fields),
        **_refusals(made, frozenset(field.name for field in fields)),
    }
    if repr:
        methods["__repr__"] = _as_text
    if eq:
        methods |= _comparison(tuple(field.name for field in fields if field.compare))
    for name, method in methods.items():
        # Python sets the hash of a class that defines `__eq__` to None.
        if own.get(name) is None:
            setattr(made, name, method)
    return made  # type: ignore[no-any-return]


class _Made:
    """Placeholder for a default that a factory creates for each value."""

    def __repr__(self) -> str:
        """Text that `dataclasses` shows in a signature."""
        return "<factory>"


_MADE = _Made()


def _constructor(cls: Any, fields: tuple[dataclasses.Field[Any], ...]) -> Callable[..., None]:
    """Build the `__init__`, which stores through the slots because these permit assignment."""
    known: dict[str, Any] = {"_MADE": _MADE}
    parameters, body = ["self"], []
    for number, field in enumerate(fields):
        known[f"_store{number}"] = vars(_definer(cls, field.name))[field.name].__set__
        value = field.name
        if field.default_factory is not dataclasses.MISSING:
            known[f"_make{number}"] = field.default_factory
            made_now = f"_make{number}()"
            value = f"{made_now} if {value} is _MADE else {value}" if field.init else made_now
            default: Any = _MADE
        else:
            default = field.default
        if field.init:
            has_default = default is not dataclasses.MISSING
            known[f"_default{number}"] = default
            parameters.append(f"{field.name}=_default{number}" if has_default else field.name)
        elif default is dataclasses.MISSING:
            continue
        elif default is not _MADE:
            known[f"_default{number}"] = default
            value = f"_default{number}"
        body.append(f" _store{number}(self, {value})")
    if hasattr(cls, "__post_init__"):
        body.append(" self.__post_init__()")
    text = f"def __init__({', '.join(parameters)}):\n" + "\n".join(body or [" pass"])
    exec(text, known)
    constructor: Callable[..., None] = known["__init__"]
    constructor.__qualname__ = f"{cls.__qualname__}.__init__"
    constructor.__module__ = cls.__module__
    types = {field.name: field.type for field in fields if field.init}
    constructor.__annotations__ = {**types, "return": None}
    return constructor


def _definer(cls: type[Any], name: str) -> type[Any]:
    """Return the class that has the slot of a field."""
    return next(one for one in cls.__mro__ if name in vars(one))


def _refusals(cls: type[Any], names: frozenset[str]) -> dict[str, Callable[..., None]]:
    def __setattr__(self: object, name: str, value: object) -> None:  # noqa: N807
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: object, name: str) -> None:  # noqa: N807
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}


def _comparison(names: tuple[str, ...]) -> dict[str, Callable[..., Any]]:
    facts = attrgetter(*names) if len(names) > 1 else _few(names)

    def __eq__(self: object, other: object) -> bool:  # noqa: N807
        if self is other:
            return True
        if type(other) is not type(self):
            return NotImplemented
        return bool(facts(self) == facts(other))

    def __hash__(self: object) -> int:  # noqa: N807
        return hash(facts(self))

    return {"__eq__": __eq__, "__hash__": __hash__}


def _few(names: tuple[str, ...]) -> Callable[[object], tuple[object, ...]]:
    """Variant of `attrgetter` that returns a tuple for any number of names."""
    return lambda of: tuple(getattr(of, name) for name in names)


@recursive_repr("...")
def _as_text(self: Any) -> str:
    shown = (field.name for field in dataclasses.fields(self) if field.repr)
    facts = ", ".join(f"{name}={getattr(self, name)!r}" for name in shown)
    return f"{type(self).__qualname__}({facts})"


def _state(self: Any) -> list[object]:
    return [getattr(self, field.name) for field in dataclasses.fields(self)]


def _take_state(self: Any, state: list[object]) -> None:
    for field, value in zip(dataclasses.fields(self), state, strict=True):
        object.__setattr__(self, field.name, value)
