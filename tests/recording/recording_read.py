"""Recordings read back from their files, and the runs that they are of."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from changed_run import with_robot
from recording_cell import cell
from rerun.chunk import RrdReader

from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.findings.reach_and_motion_data import PathNotReachable, UnreachableTarget
from rapidsim.simulation.results.simulation import Simulation

SIMULATION = cell()


def rows(path: Path, entity: str) -> Iterator[tuple[float | None, dict[str, Any]]]:
    """Time [s] (None where static) and components of each row of an entity, in order of time."""
    found: list[tuple[float | None, dict[str, Any]]] = []
    for chunk in RrdReader(path).stream().filter(content=entity):
        batch = chunk.to_record_batch()
        names = [name for name in batch.schema.names if name != "sim_time"]
        # Nanoseconds, which Python's own time spans would cut to microseconds.
        times = (
            [None] * batch.num_rows
            if chunk.is_static
            else [ns / 1e9 for ns in batch.column("sim_time").cast("int64").to_pylist()]
        )
        found += zip(times, batch.select(names).to_pylist(), strict=True)
    return iter(sorted(found, key=lambda item: -1.0 if item[0] is None else item[0]))


def texts(path: Path, entity: str, component: str) -> list[str]:
    return [row[component][0] for time, row in rows(path, entity) if row.get(component)]


def failed_run() -> Simulation:
    """A target that cannot be reached and a way that fails half-way."""
    moves = SIMULATION.moves
    far, way = moves[1], moves[2]
    start, end = far.base_from_tcp.translation, way.base_from_tcp.translation
    return with_robot(
        SIMULATION,
        failed_moves=(
            FailedMove(
                far.place,
                UnreachableTarget("p1", "ABB IRB 1600", "wrist centre 47.2 mm beyond reach"),
                far.base_from_tcp,
                start[None],
                start,
            ),
            FailedMove(
                way.place,
                PathNotReachable("p2", 50.0, 120.0, "axis 3 goes 8.0 deg past its limit"),
                way.base_from_tcp,
                np.stack([start, end]),
                0.5 * (start + end),
            ),
        ),
    )
