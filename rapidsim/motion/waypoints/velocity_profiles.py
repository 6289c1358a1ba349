"""Time laws from rest to rest: four profiles, each within a speed and acceleration.

Every profile reaches exactly the requested speed, unless the curve is too short for it.
"""

from __future__ import annotations

from enum import StrEnum
from math import sqrt

import numpy as np

from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise, integrated

QUINTIC_PEAK_SPEED = 1.875
"""Maximum first derivative of 10 u^3 - 15 u^4 + 6 u^5 on 0..1, at u = 1/2."""
QUINTIC_PEAK_ACCELERATION = 10.0 / sqrt(3.0)
"""Maximum second derivative of that polynomial, at u = 1/2 -+ sqrt(3)/6; 5.7735."""
LONGEST_EASE = 0.3
"""Largest share of the time that the sigmoid may rest at either end."""


class Profile(StrEnum):
    """Shape of the speed over time."""

    TRAPEZOID = "trapezoid"
    """Constant acceleration, constant speed, constant deceleration: fastest, with infinite jerk."""
    SCURVE = "scurve"
    """A trapezoid whose accelerations rise and fall linearly: bounded jerk."""
    SIGMOID = "sigmoid"
    """Two parabolas joined in the middle, with a rest at either end."""
    QUINTIC = "quintic"
    """One polynomial of degree 5: no jump in speed and acceleration anywhere."""


def law(
    profile: Profile, length: float, speed: float, acceleration: float, ease: float = 0.0
) -> Piecewise:
    """Return the position [m] on a curve as a function of time [s].

    Args:
        profile: The shape.
        length: Length of the curve [m]; greater than 0.
        speed: Maximum speed [m/s].
        acceleration: Maximum acceleration [m/s2].
        ease: For the sigmoid, the share of the time at rest at either end, 0 to `LONGEST_EASE`.

    Returns:
        A function with one component, from 0 to `length`, at rest at both ends.
    """
    match profile:
        case Profile.TRAPEZOID:
            reached = min(speed, sqrt(length * acceleration))
            ramp = reached / acceleration
            cruise = max(length / reached - ramp, 0.0)
            return integrated(
                np.array([ramp, cruise, ramp]),
                np.array([[acceleration], [0.0], [-acceleration]]),
            )
        case Profile.SCURVE:
            # The acceleration is a triangle over each ramp: half of its peak on average.
            reached = min(speed, sqrt(0.5 * length * acceleration))
            half = reached / acceleration
            cruise = max(length / reached - 2.0 * half, 0.0)
            rise, fall = [0.0, acceleration / half], [acceleration, -acceleration / half]
            return integrated(
                np.array([half, half, cruise, half, half]),
                np.array([rise, fall, [0.0, 0.0], np.negative(rise), np.negative(fall)]),
            )
        case Profile.SIGMOID:
            moving = max(2.0 * length / speed, sqrt(4.0 * length / acceleration))
            rest = moving * ease / (1.0 - 2.0 * ease)
            size = 4.0 * length / moving**2
            return integrated(
                np.array([rest, 0.5 * moving, 0.5 * moving, rest]),
                np.array([[0.0], [size], [-size], [0.0]]),
            )
        case Profile.QUINTIC:
            duration = max(
                QUINTIC_PEAK_SPEED * length / speed,
                sqrt(QUINTIC_PEAK_ACCELERATION * length / acceleration),
            )
            powers = np.array([0.0, 60.0, -180.0, 120.0]) / duration ** np.arange(4)
            return integrated(np.array([duration]), length / duration**2 * powers[None])
