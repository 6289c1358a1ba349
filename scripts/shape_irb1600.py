"""How an IRB 1600 looks: lower arm on one side, motors on the other and behind the elbow."""

from __future__ import annotations

from solids import DARK, GRAPHITE, ORANGE, STEEL, Body, X, Y, Z, block, disc, hull, lathe, mirrored

from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry

LOWER_ARM_SIDE = -0.108
"""y of the middle of the lower arm, which stands beside the shoulder and the arm house."""


def links(geometry: OpwGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    return {
        "base_link": _foot(),
        "link_1": _shoulder(geometry.a1, geometry.c1),
        "link_2": _lower_arm(geometry.c2),
        "link_3": _arm_house(),
        "link_4": _forearm(geometry.c3),
        "link_5": _wrist(geometry.c4),
        "link_6": _flange(),
    }


def _foot() -> list[Body]:
    corners = [(-0.235, -0.195), (-0.235, 0.195), (0.165, -0.195), (0.165, 0.195)]
    plate = [disc((x, y, 0.017), Z, 0.05, 0.034, 0.008) for x, y in corners]
    lugs = [
        lathe(STEEL, [(0.017, 0.0), (0.017, 0.012), (0.012, 0.016)], (x, y, 0.034), Z)
        for x, y in corners
    ]
    casting = hull(
        ORANGE,
        disc((-0.01, 0.0, 0.06), Z, 0.215, 0.10, 0.02),
        disc((0.0, 0.0, 0.17), Z, 0.19, 0.11, 0.02),
    )
    back = hull(
        ORANGE,
        block((-0.20, 0.0, 0.105), (0.12, 0.25, 0.17), 0.03),
        block((-0.10, 0.0, 0.115), (0.10, 0.32, 0.19), 0.04),
    )
    plug = disc((-0.262, 0.055, 0.115), X, 0.033, 0.03, 0.006, around=28)
    ring = lathe(DARK, [(0.178, 0.0), (0.178, 0.035)], (0.0, 0.0, 0.215), Z)
    return [
        hull(ORANGE, *plate),
        *lugs,
        casting,
        back,
        hull(DARK, plug),
        hull(DARK, plug - [0.0, 0.11, 0.0]),
        ring,
    ]


def _shoulder(ahead: float, up: float) -> list[Body]:
    drum = lathe(
        ORANGE,
        [(0.19, 0.0), (0.202, 0.008), (0.202, 0.06), (0.19, 0.085), (0.165, 0.10)],
        (0.0, 0.0, 0.238),
        Z,
    )
    casting = hull(
        ORANGE,
        disc((0.0, 0.012, 0.30), Z, 0.165, 0.06, 0.025),
        disc((ahead, 0.045, up), Y, 0.128, 0.19, 0.03),
        disc((ahead - 0.10, 0.045, up - 0.05), Y, 0.09, 0.15, 0.04),
    )
    collar = lathe(DARK, [(0.112, 0.0), (0.112, 0.02)], (ahead, LOWER_ARM_SIDE + 0.042, up), Y)
    gearbox = hull(ORANGE, disc((ahead, 0.145, up), Y, 0.098, 0.05, 0.018))
    motor_2 = _motor((ahead, 0.165, up), Y, 0.067, 0.115)
    motor_1 = _motor((-0.108, 0.03, 0.285), Z, 0.067, 0.19)
    cable_box = hull(GRAPHITE, block((-0.155, -0.085, 0.36), (0.06, 0.09, 0.11), 0.02))
    return [drum, casting, collar, gearbox, *motor_2, *motor_1, cable_box]


def _lower_arm(length: float) -> list[Body]:
    y = LOWER_ARM_SIDE
    foot = hull(ORANGE, disc((0.0, y, 0.0), Y, 0.122, 0.088, 0.022))
    head = hull(ORANGE, disc((0.0, y, length), Y, 0.098, 0.084, 0.022))
    beam = hull(
        ORANGE,
        disc((0.0, y, 0.02), Y, 0.100, 0.078, 0.03),
        disc((0.0, y, 0.50 * length), Y, 0.062, 0.074, 0.03),
    )
    upper = hull(
        ORANGE,
        disc((0.0, y, 0.50 * length), Y, 0.062, 0.074, 0.03),
        disc((0.0, y, length), Y, 0.078, 0.076, 0.03),
    )
    covers = [
        lathe(GRAPHITE, [(r, 0.0), (r, -0.007), (r - 0.006, -0.011)], (0.0, y - 0.043, z), Y)
        for z, r in ((0.0, 0.07), (length, 0.054))
    ]
    return [foot, head, beam, upper, *covers]


def _arm_house() -> list[Body]:
    hub = hull(ORANGE, disc((0.0, 0.018, 0.0), Y, 0.097, 0.152, 0.025))
    house = hull(
        ORANGE,
        disc((-0.085, 0.014, 0.012), X, 0.094, 0.07, 0.025),
        disc((0.10, 0.0, 0.0), X, 0.088, 0.07, 0.02),
        disc((0.0, 0.02, 0.0), Y, 0.093, 0.14, 0.03),
    )
    collar = lathe(DARK, [(0.082, 0.0), (0.082, 0.02)], (0.0, LOWER_ARM_SIDE + 0.041, 0.0), Y)
    hump = hull(
        ORANGE,
        disc((-0.10, 0.014, 0.012), X, 0.092, 0.05, 0.02),
        disc((-0.165, 0.014, 0.012), X, 0.080, 0.03, 0.014),
    )
    motors = [
        body
        for y, z in ((0.056, 0.045), (-0.028, 0.045), (0.014, -0.035))
        for body in _motor((-0.175, y, z), X, 0.036, -0.11)
    ]
    ring = lathe(DARK, [(0.078, 0.0), (0.078, 0.016)], (0.132, 0.0, 0.0), X)
    return [hub, house, collar, hump, *motors, *_motor((0.0, 0.09, 0.0), Y, 0.055, 0.10), ring]


def _forearm(length: float) -> list[Body]:
    tube = hull(
        ORANGE,
        disc((0.165, 0.0, 0.0), X, 0.086, 0.045, 0.014),
        disc((length - 0.20, 0.0, 0.0), X, 0.060, 0.04, 0.018),
    )
    neck = hull(
        ORANGE,
        disc((length - 0.21, 0.0, 0.0), X, 0.060, 0.04, 0.016),
        block((length - 0.094, 0.0, 0.0), (0.05, 0.118, 0.088), 0.02),
    )
    cheek = hull(
        ORANGE,
        disc((length, 0.050, 0.0), Y, 0.046, 0.026, 0.010),
        disc((length - 0.09, 0.046, 0.0), Y, 0.043, 0.026, 0.010),
    )
    cap = lathe(GRAPHITE, [(0.034, 0.0), (0.034, 0.004), (0.029, 0.008)], (length, 0.062, 0.0), Y)
    return [tube, neck, cheek, mirrored(cheek), cap, mirrored(cap)]


def _wrist(to_flange: float) -> list[Body]:
    tilt = hull(
        ORANGE,
        disc((0.0, 0.0, 0.0), Y, 0.042, 0.070, 0.010),
        disc((to_flange - 0.034, 0.0, 0.0), X, 0.035, 0.024, 0.008),
    )
    return [tilt]


def _flange() -> list[Body]:
    plate = lathe(
        DARK, [(0.028, -0.022), (0.0335, -0.020), (0.0335, -0.002), (0.0315, 0.0)], (0, 0, 0), X
    )
    bolts = [
        lathe(STEEL, [(0.0042, 0.0), (0.0042, 0.0012)], (0.0, 0.025 * y, 0.025 * z), X)
        for y, z in ((0.707, 0.707), (-0.707, 0.707), (0.707, -0.707), (-0.707, -0.707))
    ]
    boss = lathe(STEEL, [(0.0145, 0.0), (0.0145, 0.0008)], (0.0, 0.0, 0.0), X)
    return [plate, boss, *bolts]


def _motor(foot: tuple[float, float, float], axis: int, radius: float, length: float) -> list[Body]:
    """A servo motor: a graphite drum with a dark end cap, `length` along the axis, either way."""
    middle, end = list(foot), list(foot)
    middle[axis] += 0.5 * length
    end[axis] += length
    drum = disc(tuple(middle), axis, radius, abs(length), 0.010)
    cap = disc(tuple(end), axis, 0.86 * radius, 0.028, 0.010)
    return [hull(GRAPHITE, drum), hull(DARK, cap)]
