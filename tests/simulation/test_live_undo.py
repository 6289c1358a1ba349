"""UNDO clauses on a controller that stays on: they run where the program pointer is set elsewhere.

Source: Technical reference manual RAPID Overview, "UNDO".
"""

import pytest
from live_controller import Live

from rapidsim.simulation.live.states import ExecutionMode, StopMode

DATA = 'PERS num n := 0; PERS string done := "";'


def program(body: str, *undone: str, data: str = DATA) -> str:
    """Main calls a routine, each with an UNDO clause: the innermost first."""
    inner, outer = undone
    return (
        f"MODULE job\n  {data}\n  PROC main()\n    n := n + 1;\n    inner;\n  UNDO\n    {outer}\n"
        f"  ENDPROC\n  PROC inner()\n    {body}\n  UNDO\n    {inner}\n  ENDPROC\nENDMODULE\n"
    )


INNER, OUTER = 'done := done + "inner ";', 'done := done + "outer ";'
WAITS = program("WaitTime 10;", INNER, OUTER)


@pytest.fixture
def stopped() -> Live:
    live = Live(WAITS)
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    live.after(0.1)
    assert (live.controller.executes, live.value("done")) == (False, '""')
    return live


def test_a_stop_leaves_no_routine_and_the_program_goes_on(stopped: Live) -> None:
    stopped.controller.start()
    stopped.after(20.0)
    assert stopped.value("done") == '""'
    assert stopped.value("n") == "3"


def test_the_pointer_set_to_main_runs_the_clauses_the_innermost_first(stopped: Live) -> None:
    stopped.controller.reset_pointers()
    assert stopped.value("done") == '"inner outer "'
    assert stopped.value("n") == "1"
    stopped.controller.start()
    stopped.after(1.0)
    assert (stopped.value("n"), stopped.controller.executes) == ("2", True)


def test_the_pointer_set_to_a_routine_runs_them_too(stopped: Live) -> None:
    stopped.controller.put_pointer("T_ROB1", "", "inner")
    assert stopped.value("done") == '"inner outer "'


def test_they_run_once(stopped: Live) -> None:
    stopped.controller.reset_pointers()
    stopped.controller.reset_pointers()
    assert stopped.value("done") == '"inner outer "'


def test_power_that_is_switched_off_runs_none(stopped: Live) -> None:
    stopped.controller.switch_off()
    assert stopped.value("done") == '""'


@pytest.mark.parametrize("how", [how for how in StopMode if how is not StopMode.CYCLE])
def test_whatever_has_stopped_the_robot_on_its_way(how: StopMode) -> None:
    turn = "MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v50, fine, tool0;"
    live = Live(program(turn, INNER, OUTER))
    live.controller.start()
    live.after(1.0)
    live.controller.stop(how)
    live.after(30.0)
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'


def test_after_the_end_of_main_there_is_nothing_to_undo() -> None:
    live = Live(program("WaitTime 1;", INNER, OUTER))
    live.controller.start()
    live.controller.stop(StopMode.CYCLE)
    live.after(2.0)
    assert not live.controller.executes
    live.controller.reset_pointers()
    assert live.value("done") == '""'


@pytest.mark.parametrize("instruction", ["Stop;", "Break;"])
def test_after_an_instruction_that_stops(instruction: str) -> None:
    live = Live(program(instruction, INNER, OUTER))
    live.controller.start()
    live.after(1.0)
    assert (live.controller.executes, live.value("done")) == (False, '""')
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'


@pytest.mark.parametrize(
    "ending",
    [
        "n := 1/(n-n);",
        "VelSet 0*n, 100;",
        "MoveAbsJ [[400,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v50, fine, tool0;",
    ],
)
def test_after_an_error_that_has_ended_the_program(ending: str) -> None:
    live = Live(program(ending, INNER, f"SetDO doDone, 1; WaitTime 1; {OUTER}"))
    live.controller.start()
    live.after(1.0)
    assert (live.controller.executes, live.value("done")) == (False, '""')
    begin_s = live.controller.now_s
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'
    assert live.controller.cell.signals.read("doDone") == 1.0
    assert live.controller.now_s == pytest.approx(begin_s + 1.0)
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'


def test_what_a_handled_error_has_left_is_over() -> None:
    data = f"{DATA} VAR num zero;"
    body = "caught; WaitTime 1; n := 1/zero;"
    caught = (
        "  PROC caught()\n    fails;\n  ERROR\n    TRYNEXT;\n  ENDPROC\n"
        '  PROC fails()\n    n := 1/zero;\n  UNDO\n    done := done + "never ";\n  ENDPROC\n'
    )
    text = program(body, INNER, OUTER, data=data).replace("ENDMODULE", f"{caught}ENDMODULE")
    live = Live(text)
    live.controller.start()
    live.after(2.0)
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'


