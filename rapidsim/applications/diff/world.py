"""Positions of targets and work objects in the world, before and after a change."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, cast

import numpy as np

from rapidsim.applications.diff.values import to_rapid
from rapidsim.frames.transform import Transform

_SHOWN_MM = 5e-4


def target_in_world(targets: tuple[object, object], objects: tuple[object, object]) -> str:
    """Describe the motion of a target in the world; "" if it adds no information.

    Args:
        targets: Values of the target, as literals.
        objects: Values of its work object.
    """
    try:
        frames = [_world_from_object(_row(one)) for one in objects]
        places = [_row(_row(one)[0]) for one in targets]
        if any(frame is None for frame in frames):
            return ""
        if all(_is_identity(frame) for frame in frames if frame is not None):
            return ""
        return _moved([f.apply(np.array(p)) for f, p in zip(frames, places, strict=True) if f])
    except (ValueError, TypeError, IndexError):
        # A literal of another type: the check reports it.
        return ""


def object_in_world(objects: tuple[object, object]) -> str:
    """Describe the motion of a work object in the world; "" if its user frame shows it."""
    try:
        rows = [_row(one) for one in objects]
        frames = [_world_from_object(one) for one in rows]
        users = [_frame(one[3]) for one in rows]
        if _row(rows[0][4]) == _row(rows[1][4]) or all(_is_identity(one) for one in users):
            return ""
        return _moved([frame.translation for frame in frames if frame is not None])
    except (ValueError, TypeError, IndexError):
        return ""


def _moved(places: Sequence[Any]) -> str:
    if len(places) != 2:
        return ""
    (a, b), apart = places, places[1] - places[0]
    if math.hypot(*apart) < _SHOWN_MM:
        return ""
    each = ", ".join(
        f"{axis} {d:+.3f}: {_mm(x)} -> {_mm(y)}"
        for axis, d, x, y in zip("xyz", apart, a, b, strict=True)
        if abs(d) >= _SHOWN_MM
    )
    return f"; in the world by {math.hypot(*apart):.3f} mm ({each})"


def _mm(value: float) -> str:
    return to_rapid(round(float(value), 3) + 0.0)


def _world_from_object(wobj: Sequence[Any]) -> Transform | None:
    """Return the pose of a work object; None if a robot holds it, or a unit moves it."""
    held, fixed, _, user, frame = wobj
    if held is not False or fixed is not True:
        return None
    return _frame(user) @ _frame(frame)


def _frame(pose: Sequence[Any]) -> Transform:
    position, quaternion = _row(pose)
    length = math.hypot(*quaternion)
    if length == 0.0:
        raise ValueError
    unit = [part / length for part in quaternion]
    return Transform.from_quaternion(unit, [float(x) for x in position])


def _is_identity(frame: Transform) -> bool:
    return bool(np.allclose(frame.matrix, np.eye(4), atol=1e-9))


def _row(value: object) -> Sequence[Any]:
    if not isinstance(value, tuple | list):
        raise TypeError
    return cast("Sequence[Any]", value)
