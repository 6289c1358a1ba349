"""The engine of a debugger: where a program stops, for which reason, and at which statement."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from interpreter_cell import RecordingController, checked
from whole_findings import assert_section

from rapidsim.interpreter.linking.loader import load
from rapidsim.interpreter.tools.debugging import Breakpoint, Debugger, Stop, hit_condition
from rapidsim.interpreter.tools.step_positions import StepGranularity
from rapidsim.language.controller import uniform_controller

PROGRAM = """MODULE cell
VAR num x;
VAR intnum irq;
PROC main()
  CONNECT irq WITH rings;
  x := 1;
  twice;
  WaitTime 1;
  x := 5;
  fails;
  FOR i FROM 1 TO 3 DO
    x := x + i;
  ENDFOR
  x := 6;
ENDPROC
PROC twice()
  x := x + 1;
  x := x + 1;
ENDPROC
PROC fails()
  x := 1 / (x - x);
ERROR
  x := 7;
  TRYNEXT;
ENDPROC
TRAP rings
  x := 3;
  twice;
ENDTRAP
ENDMODULE
"""
Go = Callable[[Debugger, Stop], None]
Begin = Callable[[Debugger], None]


def on(debugger: Debugger, stop: Stop) -> None:
    debugger.go_on()


def steps(reach: StepGranularity) -> tuple[Begin, Go]:
    return Debugger.pause, lambda debugger, stop: debugger.step(reach, stop.frame)


def steps_from(line: int, reach: StepGranularity) -> tuple[Begin, Go]:
    return breaks(line), lambda debugger, stop: debugger.step(reach, stop.frame)


def breaks(line: int, hits: str = "") -> Begin:
    def begin(debugger: Debugger) -> None:
        condition = hit_condition(hits) if hits else None
        debugger.breakpoints = {("cell.mod", line): Breakpoint("cell.mod", line, None, condition)}

    return begin


def errors(debugger: Debugger) -> None:
    debugger.stops_at_error = lambda error: "zero" in error.message


def ending_steps(debugger: Debugger) -> None:
    breaks(9)(debugger)
    debugger.errors_end_steps = True


def over_errors(debugger: Debugger, stop: Stop) -> None:
    debugger.step(StepGranularity.SAME_ROUTINE, stop.frame)


def back(debugger: Debugger, stop: Stop) -> None:
    debugger.run_to(stop.number + 4)


WALKS: dict[str, tuple[Begin, Go]] = {
    **{f"steps {one.name.lower()}": steps(one) for one in StepGranularity},
    **{
        f"steps {one.name.lower()} from {line}": steps_from(line, one)
        for one in (StepGranularity.SAME_ROUTINE, StepGranularity.CALLER)
        for line in (17, 27)
    },
    "breakpoint": (breaks(17), on),
    "breakpoint, second time": (breaks(12, "= 2"), on),
    "breakpoint, from the second time on": (breaks(12, "2"), on),
    "breakpoint, each second time": (breaks(12, "% 2"), on),
    "breakpoint on a line without a statement": (breaks(4), on),
    "errors": (errors, on),
    "steps that end at errors": (ending_steps, over_errors),
    "each fourth statement": (Debugger.pause, back),
}


def told(begin: Begin, go: Go) -> Iterator[str]:
    controller = RecordingController(raise_at_service=[1.0])
    task = load(checked(PROGRAM), uniform_controller(controller))
    found = []

    def stopped(stop: Stop) -> None:
        value = task.value("x")
        found.append(f"{stop.reason.value} {stop.place.span.line}: {stop.number}, x={value}")
        found.append(f"  {stop.text}") if stop.text else None
        go(debugger, stop)

    debugger = Debugger(stopped)
    begin(debugger)
    debugger.run(task.run)
    yield from found
    before = [debugger.number_before(number) for number in range(1, debugger.number + 1)]
    yield f"{debugger.number} statements, each behind {before}; the last error at " + str(
        debugger.last_error
    )


@pytest.mark.parametrize("name", WALKS)
def test_where_a_program_stops(name: str) -> None:
    text = "".join(f"{line}\n" for line in told(*WALKS[name]))
    assert_section(Path(__file__).parent / "golden" / "stops.txt", name, text)


def test_data_that_change_stop_the_program() -> None:
    task = load(checked(PROGRAM), uniform_controller(RecordingController(raise_at_service=[1.0])))
    found = []

    def stopped(stop: Stop) -> None:
        found.append((stop.place.span.line, stop.text))

    debugger = Debugger(stopped)
    debugger.watch({"x": lambda: f"{task.value('x'):g}"})
    debugger.run(task.run)
    assert found[:3] == [
        (7, "x changed from 0 to 1"),
        (18, "x changed from 1 to 2"),
        (8, "x changed from 2 to 3"),
    ]


def test_a_breakpoint_counts_where_its_condition_holds_and_may_only_print() -> None:
    task = load(checked(PROGRAM), uniform_controller(RecordingController()))
    lines: list[int] = []
    stops: list[Stop] = []
    debugger = Debugger(stops.append)
    one = Breakpoint("cell.mod", 12, lambda frame: frame.f_locals["i"] != 2, hit_condition("> 1"))
    one.log = lambda frame: lines.append(debugger.line(frame))
    debugger.breakpoints = {("cell.mod", 12): one}
    debugger.run(task.run)
    assert (one.hits, lines, stops) == (2, [12], [])


@pytest.mark.parametrize(
    ("text", "stops_at"),
    [
        ("3", [3, 4, 5, 6]),
        (">= 3", [3, 4, 5, 6]),
        ("> 3", [4, 5, 6]),
        ("= 3", [3]),
        ("==3", [3]),
        (" % 2 ", [2, 4, 6]),
        ("%1", [1, 2, 3, 4, 5, 6]),
        ("0", [1, 2, 3, 4, 5, 6]),
    ],
)
def test_numbers_of_hits(text: str, stops_at: list[int]) -> None:
    assert [hits for hits in range(1, 7) if hit_condition(text)(hits)] == stops_at


@pytest.mark.parametrize("text", ["", "x", "< 3", "% 0", "3 4", "-1", "2.5"])
def test_what_is_no_number_of_hits(text: str) -> None:
    with pytest.raises(ValueError, match="is not a number of hits"):
        hit_condition(text)
