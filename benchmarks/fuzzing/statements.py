"""Statements of a routine, one block at a time; blocks are lines indented by what they stand in."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from fuzzing.dice import Dice
from fuzzing.expressions import PLAIN_TYPES, SIGNALS, Expressions, instructions
from fuzzing.scope import WRITABLE, Datum, Scope
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Record, Type
from rapidsim.library.predefined import TYPES
from rapidsim.library.table import LibraryRoutine

Lines = list[str]
_ERRORS = ("ERR_DIVZERO", "ERR_WAIT_MAXTIME", "ERR_FILEOPEN", "ERR_ARGDUPCND", "99", "0", "-1")
_MOVES = (
    "MoveJ {p},v1000,{z},tool0;",
    "MoveL {p},v500,{z},tool0;",
    "MoveL Offs({p},0,10,10),v500,{z},tool0;",
    "MoveC {p},Offs({p},20,20,0),v500,{z},tool0;",
    "MoveAbsJ {j}\\NoEOffs,v1000,{z},tool0;",
)


@dataclass(frozen=True)
class Around:
    """What a statement stands in."""

    depth: int = 2
    handler: bool = False
    trap: bool = False
    main: bool = False
    result: Type | None = None


def indented(lines: Iterable[str]) -> Lines:
    """A block one level deeper."""
    return [f"  {line}" for line in lines]


@dataclass
class Statements:
    """Writes statements with the data and the routines of a scope."""

    dice: Dice
    scope: Scope
    write: Expressions

    def block(self, around: Around, most: int = 4) -> Lines:
        """One to several statements."""
        lines: Lines = []
        for _ in range(self.dice.randint(1, most)):
            lines += self.statement(around)
        return lines

    def statement(self, around: Around) -> Lines:
        """Any statement."""
        simple: dict[Callable[[Around], Lines], float] = {
            self._library: 16,
            self._assignment: 6,
            self._move: 4,
            self._call: 4,
            self._interrupt: 2,
            self._print: 2,
            self._signal: 2,
            self._raise: 0.7,
            self._return: 0.4,
            self._stop: 0.2,
            self._special: 1,
        }
        if around.depth:
            simple |= {
                self._if: 2,
                self._compact_if: 1,
                self._for: 1,
                self._while: 1,
                self._test: 1,
                self._goto: 0.7,
            }
        return self.dice.weighed(simple)(around)

    def of_library(self, row: LibraryRoutine) -> Lines:
        """A statement that calls a routine of the library."""
        result = row.signature.result
        if result is None:
            return [f"{row.name}{self.write.arguments(row.signature.parameters)};"]
        target = self.write.place(result, WRITABLE)
        return [f"{target} := {self.write.function(row)};"]

    def handler(self, around: Around) -> Lines:
        """What an ERROR clause does."""
        inside = replace(around, handler=True, depth=1)
        lines = self.block(inside, 2) if self.dice.chance(0.3) else []
        if self.dice.chance(0.3):
            lines.append("TPWrite ValToStr(ERRNO);")
        end = self.dice.weighed(
            {"TRYNEXT;": 10, "RETRY;": 1, "StartMoveRetry;": 0.5, "RAISE;": 1, "RETURN": 1, "": 0.5}
        )
        if end == "RETURN" or (end == "" and around.result is not None):
            return lines + self._return(around)
        if end == "RAISE;" and around.main:
            end = "TRYNEXT;"
        return lines + ([end] if end else [])

    def _library(self, around: Around) -> Lines:
        return self.of_library(self.dice.of(instructions()))

    def _assignment(self, around: Around) -> Lines:
        own: list[Type] = list(self.scope.records)
        if own and self.dice.chance(0.2):
            of = self.dice.of(own)
        else:
            of = TYPES[self.dice.of((*PLAIN_TYPES, "jointtarget", "tooldata", "wobjdata"))]
        if self.dice.chance(0.05):
            element = self.dice.of((types.NUM, types.STRING))
            array = ArrayOf(element, (None,))
            return [f"{self.write.place(array, ('VAR',))}{{1}} := {self.write.value(element)};"]
        return [f"{self.write.place(of, WRITABLE)} := {self.write.value(of)};"]

    def _move(self, around: Around) -> Lines:
        made = []
        for _ in range(self.dice.randint(1, 3)):
            target = self.write.value(TYPES["robtarget"], 0)
            joints = self.write.value(TYPES["jointtarget"], 0)
            zone = self.dice.of(("z0", "z1", "z10", "z50", "z200", "fine", "fine"))
            made.append(self.dice.of(_MOVES).format(p=target, j=joints, z=zone))
        return made

    def _call(self, around: Around) -> Lines:
        own = [r for r in self.scope.routines if r.result is None]
        if not own:
            return self._library(around)
        routine = self.dice.of(own)
        if not routine.parameters and self.dice.chance(0.2):
            return [f'%"{routine.name}"%;']
        return [f"{routine.name} {self.write.called_with(routine)}".rstrip() + ";"]

    def _interrupt(self, around: Around) -> Lines:
        if not self.scope.traps or around.trap:
            return self._print(around)
        number = self.scope.declare(TYPES["intnum"], "VAR").name
        start = self.dice.of(
            (
                f"ITimer\\Single,0.1,{number};",
                f"ITimer 0.2,{number};",
                f"ISignalDI di1,1,{number};",
                f"ISignalDO do1,{self.dice.of('012')},{number};",
                f"ISignalAO\\Single,ao1,AIO_ABOVE_HIGH,5,1,0,{number};",
                f"IError SYSTEM_ERR,TYPE_ALL,{number};",
                f"IPers {self.write.place(types.NUM, ('PERS',))},{number};",
            )
        )
        lines = [f"CONNECT {number} WITH {self.dice.of(self.scope.traps)};", start]
        if self.dice.chance(0.5):
            switched = self.dice.of((f"ISleep {number};", f"IDelete {number};", "IDisable;"))
            lines += [*self._library(around), switched]
        return lines

    def _print(self, around: Around) -> Lines:
        of = TYPES[self.dice.of(PLAIN_TYPES)]
        return [f"TPWrite ValToStr({self.write.place(of, WRITABLE)});"]

    def _signal(self, around: Around) -> Lines:
        return [
            self.dice.of(
                (
                    f"SetDO do1,{self.dice.of('01')};",
                    f"SetGO go1,{self.write.value(types.NUM, 1)};",
                    f"SetAO ao1,{self.write.value(types.NUM, 1)};",
                    "WaitTime 0.2;",
                    "PulseDO\\PLength:=0.1,do1;",
                    f"WaitDI di1,{self.dice.of('01')}\\MaxTime:=0.5;",
                    f"WaitUntil {self.write.value(types.BOOL, 2)}\\MaxTime:=0.5;",
                )
            )
        ]

    def _raise(self, around: Around) -> Lines:
        if around.handler or around.main:
            return self._print(around)
        return [f"RAISE {self.dice.of(_ERRORS)};"]

    def _return(self, around: Around) -> Lines:
        if around.result is None:
            return ["RETURN;"]
        return [f"RETURN {self.write.value(around.result)};"]

    def _stop(self, around: Around) -> Lines:
        return [self.dice.of(("EXIT;", "Stop;", "Break;", "ExitCycle;", "StopMove;", "StartMove;"))]

    def _special(self, around: Around) -> Lines:
        array = ArrayOf(types.NUM, (None,))
        return [f"{array_element(self.write.place(array, ('VAR',)))} := {SIGNALS['signaldi']};"]

    def _if(self, around: Around) -> Lines:
        inside = replace(around, depth=around.depth - 1)
        lines = [f"IF {self.write.value(types.BOOL, 2)} THEN", *indented(self.block(inside, 2))]
        if self.dice.chance(0.3):
            lines += [f"ELSEIF {self.write.value(types.BOOL, 1)} THEN"]
            lines += indented(self.block(inside, 2))
        if self.dice.chance(0.4):
            lines += ["ELSE", *indented(self.block(inside, 2))]
        return [*lines, "ENDIF"]

    def _compact_if(self, around: Around) -> Lines:
        return [f"IF {self.write.value(types.BOOL, 2)} {self._library(around)[0]}"]

    def _for(self, around: Around) -> Lines:
        name = self.scope.name("i")
        inside = replace(around, depth=around.depth - 1)
        step = self.dice.of(("", "", " STEP 2", f" STEP {self.write.value(types.NUM, 0)}"))
        last = self.write.value(types.NUM, 1) if self.dice.odd() else self.dice.of("0123")
        counter = Datum(name, types.NUM, "IN")
        self.scope.local.append(counter)
        body = indented(self.block(inside, 3))
        self.scope.local.remove(counter)
        return [f"FOR {name} FROM 1 TO {last}{step} DO", *body, "ENDFOR"]

    def _while(self, around: Around) -> Lines:
        turns = self.scope.declare(types.NUM, "VAR").name
        inside = replace(around, depth=around.depth - 1)
        head = f"WHILE {turns} < {self.dice.of('135')} DO"
        if self.dice.odd():
            head = "WHILE TRUE DO"
        return [head, *indented([f"Incr {turns};", *self.block(inside, 3)]), "ENDWHILE"]

    def _test(self, around: Around) -> Lines:
        of = TYPES[self.dice.of(("num", "string", "bool"))]
        inside = replace(around, depth=around.depth - 1)
        lines = [f"TEST {self.write.value(of, 1)}"]
        for _ in range(self.dice.randint(1, 2)):
            lines += [f"CASE {self.write.value(of, 0)}:", *indented(self.block(inside, 2))]
        if self.dice.chance(0.5):
            lines += ["DEFAULT:", *indented(self.block(inside, 2))]
        return [*lines, "ENDTEST"]

    def _goto(self, around: Around) -> Lines:
        label = self.scope.name("l")
        inside = replace(around, depth=0)
        if self.dice.chance(0.7):
            return [f"GOTO {label};", *self.block(inside, 2), f"{label}:"]
        turns = self.scope.declare(types.NUM, "VAR").name
        back = f"IF {turns} < 3 GOTO {label};"
        return [f"{label}:", f"Incr {turns};", *self.block(inside, 2), back]


def array_element(name: str) -> str:
    """The first element of an array."""
    return f"{name}{{1}}"


def record_of_parts(name: str, parts: tuple[types.Component, ...]) -> Record:
    """A record of the program; nothing builds its values but the program."""
    return Record(name, parts, tuple)
