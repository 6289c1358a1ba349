"""Expressions of a given type, and arguments, from what the program and RAPID offer."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from fuzzing.dice import Dice
from fuzzing.scope import READABLE, WRITABLE, Scope, UserRoutine
from fuzzing.values import INFINITE, NOT_A_NUMBER, TOO_LARGE, literal
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import ArrayOf, Atomic, Kind, Record, Type, resolved, same
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.table import LibraryRoutine, Parameter

PLACED = ("present", "startmoveretry")
"""What stands only in certain places: where a routine has an optional parameter, in a handler."""
PLAIN_TYPES = ("num", "num", "num", "string", "bool", "pos", "robtarget", "dnum", "orient", "pose")
SIGNALS = {of.name: f"{of.name.removeprefix('signal')}1" for of in types.SIGNALS}
_ARRAY = "ArrPar"
"""The parameter of Dim."""
DEPTH = 3
WRONG = 0.05
"""How often an odd argument is one of a wrong kind."""
_USUALLY_GIVEN = ("maxtime", "time", "pollrate", "num")
"""Options without which most calls would wait for ever."""


@cache
def functions() -> dict[str, tuple[LibraryRoutine, ...]]:
    """The simulated functions by the name of the type they give."""
    found: dict[str, list[LibraryRoutine]] = defaultdict(list)
    for key, row in ROUTINES.items():
        if row.simulated and key not in PLACED and row.signature.result is not None:
            found[resolved(row.signature.result).name].append(row)
    return {name: tuple(rows) for name, rows in found.items()}


@cache
def instructions() -> tuple[LibraryRoutine, ...]:
    """The simulated instructions."""
    return tuple(
        row
        for key, row in ROUTINES.items()
        if row.simulated and key not in PLACED and row.signature.result is None
    )


@cache
def _predefined(type_name: str, storage: str) -> tuple[str, ...]:
    """Names of predefined data of a type."""
    storages = {(True, False): "CONST", (False, True): "PERS", (False, False): "VAR"}
    return tuple(
        d.name
        for d in DATA.values()
        if d.type.name == type_name and storages[d.constant, d.persistent] == storage
    )


@dataclass
class Expressions:
    """Writes expressions with the data and the routines of a scope."""

    dice: Dice
    scope: Scope

    def value(self, of: Type, depth: int = DEPTH) -> str:
        """An expression of a type."""
        match resolved(of):
            case ArrayOf():
                return self.place(of, READABLE)
            case Atomic(kind=kind) if kind is not Kind.VALUE:
                return self.place(of, ("VAR",))
            case _:
                pass
        weights: dict[Callable[[Type, int], str], float] = {self._literal: 3, self._read: 4}
        if depth:
            weights[self._called] = 2
            weights[self._combined] = 3
        return self.dice.weighed(weights)(of, depth - 1)

    def place(self, of: Type, storages: tuple[str, ...]) -> str:
        """Data of a type that may be passed by reference; declared if need be."""
        if of.name in SIGNALS and not self.dice.odd():
            return SIGNALS[of.name]
        if isinstance(resolved(of), ArrayOf):
            return self._array(of, "PERS" if storages == ("PERS",) else "VAR")
        given = [name for storage in storages for name in _predefined(of.name, storage)]
        if given and "VAR" not in storages and self.dice.chance(0.7):
            return self.dice.of(given)
        found = self.scope.paths(of, storages)
        if found and self.dice.chance(0.8):
            return self.dice.of(found)
        storage = self.dice.of([s for s in storages if s in ("VAR", "PERS", "CONST")])
        return self.scope.declare(of, storage).name

    def _array(self, of: Type, storage: str) -> str:
        wanted = resolved(of)
        assert isinstance(wanted, ArrayOf)
        fitting = [
            datum.name
            for datum in (*self.scope.data, *self.scope.local)
            if isinstance(has := resolved(datum.type), ArrayOf)
            and datum.storage == storage
            and same(has.element, wanted.element)
            and len(has.dimensions) == len(wanted.dimensions)
        ]
        if fitting and self.dice.chance(0.6):
            return self.dice.of(fitting)
        return self.scope.declare(of, storage).name

    def arguments(self, parameters: tuple[Parameter, ...], depth: int = 2) -> str:
        """Arguments for a routine of the library, as they stand behind its name."""
        which = self.dice.random()
        groups: dict[int, Parameter] = {}
        for p in parameters:
            if p.group and self.dice.chance(0.5):
                groups.setdefault(p.group, p)
        for p in parameters:
            if p.group and self.dice.chance(0.6):
                groups.setdefault(p.group, p)
        text = ""
        for p in parameters:
            if p.optional:
                usual = 0.85 if p.name.lower() in _USUALLY_GIVEN else 0.2
                if groups.get(p.group) is not p if p.group else not self.dice.chance(usual):
                    continue
                value = "" if p.is_switch else f":={self._argument(p, which, depth)}"
                text += f" \\{p.name}{value}"
                continue
            text += f"{',' if text else ''} {self._argument(p, which, depth)}"
        return text

    def _argument(self, parameter: Parameter, which: float, depth: int) -> str:
        of = parameter.types[int(which * len(parameter.types))]
        if parameter.name == _ARRAY:
            return self.place(ArrayOf(self.dice.of((types.NUM, types.STRING)), (None,)), READABLE)
        if of == types.ANYTYPE:
            signal = "signal" in parameter.name.lower()
            of = self.dice.of(types.SIGNALS) if signal else TYPES[self.dice.of(PLAIN_TYPES)]
            if parameter.mode is ParameterMode.IN:
                return self._read(of, depth)
        if self.dice.chance(self.dice.oddness * WRONG):
            return self._of_wrong_kind()
        match parameter.mode:
            case ParameterMode.VAR:
                return self.place(of, ("VAR",))
            case ParameterMode.INOUT:
                return self.place(of, WRITABLE)
            case ParameterMode.PERS:
                return self.place(of, ("PERS",))
            case ParameterMode.REF:
                return self.place(of, READABLE)
            case ParameterMode.IN:
                plain = of in (types.NUM, types.STRING)
                usual = () if plain else _predefined(of.name, "CONST")
                if usual and not self.dice.odd() and self.dice.chance(0.7):
                    return self.dice.of(usual)
                return self.value(of, depth)

    def _of_wrong_kind(self) -> str:
        """What the checker should refuse, or the run has to live with."""
        signals = ArrayOf(self.dice.of(types.SIGNALS), (2,))
        wrong: tuple[Type, ...] = (signals, types.CLOCK, *map(TYPES.__getitem__, PLAIN_TYPES))
        return self.scope.declare(self.dice.of(wrong), "VAR").name

    def called_with(self, routine: UserRoutine) -> str:
        """Arguments for a routine of the program."""
        parts: list[str] = []
        for p in routine.parameters:
            if p.optional and self.dice.chance(0.5):
                continue
            if same(p.type, types.SWITCH):
                parts.append(f"\\{p.name}")
                continue
            storages = {"VAR": ("VAR",), "PERS": ("PERS",), "INOUT": WRITABLE}.get(p.mode)
            given = self.place(p.type, storages) if storages else self.value(p.type, 1)
            parts.append(f"\\{p.name}:={given}" if p.optional else f"{',' if parts else ''}{given}")
        return " ".join(parts)

    def _literal(self, of: Type, depth: int) -> str:
        if same(of, types.NUM) and self.dice.odd():
            return self.dice.of((TOO_LARGE, INFINITE, f"(-{INFINITE})", NOT_A_NUMBER, "(-0)"))
        record = resolved(of)
        if isinstance(record, Record) and depth > 0 and self.dice.chance(0.3):
            return f"[{','.join(self.value(part.type, 0) for part in record.components)}]"
        return literal(of, self.dice)

    def _read(self, of: Type, depth: int) -> str:
        if same(of, types.NUM) and self.dice.chance(0.1):
            return self.dice.of(tuple(SIGNALS.values()))
        return self.place(of, READABLE)

    def _called(self, of: Type, depth: int) -> str:
        own = [r for r in self.scope.routines if r.result is not None and same(r.result, of)]
        if own and self.dice.chance(0.3):
            routine = self.dice.of(own)
            return f"{routine.name}({self.called_with(routine)})"
        rows = functions().get(resolved(of).name, ())
        return self.function(self.dice.of(rows), depth) if rows else self._read(of, depth)

    def function(self, row: LibraryRoutine, depth: int = 2) -> str:
        """A call of a function of the library."""
        return f"{row.name}({self.arguments(row.signature.parameters, depth).strip()})"

    def _combined(self, of: Type, depth: int) -> str:

        def value(part: Type) -> str:
            """An operand; an aggregate would not say what type it has."""
            plain = isinstance(resolved(part), Atomic)
            return self.value(part, depth) if plain else self._read(part, depth)

        match resolved(of).name:
            case "num" | "dnum":
                sign = self.dice.of(("+", "-", "*", "/", "DIV", "MOD", "+", "-", "*"))
                return f"({value(of)} {sign} {value(of)})"
            case "bool":
                part = TYPES[self.dice.of(("num", "string", "bool", "pos", "dnum"))]
                if self.dice.chance(0.4):
                    sign = self.dice.of(("AND", "OR", "XOR"))
                    return f"({value(of)} {sign} {self.dice.of(('', 'NOT '))}{value(of)})"
                ordered = part.name in ("num", "dnum")
                sign = self.dice.of(("<", "<=", ">", ">=", "=", "<>") if ordered else ("=", "<>"))
                return f"({value(part)} {sign} {value(part)})"
            case "string":
                return f"({value(of)} + {value(of)})"
            case "pos":
                if self.dice.chance(0.3):
                    return f"({value(types.NUM)} * {value(of)})"
                return f"({value(of)} {self.dice.of('+-*')} {value(of)})"
            case "orient":
                return f"({value(of)} * {value(of)})"
            case _:
                return self._called(of, depth)
