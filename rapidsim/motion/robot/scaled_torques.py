"""Torque constants of an arm without measurements, scaled from measured ones by speed and size.

Shape and scale are separate: the shape comes from lengths of the arm (or from its drawing), the
scale from axis speeds and reach, as accelerations of the stretched arm without a load.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan2, log, pow, sqrt

from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.dynamics import Torques
from rapidsim.values import value_class

_KAPPA = 0.46
_E_OF_D = 0.4
_ROD_OF_POINT = 3.05
LARGE = 2.55
"""Reach [m] of the large measured arm."""
_SMALL, _MEDIUM = 0.9, 1.5
"""Reach [m] of the small measured arm, and the reach up to which d / c is that of the small one."""
LEAST_WRIST_S = 0.04
"""Time [s] in which the wrist axes of the smallest arms reach their speed."""
_SHORT, _LONG, _SHORT_FACTOR = 0.9, 1.2, 1.1
"""Factor on the accelerations of arms up to the first reach [m], 1 from the second on."""


@value_class(frozen=True, slots=True)
class InertiaShape:
    """Distribution of the inertia of an arm, without its scale; see `Torques`."""

    x: float
    """[m]"""
    z: float
    """[m]"""
    rod_of_point: float
    """`rod` over `point`."""
    d_of_c: float
    """`d` over `c`."""
    delta: float
    """[rad]"""


def shape_by_lengths(geometry: OpwGeometry, reach: float) -> InertiaShape:
    """Return the shape that both measured arms have in common; `reach` [m]."""
    x, z = 0.68 * geometry.c3, -1.2 * geometry.a2
    return InertiaShape(x, z, _ROD_OF_POINT, _between(reach, _MEDIUM, 0.22, 0.41), -atan2(x, z))


def torques_of_version_2(geometry: OpwGeometry, speeds: Sequence[float], reach: float) -> Torques:
    """Return the torque constants of version 2 of the motion model; see `scaled_torques`."""
    return _torques(
        geometry,
        replace(shape_by_lengths(geometry, reach), d_of_c=0.3),
        (
            speeds[0] / (0.165 * reach),
            speeds[1] / (0.168 * reach),
            speeds[2] / (0.087 * reach**0.55),
        ),
        motors=0.3,
        wrist=(speeds[3] / 0.10, speeds[4] / 0.10, speeds[5] / 0.10),
    )


def scaled_torques(
    geometry: OpwGeometry, speeds: Sequence[float], reach: float, shape: InertiaShape | None = None
) -> Torques:
    """Return assumed torque constants of an arm of which only sizes and speeds are known.

    Args:
        geometry: Lengths of the arm.
        speeds: Axis speeds [rad/s].
        reach: Reach of the arm [m].
        shape: Shape of the arm if its drawing shows it, else that of its lengths.

    Source: the two measured arms allow a scale by speed and one by reach; this is their geometric
    mean, which scatters least against published loads on foundations and joint torques. One
    standard deviation is a factor of 1.3. The factor for small arms was chosen by picking cycles.
    """
    small = _SHORT_FACTOR ** (1.0 - _share(reach, _SHORT, _LONG))
    wrist_s = wrist_time(reach)
    return _torques(
        geometry,
        shape_by_lengths(geometry, reach) if shape is None else shape,
        (
            small * 12.74 * sqrt(speeds[0]) * reach**-1.58,
            small * 11.35 * sqrt(speeds[1]) * reach**-1.368,
            small * 25.1 * sqrt(speeds[2]) * reach**-1.142,
        ),
        motors=_between(reach, _SMALL, 0.38, 0.23),
        wrist=(speeds[3] / wrist_s, speeds[4] / wrist_s, speeds[5] / wrist_s),
    )


def wrist_time(reach: float) -> float:
    """Time [s] in which wrist axes reach their speed: measured at 2.55 m, at most this at 0.9 m."""
    return max(LEAST_WRIST_S, 0.055 * pow(reach / _SMALL, 0.87))


def _torques(
    geometry: OpwGeometry,
    shape: InertiaShape,
    stretched: tuple[float, float, float],
    motors: float,
    wrist: tuple[float, float, float],
) -> Torques:
    """Return constants for accelerations [rad/s2] of the stretched arm.

    `motors` is the share of motors and column in the inertia that axis 1 then turns.
    """
    g = geometry
    n11, n22, n33 = (1.0 / one for one in stretched)
    of_rod = shape.rod_of_point * ((g.a1 + 0.5 * g.c2) ** 2 + g.c2**2 / 12.0)
    point = (1.0 - motors) * n11 / (of_rod + (g.a1 + g.c2 + shape.x) ** 2)
    c = n22 / (1.0 + shape.d_of_c)
    d = shape.d_of_c * c
    return Torques(
        i1=motors * n11,
        rod=shape.rod_of_point * point,
        point=point,
        x=shape.x,
        z=shape.z,
        c=c,
        d=d,
        delta=shape.delta,
        e=_E_OF_D * d,
        kappa=_KAPPA,
        n33=n33,
        wrist=wrist,
    )


def _between(reach: float, lower: float, small: float, large: float) -> float:
    """Interpolate by the logarithm of the reach from `lower` to that of the large arm."""
    return small + (large - small) * _share(reach, lower, LARGE)


def _share(reach: float, lower: float, upper: float) -> float:
    """Position of a reach between two, by logarithms, within 0 to 1."""
    return min(max(log(reach / lower) / log(upper / lower), 0.0), 1.0)
