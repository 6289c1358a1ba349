"""Reader of points in a table: a header that names columns, one line per point, mm and degrees.

The result is `Points` in m and rad. Every error is reported with file, line and column.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from math import isfinite

import numpy as np

from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.euler import Convention, rotation_from_euler
from rapidsim.frames.transform import Array, quaternion_from_matrix
from rapidsim.motion.waypoints.points import Points

MOST_POINTS = 20_000
LARGEST = 1e12
"""Largest magnitude of a number, so that its cube is finite."""
_PLACE = ("x", "y", "z")
_QUATERNION = ("q1", "q2", "q3", "q4")
_EULER = ("e1", "e2", "e3")
_PITCH, _KNOT, _TIME = "pitch", "knot", "time"
_ATTITUDES = (
    ("a quaternion", _QUATERNION, "a quaternion has q1 to q4, the scalar first"),
    ("Euler angles", _EULER, "Euler angles are e1, e2, e3, in the order of --convention"),
    ("a pitch", (_PITCH,), ""),
)
"""Forms of the attitude: name, columns, and the help if a column is missing."""
_OF_JOINT = re.compile(r"[va][1-9]")
_UNIT = re.compile(r"_(mm|deg|s|deg_s|deg_s2)$")
_UNIT_TOLERANCE = 1e-3
_KNOWN = (
    "x, y, z in mm; q1 to q4, or e1 to e3 or pitch in degrees; knot; time in s; v1, v2, ... in "
    "deg/s; a1, "
)


def points_from_text(
    text: str, file: str, joint_count: int, convention: Convention = Convention.ZYX
) -> Points:
    """Read the text of a table.

    Args:
        text: Lines; empty ones and comments that begin with `#` are ignored.
        file: File name in messages.
        joint_count: Number of joints of the arm, for speeds and accelerations at the points.
        convention: Convention of the Euler angles e1, e2, e3.

    Raises:
        InputError: If something is missing, unknown, or not a number.
    """
    lines = [
        (number, line)
        for number, line in enumerate(text.splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError(f"{file} is empty", "the first line names the columns: x,y,z")
    header_line, header = lines[0]
    delimiter = next((mark for mark in (";", "\t") if mark in header), ",")
    names = _names(header, header_line, delimiter, file, joint_count)
    if len(lines) - 1 > MOST_POINTS:
        raise InputError(f"{file} has {len(lines) - 1} points; at most {MOST_POINTS} are followed")
    if len(lines) == 1:
        raise InputError(f"{file} has no points, only a header")
    rows = [
        _row(fields, number, names, file)
        for (number, _), fields in zip(
            lines[1:], csv.reader((line for _, line in lines[1:]), delimiter=delimiter), strict=True
        )
    ]
    columns = dict(zip(names, np.array(rows).T, strict=True))
    numbers = [number for number, _ in lines[1:]]
    attitudes = _attitudes(columns, numbers, file, convention)
    for rising in (_KNOT, _TIME):
        if rising in columns:
            _check_rising(columns[rising], rising, numbers, file)
    return Points(
        positions=np.stack([columns[name] for name in _PLACE], axis=1) / 1000.0,
        attitudes=attitudes,
        knots=columns.get(_KNOT),
        times=columns.get(_TIME),
        speeds=_radians(columns, [f"v{joint}" for joint in range(1, joint_count + 1)]),
        accelerations=_radians(columns, [f"a{joint}" for joint in range(1, joint_count + 1)]),
    )


def _attitudes(
    columns: Mapping[str, Array], lines: Sequence[int], file: str, convention: Convention
) -> Array | None:
    quaternions = _stacked(columns, _QUATERNION)
    if quaternions is not None:
        _check_unit(quaternions, lines, file)
        unit: Array = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)
        return unit
    angles = _radians(columns, _EULER)
    if angles is not None:
        return quaternion_from_matrix(rotation_from_euler(angles, convention))
    return _radians(columns, (_PITCH,))


def _stacked(columns: Mapping[str, Array], names: Sequence[str]) -> Array | None:
    """Columns as an array (k, n); None if the first of them is missing."""
    if names[0] not in columns:
        return None
    return np.stack([columns[name] for name in names], axis=1)


def _radians(columns: Mapping[str, Array], names: Sequence[str]) -> Array | None:
    degrees = _stacked(columns, names)
    return None if degrees is None else np.radians(degrees)


def _names(header: str, line: int, delimiter: str, file: str, joint_count: int) -> tuple[str, ...]:
    """Return the columns without units."""
    where = f"{file}:{line}"
    fields = [field.strip().strip('"').lower() for field in header.split(delimiter)]
    if all(_is_number(field) for field in fields):
        raise InputError(
            f"{where}: the first line must name the columns", "such as x,y,z or x,y,z,q1,q2,q3,q4"
        )
    names = tuple(_UNIT.sub("", field) for field in fields)
    known = (*_PLACE, *_QUATERNION, *_EULER, _PITCH, _KNOT, _TIME)
    for name in names:
        if name not in known and not _OF_JOINT.fullmatch(name):
            help = did_you_mean(name, known) or f"columns are {_KNOWN}a2, ... in deg/s2"
            raise InputError(f"{where}: there is no column `{name}`", help)
        if names.count(name) > 1:
            raise InputError(f"{where}: column `{name}` appears twice")
    _need(where, names, _PLACE, "a point has x, y and z")
    _require_one_attitude(where, names)
    for letter, what in (("v", "speeds"), ("a", "accelerations")):
        given = [name for name in names if re.fullmatch(f"{letter}[1-9]", name)]
        wanted = tuple(f"{letter}{joint}" for joint in range(1, joint_count + 1))
        beyond = [name for name in given if name not in wanted]
        if beyond:
            raise InputError(f"{where}: column `{beyond[0]}`: the arm has {joint_count} joints")
        if given:
            _need(where, names, wanted, f"{what} are given for all {joint_count} joints")
    return names


def _require_one_attitude(location: str, names: Sequence[str]) -> None:
    """Require that the attitude of points is complete, and given in one form at most."""
    given: list[str] = []
    for form, wanted, help in _ATTITUDES:
        if any(name in names for name in wanted):
            _need(location, names, wanted, help)
            given.append(form)
    if len(given) > 1:
        raise InputError(
            f"{location}: there are both {' and '.join(given)}", "leave one of them out"
        )


def _need(location: str, names: Sequence[str], wanted: Sequence[str], help: str) -> None:
    for name in wanted:
        if name not in names:
            raise InputError(f"{location}: column `{name}` is missing", help)


def _row(fields: Sequence[str], line: int, names: Sequence[str], file: str) -> list[float]:
    if len(fields) != len(names):
        raise InputError(
            f"{file}:{line}: {len(fields)} fields, but the header names {len(names)} columns"
        )
    return [_number(field, name, line, file) for field, name in zip(fields, names, strict=True)]


def _number(field: str, name: str, line: int, file: str) -> float:
    text = field.strip()
    if not _is_number(text):
        what = f"`{text}` is not a number" if text else "there is no number"
        help = "write the decimal point as `.`" if "," in text else None
        raise InputError(f"{file}:{line}: column `{name}`: {what}", help)
    number = float(text)
    if abs(number) > LARGEST:
        raise InputError(f"{file}:{line}: column `{name}`: {text} is beyond {LARGEST:g}")
    return number


def _is_number(text: str) -> bool:
    try:
        return isfinite(float(text))
    except ValueError:
        return False


def _check_unit(quaternions: Array, lines: Sequence[int], file: str) -> None:
    length = np.linalg.norm(quaternions, axis=1)
    wrong = np.flatnonzero(np.abs(length - 1.0) > _UNIT_TOLERANCE)
    if len(wrong):
        first = int(wrong[0])
        raise InputError(
            f"{file}:{lines[first]}: the quaternion has length {length[first]:.4g}, not 1",
            "the scalar part comes first, as RAPID writes it",
        )


def _check_rising(values: Array, name: str, lines: Sequence[int], file: str) -> None:
    wrong = np.flatnonzero(np.diff(values) <= 0.0)
    if len(wrong):
        row = int(wrong[0]) + 1
        raise InputError(
            f"{file}:{lines[row]}: column `{name}`: {values[row]:g} follows {values[row - 1]:g}",
            "it must rise from point to point",
        )
