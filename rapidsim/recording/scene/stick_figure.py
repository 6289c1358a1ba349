"""A bar with a ball at its foot: the drawing of links without shapes."""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.recording import palette

_SHORTEST = 1e-3
"""Length [m] below which joints coincide and have no bar between them."""


def log_bar(stream: rr.RecordingStream, entity: str, frame: str, end: Array, radius: float) -> None:
    """Log a ball at the origin of a frame and a bar from there to `end` (3,) [m] in that frame."""
    stream.log(
        f"{entity}/ball",
        rr.CoordinateFrame(frame),
        rr.Ellipsoids3D(
            half_sizes=[[1.25 * radius] * 3],
            colors=palette.rgba(palette.JOINT),
            fill_mode=rr.components.FillMode.Solid,
        ),
        static=True,
    )
    length = float(np.linalg.norm(end))
    if length < _SHORTEST:
        return
    stream.log(
        f"{entity}/bar",
        rr.CoordinateFrame(frame),
        rr.Capsules3D(
            lengths=[length],
            radii=[radius],
            quaternions=[z_to(end / length)],
            colors=palette.rgba(palette.LINK),
            fill_mode=rr.components.FillMode.Solid,
        ),
        static=True,
    )


def z_to(direction: Array) -> list[float]:
    """Return a rotation, scalar last, that maps the z axis to a unit vector (3,)."""
    x, y, z = (float(component) for component in direction)
    if z < -1.0 + 1e-9:
        return [1.0, 0.0, 0.0, 0.0]
    q = np.array([-y, x, 0.0, 1.0 + z])
    unit: list[float] = (q / np.linalg.norm(q)).tolist()
    return unit
