"""Whole cells with their stimuli: what happens when, on one axis of time.

Each program of `cells/` says in a comment what must happen; the file beside it that ends in
`.events` holds what does. `UPDATE_GOLDEN=1 pytest` writes them anew; read the difference before you
keep it. The motion model is pinned, and times may differ by as much as planning has been improved.
"""

import os
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from simulation_program import arm

from rapidsim.controller import task_moves
from rapidsim.controller.cell.description import CellIo
from rapidsim.controller.motion import TaskMotion
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.data import RobTarget
from rapidsim.module_files import read_tasks
from rapidsim.motion.model import MODELS
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate
from rapidsim.station.read import read_io

CELLS = sorted((Path(__file__).parent / "cells").glob("*.mod"), key=lambda file: file.name)
ANSWERS = ("Part", "4", "2", "Leave")
PLANNING_S = 0.02
"""How much a better plan may change the times of these cells."""
MODEL = replace(MODELS["1"], acceleration=tuple(np.radians([950, 1000, 1060, 2000, 2500, 2800])))
CYCLES = {"endless": 3}


def ran(file: Path) -> Simulation:
    """Run a cell on the default arm, with the stimuli beside it and its operator."""
    (task,) = read_tasks([str(file)])
    program = load(task.files).program
    assert program is not None
    stimuli = file.with_suffix(".toml")
    answers = iter(ANSWERS)
    options = RunOptions(
        io=read_io(stimuli) if stimuli.exists() else CellIo(),
        answers=lambda prompt: next(answers, None),
        max_cycles=CYCLES.get(file.stem, 1),
        model=MODEL,
        max_time_s=60.0,
    )
    return simulate(program, arm(), options=options)


ran_once = cache(ran)
"""The run that tests share as long as none changes what runs it."""


def events_of(run: Simulation) -> list[str]:
    """What happened, a line each; times in milliseconds."""
    lines = [
        f"{event.time_s:8.3f}  {event.place.span.line if event.place else '-':>2}  "
        f"{event.kind.value:9}  {event.message}"
        for event in run.events
    ]
    return [*lines, f"{run.time_s:8.3f}  {run.end.value}"]


@pytest.mark.parametrize("file", CELLS, ids=lambda file: file.stem)
def test_events_come_when_they_should(file: Path) -> None:
    golden = file.with_suffix(".events")
    events = events_of(ran_once(file))
    if os.environ.get("UPDATE_GOLDEN"):
        golden.write_text("\n".join(events) + "\n", encoding="utf-8")
    expected = golden.read_text(encoding="utf-8").splitlines()
    assert [line[8:] for line in events] == [line[8:] for line in expected]
    late = [float(a[:8]) - float(b[:8]) for a, b in zip(events, expected, strict=True)]
    assert max(map(abs, late)) <= PLANNING_S


@pytest.mark.parametrize("file", CELLS, ids=lambda file: file.stem)
def test_moves_planned_one_at_a_time_give_the_same(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lazy, again = ran_once(file), ran(file)
    assert [event.time_s for event in lazy.events] == [event.time_s for event in again.events]
    assert np.array_equal(lazy.only.trajectory.joints, again.trajectory.joints)
    monkeypatch.setattr(task_moves, "MAX_OPEN_MOVES", 0)
    eager = ran(file)
    assert [event.message for event in lazy.events] == [event.message for event in eager.events]
    times = np.array([[event.time_s for event in run.events] for run in (lazy, eager)])
    assert np.max(np.abs(times[0] - times[1]), initial=0.0) < 2e-3
    assert eager.time_s == pytest.approx(lazy.time_s, abs=2e-3)


@pytest.mark.parametrize("file", CELLS, ids=lambda file: file.stem)
def test_where_the_program_sees_the_robot_is_where_it_is(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[tuple[float, RobTarget]] = []
    ask = TaskMotion.current_target

    def current_target(self: TaskMotion, *frames: object) -> RobTarget:
        target = ask(self, *frames)  # type: ignore[arg-type]
        seen.append((self.clock.now(), target))
        return target

    monkeypatch.setattr(TaskMotion, "current_target", current_target)
    run = ran(file)
    for time_s, target in seen:
        there = run.only.robot.forward(run.only.sample(time_s).joints).translation[0]
        assert np.linalg.norm(there - 1e-3 * np.array(target.trans)) < 1e-6
