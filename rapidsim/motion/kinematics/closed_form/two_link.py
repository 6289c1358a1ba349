"""Triangle of upper arm and forearm, common to all arms with two parallel axes.

Nothing is computed by acos: the elbow follows from the tangent of its half angle, so the stretched
and the folded arm keep full precision and no solution is lost where two of them meet.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array

REACH_TOLERANCE = 1e-9
"""Share of the reach by which a wrist centre may be outside and still count as reached."""


def close_triangle(
    forward: Array, up: Array, upper: float, fore: float, bend: Array
) -> tuple[Array, Array, Array]:
    """Return the angles that move the end of the forearm to a point in the plane of the arm.

    Args:
        forward: Horizontal distance (...) [m] of the point from the shoulder, negative behind it.
        up: Height (...) [m] of the point above the shoulder.
        upper: Length [m] of the upper arm.
        fore: Length [m] of the forearm.
        bend: 1 where the forearm turns forward from the upper arm, -1 where backward.

    Returns:
        The angle (...) [rad] of the upper arm from vertical, the angle (...) [rad] by which the
        forearm turns from it, both positive forward, and the distance (...) [m] of the point from
        the ring that the arm reaches. Outside, the arm points at it, stretched or folded.
    """
    distance = np.hypot(forward, up)
    # Products, not differences of squares, so that the stretched elbow keeps its digits.
    short_of_stretched = (upper + fore - distance) * (upper + fore + distance)
    beyond_folded = (distance - abs(upper - fore)) * (distance + abs(upper - fore))
    elbow = (
        2.0
        * bend
        * np.arctan2(
            np.sqrt(np.maximum(short_of_stretched, 0.0)), np.sqrt(np.maximum(beyond_folded, 0.0))
        )
    )
    lean = np.arctan2(forward, up) - np.arctan2(fore * np.sin(elbow), upper + fore * np.cos(elbow))
    outside = np.maximum(distance - (upper + fore), abs(upper - fore) - distance)
    return lean, elbow, np.maximum(outside, 0.0)
