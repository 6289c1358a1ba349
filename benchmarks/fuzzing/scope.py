"""What a program has declared so far, and declarations made when somebody asks for data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from fuzzing.dice import Dice
from fuzzing.values import literal, places, sizes
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Atomic, Kind, Record, Type, resolved, same

PREFIX = "zq_"
"""All names that a generated program makes begin with this, so that they can be renamed."""
WRITABLE = ("VAR", "PERS")
READABLE = ("VAR", "PERS", "CONST", "IN")


@dataclass(frozen=True)
class Datum:
    """Something that holds a value; storage IN is a parameter, or the variable of a loop."""

    name: str
    type: Type
    storage: str
    declaration: str = ""


@dataclass(frozen=True)
class UserParameter:
    """A parameter of a routine of the program."""

    name: str
    type: Type
    mode: str = ""
    optional: bool = False

    @property
    def header(self) -> str:
        """As the header of the routine writes it."""
        of = resolved(self.type)
        stars = f"{{{','.join('*' for _ in of.dimensions)}}}" if isinstance(of, ArrayOf) else ""
        element = of.element if isinstance(of, ArrayOf) else self.type
        mode = f"{self.mode} " if self.mode else ""
        return f"{chr(92) if self.optional else ''}{mode}{element.name} {self.name}{stars}"


@dataclass(frozen=True)
class UserRoutine:
    """A routine of the program that later ones may call."""

    name: str
    parameters: tuple[UserParameter, ...] = ()
    result: Type | None = None


@dataclass
class Scope:
    """The names of one task."""

    dice: Dice
    task: str = ""
    data: list[Datum] = field(default_factory=list)
    local: list[Datum] = field(default_factory=list)
    records: list[Record] = field(default_factory=list)
    routines: list[UserRoutine] = field(default_factory=list)
    traps: list[str] = field(default_factory=list)
    made: int = 0

    def name(self, kind: str) -> str:
        """A name that nothing has yet."""
        self.made += 1
        return f"{PREFIX}{kind}{self.task}{self.made}"

    def paths(self, of: Type, storages: tuple[str, ...]) -> list[str]:
        """All that holds a value of a type: data, elements, components."""
        return [
            path
            for datum in (*self.data, *self.local)
            if datum.storage in storages
            for path in _paths(datum.name, datum.type, of, 2)
        ]

    def arrays(self, of: Type) -> list[Datum]:
        """The arrays, of a type of element or of any."""
        return [d for d in (*self.data, *self.local) if isinstance(resolved(d.type), ArrayOf)]

    def declare(self, of: Type, storage: str) -> Datum:
        """New data, of the routine that is being written or of its module."""
        match resolved(of):
            case ArrayOf(element=element, dimensions=dimensions):
                drawn = sizes(self.dice, len(dimensions))
                known = tuple(d or n for d, n in zip(dimensions, drawn, strict=True))
                of = ArrayOf(element, known)
            case Atomic(kind=kind) if kind is not Kind.VALUE:
                storage = "VAR"
            case _:
                pass
        inside = storage == "VAR" and not same(of, types.NUM) and self.dice.chance(0.2)
        datum = Datum(self.name(_letter(of)), of, storage)
        datum = replace(datum, declaration=self._declaration(datum))
        (self.local if inside and _has_value(of) else self.data).append(datum)
        return datum

    def _declaration(self, datum: Datum) -> str:
        of = resolved(datum.type)
        element = of.element if isinstance(of, ArrayOf) else datum.type
        stars = f"{{{','.join(map(str, of.dimensions))}}}" if isinstance(of, ArrayOf) else ""
        wants_value = datum.storage != "VAR" or self.dice.chance(0.5)
        value = f":={literal(of, self.dice)}" if wants_value and _has_value(of) else ""
        return f"{datum.storage} {element.name} {datum.name}{stars}{value};"


def _has_value(of: Type) -> bool:
    match resolved(of):
        case ArrayOf(element=element):
            return _has_value(element)
        case Atomic(kind=kind):
            return kind is Kind.VALUE
        case _:
            return True


def _letter(of: Type) -> str:
    element = of.element if isinstance(of, ArrayOf) else of
    return element.name.removeprefix(PREFIX)[:6].lower() + ("s" if isinstance(of, ArrayOf) else "")


def _paths(path: str, has: Type, wanted: Type, depth: int) -> Iterator[str]:
    if same(has, wanted):
        yield path
        return
    if not depth:
        return
    match resolved(has):
        case ArrayOf(element=element, dimensions=dimensions) as array if None not in dimensions:
            for place in places(array)[:3]:
                yield from _paths(path + place, element, wanted, depth - 1)
        case Record(components=components):
            for part in components:
                yield from _paths(f"{path}.{part.name}", part.type, wanted, depth - 1)
        case _:
            pass
