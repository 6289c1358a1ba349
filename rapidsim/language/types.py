"""RAPID's types and their assignability.

Types are equal by name once aliases are resolved; `num` and `dnum` never convert implicitly.
Names compare without case: a table of types is keyed by the folded name.

Source: Technical reference manual RAPID Kernel, "Data types"; RAPID Overview, "Data".
"""

from __future__ import annotations

from dataclasses import field
from enum import Enum
from typing import TypeAlias

from rapidsim.values import value_class


class Kind(Enum):
    """Operations that data of a type allow."""

    VALUE = "value"
    """Assigned, compared, passed by value."""
    SEMI_VALUE = "semi-value"
    """Read like its value, never assigned: input signals."""
    NON_VALUE = "non-value"
    """Only passed by reference: clocks, devices."""
    UNKNOWN = "unknown"
    """The type is undeclared, so it may be anything."""


@value_class(frozen=True, slots=True)
class Atomic:
    """A type without components."""

    name: str
    kind: Kind = Kind.VALUE
    reads_as: str | None = None
    """For a semi-value type, the name of the type its value has."""

    def __hash__(self) -> int:
        """By its name, as types are equal by name."""
        return hash(self.name)


@value_class(frozen=True, slots=True)
class Component:
    """One named component of a record."""

    name: str
    type: Type


@value_class(frozen=True, slots=True)
class Record:
    """A type of ordered, named components; its values are instances of `python`."""

    name: str
    components: tuple[Component, ...]
    python: type[tuple[object, ...]] = field(compare=False)
    """Each task has its own class for a record of the user; the type is the same."""

    def __hash__(self) -> int:
        """By its name, without its components."""
        return hash(self.name)


@value_class(frozen=True, slots=True)
class Alias:
    """Another name for a type."""

    name: str
    of: Atomic | Record

    def __hash__(self) -> int:
        """By its name, without the type that it names."""
        return hash(self.name)


@value_class(frozen=True, slots=True)
class ArrayOf:
    """An array of one to three dimensions; None is a dimension taken from the argument."""

    element: Atomic | Record | Alias
    dimensions: tuple[int | None, ...]

    @property
    def name(self) -> str:
        """Name in RAPID syntax: `num{3}`, `robtarget{*}`."""
        sizes = ",".join("*" if d is None else str(d) for d in self.dimensions)
        return f"{self.element.name}{{{sizes}}}"


Type: TypeAlias = Atomic | Record | Alias | ArrayOf

NUM = Atomic("num")
DNUM = Atomic("dnum")
BOOL = Atomic("bool")
STRING = Atomic("string")
SWITCH = Atomic("switch")
ANYTYPE = Atomic("anytype")
"""Parameter type of installed routines that take data of any type."""


RAWBYTES = Atomic("rawbytes", Kind.NON_VALUE)
CLOCK = Atomic("clock", Kind.NON_VALUE)
IODEV = Atomic("iodev", Kind.NON_VALUE)
SIGNAL_DI = Atomic("signaldi", Kind.SEMI_VALUE, "num")
SIGNAL_DO = Atomic("signaldo", Kind.SEMI_VALUE, "num")
SIGNAL_AI = Atomic("signalai", Kind.SEMI_VALUE, "num")
SIGNAL_AO = Atomic("signalao", Kind.SEMI_VALUE, "num")
SIGNAL_GI = Atomic("signalgi", Kind.SEMI_VALUE, "num")
SIGNAL_GO = Atomic("signalgo", Kind.SEMI_VALUE, "num")
SIGNALS = (SIGNAL_DI, SIGNAL_DO, SIGNAL_AI, SIGNAL_AO, SIGNAL_GI, SIGNAL_GO)

OPAQUE = tuple(
    Atomic(name, Kind.NON_VALUE)
    for name in (
        *("cameradev", "corrdescr", "datapos", "dir", "egmident", "loadsession", "mecunit"),
        *("pathrecid", "rmqmessage", "rmqslot", "shapedata", "socketdev"),
        *("syncident", "taskid", "trapdata", "triggdata"),
    )
)
"""Types whose content is used only by routines that are not simulated."""


def resolved(of: Type) -> Atomic | Record | ArrayOf:
    """The type of an alias; arrays of an alias become arrays of its type."""
    match of:
        case Alias(of=base):
            return base
        case ArrayOf(element=Alias(of=base), dimensions=dimensions):
            return ArrayOf(base, dimensions)
        case _:
            return of


def spelling(of: Type) -> str:
    """The notation of a type for people: `robtarget`, `num{3,*}`, `width, ALIAS of num`."""
    return f"{of.name}, ALIAS of {of.of.name}" if isinstance(of, Alias) else of.name


def same(a: Type, b: Type) -> bool:
    """Whether two types are one type once aliases are resolved."""
    return resolved(a) == resolved(b)
