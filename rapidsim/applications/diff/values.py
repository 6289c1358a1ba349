"""Differences between two values, in the units of their type: mm, degrees, mm/s.

Each component that differs is named with both values and its unit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, cast

from rapidsim.language.data import UNUSED_AXIS

_KINDS = {
    "robtarget": "target",
    "jointtarget": "target",
    "tooldata": "tool",
    "wobjdata": "work object",
    "loaddata": "load",
    "speeddata": "speed",
    "zonedata": "zone",
}
_CONFIGURATION = ("cf1", "cf4", "cf6", "cfx")
_SPEEDS = (("v_tcp", "mm/s"), ("v_ori", "deg/s"), ("v_leax", "mm/s"), ("v_reax", "deg/s"))


def kind_of(type_name: str) -> str:
    """Return the kind of data of a type, as comparisons name it."""
    return _KINDS.get(type_name, "data")


def difference(type_name: str, old: object, new: object) -> str | None:
    """Describe the change of a value; None if literals do not determine it."""
    if old is None or new is None:
        return None
    try:
        match type_name:
            case "robtarget":
                return _listed(_pose_parts(old, new) + _target_parts(old, new))
            case "jointtarget":
                return _listed(_axes(old, new))
            case "tooldata":
                return _listed(_tool(old, new))
            case "wobjdata":
                return _listed(_work_object(old, new))
            case "loaddata":
                return _listed(_load(_row(old), _row(new)))
            case "pose" | "pos" | "orient":
                return _listed(_frame(type_name, old, new))
            case "speeddata":
                return _listed(_speed(_row(old), _row(new)))
            case "zonedata":
                return _listed(_zone(old, new))
            case _:
                return f"{to_rapid(old)} -> {to_rapid(new)}"
    except (ValueError, TypeError, IndexError):
        # A literal of another type: the check reports it.
        return f"{to_rapid(old)} -> {to_rapid(new)}"


def to_rapid(value: object) -> str:
    """Return a literal in RAPID's notation, truncated if long."""
    match value:
        case bool():
            text = "TRUE" if value else "FALSE"
        case int() | float():
            text = "9E9" if value >= UNUSED_AXIS else f"{value:.9g}"
        case str():
            text = f'"{value}"'
        case tuple() | list():
            text = f"[{','.join(map(to_rapid, value))}]"
        case _:
            text = str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _pose_parts(old: object, new: object) -> list[str]:
    return _moved(_row(old)[0], _row(new)[0]) + _turned(_row(old)[1], _row(new)[1])


def _target_parts(old: object, new: object) -> list[str]:
    told = [
        f"{name} {to_rapid(a)} -> {to_rapid(b)}"
        for name, a, b in zip(_CONFIGURATION, _row(old)[2], _row(new)[2], strict=True)
        if a != b
    ]
    axes = zip("abcdef", _row(old)[3], _row(new)[3], strict=True)
    return told + [
        f"eax_{n} {to_rapid(a)} -> {to_rapid(b)} deg or mm" for n, a, b in axes if a != b
    ]


def _moved(old: Sequence[float], new: Sequence[float], subject: str = "") -> list[str]:
    if tuple(old) == tuple(new):
        return []
    apart = [b - a for a, b in zip(old, new, strict=True)]
    each = ", ".join(
        f"{axis} {d:+.3f}: {to_rapid(a)} -> {to_rapid(b)}"
        for axis, d, a, b in zip("xyz", apart, old, new, strict=True)
        if d
    )
    return [f"{subject}moved by {math.hypot(*apart):.3f} mm ({each})"]


def _turned(old: Sequence[float], new: Sequence[float], subject: str = "") -> list[str]:
    if tuple(old) == tuple(new):
        return []
    lengths = math.hypot(*old) * math.hypot(*new)
    cosine = abs(sum(a * b for a, b in zip(old, new, strict=True))) / lengths
    angle = math.degrees(2.0 * math.acos(min(1.0, cosine)))
    return [f"{subject}turned by {angle:.3f} deg ({to_rapid(old)} -> {to_rapid(new)})"]


def _axes(old: object, new: object) -> list[str]:
    pairs = list(zip(_row(old)[0], _row(new)[0], strict=True))
    # Axis 3 of a SCARA, which has no axes 5 and 6, is prismatic; the text does not name the arm.
    units = {3: "deg or mm"} if pairs[4:] == [(0.0, 0.0)] * 2 else {}
    told = [
        f"axis {n} by {b - a:+.3f} {units.get(n, 'deg')}: {to_rapid(a)} -> {to_rapid(b)}"
        for n, (a, b) in enumerate(pairs, 1)
        if a != b
    ]
    axes = zip("abcdef", _row(old)[1], _row(new)[1], strict=True)
    return told + [
        f"eax_{n} {to_rapid(a)} -> {to_rapid(b)} deg or mm" for n, a, b in axes if a != b
    ]


def _tool(old: object, new: object) -> list[str]:
    (a_held, a_frame, a_load), (b_held, b_frame, b_load) = _row(old), _row(new)
    told = [f"robhold {to_rapid(a_held)} -> {to_rapid(b_held)}"] if a_held != b_held else []
    told += _moved(a_frame[0], b_frame[0], "TCP ") + _turned(a_frame[1], b_frame[1], "TCP ")
    return told + _load(a_load, b_load)


def _load(old: Sequence[Any], new: Sequence[Any]) -> list[str]:
    told = [f"mass {to_rapid(old[0])} -> {to_rapid(new[0])} kg"] if old[0] != new[0] else []
    told += _moved(old[1], new[1], "centre of gravity ")
    told += _turned(old[2], new[2], "axes of moment ")
    moments = zip("xyz", old[3:], new[3:], strict=True)
    return told + [f"i{n} {to_rapid(a)} -> {to_rapid(b)} kgm2" for n, a, b in moments if a != b]


def _work_object(old: object, new: object) -> list[str]:
    a, b = _row(old), _row(new)
    names = ("robhold", "ufprog", "ufmec")
    told = [
        f"{n} {to_rapid(x)} -> {to_rapid(y)}"
        for n, x, y in zip(names, a, b, strict=False)
        if x != y
    ]
    for name, x, y in (("user frame ", a[3], b[3]), ("object frame ", a[4], b[4])):
        told += _moved(x[0], y[0], name) + _turned(x[1], y[1], name)
    return told


def _frame(type_name: str, old: object, new: object) -> list[str]:
    if type_name == "pos":
        return _moved(_row(old), _row(new))
    return _turned(_row(old), _row(new)) if type_name == "orient" else _pose_parts(old, new)


def _speed(old: Sequence[Any], new: Sequence[Any]) -> list[str]:
    rows = zip(_SPEEDS, old, new, strict=True)
    return [f"{n} {to_rapid(a)} -> {to_rapid(b)} {unit}" for (n, unit), a, b in rows if a != b]


def _zone(old: object, new: object) -> list[str]:
    names = ("finep", "pzone_tcp", "pzone_ori", "pzone_eax", "zone_ori", "zone_leax", "zone_reax")
    units = ("", " mm", " mm", " mm", " deg", " mm", " deg")
    rows = zip(names, units, _row(old), _row(new), strict=True)
    return [f"{n} {to_rapid(a)} -> {to_rapid(b)}{u}" for n, u, a, b in rows if a != b]


def _row(value: object) -> Sequence[Any]:
    if not isinstance(value, tuple | list):
        raise TypeError
    return cast("Sequence[Any]", value)


def _listed(parts: Sequence[str]) -> str | None:
    return "; ".join(parts) or None
