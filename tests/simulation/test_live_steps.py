"""Programs of a controller that stays on, executed step by step."""

from __future__ import annotations

import sys
from types import FrameType

import pytest
from live_controller import SIGNALS, Live

from rapidsim.controller.cell.description import CellIo
from rapidsim.interpreter.tools.step_positions import (
    FramePositions,
    StepGranularity,
    StepPosition,
)
from rapidsim.simulation.live import signals
from rapidsim.simulation.live.event_log import STEPPED
from rapidsim.simulation.live.states import Cycle, ExecutionMode, StopMode
from rapidsim.station.task_kind import TaskEvent

IN, OVER = ExecutionMode.STEP_IN, ExecutionMode.STEP_OVER
OUT, MOTION = ExecutionMode.STEP_OUT, ExecutionMode.STEP_MOTION

CALLS = """MODULE Tried
PERS num n := 0;
PROC main()
  VAR num i := 1;
  n := 0;
  twice;
  n := added(
    n,
    1);
  FOR k FROM 1 TO 2 DO
    n := n + 1;
  ENDFOR
  fails;
  IF n > 100 THEN
    n := 0;
  ELSEIF n = 4 THEN
    n := 5;
  ENDIF
ENDPROC
PROC twice()
  once;
  once;
ENDPROC
PROC once()
  n := n + 0.5;
ENDPROC
FUNC num added(num a, num b)
  RETURN a + b;
ENDFUNC
PROC fails()
  n := n / 0;
  n := 4;
ERROR
  n := 4;
  TRYNEXT;
ENDPROC
ENDMODULE
"""


def stepped(live: Live, how: ExecutionMode) -> int:
    """The line before which the program stands after a step."""
    live.controller.start(how=how)
    live.after(10.0)
    assert not live.controller.executes
    return live.line


def walked(live: Live, steps: list[ExecutionMode]) -> list[int]:
    return [stepped(live, how) for how in steps]


def test_a_step_over_executes_a_statement_with_all_that_it_calls() -> None:
    live = Live(CALLS)
    assert walked(live, [OVER] * 4) == [6, 7, 10, 11]
    assert live.value("n") == "2"
    # The loop is looked at once more and is over.
    assert walked(live, [OVER] * 5) == [10, 11, 10, 13, 14]
    assert live.value("n") == "4"
    # The end of main is followed by its beginning.
    assert walked(live, [OVER] * 3) == [16, 17, 5]
    assert live.value("n") == "5"


def test_a_step_in_goes_into_routines_functions_and_error_clauses() -> None:
    live = Live(CALLS)
    assert walked(live, [IN] * 6) == [6, 21, 25, 22, 25, 7]
    assert walked(live, [IN] * 2) == [28, 10]
    assert walked(live, [IN] * 5) == [11, 10, 11, 10, 13]
    assert walked(live, [IN] * 3) == [31, 34, 35]
    assert 32 in walked(live, [IN] * 2)


def test_a_step_over_a_statement_that_fails_stops_in_the_error_clause() -> None:
    live = Live(CALLS)
    live.controller.put_pointer("T_ROB1", "", "fails")
    assert walked(live, [OVER] * 2) == [34, 35]
    # Python 3.12 shows the failed line once more where TRYNEXT leaves it.
    assert 32 in walked(live, [OVER] * 2)


def test_a_step_out_ends_behind_the_call() -> None:
    live = Live(CALLS)
    assert walked(live, [OVER, IN, IN, OUT, OUT, OUT]) == [6, 21, 25, 22, 7, 5]


def test_after_a_step_the_place_is_the_whole_statement_that_comes_next() -> None:
    live = Live(CALLS)
    walked(live, [OVER, OVER])
    place = live.controller.task("T_ROB1").place
    assert place.routine == "main"
    ends = (place.span.line, place.span.column, place.span.end_line, place.span.end_column)
    assert ends == (7, 3, 9, 7)
    stepped(live, OVER)
    # Of a statement that holds others it is the header.
    span = live.controller.task("T_ROB1").place.span
    assert span.source.text[span.start : span.end] == "FOR k FROM 1 TO 2 DO"


