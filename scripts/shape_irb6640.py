"""How an IRB 6640 looks: heavy, motors at the shoulder, a balancing cylinder behind."""

from __future__ import annotations

from solids import DARK, GRAPHITE, ORANGE, STEEL, Body, X, Y, Z, block, disc, hull, lathe, mirrored

from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry


def links(geometry: OpwGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    return {
        "base_link": _foot(),
        "link_1": _shoulder(geometry.a1, geometry.c1),
        "link_2": _lower_arm(geometry.c2),
        "link_3": _arm_house(-geometry.a2),
        "link_4": _forearm(geometry.c3),
        "link_5": _wrist(geometry.c4),
        "link_6": _flange(),
    }


def _foot() -> list[Body]:
    corners = [(x, y) for x in (-0.36, 0.36) for y in (-0.30, 0.30)]
    plate = hull(ORANGE, *(disc((x, y, 0.03), Z, 0.08, 0.06, 0.012) for x, y in corners))
    column = hull(
        ORANGE,
        block((0.0, 0.0, 0.13), (0.70, 0.62, 0.20), 0.06),
        disc((0.0, 0.0, 0.27), Z, 0.31, 0.08, 0.02),
    )
    panel = hull(GRAPHITE, block((-0.36, 0.0, 0.14), (0.06, 0.34, 0.14), 0.02))
    ring = lathe(DARK, [(0.29, 0.0), (0.29, 0.05)], (0.0, 0.0, 0.30), Z)
    return [plate, column, panel, ring]


def _shoulder(ahead: float, up: float) -> list[Body]:
    drum = lathe(
        ORANGE,
        [(0.32, 0.0), (0.335, 0.01), (0.335, 0.10), (0.31, 0.14), (0.27, 0.16)],
        (0.0, 0.0, 0.34),
        Z,
    )
    casting = hull(
        ORANGE,
        disc((0.02, 0.0, 0.45), Z, 0.28, 0.08, 0.04),
        disc((ahead, 0.0, up), Y, 0.20, 0.30, 0.04),
        disc((ahead - 0.14, 0.0, up - 0.10), Y, 0.16, 0.36, 0.05),
    )
    motor_2 = [
        hull(ORANGE, disc((ahead, 0.21, up), Y, 0.17, 0.14, 0.03)),
        hull(GRAPHITE, disc((ahead, 0.34, up), Y, 0.11, 0.20, 0.02)),
        hull(DARK, disc((ahead, 0.44, up), Y, 0.09, 0.05, 0.02)),
    ]
    motor_1 = [
        hull(GRAPHITE, disc((-0.17, 0.17, 0.58), Z, 0.10, 0.24, 0.02)),
        hull(DARK, disc((-0.17, 0.17, 0.70), Z, 0.085, 0.05, 0.02)),
    ]
    collar = lathe(DARK, [(0.17, -0.165), (0.17, -0.145)], (ahead, 0.0, up), Y)
    # The gas spring that carries the arm's weight lies at the back, under the lower arm.
    spring = hull(
        ORANGE,
        disc((ahead - 0.62, -0.06, up - 0.22), X, 0.105, 0.10, 0.03),
        disc((ahead - 0.20, -0.06, up - 0.18), X, 0.105, 0.10, 0.03),
    )
    cap = hull(DARK, disc((ahead - 0.675, -0.06, up - 0.222), X, 0.08, 0.03, 0.01))
    return [drum, casting, *motor_2, *motor_1, collar, spring, cap]


def _lower_arm(length: float) -> list[Body]:
    y = -0.245
    lower = hull(
        ORANGE,
        disc((0.0, y, 0.0), Y, 0.205, 0.17, 0.04),
        disc((-0.01, y, 0.45 * length), Y, 0.135, 0.15, 0.05),
    )
    upper = hull(
        ORANGE,
        disc((-0.01, y, 0.45 * length), Y, 0.135, 0.15, 0.05),
        disc((0.0, y, length), Y, 0.165, 0.15, 0.04),
    )
    covers = [
        lathe(GRAPHITE, [(r, 0.0), (r, -0.012), (r - 0.012, -0.02)], (0.0, y - depth, z), Y)
        for z, r, depth in ((0.0, 0.12, 0.083), (length, 0.095, 0.073))
    ]
    return [lower, upper, *covers]


def _arm_house(above: float) -> list[Body]:
    hub = hull(
        ORANGE,
        disc((0.0, -0.01, 0.0), Y, 0.165, 0.31, 0.04),
        disc((0.02, 0.0, above), Y, 0.17, 0.28, 0.06),
    )
    house = hull(
        ORANGE,
        disc((-0.14, 0.0, above), X, 0.175, 0.12, 0.04),
        disc((0.24, 0.0, above), X, 0.15, 0.10, 0.03),
        disc((0.0, 0.0, above - 0.06), Y, 0.16, 0.28, 0.06),
    )
    motors = []
    for y, z in ((0.085, above + 0.075), (-0.085, above + 0.075), (0.0, above - 0.085)):
        motors += [
            hull(GRAPHITE, disc((-0.29, y, z), X, 0.068, 0.22, 0.015)),
            hull(DARK, disc((-0.40, y, z), X, 0.058, 0.05, 0.015)),
        ]
    motor_3 = [
        hull(GRAPHITE, disc((0.0, 0.22, 0.0), Y, 0.10, 0.18, 0.02)),
        hull(DARK, disc((0.0, 0.31, 0.0), Y, 0.085, 0.05, 0.02)),
    ]
    collar = lathe(DARK, [(0.14, -0.172), (0.14, -0.155)], (0.0, 0.0, 0.0), Y)
    ring = lathe(DARK, [(0.135, 0.0), (0.135, 0.03)], (0.28, 0.0, above), X)
    return [hub, house, *motors, *motor_3, collar, ring]


def _forearm(length: float) -> list[Body]:
    tube = hull(
        ORANGE,
        disc((0.34, 0.0, 0.0), X, 0.148, 0.08, 0.025),
        disc((length - 0.32, 0.0, 0.0), X, 0.115, 0.08, 0.03),
    )
    neck = hull(
        ORANGE,
        disc((length - 0.33, 0.0, 0.0), X, 0.115, 0.08, 0.03),
        block((length - 0.19, 0.0, 0.0), (0.08, 0.27, 0.19), 0.04),
    )
    cheek = hull(
        ORANGE,
        disc((length, 0.118, 0.0), Y, 0.105, 0.055, 0.02),
        disc((length - 0.18, 0.112, 0.0), Y, 0.098, 0.055, 0.02),
    )
    cap = lathe(GRAPHITE, [(0.075, 0.0), (0.075, 0.008), (0.066, 0.016)], (length, 0.145, 0.0), Y)
    return [tube, neck, cheek, mirrored(cheek), cap, mirrored(cap)]


def _wrist(to_flange: float) -> list[Body]:
    tilt = hull(
        ORANGE,
        disc((0.0, 0.0, 0.0), Y, 0.098, 0.165, 0.02),
        disc((to_flange - 0.075, 0.0, 0.0), X, 0.092, 0.06, 0.02),
    )
    return [tilt]


def _flange() -> list[Body]:
    plate = lathe(
        DARK, [(0.085, -0.05), (0.10, -0.045), (0.10, -0.006), (0.095, 0.0)], (0.0, 0.0, 0.0), X
    )
    boss = lathe(STEEL, [(0.05, 0.0), (0.05, 0.002)], (0.0, 0.0, 0.0), X)
    return [plate, boss]
