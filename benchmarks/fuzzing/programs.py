"""A whole program: modules, tasks, and the station they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from fuzzing.dice import Dice
from fuzzing.expressions import PLAIN_TYPES, Expressions
from fuzzing.scope import Datum, Scope, UserParameter, UserRoutine
from fuzzing.statements import Around, Lines, Statements, indented, record_of_parts
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Component, Type
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.predefined import TYPES

STATION = "rapidsim.toml"
SPOILED = 0.05
REPEATED = 0.5
"""Share of the mains that repeat their statements."""
ROUNDS = (2, 20, 200)
_SIGNALS = """
[signals]
di1 = { type = "di", value = 0 }
do1 = { type = "do" }
go1 = { type = "go", width = 8 }
ao1 = { type = "ao", min = 0, max = 10 }

[[stimulus]]
at = 0.3
every = 1.0
pulse = 0.2
set = { di1 = 1 }
"""
_TWO_ROBOTS = """
[[robot]]
name = "left"
model = "irb1600-6-1.2"
[[robot]]
name = "right"
model = "irb1600-6-1.2"
base = { position = [1600, 0, 0], quaternion = [0, 0, 0, 1] }
"""
_SYNC = (
    'PERS tasks zq_all{2}:=[["T_ROB1"],["T_ROB2"]];',
    "VAR syncident zq_together;",
    "VAR syncident zq_apart;",
)


@dataclass(frozen=True)
class Made:
    """A program as files; `named` are those that the command line names."""

    files: dict[str, str]
    named: tuple[str, ...]

    def with_text(self, file: str, text: str) -> Made:
        """The same with another text in a file."""
        return replace(self, files={**self.files, file: text})


def make(seed: str, wanted: Sequence[str] = ()) -> Made:
    """A program that follows from its seed, one in twenty with a line missing.

    Args:
        seed: Any text.
        wanted: Folded names of routines of the library that it is to call.
    """
    dice = Dice(seed)
    made = _sound(dice, wanted)
    if not dice.chance(SPOILED):
        return made
    file = dice.of(made.named)
    lines = made.files[file].splitlines()
    del lines[dice.randrange(len(lines))]
    return made.with_text(file, "\n".join([*lines, ""]))


def _sound(dice: Dice, wanted: Sequence[str]) -> Made:
    kind = dice.weighed({"one": 10, "modules": 3, "station": 2, "tasks": 1, "multimove": 1})
    if kind in ("one", "modules", "station"):
        task = _Task(dice, Scope(dice))
        modules = task.modules(2 if kind == "modules" else 1, wanted)
        files = {f"m{n}.mod": text for n, text in enumerate(modules, 1)}
        if kind == "station":
            return Made({**files, STATION: _SIGNALS}, tuple(files))
        return Made(files, tuple(files))
    together = [str(n) for n in range(10, 10 + 10 * dice.randint(1, 3), 10)]
    ids = together if kind == "multimove" else []
    shared: list[Datum] = []
    files = {}
    for letter in "ab":
        task = _Task(dice, Scope(dice, letter), ids, shared)
        (files[f"{letter}.mod"],) = task.modules(1, wanted if letter == "a" else ())
    background = kind == "tasks" and dice.chance(0.5)
    tasks = [
        '[[task]]\nname = "T_ROB1"\nmodules = ["a.mod"]\n',
        '[[task]]\nname = "T_ROB2"\nmodules = ["b.mod"]\n'
        + ('type = "semistatic"\nmotion = false\n' if background else ""),
    ]
    robots = '[robot]\nmodel = "irb1600-6-1.2"\n' if background else _TWO_ROBOTS
    return Made({**files, STATION: robots + "".join(tasks) + _SIGNALS}, ("a.mod", "b.mod"))


@dataclass
class _Task:
    """The modules of one task while they are written."""

    dice: Dice
    scope: Scope
    ids: Sequence[str] = ()
    shared: list[Datum] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.write = Expressions(self.dice, self.scope)
        self.statements = Statements(self.dice, self.scope, self.write)

    def modules(self, count: int, wanted: Sequence[str]) -> list[str]:
        """The texts of the modules."""
        if self.ids:
            self.scope.data += self.shared
        records = [self._record() for _ in range(self.dice.of((0, 0, 1, 2)))]
        routines: list[Lines] = []
        for _ in range(self.dice.of((0, 0, 1))):
            routines.append(self._trap())
        for _ in range(self.dice.of((0, 1, 2, 3))):
            routines.append(self._function() if self.dice.chance(0.3) else self._procedure())
        for names in (wanted[n : n + 2] for n in range(0, len(wanted), 2)):
            routines.append(self._procedure(names))
        routines.append(self._main())
        return self._texts(count, records, routines)

    def _texts(self, count: int, records: list[Lines], routines: list[Lines]) -> list[str]:
        bodies: list[list[Lines]] = [[] for _ in range(count)]
        for routine in routines:
            self.dice.of(bodies).append(routine)
        texts = []
        for n, body in enumerate(bodies):
            data = [d.declaration for d in self.scope.data if d.declaration] if n == 0 else []
            local = "LOCAL " if count == 1 and not self.scope.task and self.dice.chance(0.2) else ""
            head: Lines = [line for lines in records for line in lines] if n == 0 else []
            head += list(_SYNC) if self.ids else []
            head += [local + line for line in data]
            lines = [f"MODULE zq_m{self.scope.task}{n}", *indented(head)]
            for routine in body:
                lines += indented(routine)
            texts.append("\n".join([*lines, "ENDMODULE", ""]))
        return texts

    def _record(self) -> Lines:
        name = self.scope.name("Rec")
        kinds: list[Type] = [*(TYPES[of] for of in PLAIN_TYPES), *self.scope.records]
        parts = tuple(
            Component(f"zq_c{n}", self.dice.of(kinds)) for n in range(1, self.dice.randint(2, 4))
        )
        self.scope.records.append(record_of_parts(name, parts))
        inside = [f"{part.type.name} {part.name};" for part in parts]
        return [f"RECORD {name}", *indented(inside), "ENDRECORD"]

    def _main(self) -> Lines:
        self.scope.local = []
        around = Around(main=True)
        body: Lines = []
        for routine in self.scope.routines:
            if routine.result is None and self.dice.chance(0.9):
                body.append(f"{routine.name} {self.write.called_with(routine)}".rstrip() + ";")
        body[self.dice.randint(0, len(body)) :] = self.statements.block(around, 6)
        if self.ids:
            body.append("SyncMoveOn zq_together,zq_all;")
            for number in self.ids:
                target = self.write.value(TYPES["robtarget"], 0)
                zone = self.dice.of(("z10", "z50", "fine"))
                move = self.dice.of(("MoveJ", "MoveL", "MoveL"))
                body.append(f"{move} {target}\\ID:={number},v500,{zone},tool0;")
                if self.dice.chance(0.3):
                    body += self.statements.statement(around)
            body.append("SyncMoveOff zq_apart;")
        if self.dice.chance(REPEATED):
            loop = f"FOR zq_round FROM 1 TO {self.dice.of(ROUNDS)} DO"
            body = [loop, *indented(body), "ENDFOR"]
        return self._routine("PROC main()", body, around, "ENDPROC")

    def _procedure(self, wanted: Sequence[str] = ()) -> Lines:
        self.scope.local = []
        parameters = () if wanted else self._parameters()
        routine = UserRoutine(self.scope.name("p"), parameters)
        body: Lines = []
        for name in wanted:
            body += self.statements.of_library(ROUTINES[name])
            if self.dice.chance(0.3):
                body += self.statements.statement(Around())
        body = body or self.statements.block(Around(), 5)
        self.scope.routines.append(routine)
        header = f"PROC {routine.name}({_header(parameters)})"
        return self._routine(header, body, Around(), "ENDPROC")

    def _function(self) -> Lines:
        self.scope.local = []
        parameters = self._parameters()
        result = TYPES[self.dice.of(PLAIN_TYPES)]
        routine = UserRoutine(self.scope.name("f"), parameters, result)
        around = Around(result=result)
        body = [*self.statements.block(around, 3), f"RETURN {self.write.value(result)};"]
        self.scope.routines.append(routine)
        header = f"FUNC {result.name} {routine.name}({_header(parameters)})"
        return self._routine(header, body, around, "ENDFUNC")

    def _trap(self) -> Lines:
        self.scope.local = []
        name = self.scope.name("t")
        around = Around(trap=True)
        body = self.statements.block(around, 3)
        self.scope.traps.append(name)
        return self._routine(f"TRAP {name}", body, around, "ENDTRAP")

    def _routine(self, header: str, body: Lines, around: Around, end: str) -> Lines:
        clauses: Lines = []
        if self.dice.chance(0.75):
            chosen = self.dice.weighed({"": 9, " (ERR_DIVZERO,99)": 1, " (LONG_JMP_ALL_ERR)": 0.3})
            clauses += [f"ERROR{chosen}", *indented(self.statements.handler(around))]
        if self.dice.chance(0.05):
            clauses += ["UNDO", *indented(self.statements.block(replace(around, depth=0), 1))]
        local = [d.declaration for d in self.scope.local if d.declaration]
        self.scope.local = []
        return [header, *indented([*local, *body]), *clauses, end]

    def _parameters(self) -> tuple[UserParameter, ...]:
        made: list[UserParameter] = []
        for _ in range(self.dice.of((0, 0, 1, 2, 3))):
            of: Type = TYPES[self.dice.of(PLAIN_TYPES)]
            mode = self.dice.of(("", "", "VAR", "INOUT", "PERS"))
            optional = self.dice.chance(0.2)
            if optional and self.dice.chance(0.3):
                of, mode = types.SWITCH, ""
            elif mode != "PERS" and self.dice.chance(0.1):
                of, mode = ArrayOf(types.NUM, (None,)), "VAR"
            made.append(UserParameter(self.scope.name("a"), of, mode, optional))
        for p in made:
            storage = p.mode if p.mode in ("VAR", "PERS") else "INOUT" if p.mode else "IN"
            if not p.optional:
                self.scope.local.append(Datum(p.name, p.type, storage))
        return tuple(made)


def _header(parameters: Sequence[UserParameter]) -> str:
    text = ""
    for p in parameters:
        text += f"{',' if text and not p.optional else ''}{' ' if text else ''}{p.header}"
    return text
