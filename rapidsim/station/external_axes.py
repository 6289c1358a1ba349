"""The tables [[external_axis]]: tracks, positioners and other axes in addition to the arm's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated

from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import AboveZero, Valid
from rapidsim.motion.configurations.targets import MM
from rapidsim.motion.robot.external_axes import LETTERS, Carried, ExternalAxis
from rapidsim.station.declared_tables import ReadBy, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_FRAME_KEYS = ("position", "quaternion")
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


def read_frame(reader: Reader, table: Table, path: str) -> Transform:
    """Read a frame [mm] as a transform [m]; the identity if it is missing."""
    reader.note_unknown_keys(path, table, _FRAME_KEYS)
    position = reader.numbers(table, path, "position", 3) or (0.0, 0.0, 0.0)
    quaternion = reader.numbers(table, path, "quaternion", 4) or (1.0, 0.0, 0.0, 0.0)
    length = math.hypot(*quaternion)
    if abs(length - 1.0) > 1e-2:
        reader.wrong(f"{path}.quaternion", f"its length is {length:.4g}, not 1")
        return Transform.identity()
    return Transform.from_quaternion(quaternion, [x * MM for x in position])


def _frame(reader: Reader, table: Table, path: str, key: str) -> Transform:
    return read_frame(reader, reader.table(table, key, f"{path}.{key}"), f"{path}.{key}")


def _is_direction(direction: Sequence[float]) -> bool:
    return math.hypot(*direction) >= 1e-6


@value_class(frozen=True, slots=True)
class AxisTable:
    """A table [[external_axis]]; lengths are in mm, angles in degrees."""

    name: str | None = None
    axis: str | None = None
    kind: str | None = None
    limits: Annotated[
        tuple[float, float] | None,
        Valid(lambda pair: pair[0] < pair[1], "the first must be below the second"),
    ] = None
    speed: AboveZero | None = None
    acceleration: AboveZero | None = None
    start: float = 0.0
    carries: Carried | None = None
    direction: Annotated[
        tuple[float, float, float] | None,
        Valid(_is_direction, "a direction must not be all zeros"),
    ] = None
    frame: Annotated[Transform | None, ReadBy(_frame)] = None


def _read_axis(
    reader: Reader,
    path: str,
    table: Table,
    acceleration_time: float,
    fallback: ExternalAxis | None,
) -> ExternalAxis | None:
    found = AxisTable(**values_of(reader, AxisTable, table, path))
    letter, kind, limits, speed = found.axis, found.kind, found.limits, found.speed
    acceleration, carries, direction = found.acceleration, found.carries, found.direction
    if fallback is not None:
        letter, of_known = fallback.letter, "linear" if fallback.linear else "rotational"
        fallback, kind = (fallback if kind in (None, of_known) else None), kind or of_known
    if fallback is None:
        reader.require(path, table, ("name", "axis", "kind", "limits", "speed"))
    letter = _one_of(reader, f"{path}.axis", letter, tuple(LETTERS), "none of a, b, c, d, e, f")
    kind = _one_of(
        reader, f"{path}.kind", kind, tuple(_DIRECTIONS), "neither `linear` nor `rotational`"
    )
    frame = found.frame
    if fallback is not None:
        scale = _unit(linear=fallback.linear)
        limits = limits or (fallback.lower / scale, fallback.upper / scale)
        acceleration = acceleration or fallback.max_acceleration / scale
        speed, direction = speed or fallback.max_speed / scale, direction or fallback.direction
        carries = carries if "carries" in table else fallback.carries
        frame = frame or fallback.world_from_user
    if found.name is None or letter is None or kind is None or limits is None or speed is None:
        return None
    linear = kind == "linear"
    scale = _unit(linear=linear)
    return ExternalAxis(
        unit=found.name,
        letter=letter,
        linear=linear,
        lower=limits[0] * scale,
        upper=limits[1] * scale,
        max_speed=speed * scale,
        max_acceleration=(acceleration or speed / acceleration_time) * scale,
        start=found.start * scale,
        carries=carries,
        direction=direction or _DIRECTIONS[kind],
        world_from_user=frame or Transform.identity(),
    )


def _one_of(
    reader: Reader, path: str, text: str | None, words: tuple[str, ...], problem: str
) -> str | None:
    if text is None or text in words:
        return text
    reader.wrong(path, f"`{text}` is {problem}")
    return None


def _unit(*, linear: bool) -> float:
    """The unit of the file [m or rad]."""
    return MM if linear else math.radians(1.0)


def _refuse_twice(reader: Reader, letters: Sequence[str]) -> None:
    for letter in sorted(set(letters)):
        if letters.count(letter) > 1:
            reader.wrong("external_axis", f"axis `{letter}` is declared twice")