def test_a_program_goes_on_after_steps_and_is_stepped_after_a_stop() -> None:
    live = Live(
        """MODULE Tried
PERS num n := 0;
PROC main()
  n := n + 1;
  WaitTime
    2;
  n := n + 1;
ENDPROC
ENDMODULE
"""
    )
    assert walked(live, [OVER]) == [5]
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    # The wait goes on, which ends the statement that was stopped.
    assert walked(live, [OVER, OVER]) == [7, 4]
    live.controller.start(Cycle.ONCE)
    live.after(5.0)
    assert live.value("n") == "4"
    assert STEPPED in {one.code for one in live.entries}
    assert sys.gettrace() is None or "Stepper" not in repr(sys.gettrace())


def test_a_step_that_waits_can_be_stopped() -> None:
    live = Live("MODULE Tried\nPROC main()\n  WaitDI diGo, 1;\n  Break;\nENDPROC\nENDMODULE\n")
    live.controller.start(how=OVER)
    live.after(5.0)
    assert live.controller.executes
    live.controller.stop(StopMode.STOP)
    assert not live.controller.executes
    live.controller.start(how=OVER)
    live.after(1.0)
    signals.write(live.controller, "diGo", 1.0)
    assert not live.controller.executes
    assert live.line == 4


MOVES = """MODULE Tried
PERS num n := 0;
PROC main()
  n := 1;
  go 20;
  n := 2;
  go 40;
  MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z100, tool0;
ENDPROC
PROC go(num degrees)
  MoveAbsJ [[degrees,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z100, tool0;
  n := n + 10;
ENDPROC
ENDMODULE
"""


def test_a_step_to_the_next_move_ends_where_the_robot_has_made_it() -> None:
    live = Live(MOVES)
    assert stepped(live, MOTION) == 12
    assert live.value("n") == "1"
    assert live.axis_1() == pytest.approx(0.3490658504)
    assert stepped(live, MOTION) == 12
    assert live.value("n") == "2"
    assert live.axis_1() == pytest.approx(0.6981317008)
    assert stepped(live, MOTION) == 4


def test_a_move_is_a_step_and_ends_at_its_point_though_it_has_a_zone() -> None:
    live = Live(MOVES)
    live.controller.start(how=OVER)
    live.after(0.0)
    live.controller.start(how=OVER)
    live.after(0.1)
    assert live.controller.executes
    live.after(10.0)
    assert (live.controller.executes, live.line) == (False, 6)
    assert live.axis_1() == pytest.approx(0.3490658504)
    assert live.value("n") == "11"
    # A corner that no move follows is nothing to warn of.
    assert not [one for one in live.entries if one.type > 1]


def test_traps_run_through_while_a_program_is_stepped() -> None:
    program = """MODULE Tried
PERS num n := 0;
VAR intnum go;
PROC main()
  CONNECT go WITH came;
  ISignalDI diGo, 1, go;
  WaitTime 2;
  n := n + 1;
ENDPROC
TRAP came
  n := n + 10;
  n := n + 10;
ENDTRAP
ENDMODULE
"""
    live = Live(program, io=CellIo(signals=SIGNALS))
    walked(live, [IN, IN])
    live.controller.start(how=IN)
    live.after(1.0)
    signals.write(live.controller, "diGo", 1.0)
    live.after(5.0)
    assert (live.line, live.value("n")) == (8, "20")


COUNTS = """MODULE Tried
VAR num k := 0;
PROC main()
  k := k + 1;
  WaitTime 1;
ENDPROC
ENDMODULE
"""


def test_each_task_makes_its_own_step_and_tasks_of_the_background_run_on() -> None:
    live = Live(CALLS, COUNTS, background=COUNTS)
    for _ in range(4):
        stepped(live, OVER)
    assert live.line == 11
    assert live.value("k", "T_ROB2") == "2"
    assert live.controller.task("T_ROB2").place.span.line == 4
    assert live.value("k", "T_BACK") == "40"