def test_after_an_error_in_one_the_rest_is_left_out_then_too() -> None:
    live = Live(program("n := 1/(n-n);", f"{INNER} n := 1/(n-n);", OUTER))
    live.controller.start()
    live.after(1.0)
    count = len(live.entries)
    live.controller.reset_pointers()
    assert live.value("done") == '"inner "'
    assert "division by zero" in "".join(one.text for one in live.entries[count:])
    live.controller.start()
    live.after(0.5)


@pytest.mark.parametrize(("steps", "undone"), [(1, "outer "), (2, "inner outer ")])
def test_after_steps_and_without_stepping(steps: int, undone: str) -> None:
    live = Live(WAITS)
    for _ in range(steps):
        live.controller.start(how=ExecutionMode.STEP_IN)
        live.after(1.0)
    assert not live.controller.executes
    live.controller.reset_pointers()
    assert live.value("done") == f'"{undone}"'


def test_a_trap_in_which_the_program_halts_is_left_with_the_routine_that_it_interrupts() -> None:
    text = program("WaitTime 10;", INNER, OUTER, data=f"{DATA} VAR intnum timer;")
    text = text.replace(
        "n := n + 1;", "n := n + 1; CONNECT timer WITH late; ITimer\\Single, 1, timer;"
    )
    trap = '  TRAP late\n    WaitTime 5;\n  UNDO\n    done := done + "trap ";\n  ENDTRAP\nENDMODULE'
    live = Live(text.replace("ENDMODULE", trap))
    live.controller.start()
    live.after(2.0)
    live.controller.stop()
    live.after(0.1)
    live.controller.reset_pointers()
    assert live.value("done") == '"trap inner outer "'


def test_they_set_outputs_and_may_wait_for_a_while() -> None:
    live = Live(program("WaitTime 10;", "WaitTime 2; SetDO doDone, 1;", OUTER))
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    live.after(0.5)
    begin_s = live.controller.now_s
    live.controller.reset_pointers()
    assert live.controller.now_s == pytest.approx(begin_s + 2.0)
    assert live.controller.cell.signals.read("doDone") == 1.0
    assert live.value("done") == '"outer "'


@pytest.mark.parametrize(
    "clause", ["WaitDI diGo, 1;", "WHILE TRUE DO ENDWHILE", "WaitTime 11;", r"WaitTime\InPos, 11;"]
)
def test_no_longer_than_ten_seconds(clause: str) -> None:
    live = Live(program("WaitTime 10;", clause, OUTER))
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    live.after(0.1)
    live.controller.reset_pointers()
    assert live.controller.now_s <= 11.2
    assert live.value("done") == '""'
    assert "UNDO clauses take more than 10 s" in live.entries[-1].text
    live.controller.start()
    live.after(1.0)
    assert live.value("n") == "2"


@pytest.mark.parametrize(
    ("clause", "message"),
    [
        ("n := 1/(n-n);", "division by zero"),
        ("Stop;", "Stop in an UNDO clause"),
        (
            "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v50, fine, tool0;",
            "MoveAbsJ in an UNDO clause",
        ),
    ],
)
def test_an_error_in_one_ends_them_and_is_logged(clause: str, message: str) -> None:
    live = Live(program("WaitTime 10;", clause, OUTER))
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    live.after(0.1)
    live.controller.reset_pointers()
    assert live.value("done") == '""'
    assert message in live.entries[-1].text
    live.controller.start()
    live.after(1.0)
    assert (live.value("n"), live.controller.executes) == ("2", True)


@pytest.mark.parametrize("clause", ["EXIT;", "ExitCycle;"])
def test_a_reset_in_one_leaves_the_rest_out(clause: str) -> None:
    live = Live(program("WaitTime 10;", clause, OUTER))
    live.controller.start()
    live.after(1.0)
    live.controller.stop()
    live.after(0.1)
    live.controller.reset_pointers()
    live.controller.start()
    live.after(1.0)
    assert (live.value("n"), live.value("done")) == ("2", '""')
    assert live.controller.executes


def test_a_breakpoint_halts_none() -> None:
    live = Live(program("Stop;", INNER, OUTER))
    live.controller.task("T_ROB1").breakpoints.add(("job", 7))
    live.controller.start()
    live.after(1.0)
    live.controller.reset_pointers()
    assert live.value("done") == '"inner outer "'
