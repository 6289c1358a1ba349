"""How long single calls of the library take, whatever their arguments are.

Each simulated routine is called with one odd argument at a time, in each of its places, and each
operator with each pair of odd operands: numbers that are loop counts, not numbers or infinite,
arrays of a million elements, texts of eighty characters.
"""

from __future__ import annotations

import gc
import itertools
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from fuzzing.dice import Dice
from fuzzing.expressions import Expressions
from fuzzing.scope import WRITABLE, Scope
from fuzzing.values import INFINITE, NOT_A_NUMBER
from rapidsim.diagnostics import Severity
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import Type
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.table import LibraryRoutine, Parameter
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

SIMULATED = tuple(sorted(key for key, row in ROUTINES.items() if row.simulated))
LONGEST_S = 0.05
"""Of the processor, for a call; on a slower machine more."""
LONGEST_MOVE_S = 0.25
"""Of the processor, for a call that has a move planned, and for the plan."""
_ADDITIONS = 200_000
_ADDED_S = 0.015
"""Of the processor, for so many additions, where these limits are meant."""
MAX_TIME_S = 2.0
"""Of the run, so that calls that wait end."""
NUMBERS = (
    *("0", "1", "-1", "0.5", "255", "1E6", "1E9", "4294967296", "9E9", "1E38", "-1E38"),
    *(INFINITE, NOT_A_NUMBER),
)
LARGE = 1_000_000
_FULL = "x" * 80
TEXTS = (f'"{_FULL}"', '""', f'"[{"[" * 78}"', f'"{"9" * 80}"', f'"{"%" * 80}"')
OPERATORS = ("+", "-", "*", "/", "DIV", "MOD", "<", "<=", "=", "<>", ">", ">=")
_ARRAYS = {
    "num": ("zq_large",),
    "string": ("zq_texts",),
    "byte": ("zq_bytes",),
    "robtarget": ("zq_targets",),
    "bool": ("zq_flags",),
    "pos": ("zq_places",),
}
_DATA = f"""  VAR num zq_large{{{LARGE}}};
  VAR string zq_texts{{{LARGE}}};
  VAR byte zq_bytes{{{LARGE}}};
  VAR robtarget zq_targets{{100000}};
  VAR bool zq_flags{{{LARGE}}};
  VAR pos zq_places{{{LARGE}}};
"""


@dataclass(frozen=True)
class Call:
    """A statement, with what it declares."""

    statement: str
    data: tuple[str, ...] = ()
    local: tuple[str, ...] = ()


@dataclass(frozen=True)
class Slow:
    """A call that takes too long."""

    statement: str
    excess_s: float
    """Seconds of the processor beyond what is allowed."""


def calls_of(row: LibraryRoutine, seed: str = "times") -> Iterator[Call]:
    """Yield calls of a routine, each with one odd argument."""
    for place, parameter in enumerate(row.signature.parameters):
        for of in parameter.types:
            for value in _odd(parameter, of):
                yield _call(row, place, of, value, f"{seed} {row.name} {place} {value}")


def _odd(parameter: Parameter, of: Type) -> tuple[str, ...]:
    element = types.resolved(of)
    name = element.element.name if isinstance(element, types.ArrayOf) else element.name
    if isinstance(element, types.ArrayOf):
        return _ARRAYS.get(name, ()) if len(element.dimensions) == 1 else ()
    if of == types.ANYTYPE:
        return ("zq_large", "zq_large{1000000}", "zq_targets")
    if parameter.mode is not ParameterMode.IN:
        return ()
    if name in ("num", "dnum"):
        return NUMBERS
    return TEXTS if name == "string" else ()


class _Odd(Expressions):
    """Ordinary arguments but for one."""

    place_of_odd = 0
    odd = ""

    def arguments(self, parameters: tuple[Parameter, ...], depth: int = 0) -> str:
        """Arguments for a routine of the library, as they stand behind its name."""
        text, alternatives = "", set[int]()
        wanted = parameters[self.place_of_odd]
        for number, p in enumerate(parameters):
            is_odd = number == self.place_of_odd
            if p.optional and not is_odd:
                continue
            if p.group and p.group in alternatives:
                continue
            if p.group and not is_odd and p.group == wanted.group:
                continue
            alternatives |= {p.group} if p.group else set()
            value = self.odd if is_odd else self._ordinary(p)
            given = "" if p.is_switch else value
            if p.optional:
                text += f" \\{p.name}" + (f":={given}" if given else "")
            else:
                text += f"{',' if text else ''} {given}"
        return text

    def _ordinary(self, parameter: Parameter) -> str:
        is_any = types.ANYTYPE in parameter.types
        if is_any and parameter.mode is not ParameterMode.IN:
            return "zq_large"
        return self._argument(parameter, 0.0, 0)


def _call(row: LibraryRoutine, place: int, of: Type, value: str, seed: str) -> Call:
    dice = Dice(seed)
    dice.oddness = 0.0
    scope = Scope(dice)
    write = _Odd(dice, scope)
    write.place_of_odd, write.odd = place, value
    result = row.signature.result
    arguments = write.arguments(row.signature.parameters)
    statement = f"{row.name}{arguments};"
    if result is not None:
        target = write.place(result, WRITABLE)
        statement = f"{target}:={row.name}({arguments.strip()});"
    return Call(
        statement,
        tuple(datum.declaration for datum in scope.data),
        tuple(datum.declaration for datum in scope.local),
    )


