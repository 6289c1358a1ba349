"""Programs of a controller that stays on: started, stopped, begun anew, failed."""

from pathlib import Path

import pytest
from live_controller import Live, module

from rapidsim.controller.journal.events import Event
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.live import signals
from rapidsim.simulation.live.states import (
    ControllerState,
    Cycle,
    Motors,
    OperatingMode,
    RequestRefused,
    StopMode,
)
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

COUNTS = module("n := n + 1; k := k + 1; WaitTime 1;", "PERS num n := 0; VAR num k := 0;")
TURNS = module(
    """MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    n := n + 1;""",
    "PERS num n := 0;",
)


def test_nothing_runs_until_it_is_started_and_time_passes_all_the_same() -> None:
    live = Live(COUNTS)
    live.after(5.0)
    assert (live.controller.now_s, live.controller.executes, live.value("n")) == (5.0, False, "0")
    live.controller.start()
    live.after(2.5)
    assert live.controller.executes
    assert live.value("n") == "3"


def test_main_runs_once_or_for_ever_and_a_stop_at_its_end_waits_for_that() -> None:
    live = Live(COUNTS)
    live.controller.start(Cycle.ONCE)
    live.after(3.0)
    assert (live.controller.executes, live.value("n")) == (False, "1")
    live.controller.start(Cycle.FOREVER)
    live.after(1.5)
    live.controller.stop(StopMode.CYCLE)
    assert live.controller.executes
    live.after(1.0)
    assert (live.controller.executes, live.value("n")) == (False, "3")


def test_variables_begin_anew_with_the_pointer_and_persistents_keep_their_values() -> None:
    live = Live(COUNTS)
    live.controller.start()
    live.after(1.5)
    with pytest.raises(RequestRefused, match="executes"):
        live.controller.reset_pointers()
    live.controller.stop()
    # Main runs on from where it stopped: the wait goes on, no round is counted twice.
    live.controller.start()
    live.after(0.1)
    assert (live.value("n"), live.value("k")) == ("2", "2")
    live.controller.stop()
    live.controller.reset_pointers()
    assert (live.value("n"), live.value("k")) == ("2", "0")
    live.controller.start()
    live.after(0.1)
    assert (live.value("n"), live.value("k")) == ("3", "1")


def test_a_stop_brakes_on_the_path_and_a_start_goes_on_to_the_end() -> None:
    live = Live(TURNS)
    live.controller.start(Cycle.ONCE)
    live.after(0.6)
    moving = live.axis_1()
    assert 0.0 < moving < 1.0
    live.controller.stop()
    live.after(1.0)
    stopped = live.axis_1()
    assert moving < stopped < 1.0
    live.after(10.0)
    assert live.axis_1() == stopped
    assert live.value("n") == "0"
    live.controller.start()
    live.after(10.0)
    assert live.axis_1() == pytest.approx(1.0471975512)
    assert live.value("n") == "1"


def test_a_system_output_tells_whether_the_robot_stands() -> None:
    def changes() -> list[tuple[float, str]]:
        return [(one.time_s, one.message) for one in happened if "doStands" in one.message]

    move = "MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;"
    live, happened = Live(module(f"WaitTime 0.5;\n{move}\nWaitTime 1;")), list[Event]()
    live.controller.happened = happened.append
    live.after(1.0)
    live.controller.start(Cycle.ONCE)
    live.after(1.0)
    assert changes() == [(1.5, "doStands = 0")]
    live.controller.stop()
    live.after(1.0)
    (_, (stood_s, stands)) = changes()
    assert stands == "doStands = 1"
    assert 2.0 < stood_s < 2.4
    assert live.axis_1(2.0) < live.axis_1(stood_s - 0.01) < live.axis_1(stood_s) == live.axis_1()
    live.controller.start()
    live.after(0.1)
    live.controller.stop()
    live.controller.reset_pointers()
    live.after(1.0)
    assert [text for _, text in changes()[2:]] == ["doStands = 0", "doStands = 1"]
    live.controller.start(Cycle.ONCE)
    live.after(20.0)
    assert [text for _, text in changes()[4:]] == ["doStands = 0", "doStands = 1"]
    assert changes()[4][0] == pytest.approx(live.controller.now_s - 20.0 + 0.5)