COMPUTES = """MODULE Tried
VAR num n := 0;
PERS num late := 0;
VAR clock c;
PROC main()
  ClkStart c;
  FOR i FROM 1 TO 1000 DO
    n := n + i;
    n := n - 1;
  ENDFOR
  late := ClkRead(c);
  Stop;
ENDPROC
ENDMODULE
"""


def test_a_loop_that_counts_its_own_time_goes_on_counting_after_a_step() -> None:
    alone, live = Live(COMPUTES), Live(COMPUTES)
    for _ in range(20):
        live.controller.start(how=OVER)
        live.after(0.01)
    for one in (alone, live):
        one.controller.start(Cycle.ONCE)
        one.after(10.0)
    assert live.value("n") == alone.value("n") == "499500"
    # Time passes while a program stands, so its clock counts that, too.
    stood_s = float(live.value("late")) - float(alone.value("late"))
    assert stood_s == pytest.approx(0.2, abs=0.02)


def test_a_program_halts_at_its_breakpoints_and_goes_on_from_there() -> None:
    live = Live(CALLS)
    controller, task = live.controller, live.controller.task("T_ROB1")
    first = CALLS.splitlines().index("    n := n + 1;") + 1
    task.breakpoints |= {("tried", first), ("other", 2)}
    values = []
    controller.start(Cycle.ONCE)
    for _ in range(2):
        live.after(1.0)
        assert not controller.executes
        assert task.module_line(task.place) == ("Tried", first)
        values.append(live.value("n"))
        controller.start(Cycle.ONCE)
    # Before each turn of the loop.
    assert values == ["2", "3"]
    task.breakpoints.clear()
    live.after(1.0)
    assert live.value("n") == "5"
    assert sys.gettrace() is None


EVENTS = """MODULE Tried
VAR num n := 0;
PROC main()
  n := n + 1;
  n := n + 1;
ENDPROC
PROC halts()
  n := n + 10;
ENDPROC
PROC continues()
  n := n + 100;
ENDPROC
ENDMODULE
"""


def test_the_event_routines_of_a_halt_at_a_breakpoint_are_not_halted() -> None:
    live = Live(EVENTS, events=((TaskEvent.STOP, "halts"), (TaskEvent.RESTART, "continues")))
    controller, task = live.controller, live.controller.task("T_ROB1")
    task.breakpoints |= {("tried", 5), ("tried", 8), ("tried", 11)}
    controller.start(Cycle.ONCE)
    live.after(1.0)
    assert (controller.executes, live.line, live.value("n")) == (False, 5, "11")
    controller.start(Cycle.ONCE)
    live.after(1.0)
    assert (controller.executes, live.value("n")) == (False, "112")


DEEP = """MODULE Tried
PERS num n := 0;
PROC main()
  down 60;
ENDPROC
PROC down(num left)
  n := n + 1;
  IF left > 0 down left - 1;
  n := n + 1;
ENDPROC
ENDMODULE
"""


def test_the_stack_is_counted_once_for_each_step(monkeypatch: pytest.MonkeyPatch) -> None:
    counted = FramePositions.of
    passed = StepPosition.ends_step
    positions, ends = [], []

    def of(self: FramePositions, frame: FrameType) -> StepPosition:
        positions.append(frame)
        return counted(self, frame)

    def ends_step(self: StepPosition, start: StepPosition, reach: StepGranularity) -> bool:
        # Whatever was counted on the way is what there is.
        assert self == counted(FramePositions(), sys._getframe(3))
        ends.append(self.depth)
        return passed(self, start, reach)

    live = Live(DEEP)
    monkeypatch.setattr(FramePositions, "of", of)
    monkeypatch.setattr(StepPosition, "ends_step", ends_step)
    assert stepped(live, OVER) == 4
    assert len(ends) == 184
    assert max(ends) == 62
    assert len(positions) <= 2
