"""How a SCARA looks: a pedestal, a flat arm, an arm with the motors on it, and the spline.

Drawn in the frames of the links, which are parallel to the base with both arms stretched forward.
"""

from __future__ import annotations

from collections.abc import Sequence

from solids import DARK, GRAPHITE, LIGHT, STEEL, Body, X, Z, block, disc, hull, lathe

from rapidsim.motion.kinematics.arm import METRES_PER_UNIT
from rapidsim.motion.kinematics.closed_form.scara import SLIDING, ScaraGeometry

_ARM_2_PLATE = 0.052
"""Thickness [m] of arm 2 below its motors."""
_MOTORS_UP = 0.19
"""From the underside of arm 2 to the top of its cover [m]."""
_ROD = 0.010
"""Radius [m] of the spline."""


def links(g: ScaraGeometry, limits: Sequence[tuple[float, float]]) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame.

    Args:
        g: The lengths.
        limits: Of all joints [rad], which tell the stroke.
    """
    lower, upper = limits[SLIDING]
    return {
        "base_link": _pedestal(g.arm_1_up),
        "link_1": _arm_1(g.a1, g.arm_2_up - g.arm_1_up),
        "link_2": _arm_2(g.a2),
        "link_3": _spline(g.arm_2_up - g.flange_up, METRES_PER_UNIT * (upper - lower)),
        "link_4": _flange(),
    }


def _pedestal(top: float) -> list[Body]:
    plate = block((-0.03, 0.0, 0.009), (0.24, 0.19, 0.018), 0.007, fillet_steps=2)
    column = hull(
        LIGHT,
        block((-0.03, 0.0, 0.035), (0.19, 0.16, 0.05), 0.014, fillet_steps=2),
        disc((0.0, 0.0, 0.86 * top), Z, 0.074, 0.12 * top, 0.008),
    )
    rear = hull(GRAPHITE, block((-0.125, 0.0, 0.085), (0.05, 0.12, 0.11), 0.010, fillet_steps=2))
    plugs = [
        hull(DARK, disc((-0.155, y, 0.085), X, 0.018, 0.02, 0.003, around=20))
        for y in (-0.03, 0.03)
    ]
    neck = lathe(DARK, [(0.064, 0.0), (0.064, 0.088 * top)], (0.0, 0.0, 0.91 * top), Z)
    return [hull(LIGHT, plate), column, rear, *plugs, neck]


def _arm_1(length: float, thick: float) -> list[Body]:
    high, middle = 0.88 * thick, 0.44 * thick
    beam = hull(
        LIGHT,
        disc((0.0, 0.0, middle), Z, 0.068, high, 0.012),
        disc((length, 0.0, middle), Z, 0.056, high, 0.012),
    )
    cap = lathe(GRAPHITE, [(0.052, 0.0), (0.048, 0.010)], (0.0, 0.0, high), Z)
    joint = lathe(DARK, [(0.048, 0.0), (0.048, 0.12 * thick)], (length, 0.0, high), Z)
    return [beam, cap, joint]


def _arm_2(length: float) -> list[Body]:
    beam = hull(
        LIGHT,
        disc((0.0, 0.0, 0.5 * _ARM_2_PLATE), Z, 0.058, _ARM_2_PLATE, 0.012),
        disc((length, 0.0, 0.5 * _ARM_2_PLATE), Z, 0.044, _ARM_2_PLATE, 0.012),
    )
    cover = hull(
        LIGHT,
        disc((0.0, 0.0, _ARM_2_PLATE), Z, 0.056, 0.02, 0.006),
        disc((0.62 * length, 0.0, _ARM_2_PLATE), Z, 0.050, 0.02, 0.006),
        disc((0.1 * length, 0.0, _MOTORS_UP - 0.01), Z, 0.044, 0.02, 0.008),
        disc((0.52 * length, 0.0, _MOTORS_UP - 0.01), Z, 0.040, 0.02, 0.008),
    )
    hose = lathe(DARK, [(0.017, 0.0), (0.015, 0.035)], (0.05 * length, 0.0, _MOTORS_UP), Z)
    bush = lathe(GRAPHITE, [(0.030, 0.0), (0.026, 0.03)], (length, 0.0, _ARM_2_PLATE), Z)
    return [beam, cover, hose, bush]


def _spline(to_arm: float, stroke: float) -> list[Body]:
    top = to_arm + _ARM_2_PLATE + 0.04 + stroke
    rod = lathe(STEEL, [(_ROD, 0.012), (_ROD, top)], (0.0, 0.0, 0.0), Z, around=24)
    stop = lathe(DARK, [(1.8 * _ROD, top - 0.014), (1.8 * _ROD, top)], (0.0, 0.0, 0.0), Z)
    return [rod, stop]


def _flange() -> list[Body]:
    rim = [(0.020, 0.0), (0.022, 0.002), (0.022, 0.010), (0.014, 0.014)]
    mark = block((0.019, 0.0, 0.006), (0.006, 0.006, 0.006), 0.001, fillet_steps=2)
    return [lathe(STEEL, rim, (0.0, 0.0, 0.0), Z, around=28), hull(DARK, mark)]