def test_a_stop_after_the_instruction_lets_the_robot_make_its_move() -> None:
    live = Live(TURNS)
    live.controller.start(Cycle.ONCE)
    live.after(0.6)
    live.controller.stop(StopMode.INSTRUCTION)
    live.after(10.0)
    assert not live.controller.executes
    assert live.axis_1() == pytest.approx(1.0471975512)
    assert live.value("n") == "0"


def test_after_a_stop_on_the_way_the_robot_may_begin_anew_from_where_it_stands() -> None:
    live = Live(TURNS)
    live.controller.start()
    live.after(0.6)
    live.controller.stop()
    live.after(1.0)
    stands = live.axis_1()
    live.controller.reset_pointers()
    assert live.axis_1() == stands
    live.controller.start(Cycle.ONCE)
    live.after(0.01)
    assert live.axis_1() <= stands
    live.after(20.0)
    assert live.value("n") == "1"


def test_a_program_stops_itself_and_is_started_again_behind_the_stop() -> None:
    live = Live(module("n := 1; Stop; n := 2; Break; n := 3;", "PERS num n := 0;"))
    live.controller.start(Cycle.ONCE)
    for value in "12":
        live.after(0.1)
        assert (live.controller.executes, live.value("n")) == (False, value)
        live.controller.start()
    live.after(0.1)
    assert live.value("n") == "3"


def test_a_task_that_stops_itself_leaves_the_others_running() -> None:
    going = module("WHILE n < 100 DO WaitTime 0.1; n := n + 1; ENDWHILE", "PERS num n := 0;")
    stopping = module("k := 1; Stop; k := 2; Stop \\AllMoveTasks; k := 3;", "PERS num k := 0;")
    live = Live(going, stopping)
    live.controller.start(Cycle.ONCE)
    live.after(1.05)
    assert (live.value("n"), live.value("k", "T_ROB2")) == ("10", "1")
    # A start lets those continue that are stopped.
    live.controller.start()
    live.after(1.0)
    assert (live.value("n"), live.value("k", "T_ROB2")) == ("10", "2")
    assert not live.controller.executes
    live.controller.start()
    live.after(1.0)
    assert (live.value("n"), live.value("k", "T_ROB2")) == ("20", "3")
    with pytest.raises(RequestRefused, match="executes already"):
        live.controller.start()


def test_an_error_stops_the_program_and_leaves_the_controller_alive() -> None:
    live = Live(module("n := n + 1; n := n / 0;", "PERS num n := 0;"))
    live.controller.start()
    live.after(0.1)
    assert not live.controller.executes
    errors = [entry for entry in live.entries if entry.type == 3]
    assert [entry.code for entry in errors] == [40194, 10020] or len(errors) == 2
    assert "line 4" in errors[0].text
    assert signals.value_of(live.controller, "doFault") == 1.0
    with pytest.raises(RequestRefused, match="pointer is lost"):
        live.controller.start()
    live.controller.reset_pointers()
    assert signals.value_of(live.controller, "doFault") == 0.0
    live.controller.start()
    live.after(0.1)
    assert live.value("n") == "2"


def test_an_error_of_one_task_stops_the_others() -> None:
    live = Live(module("WaitTime 1; n := 1 / n;", "VAR num n := 0;"), COUNTS)
    live.controller.start()
    live.after(5.0)
    assert not live.controller.executes
    assert live.value("n", "T_ROB2") == "1"


def test_tasks_of_the_background_run_whatever_is_started_and_stopped() -> None:
    live = Live(COUNTS, background=module("b := b + 1; WaitTime 1;", "PERS num b := 0;"))
    live.after(2.5)
    assert live.value("b", "T_BACK") == "3"
    live.controller.start()
    live.controller.stop()
    live.controller.reset_pointers()
    live.after(1.0)
    assert live.value("b", "T_BACK") == "4"


def test_a_program_without_an_end_leaves_nothing_behind_of_what_it_did() -> None:
    """A controller that stays on for days would fill up."""
    live = Live(COUNTS, background=module("WHILE TRUE DO WaitTime 0.01; ENDWHILE"))
    live.controller.start()
    journals = [one.journal for one in live.controller.tasks.values()]
    live.after(2.5)
    assert live.value("n") == "3"
    assert [one.noted for one in journals] == [0, 0]


FLY_BY = module(
    """WHILE TRUE DO
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z50, tool0;
        MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z50, tool0;
    ENDWHILE"""
)
RAMPED = TURNS.replace(
    "n := n + 1;", "n := n + 1; AccSet 50 + 10 * (n MOD 4), 30 + 20 * (n MOD 3);"
)


