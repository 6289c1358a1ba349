"""A run whose only robot did something else."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rapidsim.simulation.results.simulation import Simulation


def with_robot(run: Simulation, **changes: Any) -> Simulation:
    """The same run with other values of fields of its only robot."""
    return replace(run, robots=(replace(run.only, **changes),))
