"""Cycles that repeat are planned once, and nobody can tell from the run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.plan_cache import PlanCache
from rapidsim.jobs.running.run_files import simulate
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.interruption import Look
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path as MotionPath
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.results.simulation import Simulation

CYCLES = """MODULE cycles
  CONST robtarget a:=[[800,-200,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[750,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum beat;
  VAR num beats;
  PROC main()
    ConfL\\Off;
    ConfJ\\Off;
    CONNECT beat WITH tick;
    FOR n FROM 1 TO 6 DO
      MoveJ a,v1000,z20,tool0;
      MoveL b,v500,fine,tool0;
      IF n=3 AccSet 50,100;
      IF n=4 ITimer\\Single,0.3,beat;
      MoveC Offs(b,20,0,30),Offs(b,0,-40,60),v200,z5,tool0;
      MoveL b,v500\\T:=1.5,fine,tool0;
      SetDO doGrip,n MOD 2;
      WaitTime 0.1;
    ENDFOR
  ENDPROC
  TRAP tick
    Incr beats;
    StopMove;
    StartMove;
  ENDTRAP
ENDMODULE
"""
STATION = '[signals]\ndoGrip = { type = "do" }\n'


def ran(folder: Path) -> Simulation:
    (folder / "cycles.mod").write_text(CYCLES)
    (folder / "rapidsim.toml").write_text(STATION)
    return simulate([folder / "cycles.mod"], robot="irb1600")


def test_the_last_thousand_plans_are_kept_and_no_more() -> None:
    # A controller that stays on, and whose robot is stopped anywhere, plans new ones for ever.
    repeats, made = PlanCache(), list[int]()

    def ask(number: int) -> None:
        def make() -> Any:
            made.append(number)
            return SimpleNamespace(parts=(SimpleNamespace(segments=()),)), None

        repeats.plan([()], number, make)

    for number in range(3000):
        ask(number)
    assert made == list(range(3000))
    made.clear()
    for number in range(2000, 3000):
        ask(number)
    assert made == []
    ask(1999)
    assert made == [1999]


def test_a_run_that_keeps_plans_is_the_run_that_makes_each(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = ran(tmp_path)
    monkeypatch.setattr(PlanCache, "plan", lambda self, segments, start, make: make())
    monkeypatch.setattr(
        Resolver,
        "resolve",
        lambda self, *asked, **options: self._resolved(*asked, **options),
    )
    made = ran(tmp_path)
    assert kept.end is made.end
    assert [str(one) for one in kept.events] == [str(one) for one in made.events]
    assert [one.message for one in kept.diagnostics] == [one.message for one in made.diagnostics]
    assert [_times(move) for move in kept.moves] == [_times(move) for move in made.moves]
    assert kept.only.path_m == made.only.path_m
    at = np.linspace(0.0, kept.time_s, 500)
    one, other = kept.only.trajectory.at(at), made.only.trajectory.at(at)
    assert np.array_equal(one.joints, other.joints)
    assert np.array_equal(one.move, other.move)


def _times(move: ExecutedMove) -> tuple[object, ...]:
    return move.index, move.start_s, move.end_s, move.corner, move.zone_m, move.length_m


@pytest.fixture
def planned(monkeypatch: pytest.MonkeyPatch) -> list[Robot]:
    """The arm of each block that is planned."""
    planned: list[Robot] = []

    def counted(
        robot: Robot, segments: Sequence[Segment], model: MotionModel, look: Look
    ) -> MotionPath | PathFault:
        planned.append(robot)
        return build_path(robot, segments, model, look)

    monkeypatch.setattr("rapidsim.motion.path.shared_building.build_path", counted)
    return planned


def test_only_what_is_new_is_planned(tmp_path: Path, planned: list[Robot]) -> None:
    cycles = CYCLES.replace("IF n=3 AccSet 50,100;", "").replace(
        "IF n=4 ITimer\\Single,0.3,beat;", ""
    )
    (tmp_path / "rapidsim.toml").write_text(STATION)
    (tmp_path / "cycles.mod").write_text(cycles.replace("TO 6", "TO 30"))
    run = simulate([tmp_path / "cycles.mod"], robot="irb1600")
    assert len(run.moves) == 120
    # The first round begins elsewhere, and the arm needs a round to come back to the same bits.
    assert len(planned) < 10


PALLET = """MODULE pallet
  CONST robtarget a:=[[800,-200,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[750,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfL\\Off;
    ConfJ\\Off;
    FOR layer FROM 1 TO 3 DO
      FOR x FROM 1 TO 4 DO
        FOR y FROM 1 TO 10 DO
          MoveJ a,v5000,fine,tool0;
          MoveJ Offs(b,5*x,5*y,0),v5000,fine,tool0;
        ENDFOR
      ENDFOR
    ENDFOR
  ENDPROC
ENDMODULE
"""


def test_a_pallet_of_many_places_is_planned_once(tmp_path: Path, planned: list[Robot]) -> None:
    (tmp_path / "pallet.mod").write_text(PALLET)
    run = simulate([tmp_path / "pallet.mod"], robot="irb1600")
    assert len(run.moves) == 240
    # To each place and back, and the way from where the arm starts.
    assert len(planned) == 81