@pytest.mark.parametrize("program", [TURNS, FLY_BY, RAMPED], ids=["stops", "fly-by", "ramps"])
def test_a_robot_that_moves_for_ever_leaves_nothing_behind_of_its_motion(program: str) -> None:
    forgets, keeps = Live(program), Live(program)
    keeps.controller.keeps_all = True
    kept = []
    for seconds in range(1, 81):
        for live in (forgets, keeps):
            if live.controller.now_s in (21.0, 41.0):
                live.controller.stop()
            if not live.controller.executes and live.controller.now_s not in (21.0, 41.0):
                live.controller.start()
            live.after(1.0)
        # What is forgotten changes nothing, to the last bit.
        assert (forgets.axis_1(), forgets.line) == (keeps.axis_1(), keeps.line)
        kept.append(_kept(forgets) if seconds > 14 else 0)
    assert max(kept[54:]) <= 1.5 * max(kept[14:40])
    assert _kept(keeps) > 2 * max(kept)


def test_what_a_program_may_go_back_on_is_not_forgotten() -> None:
    program = module(
        """PathRecStart a;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    FOR i FROM 1 TO 6 DO
        MoveAbsJ [[10*i,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        WaitTime 5;
    ENDFOR
    StopMove;
    StorePath;
    PathRecMoveBwd \\ID:=a;
    RestoPath;
    n := 1;""",
        "VAR pathrecid a;\nPERS num n := 0;",
    )
    live = Live(program)
    live.controller.start(Cycle.ONCE)
    live.after(60.0)
    assert live.value("n") == "1", live.entries
    assert live.axis_1() == pytest.approx(0.0)


def _kept(live: Live) -> int:
    """How much is kept of what the robot did."""
    unit = live.controller.task("T_ROB1").unit
    block, given = unit.queue.block, sum(1 for _ in unit.moves)
    pieces, windows = len(unit.trajectory.pieces), len(unit.trajectory._windows._steps)
    return given + pieces + windows + len(block.moves) + len(block.driven)


def test_motors_off_stop_the_program_and_nothing_starts_without_them() -> None:
    live = Live(TURNS)
    live.controller.start()
    assert signals.value_of(live.controller, "doRuns") == 1.0
    live.after(0.5)
    live.controller.panel.set_motors(Motors.OFF)
    assert not live.controller.executes
    assert signals.value_of(live.controller, "doRuns") == 0.0
    with pytest.raises(RequestRefused, match="motors are off"):
        live.controller.start()
    live.controller.panel.set_motors(Motors.ON)
    live.controller.start()
    assert live.controller.executes
    at_the_start, later = [10017, 10011], [10150, 10125, 10010, 10011, 10151]
    assert [entry.code for entry in live.entries] == [*at_the_start, *later]


def test_the_key_goes_through_reduced_speed_and_switches_the_motors_off() -> None:
    live = Live(COUNTS)
    with pytest.raises(RequestRefused, match="MANR"):
        live.controller.panel.set_mode(OperatingMode.FULL)
    live.controller.panel.set_mode(OperatingMode.REDUCED)
    live.controller.panel.set_mode(OperatingMode.FULL)
    assert live.controller.panel.state is ControllerState.MOTORS_OFF
    with pytest.raises(RequestRefused, match="automatic"):
        live.controller.panel.set_speed_ratio(50)


def test_at_half_the_speed_ratio_a_way_takes_longer() -> None:
    times = []
    for percent in (100, 25):
        live = Live(TURNS)
        live.controller.panel.set_speed_ratio(percent)
        live.controller.reset_pointers()
        live.controller.start(Cycle.ONCE)
        while live.controller.executes:
            live.after(0.05)
        times.append(live.controller.now_s)
    assert times[1] > 2.5 * times[0]


def test_a_program_that_only_computes_lets_itself_be_stopped() -> None:
    live = Live(module("WHILE TRUE DO n := n + 1; ENDWHILE", "VAR num n := 0;"))
    live.controller.start()
    live.after(0.1)
    live.controller.stop()
    assert not live.controller.executes
    counted = live.value("n")
    assert float(counted) > 1000
    live.after(1.0)
    assert live.value("n") == counted


