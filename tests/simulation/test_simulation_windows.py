"""A long block is planned some thousand moves at a time, and nobody can tell."""

from __future__ import annotations

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path as FilePath
from types import ModuleType

import pytest

from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.timing.planning import plan


def benchmark() -> ModuleType:
    """The benchmark that plans as a run does."""
    file = FilePath(__file__).parents[2] / "benchmarks" / "planning.py"
    spec = spec_from_file_location("planning", file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    # Its dataclasses look their module up.
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(("window", "speed"), [(60, 0.5), (150, 0.1)])
def test_planning_in_windows_takes_the_same_time(
    window: int, speed: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    planning = benchmark()
    robot = load_robot(planning.ROBOT)
    segments = planning.print_moves(robot, 400, speed)
    path = build_path(robot, segments, MotionModel())
    assert isinstance(path, Path)
    at_once = plan(path, limits_of(robot, MotionModel())).duration
    monkeypatch.setattr(planning, "MAX_OPEN_MOVES", window)
    assert planning.plan_as_a_run(robot, segments) == pytest.approx(at_once, rel=1e-4)
