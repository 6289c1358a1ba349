"""A run whose only robot did something else."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.simulation.results.simulation import Simulation


def with_robot(run: Simulation, **changes: Any) -> Simulation:
    """The same run with other values of fields of its only robot; `moves` may be a tuple."""
    if "moves" in changes:
        changes["moves"] = moves_of(changes["moves"])
    return replace(run, robots=(replace(run.only, **changes),))
