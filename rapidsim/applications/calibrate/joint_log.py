"""Read the joint angles that a controller logged while it ran a program."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rapidsim.files import InputError, input_text
from rapidsim.frames.transform import Array
from rapidsim.values import value_class

_TIME = re.compile(r"(time|t|timestamp|tm)(_?(s|sec|ms))?", re.IGNORECASE)
_JOINT = re.compile(r"(?:rob1_|r1_)?(?:j|joint|q|axis|rax)_?(\d)(?:_?(deg|rad))?", re.IGNORECASE)
_MILLISECONDS = ("ms", "tm")
"""Endings of names of times in ms; EGM calls its own `tm`."""
_SEPARATORS = re.compile(r"[;,\t]")
_FEWEST_ROWS = 10


@value_class(frozen=True, slots=True, eq=False)
class JointLog:
    """Logged joint angles with ascending times."""

    name: str
    times: Array
    """Shape (k,) [s], from an arbitrary zero."""
    joints: Array
    """Shape (k, n) [rad]."""


def read_joint_log(file: Path, axes: int) -> JointLog:
    """Read a CSV file of times and joint angles.

    With a header, the columns named `time` (or `time_s`, `time_ms`, `t`, `timestamp`, and `tm` for
    the milliseconds of EGM) and `j1` to `jn` (or `joint_1`, `q1`, `axis1`, `rax_1`) are read in any
    order, as abb-motion-program-exec and EGM clients write them; without one, the first columns are
    the time in seconds and the angles. Angles are in degrees, or in radians if names end with
    `_rad`. Comma, semicolon and tab separate. Of rows with equal time and pose, which EGM repeats
    if nothing has changed, the first counts.

    Args:
        file: The CSV file.
        axes: Number of axes of the arm.

    Raises:
        InputError: If the file cannot be read, a column is missing, a value is no finite number,
            times do not ascend, or there are fewer than 10 rows. The message names the line.
    """
    text = input_text(file)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    if not lines:
        raise InputError(f"{file} is empty")
    first = _cells(lines[0][1])
    titled = any(_number(cell) is None for cell in first)
    columns, unit_s, in_radians = (
        _columns(file, first, axes) if titled else (list(range(axes + 1)), 1.0, False)
    )
    rows: list[list[float]] = []
    numbers: list[int] = []
    for number, line in lines[titled:]:
        row = _row(file, number, line, columns)
        if not rows or row != rows[-1]:
            rows.append(row)
            numbers.append(number)
    if len(rows) < _FEWEST_ROWS:
        raise InputError(f"{file} has {len(rows)} rows; at least {_FEWEST_ROWS} are needed")
    table = np.array(rows)
    back = np.flatnonzero(np.diff(table[:, 0]) <= 0.0)
    if len(back):
        number = numbers[int(back[0]) + 1]
        raise InputError(f"{file}:{number}: the time does not ascend")
    joints = table[:, 1:] if in_radians else np.radians(table[:, 1:])
    return JointLog(file.name, table[:, 0] * unit_s, joints)


def _columns(file: Path, titles: Sequence[str], axes: int) -> tuple[list[int], float, bool]:
    """Columns of time and joints, the unit of time [s], and whether angles are in radians."""
    names = [title.lower().lstrip("# ") for title in titles]
    times = [i for i, name in enumerate(names) if _TIME.fullmatch(name)]
    joints: dict[int, int] = {}
    radians = []
    for i, name in enumerate(names):
        if found := _JOINT.fullmatch(name):
            joints.setdefault(int(found[1]), i)
            radians.append(found[2] == "rad")
    wanted = range(1, axes + 1)
    missing = [f"j{axis}" for axis in wanted if axis not in joints]
    if not times or missing:
        lacks = "time" if not times else ", ".join(missing)
        raise InputError(
            f"{file}:1: no column is called {lacks}",
            f"the header must name time and j1 to j{axes}, angles in degrees",
        )
    unit_s = 1e-3 if names[times[0]].endswith(_MILLISECONDS) else 1.0
    return [times[0], *(joints[axis] for axis in wanted)], unit_s, all(radians)


def _row(file: Path, number: int, line: str, columns: Sequence[int]) -> list[float]:
    cells = _cells(line)
    if len(cells) <= max(columns):
        raise InputError(
            f"{file}:{number}: {len(cells)} columns, at least {max(columns) + 1} are needed"
        )
    row = []
    for column in columns:
        value = _number(cells[column])
        if value is None or not math.isfinite(value):
            raise InputError(f"{file}:{number}: `{cells[column]}` is not a finite number")
        row.append(value)
    return row


def _cells(line: str) -> list[str]:
    return [cell.strip().strip('"') for cell in _SEPARATORS.split(line)]


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
