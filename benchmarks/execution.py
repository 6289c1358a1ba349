"""How fast executed RAPID is: `python benchmarks/execution.py [ROUNDS]`.

Each loop of `loops.mod` runs as generated code, as plain Python without checks, and in a closure
interpreter, one after the other in every round; the minimum of the rounds is printed, in time of
the processor, since whatever else the machine does only adds time.

Loops that poll are run on the virtual controller, and the processor time that a virtual second
takes is printed; next to nothing where nothing can change before the next event.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import plain_loops
from closures import Interpreter

from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import DataSymbol, Program, Scope
from rapidsim.diagnostics import Source
from rapidsim.interpreter.linking.loader import Task, load
from rapidsim.language.controller import uniform_controller
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate
from rapidsim.syntax.parser import parse

HERE = Path(__file__).parent
FILES = (HERE.parent / "programs" / "algorithms.mod", HERE / "loops.mod")
LOOPS = (
    *("sieve", "insertion_sort", "quicksort", "matrix_product", "texts"),
    *("records", "recursion", "collatz", "floats"),
)
GEOMETRIC_MEAN_TARGET = 2.3
WORST_TARGET = 4.0
CLOSURE_TARGET = 2.0
POLLED_S = {
    **{"a signal": 20.0, "a persistent": 20.0, "a clock": 5.0},
    **{"the position": 2.0, "the position after waits": 5.0},
}
"""Virtual time that each polling loop lasts."""
POLLING_TARGETS = {
    **{"a signal": 0.05, "a persistent": 0.05, "a clock": 0.2},
    **{"the position": 1.0, "the position after waits": 0.2},
}
"""Seconds of processor for a virtual one. What a clock shows, and where the robot is, change each
millisecond, so that the program has to look so often; each turn of a loop takes 10 us."""
POLLING = {
    "a signal": "SetDO \\SDelay:=<s>,doReady,1;\nWHILE doReady=0 DO\nENDWHILE",
    "a persistent": "ITimer \\Single,<s>,late;\nWHILE NOT go DO\nENDWHILE",
    "a clock": "WHILE ClkRead(watch)<<s> DO\nENDWHILE",
    "the position": "WHILE ClkRead(watch)<<s> DO\nseen:=CPos();\nENDWHILE",
    "the position after waits": (
        "WHILE Distance(CPos(),seen)>0.001 AND ClkRead(watch)<<s> DO\nWaitTime 0.01;\nENDWHILE"
    ),
}


POLLING_PROGRAM = """MODULE polling
  CONST jointtarget away:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS bool go:=FALSE;
  VAR clock watch;
  VAR intnum late;
  VAR pos seen;
  PROC main()
    CONNECT late WITH now;
    ClkStart watch;
    MoveAbsJ \\Conc,away,v5,fine,tool0;
<loop>
  ENDPROC
  TRAP now
    go:=TRUE;
  ENDTRAP
ENDMODULE
"""


@dataclass
class Ticking:
    """As much of a controller as loops need."""

    ticks_left: int = 1000
    watches: bool = False
    errno: float = 0.0
    place: object = None
    booked: float = 0.0

    def service(self) -> None:
        """Begin the next slice."""
        self.ticks_left = 1000

    def book_error_number(self) -> float:
        """The next free number."""
        self.booked += 1
        return 20500.0 + self.booked


def main() -> None:
    """Measure and print."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    _show(loop_times(rounds))
    _show_polling(min(rounds, 3))


def loop_times(rounds: int) -> dict[str, list[float]]:
    """Seconds of processor of each loop: as generated code, in Python, in closures."""
    program = _program()
    task = load(program, uniform_controller(Ticking()))
    closures = Interpreter(program, Ticking())
    task.run("prepare")
    closures.run("prepare")
    times: dict[str, list[float]] = {}
    for name in LOOPS:
        ways: list[Callable[[], None]] = [
            lambda name=name: task.run(name),  # type: ignore[misc]
            getattr(plain_loops, name),
            lambda name=name: closures.run(name),  # type: ignore[misc]
        ]
        for way in ways:
            way()  # once before the clock runs
        measured = [[_seconds(way) for way in ways] for _ in range(rounds)]
        times[name] = [min(column) for column in zip(*measured, strict=True)]
    _expect_equal_memory(task, closures)
    return times


def _show_polling(rounds: int) -> None:
    """What polling costs, with the robot under way."""
    arm = load_robot("irb1600-6-1.2")
    for name, loop in POLLING.items():
        text = POLLING_PROGRAM.replace("<loop>", loop).replace("<s>", f"{POLLED_S[name]:g}")
        checked = check([parse(Source("polling.mod", text)).file])
        assert checked.program is not None, checked.diagnostics
        times = []
        for _ in range(rounds):
            begin = time.process_time()
            simulate(checked.program, arm, options=RunOptions(max_time_s=40.0))
            times.append((time.process_time() - begin) / POLLED_S[name])
        print(f"polling {name:24}{1000 * min(times):8.2f} ms of processor for a virtual second")
        if min(times) > POLLING_TARGETS[name]:
            print(f"  beyond the target of {1000 * POLLING_TARGETS[name]:g} ms")


def _program() -> Program:
    files = [parse(Source(path.name, path.read_text())).file for path in FILES]
    checked = check(files)
    assert checked.program is not None, checked.diagnostics
    return checked.program


def _expect_equal_memory(task: Task, closures: Interpreter) -> None:
    """What is compared must do the same."""
    for symbol, held in closures.variables.items():
        if isinstance(symbol, DataSymbol) and symbol.scope is not Scope.ROUTINE and symbol.node:
            value = held if isinstance(held, list) else held.value
            assert value == task.value(symbol.name), symbol.name


def _seconds(way: Callable[[], None]) -> float:
    begin = time.process_time()
    way()
    return time.process_time() - begin


def _show(times: dict[str, list[float]]) -> None:
    print(f"{'loop':16}{'rapidsim':>11}{'Python':>11}{'closures':>11}   ratio  closures/rapidsim")
    slower, faster = [], []
    for name, (generated, plain, closures) in times.items():
        slower.append(generated / plain)
        faster.append(closures / generated)
        columns = "".join(f"{1000 * t:8.2f} ms" for t in (generated, plain, closures))
        print(f"{name:16}{columns}{slower[-1]:8.2f}{faster[-1]:10.2f}")
    print(
        f"slower than Python: geometric mean {mean_of(slower):.2f}"
        f" (target {GEOMETRIC_MEAN_TARGET:g}), worst {max(slower):.2f} (target {WORST_TARGET:g})"
    )
    print(
        f"faster than closures: geometric mean {mean_of(faster):.2f}, "
        f"least {min(faster):.2f} (target {CLOSURE_TARGET:g})"
    )


def mean_of(ratios: list[float]) -> float:
    """The geometric mean."""
    return math.exp(sum(map(math.log, ratios)) / len(ratios))


if __name__ == "__main__":
    main()
