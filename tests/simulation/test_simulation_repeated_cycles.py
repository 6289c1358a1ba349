"""Cycles that repeat are planned once, and nobody can tell from the run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue import plan_cache
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


class Requests:
    """A cache, and the blocks that it lets be planned."""

    def __init__(self, segments: int = 1) -> None:
        self.cache, self._made = PlanCache(), list[int]()
        self._row: Any = [SimpleNamespace()] * segments

    def __call__(self, numbers: Iterable[int]) -> list[int]:
        """Those of some blocks that are planned."""
        self._made.clear()
        for number in numbers:
            self.cache.plan([self._row], number, partial(self._plan, number))
        return [*self._made]

    def _plan(self, number: int) -> Any:
        self._made.append(number)
        return SimpleNamespace(parts=(SimpleNamespace(segments=self._row),)), None

    @property
    def kept(self) -> int:
        """The number of plans that there are."""
        return len(self.cache._new._plans) + len(self.cache._repeated._plans)


@pytest.fixture
def _plain(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plan_cache, "_values", lambda segment: 0)


@pytest.mark.usefixtures("_plain")
@pytest.mark.parametrize("segments", [1, 150])
def test_plans_that_nothing_repeats_take_little_memory(segments: int) -> None:
    # A controller that stays on, and whose robot is stopped anywhere, plans new ones for ever.
    requests = Requests(segments)
    sizes = []
    for blocks in (range(12_000), range(12_000, 14_000)):
        assert requests(blocks) == [*blocks]
        assert requests.kept * (segments + 4) <= 6000
        requests.cache.forget()
        sizes.append((requests.kept, len(requests.cache._discarded)))
    assert sizes[0] == sizes[1]
    assert requests.kept * (segments + 4) <= 1500


@pytest.mark.usefixtures("_plain")
def test_plans_that_repeat_are_kept_whatever_comes_between() -> None:
    requests, cycle = Requests(), range(1000)
    assert requests([*cycle, *cycle]) == [*cycle]
    requests.cache.forget()
    assert requests(cycle) == [*range(700)]
    for number in range(3):
        requests(range(2000 + 500 * number, 2500 + 500 * number))
        requests.cache.forget()
        assert requests(cycle) == ([] if number else [*range(700, 1000)])
    few = Requests()
    assert few([*range(200), *range(200)]) == [*range(200)]


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
