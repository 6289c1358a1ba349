"""Rotation rates of a trajectory between points, compared with linear quaternion interpolation."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.waypoints.curves import StraightLine
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.motion.waypoints.plan import Refused, Way, tcp_motion
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class AttitudeRates:
    """Rotations since the previous point and their rates, at each sample."""

    angle: Array
    """Shape (k,) [rad]."""
    rate: Array
    """Shape (k,) [rad/s]."""
    linear_angle: Array | None
    """Shape (k,) [rad] for linear interpolation of quaternions, normalised; None unless the path
    between two attitudes is a line."""
    linear_rate: Array | None


def attitude_rates(followed: FollowedTrajectory) -> AttitudeRates:
    """Return the rotation rates of a trajectory."""
    samples = followed.samples
    begins = np.flatnonzero(np.diff(samples.move, prepend=-1))
    first = begins[np.searchsorted(begins, np.arange(len(samples.times)), side="right") - 1]
    quaternions = samples.base_from_tcp.quaternion
    angle = _between(quaternions[first], quaternions)
    step = _between(quaternions[:-1], quaternions[1:])
    rate = np.zeros_like(angle)
    rate[1:] = step / np.diff(samples.times)
    linear = _linear(followed)
    if linear is None:
        return AttitudeRates(angle, rate, None, None)
    blended = np.zeros_like(angle)
    blended[1:] = _between(linear[:-1], linear[1:]) / np.diff(samples.times)
    # The end of one section and the start of the next are both at the point.
    return AttitudeRates(angle, rate, _between(linear[first], linear), blended)


def _linear(followed: FollowedTrajectory) -> Array | None:
    """Return quaternions (k, 4) along the lines with their profiles, interpolated linearly."""
    attitudes = followed.attitudes
    if followed.plan.kind is not Way.LINE or attitudes.shape[1] != 4:
        return None
    motion = tcp_motion(followed.points, attitudes, followed.plan)
    assert not isinstance(motion, Refused)
    samples = followed.samples
    blended = np.empty((len(samples.times), 4))
    starts = motion.starts
    row = np.clip(
        np.searchsorted(starts, samples.times, side="right") - 1, 0, len(motion.curves) - 1
    )
    for number, curve in enumerate(motion.curves):
        at = np.flatnonzero(row == number)
        if not isinstance(curve, StraightLine):
            return None
        share = motion.laws[number].at(samples.times[at] - starts[number])[:, :1] / curve.length
        start, end = curve.start_attitude, curve.end_attitude
        end = -end if float(start @ end) < 0.0 else end
        mixed = (1.0 - share) * start + share * end
        blended[at] = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)
    return blended


def _between(a: Array, b: Array) -> Array:
    """Return angles (k,) [rad] between quaternions (k, 4)."""
    sign = np.where(np.sum(a * b, axis=-1, keepdims=True) < 0.0, -1.0, 1.0)
    chord = np.linalg.norm(b * sign - a, axis=-1)
    rest = np.linalg.norm(b * sign + a, axis=-1)
    angle: Array = 4.0 * np.arctan2(chord, rest)
    return angle
