"""A run as seen by those who look at it while it is under way: an answer is a moment to look."""

from __future__ import annotations

import numpy as np
import pytest
from simulation_program import arm

from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.progress import MoveCounter, Progress, RunInProgress
from rapidsim.simulation.robot_state import RobotState, robot_state
from rapidsim.simulation.simulate import run_tasks
from rapidsim.simulation.task_run import TaskSetup

PROGRAM = r"""MODULE watched
  TASK PERS tooldata grip := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget p1 := [[700,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2 := [[700,100,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n;
  PROC main()
    TPReadNum n,"start";
    MoveJ p1,v1000,fine,grip;
    TPReadNum n,"there";
    FOR i FROM 1 TO 2 DO
      MoveL p2,v200,z50,grip;
      MoveL p1,v200,fine,grip;
    ENDFOR
    MoveL p2,v200\T:=4,fine,grip\WObj:=wobj0;
    TPReadNum n,"end";
  ENDPROC
ENDMODULE
"""


class Watcher:
    """Looks at the run at each question."""

    def __init__(self) -> None:
        self.run: RunInProgress | None = None
        self.counter: MoveCounter | None = None
        self.progress: dict[str, Progress] = {}
        self.states: dict[str, RobotState] = {}

    def watch(self, run: RunInProgress) -> None:
        self.run, self.counter = run, run.progress

    def answer(self, prompt: str) -> str:
        assert self.run is not None
        assert self.counter is not None
        said = prompt.split()[0]
        self.progress[said] = self.counter()
        self.states[said] = robot_state(self.run.current)
        return "1"


@pytest.fixture(scope="module")
def watcher() -> Watcher:
    loaded = load([SourceFile("watched.mod", PROGRAM, "utf-8")])
    assert loaded.program is not None
    found = Watcher()
    setup = TaskSetup("T_ROB1", loaded.program, arm())
    run_tasks([setup], RunOptions(answers=found.answer), found.watch)
    return found


def test_progress_counts_moves_and_the_statements_that_made_them(watcher: Watcher) -> None:
    start, there, end = (watcher.progress[one] for one in ("start", "there", "end"))
    assert (start.moves, start.places, start.planned) == (0, 0, 0)
    assert (there.moves, there.places, there.planned) == (1, 1, 0)
    assert (end.moves, end.places, end.planned) == (6, 4, 0)
    assert [one.place.line if one.place else 0 for one in (start, there, end)] == [7, 9, 15]
    assert start.time_s == 0.0 < there.time_s < end.time_s


def test_the_state_is_that_of_the_robot_at_the_statement(watcher: Watcher) -> None:
    start, there, end = (watcher.states[one] for one in ("start", "there", "end"))
    for state in (start, there, end):
        assert state.tcp_speed_mm_s == pytest.approx(0.0, abs=1e-6)
    assert start.move is None
    assert there.move is None
    # The robot follows the command, which is at its end, with a delay.
    assert end.move is not None
    assert end.move.span.line == 14
    assert start.time_s == 0.0
    assert np.degrees(arm().start) == pytest.approx(start.joints.robax[:6], abs=1e-4)
    assert (there.tool, there.wobj) == ("grip", "wobj0")
    assert tuple(there.target.trans) == pytest.approx((700.0, -200.0, 700.0), abs=1e-3)
    assert tuple(end.target.trans) == pytest.approx((700.0, 100.0, 700.0), abs=1e-3)
    assert end.time_s - there.time_s > 4.0
