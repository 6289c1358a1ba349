"""How a small five-axis teaching arm looks: a pedestal, two slim arms between plates, a stub wrist.

Drawn in the frames of the links, which are parallel to the base with the arm stretched forward.
"""

from __future__ import annotations

from solids import DARK, GRAPHITE, IVORY, STEEL, Body, X, Y, Z, block, disc, hull, lathe, mirrored

from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxisGeometry


def links(geometry: FiveAxisGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    size = geometry.d1 / 0.152
    return {
        "base_link": _foot(size),
        "link_1": _waist(geometry.d1, size),
        "link_2": _upper_arm(geometry.a2, size),
        "link_3": _forearm(geometry.a3, size),
        "link_4": _wrist(geometry.d5, size),
        "link_5": _flange(size),
    }


def _foot(m: float) -> list[Body]:
    plate = block((-0.02 * m, 0.0, 0.012 * m), (0.25 * m, 0.19 * m, 0.024 * m), 0.008 * m)
    pedestal = hull(
        IVORY,
        block((-0.01 * m, 0.0, 0.04 * m), (0.19 * m, 0.16 * m, 0.05 * m), 0.014 * m),
        disc((0.0, 0.0, 0.060 * m), Z, 0.075 * m, 0.03 * m, 0.008 * m),
    )
    plug = disc((-0.112 * m, 0.0, 0.042 * m), X, 0.014 * m, 0.02 * m, 0.003 * m, around=20)
    ring = lathe(DARK, [(0.070 * m, 0.0), (0.070 * m, 0.008 * m)], (0.0, 0.0, 0.072 * m), Z)
    return [hull(GRAPHITE, plate), pedestal, hull(DARK, plug), ring]


def _waist(height: float, m: float) -> list[Body]:
    table = disc((0.0, 0.0, 0.090 * m), Z, 0.074 * m, 0.022 * m, 0.006 * m)
    tower = hull(
        IVORY,
        block((0.0, 0.0, 0.105 * m), (0.12 * m, 0.105 * m, 0.03 * m), 0.010 * m),
        disc((0.0, 0.0, height), Y, 0.042 * m, 0.09 * m, 0.010 * m),
    )
    motor = hull(
        IVORY,
        block((-0.075 * m, 0.0, height - 0.015 * m), (0.07 * m, 0.085 * m, 0.07 * m), 0.012 * m),
    )
    hub = disc((0.0, 0.0, height), Y, 0.024 * m, 0.13 * m, 0.004 * m)
    return [hull(IVORY, table), tower, motor, hull(STEEL, hub)]


def _upper_arm(length: float, m: float) -> list[Body]:
    side = hull(
        IVORY,
        disc((0.0, 0.054 * m, 0.0), Y, 0.043 * m, 0.016 * m, 0.005 * m),
        disc((length, 0.054 * m, 0.0), Y, 0.031 * m, 0.016 * m, 0.005 * m),
    )
    spine = block((0.52 * length, 0.0, 0.0), (0.46 * length, 0.10 * m, 0.042 * m), 0.010 * m)
    rim = [(0.026 * m, 0.0), (0.026 * m, 0.004 * m), (0.022 * m, 0.007 * m)]
    cap = lathe(GRAPHITE, rim, (length, 0.062 * m, 0.0), Y)
    return [side, mirrored(side), hull(IVORY, spine), cap, mirrored(cap)]


def _forearm(length: float, m: float) -> list[Body]:
    tube = hull(
        IVORY,
        disc((0.0, 0.0, 0.0), Y, 0.029 * m, 0.086 * m, 0.008 * m),
        block((0.55 * length, 0.0, 0.0), (0.3 * length, 0.078 * m, 0.046 * m), 0.010 * m),
    )
    cheek = hull(
        IVORY,
        disc((length, 0.033 * m, 0.0), Y, 0.022 * m, 0.013 * m, 0.004 * m),
        disc((0.62 * length, 0.033 * m, 0.0), Y, 0.024 * m, 0.013 * m, 0.004 * m),
    )
    rim = [(0.015 * m, 0.0), (0.015 * m, 0.003 * m), (0.012 * m, 0.005 * m)]
    cap = lathe(GRAPHITE, rim, (length, 0.0395 * m, 0.0), Y)
    return [tube, cheek, mirrored(cheek), cap, mirrored(cap)]


def _wrist(to_flange: float, m: float) -> list[Body]:
    body = hull(
        GRAPHITE,
        disc((0.0, 0.0, 0.0), Y, 0.019 * m, 0.050 * m, 0.005 * m),
        disc((0.6 * to_flange, 0.0, 0.0), X, 0.021 * m, 0.02 * m, 0.005 * m),
    )
    neck = disc((0.75 * to_flange, 0.0, 0.0), X, 0.016 * m, 0.4 * to_flange, 0.003 * m)
    return [body, hull(DARK, neck)]


def _flange(m: float) -> list[Body]:
    rim = [(0.017 * m, -0.012 * m), (0.020 * m, -0.010 * m), (0.020 * m, 0.0)]
    mark = block((-0.005 * m, 0.0, 0.016 * m), (0.006 * m, 0.006 * m, 0.012 * m), 0.002 * m)
    return [lathe(STEEL, rim, (0.0, 0.0, 0.0), X), hull(DARK, mark)]
