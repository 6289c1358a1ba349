"""Writer of the motion of a run as a table: CSV, JSON or Parquet, by file suffix.

`.ros.json` writes a ROS joint trajectory instead (`joint_trajectory`).

Numbers are rounded (`table.DECIMALS`), so that files of two machines are equal but for ties, and
each format reads back as the same doubles. Angles are in degrees, lengths in mm; the TCP is in the
robot's base frame, quaternions have the scalar first.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import repeat
from pathlib import Path
from types import MappingProxyType

import numpy as np

from rapidsim.export.joint_trajectory import SUFFIX as JOINT_TRAJECTORY
from rapidsim.export.joint_trajectory import write_joint_trajectory
from rapidsim.export.table import (
    DEFAULT_DT,
    RowBlock,
    belt_columns,
    block,
    blocks,
    columns,
    rounded,
    table_widths,
)
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.output_files import whole_file
from rapidsim.simulation.results.simulation import Simulation

Writer = Callable[[Path, tuple[str, ...], Iterator[RowBlock]], None]


def write_trace(simulation: Simulation, path: str | Path, dt: float = DEFAULT_DT) -> Path:
    """Write a trace.

    Args:
        simulation: The run.
        path: The file to write; its suffix determines the format.
        dt: Time [s] between rows.

    Returns:
        The path written.

    Raises:
        InputError: For an unknown suffix, an invalid `dt`, or a path that cannot be written.
    """
    if Path(path).name.lower().endswith(JOINT_TRAJECTORY):
        return write_joint_trajectory(simulation, Path(path), dt)
    names = (*columns(*table_widths(simulation)), *belt_columns(simulation))
    if len(simulation.robots) > 1:
        names = (*names, "task")
    return _write(Path(path), names, blocks(simulation, dt))


def write_samples(samples: Samples, path: str | Path, convention: Convention) -> Path:
    """Write samples of a motion in the trace format, with Euler angles of the tool orientation.

    The extra columns are the last ones, with names by convention, such as `rz_deg`. See
    `write_trace`.
    """
    names = (
        *columns(samples.joints.shape[1]),
        *(f"{name}_deg" for name in convention.names),
    )
    angles = rounded(np.degrees(euler_from_rotation(samples.base_from_tcp.rotation, convention)))
    plain = block(samples)
    return _write(Path(path), names, iter([replace(plain, numbers=(*plain.numbers, *angles.T))]))


def _write(path: Path, names: tuple[str, ...], rows: Iterator[RowBlock]) -> Path:
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        known = ", ".join(WRITERS)
        raise InputError(
            f"cannot determine the format of the trace `{path}` from its suffix",
            f"use one of {known}",
        )
    with whole_file(path) as temporary:
        writer(temporary, names, rows)
    return path


def _write_csv(path: Path, names: tuple[str, ...], rows: Iterator[RowBlock]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(",".join(names) + "\n")
        for block in rows:
            file.writelines(",".join(row) + "\n" for row in _texts(block))


def _write_json(path: Path, names: tuple[str, ...], rows: Iterator[RowBlock]) -> None:
    """Write an array of one object per row, one row per line."""
    keys = [f'"{name}":' for name in names]
    with path.open("w", encoding="utf-8", newline="") as file:
        separator = "[\n"
        for block in rows:
            for row in _texts(block):
                values = zip(keys, map(_json_value, keys, row), strict=True)
                fields = ",".join(key + text for key, text in values)
                file.write(f"{separator}{{{fields}}}")
                separator = ",\n"
        file.write("\n]\n")


def _write_parquet(path: Path, names: tuple[str, ...], rows: Iterator[RowBlock]) -> None:
    require("pyarrow", "a trace as Parquet")
    from rapidsim.export.parquet import write_parquet  # noqa: PLC0415 - Optional package.

    write_parquet(path, names, rows)


def _texts(block: RowBlock) -> Iterator[tuple[str, ...]]:
    """Yield the fields of rows; `repr` of a float is the shortest text that reads back equal."""
    count = len(block.move)
    time_s, *rest = (
        repeat("", count) if column is None else map(repr, column.tolist())
        for column in block.numbers
    )
    task = () if block.task is None else (repeat(block.task, count),)
    return zip(time_s, map(str, block.move), *rest, *task, strict=True)


def _json_value(key: str, text: str) -> str:
    return json.dumps(text) if key == '"task":' else text or "null"


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {".csv": _write_csv, ".parquet": _write_parquet, ".json": _write_json}
)
