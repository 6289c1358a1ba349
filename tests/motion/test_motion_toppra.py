"""Another solver finds the same time, on the same rows and the same grid."""

from __future__ import annotations

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path as File
from types import ModuleType

import numpy as np
import pytest
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.motion.grid import cells_of
from rapidsim.motion.problem import problem_of
from rapidsim.motion.segments import Speed
from rapidsim.motion.solver import solve


@pytest.fixture(scope="module")
def planning() -> ModuleType:
    """The benchmark that drives the other solver."""
    pytest.importorskip("toppra", reason="toppra is not installed")
    file = File(__file__).parents[2] / "benchmarks" / "planning.py"
    spec = spec_from_file_location("planning", file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("speed", [0.3, 1.0, 7.0])
@pytest.mark.parametrize("seed", range(10))
def test_another_solver_finds_the_same_time(seed: int, speed: float, planning: ModuleType) -> None:
    random = np.random.default_rng(seed)
    program = Programmer(speed=Speed(speed, 1e3))
    for _ in range(4):
        offset, turn = random.uniform(-0.08, 0.08, 3), random.uniform(-0.1, 0.1, 3)
        program.line(offset.tolist(), turn.tolist(), zone(20))
    path = path_of(program)
    cells = cells_of(path, LIMITS, 0.0)
    # Speeds at the middles of cells are our own addition; they are taken away for comparison.
    start, middle, end = cells.at.T
    for values in (cells.places.rates.first, cells.places.rates.tcp_rate):
        values[middle] = 0.5 * np.minimum(np.abs(values[start]), np.abs(values[end]))
    theirs = planning.toppra_duration(path, LIMITS, cells)
    x, _ = solve(problem_of(path, cells, LIMITS, np.full(len(path.segments), np.nan)), 0.0)
    speeds = np.sqrt(x)
    ours = float((2.0 * cells.width / (speeds[1:] + speeds[:-1])).sum())
    assert ours == pytest.approx(theirs, rel=1e-4)
