"""How an IRB 120 looks: a small symmetric arm, the lower arm a fork around shoulder and elbow."""

from __future__ import annotations

from solids import DARK, GRAPHITE, ORANGE, STEEL, Body, X, Y, Z, block, disc, hull, lathe, mirrored

from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry


def links(geometry: OpwGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    return {
        "base_link": _foot(),
        "link_1": _shoulder(geometry.c1),
        "link_2": _lower_arm(geometry.c2),
        "link_3": _arm_house(-geometry.a2),
        "link_4": _forearm(geometry.c3),
        "link_5": _wrist(geometry.c4),
        "link_6": _flange(),
    }


def _foot() -> list[Body]:
    corners = [(x, y) for x in (-0.072, 0.072) for y in (-0.072, 0.072)]
    plate = hull(ORANGE, *(disc((x, y, 0.009), Z, 0.020, 0.018, 0.004) for x, y in corners))
    box = hull(
        ORANGE,
        block((-0.005, 0.0, 0.05), (0.158, 0.158, 0.09), 0.022),
        disc((0.0, 0.0, 0.125), Z, 0.080, 0.05, 0.014),
    )
    # The connectors for power, signals and air sit on the back.
    back = hull(
        ORANGE,
        block((-0.095, 0.0, 0.058), (0.06, 0.118, 0.088), 0.014),
        block((-0.05, 0.0, 0.06), (0.05, 0.13, 0.095), 0.016),
    )
    plugs = [
        hull(DARK, disc((-0.126, y, z), X, 0.013, 0.012, 0.003, around=24))
        for y, z in ((-0.032, 0.07), (0.0, 0.07), (0.032, 0.07), (-0.016, 0.038), (0.016, 0.038))
    ]
    ring = lathe(DARK, [(0.073, 0.0), (0.073, 0.022)], (0.0, 0.0, 0.146), Z)
    return [plate, box, back, *plugs, ring]


def _shoulder(up: float) -> list[Body]:
    drum = lathe(
        ORANGE,
        [(0.076, 0.0), (0.082, 0.004), (0.082, 0.028), (0.076, 0.042), (0.066, 0.05)],
        (0.0, 0.0, 0.160),
        Z,
    )
    casting = hull(
        ORANGE,
        disc((0.0, 0.0, 0.185), Z, 0.074, 0.03, 0.012),
        disc((0.0, 0.0, up), Y, 0.066, 0.098, 0.018),
    )
    collar = lathe(DARK, [(0.058, 0.046), (0.058, 0.054)], (0.0, 0.0, up), Y)
    return [drum, casting, collar, mirrored(collar)]


def _lower_arm(length: float) -> list[Body]:
    cheek = hull(
        ORANGE,
        disc((0.0, 0.069, 0.0), Y, 0.067, 0.032, 0.013),
        disc((0.0, 0.066, 0.52 * length), Y, 0.050, 0.030, 0.013),
    )
    upper = hull(
        ORANGE,
        disc((0.0, 0.066, 0.48 * length), Y, 0.050, 0.030, 0.013),
        disc((0.0, 0.066, length), Y, 0.056, 0.030, 0.013),
    )
    web = hull(
        ORANGE,
        disc((-0.006, 0.0, 0.37 * length), Y, 0.026, 0.13, 0.010),
        disc((-0.006, 0.0, 0.64 * length), Y, 0.024, 0.13, 0.010),
    )
    caps = [
        lathe(GRAPHITE, [(r, 0.0), (r, 0.003), (r - 0.004, 0.006)], (0.0, y, z), Y)
        for z, r, y in ((0.0, 0.040, 0.084), (length, 0.033, 0.080))
    ]
    return [cheek, mirrored(cheek), upper, mirrored(upper), web, *caps, *map(mirrored, caps)]


def _arm_house(above: float) -> list[Body]:
    hub = hull(
        ORANGE,
        disc((0.0, 0.0, 0.0), Y, 0.053, 0.098, 0.014),
        disc((-0.012, 0.0, above), Y, 0.045, 0.084, 0.022),
    )
    house = hull(
        ORANGE,
        disc((-0.055, 0.0, above + 0.002), X, 0.056, 0.04, 0.018),
        disc((0.085, 0.0, above), X, 0.049, 0.04, 0.012),
        disc((0.0, 0.0, above - 0.012), Y, 0.05, 0.088, 0.024),
    )
    # The motors of axes 4 to 6 make the hump behind the elbow.
    hump = hull(
        ORANGE,
        disc((-0.068, 0.0, above + 0.002), X, 0.051, 0.03, 0.014),
        block((-0.105, 0.0, above + 0.004), (0.05, 0.074, 0.072), 0.022),
    )
    cover = hull(GRAPHITE, block((-0.130, 0.0, above + 0.004), (0.012, 0.050, 0.048), 0.005))
    collar = lathe(DARK, [(0.047, 0.046), (0.047, 0.053)], (0.0, 0.0, 0.0), Y)
    ring = lathe(DARK, [(0.043, 0.0), (0.043, 0.010)], (0.102, 0.0, above), X)
    return [hub, house, hump, cover, collar, mirrored(collar), ring]


def _forearm(length: float) -> list[Body]:
    tube = hull(
        ORANGE,
        disc((0.128, 0.0, 0.0), X, 0.048, 0.036, 0.010),
        block((length - 0.076, 0.0, 0.0), (0.05, 0.098, 0.066), 0.016),
    )
    cheek = hull(
        ORANGE,
        disc((length, 0.0405, 0.0), Y, 0.0325, 0.021, 0.008),
        disc((length - 0.085, 0.039, 0.0), Y, 0.032, 0.021, 0.008),
    )
    cap = lathe(GRAPHITE, [(0.024, 0.0), (0.024, 0.002), (0.021, 0.005)], (length, 0.0505, 0.0), Y)
    return [tube, cheek, mirrored(cheek), cap, mirrored(cap)]


def _wrist(to_flange: float) -> list[Body]:
    tilt = hull(
        ORANGE,
        disc((0.0, 0.0, 0.0), Y, 0.0315, 0.056, 0.008),
        disc((to_flange - 0.026, 0.0, 0.0), X, 0.0275, 0.020, 0.006),
    )
    return [tilt]


def _flange() -> list[Body]:
    plate = lathe(
        DARK, [(0.0215, -0.018), (0.025, -0.016), (0.025, -0.0015), (0.0235, 0.0)], (0, 0, 0), X
    )
    boss = lathe(STEEL, [(0.0095, 0.0), (0.0095, 0.0006)], (0.0, 0.0, 0.0), X)
    bolts = [
        lathe(STEEL, [(0.0028, 0.0), (0.0028, 0.0008)], (0.0, 0.01575 * y, 0.01575 * z), X)
        for y, z in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0))
    ]
    return [plate, boss, *bolts]
