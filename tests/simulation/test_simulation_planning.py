"""Planning is tentative: somebody who looks ahead after every move changes nothing.

Two programs that differ only in when they are planned are the same to the last bit; what is fixed
early because an interrupt may come is compared in `test_simulation_cells.py`.
"""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from simulation_program import arm, ran
from test_simulation_cells import CELLS
from test_simulation_cells import ran as ran_cell

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.task_moves import TaskMoves
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.moves import Move
from rapidsim.module_files import read_tasks
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate

PROGRAMS = sorted((Path(__file__).parents[2] / "programs").glob("*.mod"))
STEP_S = 0.01
TIMED = """MODULE cell
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget d:=[[800,-200,800],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum beat;
  PROC main()
    CONNECT beat WITH tick;
    ITimer 0.1,beat;
    MoveJ a,v500,fine,tool0;
    MoveL b,v1000,%s,tool0;
    MoveL c,v100,%s,tool0;
    MoveL d,v50,fine,tool0;
  ENDPROC
  TRAP tick
  ENDTRAP
ENDMODULE
"""
THROUGH_ITSELF = """MODULE cell
  CONST robtarget front:=[[600,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget side:=[[600,300,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget behind:=[[-600,250,700],[0,0,1,0],[1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ front,v500,fine,tool0;
    MoveL side,v200,z10,tool0;
    MoveL behind,v200,z10,tool0;
    SetDO doAhead,1;
    MoveL side,v200,z10,tool0;
    MoveL front,v200,fine,tool0;
  ENDPROC
ENDMODULE
"""


def ran_program(file: Path) -> Simulation:
    """Run a program of `programs/` on the default arm."""
    (task,) = read_tasks([str(file)])
    program = load(task.files).program
    assert program is not None
    return simulate(program, arm(), options=RunOptions(max_time_s=60.0))


def findings_of(run: Simulation) -> list[tuple[str, str, int]]:
    return [(d.violation.code, d.violation.message, d.span.line) for d in run.diagnostics if d.span]


def look_ahead_always(monkeypatch: pytest.MonkeyPatch) -> list[QueuedMove]:
    """Let every task preview its motion after each move from now on; the moves so far."""
    put = TaskMoves.put
    looked_at: list[QueuedMove] = []

    def looking(
        self: TaskMoves, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True
    ) -> None:
        def and_look(queued: QueuedMove) -> None:
            before(queued)
            looked_at.append(queued)
            with suppress(MotionError):
                self.unit.preview()

        put(self, move, and_look, wait=wait)

    monkeypatch.setattr(TaskMoves, "put", looking)
    return looked_at


def assert_same(plain: Simulation, looked: Simulation) -> None:
    assert looked.end is plain.end
    assert findings_of(looked) == findings_of(plain)
    times = np.arange(0.0, plain.time_s, STEP_S)
    assert np.array_equal(plain.only.sample(times).joints, looked.sample(times).joints)
    assert [(e.time_s, e.message) for e in plain.events] == [
        (e.time_s, e.message) for e in looked.events
    ]
    for a, b in zip(plain.moves, looked.moves, strict=True):
        assert (a.start_s, a.end_s, a.corner, a.zone_m) == (b.start_s, b.end_s, b.corner, b.zone_m)


@pytest.mark.parametrize("file", [*CELLS, *PROGRAMS], ids=lambda file: file.stem)
def test_looking_ahead_after_every_move_changes_nothing(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = ran_cell if file in CELLS else ran_program
    plain = run(file)
    looked_at = look_ahead_always(monkeypatch)
    assert_same(plain, run(file))
    assert len(looked_at) >= len(plain.moves)


@pytest.mark.parametrize("seconds", [0.0, 0.15, 3.0])
def test_looking_ahead_while_the_robot_is_under_way_changes_nothing(
    seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After a wait part of the path is travelled; the last of them makes a corner path failure."""
    text = TIMED % ("z50", "z50")
    text = text.replace("    MoveL d", f"    WaitTime {seconds};\n    MoveL d")
    plain = ran(text).run
    looked_at = look_ahead_always(monkeypatch)
    assert_same(plain, ran(text).run)
    assert len(looked_at) == len(plain.moves)


@pytest.mark.parametrize("zones", [("z1", "z1"), ("z50", "z50"), ("z100", "z1")])
def test_turning_back_and_going_on_slowly_is_no_corner_path_failure(
    zones: tuple[str, str],
) -> None:
    """At b the TCP turns on the spot, a place without a speed of its own to slow down from."""
    done = ran(TIMED % zones)
    assert [move.corner for move in done.run.moves[1:3]] == [CornerKind.FLY_BY] * 2
    assert not done.findings


def test_a_move_that_fails_is_found_when_it_must_be_and_not_by_looking(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plain = ran(THROUGH_ITSELF).run
    assert [(line, code[0]) for code, _, line in findings_of(plain)] == [(8, "K")]
    look_ahead_always(monkeypatch)
    assert_same(plain, ran(THROUGH_ITSELF).run)
