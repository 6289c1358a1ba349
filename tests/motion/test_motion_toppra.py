"""Another solver finds the same time, on the same rows and the same grid."""

from __future__ import annotations

import sys
from dataclasses import replace
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path as FilePath
from types import ModuleType

import numpy as np
import pytest
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MODELS
from rapidsim.motion.timing.discretisation import cells_of
from rapidsim.motion.timing.problem import problem_of

UNSMOOTHED = replace(MODELS["1"], filter_time=0.0)
FULL = replace(LIMITS, zone_share=np.ones(6))
"""Limits that know nothing of zones, as the other solver's."""


@pytest.fixture(scope="module")
def planning() -> ModuleType:
    """The benchmark that drives the other solver."""
    pytest.importorskip("toppra", reason="toppra is not installed")
    file = FilePath(__file__).parents[2] / "benchmarks" / "planning.py"
    spec = spec_from_file_location("planning", file)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    # Its dataclasses look their module up.
    sys.modules[spec.name] = module
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
    path = path_of(program, UNSMOOTHED)
    cells = cells_of(path, FULL, 0.0)
    theirs = planning.toppra_duration(path, FULL, cells)
    problem = problem_of(path, cells, FULL)
    ours = float(planning.drive_on_cells(problem).times.sum())
    assert ours == pytest.approx(theirs, rel=1e-4)