def test_a_robot_that_stopmove_holds_stays_where_it_is_when_the_program_goes_on() -> None:
    body = """MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    CONNECT held WITH hold; ISignalDI diGo, 1, held;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;"""
    live = Live(
        module(body, "VAR intnum held;", "TRAP hold\nStopMove; WaitDI diGo, 0; StartMove;\nENDTRAP")
    )
    live.controller.start(Cycle.ONCE)
    live.after(0.6)
    signals.write(live.controller, "diGo", 1)
    live.after(1.0)
    held = live.axis_1()
    live.controller.stop()
    live.controller.start()
    live.after(1.0)
    assert live.axis_1() == held
    signals.write(live.controller, "diGo", 0)
    live.after(5.0)
    assert live.axis_1() == pytest.approx(1.0471975512)


def test_the_same_acts_at_the_same_times_give_the_same_run_to_the_last_bit() -> None:
    def run(slice_s: float) -> list[object]:
        live = Live(TURNS)
        live.controller.start()
        while live.controller.now_s < 0.7:
            live.after(slice_s)
        live.controller.advance(0.75)
        live.controller.stop()
        live.controller.advance(1.5)
        live.controller.start()
        live.controller.advance(9.0)
        return [live.axis_1(), live.value("n"), live.entries]

    assert run(0.05) == run(0.35)


NOTES = r"""MODULE notes
  PERS string heard := "";
  VAR intnum wrong;
  VAR iodev log;
  PROC main()
    CONNECT wrong WITH note;
    IError COMMON_ERR, TYPE_ERR, wrong;
    Open "HOME:" \File:="notes.txt", log \Write;
    WHILE TRUE DO
      WaitTime 0.1;
      Write log, "still here";
    ENDWHILE
  ENDPROC
  TRAP note
    VAR trapdata cause;
    VAR errdomain domain;
    VAR num id;
    VAR errtype kind;
    VAR string first;
    GetTrapData cause;
    ReadErrData cause, domain, id, kind \Str1:=first;
    heard := heard + NumToStr(10000*domain+id, 0) + " " + first + ";";
  ENDTRAP
ENDMODULE
"""


def test_a_task_of_the_background_hears_of_what_stops_another(tmp_path: Path) -> None:
    # The task itself runs no trap any more.
    fails = 'ErrWrite "Gripper", "lost"; WaitTime 1; n := 1 / n;'
    live = Live(module(fails, "PERS num n := 0;"), background=NOTES, home=tmp_path)
    live.after(0.1)
    live.controller.start(Cycle.ONCE)
    live.after(0.5)
    assert live.value("heard", "T_BACK") == '"80001 lost;"'
    live.after(1.0)
    assert not live.controller.executes
    assert live.value("heard", "T_BACK") == '"80001 lost;40194 T_ROB1;"'


def test_the_pointer_to_main_closes_the_files_of_its_task_only(tmp_path: Path) -> None:
    # A task may have a hundred files open.
    opens = 'Open "HOME:" \\File:="own.txt", own \\Write; Stop;'
    live = Live(module(opens, "VAR iodev own;"), background=NOTES, home=tmp_path)
    for _ in range(101):
        live.controller.start(Cycle.ONCE)
        live.after(0.1)
        live.controller.reset_pointers()
    assert [one.text for one in live.entries if one.type == 3] == []
    assert live.controller.task("T_BACK").executes


def test_a_program_of_a_team_that_is_served_alone_moves_as_in_a_run() -> None:
    live = Live(
        module("MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\ID:=10,v200,fine,tool0;")
    )
    live.controller.start(Cycle.ONCE)
    live.after(5.0)
    assert live.axis_1() == pytest.approx(0.34906585)


def test_a_controller_that_is_dropped_leaves_other_programs_as_deep_a_stack() -> None:
    text = module("again 1;", more="PROC again(num n)\nagain n + 1;\nENDPROC")
    found = load([SourceFile("tried.mod", text, "utf-8")])
    assert found.program is not None

    def stopped_on_the_way(calls: int) -> Live:
        if calls:
            return stopped_on_the_way(calls - 1)
        live = Live(COUNTS)
        live.controller.start()
        live.after(2.5)
        return live

    ended = simulate(found.program, load_robot("irb1600"), options=RunOptions())
    assert "the stack overflowed" in str(ended.diagnostics)
    dropped = stopped_on_the_way(100)
    assert (
        simulate(found.program, load_robot("irb1600"), options=RunOptions()).time_s == ended.time_s
    )
    assert dropped.controller.executes
