"""The tables [[external_axis]]: tracks, positioners and other axes in addition to the arm's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, Literal

from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import AboveZero, Valid
from rapidsim.motion.configurations.targets import MM
from rapidsim.motion.robot.external_axes import LETTERS, Carried, ExternalAxis
from rapidsim.station.declared_tables import as_record, values_of
from rapidsim.station.frames import Frame
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_DIRECTIONS = {"linear": (1.0, 0.0, 0.0), "rotational": (0.0, 0.0, 1.0)}
"""The direction of an axis without `direction`, by its kind."""


def read_external_axes(
    reader: Reader,
    station: Table,
    acceleration_time: float,
    defaults: Sequence[ExternalAxis] = (),
) -> tuple[ExternalAxis, ...]:
    """Read the tables; errors are collected in the reader.

    Args:
        reader: Reads the file.
        station: Top-level table.
        acceleration_time: Time [s] in which an axis without `acceleration` reaches its speed.
        defaults: The axes of a backup. Those with other letters remain; a key that a table lacks
            has the value of the axis of its unit and, if the table has a letter, of its letter.

    Returns:
        The axes in the order of their letters.
    """
    axes = [
        _read_axis(reader, path, table, acceleration_time, _axis_of(table, defaults))
        for path, table in reader.tables(station, "external_axis")
    ]
    found = [axis for axis in axes if axis is not None]
    _refuse_twice(reader, [axis.letter for axis in found])
    letters = [axis.letter for axis in found]
    found += [axis for axis in defaults if axis.letter not in letters]
    return tuple(sorted(found, key=lambda axis: axis.letter))


def _axis_of(table: Table, defaults: Sequence[ExternalAxis]) -> ExternalAxis | None:
    """Return the axis of a backup that a table describes; None if it describes no such axis."""
    unit, letter = str(table.get("name", "")).lower(), table.get("axis")
    axes = [axis for axis in defaults if axis.unit.lower() == unit]
    if letter is None:
        return axes[0] if len(axes) == 1 else None
    return next((axis for axis in axes if axis.letter == letter), None)


def _is_direction(direction: Sequence[float]) -> bool:
    return math.hypot(*direction) >= 1e-6


@value_class(frozen=True, slots=True)
class AxisTable:
    """A table [[external_axis]]; lengths are in mm, angles in degrees."""

    name: str
    """Name of its mechanical unit."""
    axis: Annotated[
        str, Valid(tuple(LETTERS).__contains__, f"`{{}}` is none of {', '.join(LETTERS)}")
    ]
    """Its letter in `extjoint`."""
    kind: Literal["linear", "rotational"]
    """Whether its unit is mm or degrees."""
    limits: Annotated[
        tuple[float, float],
        Valid(lambda pair: pair[0] < pair[1], "the first must be below the second"),
    ]
    """Lowest and highest position."""
    speed: AboveZero
    """Highest speed, per second."""
    acceleration: AboveZero | None = None
    """Highest acceleration, per s2; None if it reaches its speed in `acceleration_time`."""
    start: float = 0.0
    """Position before the first move."""
    carries: Carried | None = None
    """Object that it moves; None if it moves nothing that targets refer to."""
    direction: Annotated[
        tuple[float, float, float] | None,
        Valid(_is_direction, "a direction must not be all zeros"),
    ] = None
    """Direction of a linear axis or of the axis of rotation, in the world with all axes at zero;
    None for x of a linear axis, else z."""
    frame: Frame | None = None
    """User frame that a positioner carries, with all axes at zero; None for the world."""


def _read_axis(
    reader: Reader,
    path: str,
    table: Table,
    acceleration_time: float,
    backup: ExternalAxis | None,
) -> ExternalAxis | None:
    defaults: dict[str, Any] = {}
    if backup is not None and table.get("kind") != _kind(linear=not backup.linear):
        defaults = _keys_of(backup)
    axis = as_record(AxisTable, values_of(reader, AxisTable, table, path, defaults=defaults))
    if axis is None:
        return None
    scale = _unit(linear=axis.kind == "linear")
    return ExternalAxis(
        unit=axis.name,
        letter=axis.axis,
        linear=axis.kind == "linear",
        lower=axis.limits[0] * scale,
        upper=axis.limits[1] * scale,
        max_speed=axis.speed * scale,
        max_acceleration=(axis.acceleration or axis.speed / acceleration_time) * scale,
        start=axis.start * scale,
        carries=axis.carries,
        direction=axis.direction or _DIRECTIONS[axis.kind],
        world_from_user=axis.frame or Transform.identity(),
    )


def _keys_of(axis: ExternalAxis) -> dict[str, Any]:
    """Return the fields of the table of an axis, except for its name and start."""
    scale = _unit(linear=axis.linear)
    return {
        "axis": axis.letter,
        "kind": _kind(linear=axis.linear),
        "limits": (axis.lower / scale, axis.upper / scale),
        "speed": axis.max_speed / scale,
        "acceleration": axis.max_acceleration / scale,
        "carries": axis.carries,
        "direction": axis.direction,
        "frame": axis.world_from_user,
    }


def _kind(*, linear: bool) -> str:
    return "linear" if linear else "rotational"


def _unit(*, linear: bool) -> float:
    """The unit of the file [m or rad]."""
    return MM if linear else math.radians(1.0)


def _refuse_twice(reader: Reader, letters: Sequence[str]) -> None:
    for letter in sorted(set(letters)):
        if letters.count(letter) > 1:
            reader.wrong("external_axis", f"axis `{letter}` is declared twice")