def operator_calls() -> Iterator[Call]:
    """Yield assignments of each operator with each pair of odd operands."""
    for left, sign, right in itertools.product(NUMBERS, OPERATORS, NUMBERS):
        target = "zq_flag" if sign[0] in "<>=" else "zq_number"
        yield Call(f"{target}:={left} {sign} {right};", ("VAR num zq_number;", "VAR bool zq_flag;"))
    for left, right in itertools.product(TEXTS, TEXTS):
        yield Call(f"zq_text:={left} + {right};", ("VAR string zq_text;",))


def module(calls: Sequence[Call]) -> str:
    """A program with one procedure a call."""
    used = "".join(call.statement for call in calls)
    data = [line for line in _DATA.splitlines() if line.split("{")[0].split()[-1] in used]
    names: dict[str, str] = {}
    routines = []
    for number, call in enumerate(calls):
        # Names of data are those of the call alone.
        own, statement, local = list(call.data), call.statement, list(call.local)
        for line in (*own, *local):
            name = _declared(line)
            if name in ("zq_number", "zq_flag", "zq_text"):
                names.setdefault(name, line)
                continue
            statement = statement.replace(name, f"{name}_{number}")
            own = [other.replace(name, f"{name}_{number}") for other in own]
            local = [other.replace(name, f"{name}_{number}") for other in local]
        data += [f"  {line}" for line in own if _declared(line) not in names]
        body = "".join(f"    {line}\n" for line in (*local, statement))
        routines.append(f"  PROC zq_call{number}()\n{body}  ERROR\n    TRYNEXT;\n  ENDPROC\n")
    data += [f"  {line}" for line in names.values()]
    text = "\n".join(data) + "\n" + "".join(routines)
    return f"MODULE zq_times\n{text}  PROC main()\n  ENDPROC\nENDMODULE\n"


def _declared(line: str) -> str:
    return line.split(":=")[0].split("{")[0].split(";")[0].split()[-1]


def slowness() -> float:
    """Return how many times slower than meant this machine adds, at least one."""
    longest = []
    for _ in range(5):
        begin, total = time.process_time(), 0
        for number in range(_ADDITIONS):
            total += number
        longest.append(time.process_time() - begin)
    return max(1.0, min(longest) / _ADDED_S)


def slow_calls(calls: Sequence[Call]) -> tuple[int, list[Slow]]:
    """Execute calls, and return how many ran and which took too long.

    Calls that the checker refuses do not run.
    """
    calls = list(calls)
    while True:
        begin = time.process_time()
        loaded = load([SourceFile("times.mod", module(calls), "utf-8")])
        seconds = time.process_time() - begin
        if loaded.program is not None or not calls:
            break
        lines = module(calls).splitlines()
        refused = set()
        for found in loaded.diagnostics:
            if found.severity is Severity.ERROR and found.span is not None:
                above = lines[: found.span.line]
                heads = [line for line in above if line.startswith("  PROC zq_call")]
                refused |= {int(heads[-1][14:-2])} if heads else set()
        if not refused:
            return 0, []
        calls = [call for number, call in enumerate(calls) if number not in refused]
    slow: list[Slow] = []
    scale = slowness()
    if seconds > scale * LONGEST_S * max(len(calls), 20):
        slow.append(Slow("the check of all", seconds - scale * LONGEST_S * len(calls)))
    robot = load_robot("irb1600-6-1.2")
    with TemporaryDirectory() as home:
        options = RunOptions(home=Path(home), max_time_s=MAX_TIME_S, max_wall_s=20.0)

        def cost_of(entry: str) -> tuple[float, float]:
            """Seconds of the processor, and how many are allowed beyond a run of nothing."""
            assert loaded.program is not None
            # Large arrays are few objects, which Python does not collect by itself.
            gc.collect()
            begin = time.process_time()
            run = simulate(loaded.program, robot, options=replace(options, entry=entry))
            seconds = time.process_time() - begin
            return seconds, LONGEST_MOVE_S if run.moves else LONGEST_S

        # What is here stays, and takes no time to look at again.
        gc.collect()
        gc.freeze()
        base_s = min(cost_of("main")[0] for _ in range(3))
        for number, call in enumerate(calls):
            # The first call of a formula may compile it, and the machine has other work.
            excess = 0.0
            for _ in range(4):
                seconds, allowed_s = cost_of(f"zq_call{number}")
                excess = seconds - base_s - scale * allowed_s
                if excess <= 0.0:
                    break
                scale = max(scale, slowness())
            else:
                slow.append(Slow(call.statement, excess))
    return len(calls), slow


def fuzz_times() -> bool:
    """Try all routines and operators, and print; whether none took too long."""
    ran = tried = 0
    found: list[Slow] = []
    begin = time.process_time()
    batches = [list(calls_of(ROUTINES[key])) for key in SIMULATED]
    operators = list(operator_calls())
    batches += [operators[at : at + 200] for at in range(0, len(operators), 200)]
    for calls in batches:
        count, slow = slow_calls(calls)
        tried, ran = tried + len(calls), ran + count
        for one in slow:
            print(f"{1e3 * one.excess_s:.0f} ms too long: {one.statement}", flush=True)
        found += slow
    print(
        f"{tried} calls of {len(batches)} groups, {ran} of them ran, {len(found)} took too long;"
        f" {time.process_time() - begin:.0f} s of the processor"
    )
    return not found
