"""A run that is cut off says where the program was."""

import sys
from collections import deque
from dataclasses import replace
from threading import Thread
from threading import enumerate as threads
from time import monotonic, thread_time
from types import SimpleNamespace

import numpy as np
import pytest

from rapidsim.analysis.passes.checker import check
from rapidsim.controller import task_moves
from rapidsim.controller.cell.watchdog import Watchdog
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import WallLimitReached
from rapidsim.diagnostics import Source
from rapidsim.files import InputError
from rapidsim.motion import numba_jit
from rapidsim.motion.numba_jit import COMPILING
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing import two_pass_loops
from rapidsim.report.run.figures import figures
from rapidsim.simulation import task_run
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.simulate import simulate
from rapidsim.syntax.parser import parse

LOOPS = {
    "busy": "n:=n+1;",
    "waiting": "WaitTime 1;",
    "moving": "MoveJ p,v500,fine,tool0; MoveJ Offs(p,0,50,0),v500,fine,tool0;",
    "flying by": "MoveL p,v500,z10,tool0; MoveL Offs(p,0,50,0),v500,z10,tool0;",
}
TEXT = """MODULE endless
  CONST robtarget p:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;
  PROC main()
    MoveJ p,v500,fine,tool0;
    again;
  ENDPROC
  PROC again()
    WHILE TRUE DO
      {body}
    ENDWHILE
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("body", LOOPS.values(), ids=LOOPS.keys())
def test_the_note_stands_in_the_loop_that_does_not_end(
    body: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The program never waits: this decides how far it gets before the clock does. How a block is
    # cut where it gets too long is looked at in the tests of queues and windows.
    monkeypatch.setattr(task_moves, "MAX_OPEN_MOVES", 100)
    source = Source("endless.mod", TEXT.format(body=body))
    program = check((parse(source).file,)).program
    assert program is not None
    run = simulate(program, load_robot("irb1600"), options=RunOptions(max_time_s=4.0))
    assert run.end is End.TIME_LIMIT
    assert run.time_s == pytest.approx(4.0)
    (note,) = [d for d in run.diagnostics if d.violation.code == "R109"]
    assert note.span is not None
    assert note.span.line in (9, 10)
    assert note.routine == "again"
    assert [related.span.line for related in note.related] == [6]


@pytest.mark.parametrize("limit_s", [0.3, 1.0, 2.0])
def test_what_the_arm_would_do_after_the_limit_is_not_counted(limit_s: float) -> None:
    source = Source("slow.mod", TEXT.format(body="MoveL Offs(p,0,400,0),v50,fine,tool0;"))
    program = check((parse(source).file,)).program
    assert program is not None
    run = simulate(program, load_robot("irb1600"), options=RunOptions(max_time_s=limit_s))
    assert run.time_s == limit_s
    assert run.motion_s + run.wait_s == pytest.approx(limit_s)
    # The arm brakes where it is when the limit comes, and the smoothing is seen to its end.
    assert run.only.trajectory.duration < limit_s + 0.5
    assert run.moves[-1].end_s < limit_s + 0.5
    assert figures(run).sensitivity == ()
    whole = simulate(program, load_robot("irb1600"), options=RunOptions(max_time_s=6.0))
    before_s = limit_s - run.model.window - 0.05
    cut, longer = (one.sample(before_s).joints for one in (run.only, whole))
    assert np.allclose(cut, longer, rtol=0.0, atol=1e-12), "the same way up to the limit"


def test_a_run_cut_off_by_the_computers_clock_is_drawn_to_its_end() -> None:
    # Then nobody plans any more how the robot comes to rest: its trajectory goes on to the target.
    source = Source("slow.mod", TEXT.format(body="MoveL Offs(p,0,400,0),v10,fine,tool0;"))
    program = check((parse(source).file,)).program
    assert program is not None
    run = simulate(program, load_robot("irb1600"), options=RunOptions(max_time_s=30.0))
    assert run.only.trajectory.duration > 29.0
    cut = replace(run, time_s=1.0)
    assert cut.motion_end_s < 7.0
    margin = figures(cut).joint_margin
    assert margin is not None
    assert margin.time_s < 7.0


@pytest.mark.parametrize("work", ["fatal_finding", "impossible_move_finding", "motion_finding"])
def test_a_limit_that_comes_while_the_end_is_worked_out_ends_the_run(
    work: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Behind the error handling of a thousand calls, the clock did so between error and result.
    statement = {
        "fatal_finding": "n:=1/0*n;",
        "impossible_move_finding": "MoveJ Offs(p,9000,0,0),v500,fine,tool0;",
        "motion_finding": "MoveL Offs(p,-1600,0,0),v500,fine,tool0;",
    }[work]

    def interrupted(*_: object) -> None:
        raise WallLimitReached("the run was cut off")

    monkeypatch.setattr(task_run, work, interrupted)
    source = Source("ends.mod", TEXT.format(body=statement))
    program = check((parse(source).file,)).program
    assert program is not None
    run = simulate(program, load_robot("irb1600"), options=RunOptions())
    assert run.end is End.TIME_LIMIT
    assert run.diagnostics[-1].violation.code == "R109"


def test_many_moves_end_a_run_earlier_because_they_must_still_be_reported() -> None:
    journal = Journal("T_ROB1", moves_given=1_000_000)
    watchdog = Watchdog(100.0, lambda: journal.noted)
    with pytest.raises(WallLimitReached):
        deque(iter(watchdog.check, NotImplemented), 0)
    # Without the moves, nothing would have ended the run so early.
    assert watchdog.left_s > 0.0


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has the time of a single thread")
def test_other_work_of_the_computer_does_not_shorten_a_run() -> None:
    watchdog = Watchdog(None, lambda: 0, work_s=0.1)

    def work() -> None:
        while thread_time() < 0.2:
            pass

    other = Thread(target=work)
    other.start()
    other.join()
    # Nor does the size of its program.
    with watchdog.loading():
        begun_s = thread_time()
        while thread_time() < begun_s + 0.2:
            pass
    watchdog.check()
    with pytest.raises(WallLimitReached, match=r"cut off after 0\.1 s of processor time"):
        deque(iter(watchdog.check, NotImplemented), 0)
    watchdog.rest()


def test_numba_is_not_interrupted_while_it_compiles() -> None:
    watchdog = Watchdog(0.02, lambda: 0)
    begun_s, has_compiled = monotonic(), False
    with pytest.raises(WallLimitReached):  # noqa: PT012
        try:
            with COMPILING:
                # Longer than the watchdog's patience, without a look.
                while monotonic() < begun_s + 1.3:
                    pass
                has_compiled = True
            # Anything else is interrupted, wherever it is.
            while monotonic() < begun_s + 5.0:
                pass
        finally:
            # At once: a second later the watchdog would interrupt pytest.
            watchdog.is_needed = False
    assert has_compiled


def test_a_run_that_cannot_begin_leaves_no_watchdog(monkeypatch: pytest.MonkeyPatch) -> None:
    """It interrupted what the process did a minute later, again and again."""

    def fail(*_: object) -> None:
        raise InputError("there is no such arm")

    monkeypatch.setattr("rapidsim.simulation.simulate.prepare", fail)
    program = check((parse(Source("m.mod", TEXT.format(body=LOOPS["busy"]))).file,)).program
    assert program is not None
    with pytest.raises(InputError):
        simulate(program, load_robot("irb1600"), options=RunOptions(max_wall_s=60.0))
    watchdogs = [one for one in threads() if "max-wall" in one.name]
    for one in watchdogs:
        one.join(10.0)
    assert not any(one.is_alive() for one in watchdogs)


def test_a_function_compiles_under_the_lock(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    held = []

    class Dispatcher:
        def compile(self, types: object) -> None:
            # Taken by this thread already: another one does not get it.
            other = Thread(target=lambda: held.append(COMPILING.acquire(blocking=False)))
            other.start()
            other.join()

    dispatcher = Dispatcher()
    fake = SimpleNamespace(njit=lambda *_, **__: dispatcher)
    monkeypatch.setattr(
        numba_jit, "import_module", lambda name: fake if name == "numba" else motion
    )
    motion = two_pass_loops
    numba_jit._functions.__wrapped__(two_pass_loops)
    dispatcher.compile(())
    assert held == [False]
