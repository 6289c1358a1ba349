"""How a four-axis palletizer looks: a turning base, two long arms, and the rods that keep it level.

The rods are links of their own: they follow joints 2 and 3 as the rods of the machine do, and a
plate on the elbow and the head on the wrist stay level with them. Bodies are drawn in frames that
are parallel to the base with the upper arm upright and the forearm level.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import solids
from solids import DARK, GRAPHITE, ORANGE, STEEL, Body, X, Y, Z, hull, lathe

from rapidsim.motion.kinematics.closed_form.palletizer import PalletizerGeometry

disc = partial(solids.disc, around=24, fillet_steps=2)
block = partial(solids.block, fillet_steps=2)

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Follower:
    """A link that mimics a joint of the arm."""

    link: str
    parent: str
    origin: Point
    """In the parent [m]."""
    joint: str
    turns: int
    """1 with the joint, -1 against it, about the axis that points left."""
    carries: str = ""
    """The joint of the arm that stands on this link."""
    drawn: bool = True
    pivot: str = ""
    """The name of its joint, if not that of the link."""


def followers(g: PalletizerGeometry) -> tuple[Follower, ...]:
    """The links that rods turn, besides those of the joints."""
    lever, plate = 0.42 * g.c2, _plate(g)
    below = (g.a1 + plate[0], 0.0, g.c1 + plate[2])
    return (
        Follower("link_2_level", "link_2", (0.0, 0.0, g.c2), "joint_2", -1, "joint_3"),
        Follower("link_3_level", "link_3", (g.c3, 0.0, 0.0), "joint_3", -1, "joint_4"),
        Follower("rear_rod", "link_1", below, "joint_2", 1),
        Follower("upper_rod", "link_2_level", _tip(g), "joint_3", 1),
        Follower("lever", "link_1", (g.a1, 0.0, g.c1), "joint_3", 1),
        Follower("lever_end", "lever", (-lever, 0.0, 0.0), "joint_3", -1, drawn=False),
        Follower("forearm_rod", "lever_end", (0.0, 0.0, 0.0), "joint_2", 1),
    )


def links(g: PalletizerGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    s = 0.165 * g.c2
    return {
        "base_link": _foot(g, s),
        "link_1": _swing(g, s),
        "link_2": _upper_arm(g.c2, s),
        "link_3": _forearm(g, s),
        "link_4": _flange(s),
        "link_2_level": _elbow_plate(g, s),
        "link_3_level": _head(g, s),
        "rear_rod": [_rod((0.0, 0.9 * s, 0.0), (0.0, 0.9 * s, g.c2), 0.12 * s)],
        "upper_rod": [_rod((0.0, 0.62 * s, 0.0), (g.c3, 0.62 * s, 0.0), 0.12 * s)],
        "lever": _lever(g, s),
        "forearm_rod": [_rod((0.0, 0.5 * s, 0.0), (0.0, 0.5 * s, g.c2), 0.20 * s)],
    }


def _plate(g: PalletizerGeometry) -> Point:
    """Where the rear rod meets the plate, seen from axis 2 or, with the arm upright, the elbow."""
    return (-0.27 * g.c2, 0.0, 0.15 * g.c2)


def _tip(g: PalletizerGeometry) -> Point:
    """Where the upper rod meets the plate and, on the head, the wrist."""
    return (0.24 * g.c2, 0.0, 0.20 * g.c2)


def _foot(g: PalletizerGeometry, s: float) -> list[Body]:
    top = 0.31 * g.c1
    corners = [(x * s, y * s) for x in (-2.5, 2.3) for y in (-2.2, 2.2)]
    plate = hull(
        ORANGE, *(disc((x, y, 0.18 * s), Z, 0.4 * s, 0.36 * s, 0.06 * s) for x, y in corners)
    )
    column = hull(
        ORANGE,
        disc((0.0, 0.0, 0.5 * s), Z, 2.3 * s, 0.6 * s, 0.12 * s),
        disc((0.0, 0.0, top - 0.15 * s), Z, 1.95 * s, 0.3 * s, 0.10 * s),
    )
    box = block((-2.3 * s, 0.0, 0.6 * s), (1.1 * s, 2.2 * s, 0.9 * s), 0.14 * s)
    return [plate, column, hull(DARK, box)]


def _swing(g: PalletizerGeometry, s: float) -> list[Body]:
    top, a1, c1 = 0.31 * g.c1, g.a1, g.c1
    x, z = _plate(g)[0] + a1, _plate(g)[2] + c1
    drum = lathe(
        ORANGE,
        [(1.95 * s, 0.0), (2.1 * s, 0.08 * s), (2.1 * s, 0.55 * s), (1.75 * s, 0.9 * s)],
        (0.0, 0.0, top),
        Z,
    )
    casting = hull(
        ORANGE,
        disc((0.0, 0.0, top + 0.5 * s), Z, 1.7 * s, 0.5 * s, 0.2 * s),
        disc((a1, 0.15 * s, c1), Y, 1.15 * s, 1.5 * s, 0.24 * s),
    )
    horn = hull(
        ORANGE,
        disc((0.0, 0.75 * s, c1 - 0.8 * s), Y, 0.7 * s, 0.5 * s, 0.15 * s),
        disc((x, 0.80 * s, z), Y, 0.34 * s, 0.5 * s, 0.12 * s),
    )
    pin = lathe(DARK, [(0.16 * s, -0.4 * s), (0.16 * s, 0.4 * s)], (x, 0.85 * s, z), Y)
    left = hull(ORANGE, disc((a1, 1.15 * s, c1), Y, 0.85 * s, 0.7 * s, 0.16 * s))
    motors = []
    for at, side in (((a1, 1.5 * s, c1), 1.0), ((a1, -1.3 * s, c1), -1.0)):
        middle = (at[0], at[1] + 0.5 * side * s, at[2])
        motors.append(hull(GRAPHITE, disc(middle, Y, 0.55 * s, 1.0 * s, 0.1 * s)))
    stand = disc((-1.3 * s, -0.3 * s, top + 1.3 * s), Z, 0.5 * s, 1.5 * s, 0.1 * s)
    return [drum, casting, horn, pin, left, *motors, hull(GRAPHITE, stand)]


def _upper_arm(length: float, s: float) -> list[Body]:
    y = -0.95 * s
    middle = disc((0.0, y, 0.5 * length), Y, 0.62 * s, 0.56 * s, 0.2 * s)
    ends = [
        hull(ORANGE, disc((0.0, y, z), Y, r * s, 0.66 * s, 0.16 * s))
        for z, r in ((0.0, 1.0), (length, 0.74))
    ]
    halves = [
        hull(ORANGE, middle, disc((0.0, y, z), Y, 0.7 * r * s, 0.58 * s, 0.2 * s))
        for z, r in ((0.0, 1.1), (length, 0.9))
    ]
    axle = disc((0.0, -0.35 * s, length), Y, 0.34 * s, 1.5 * s, 0.06 * s)
    return [*ends, *halves, hull(DARK, axle)]


def _forearm(g: PalletizerGeometry, s: float) -> list[Body]:
    rear, tip = -0.42 * g.c2, g.c3
    hub = hull(ORANGE, disc((0.0, -0.05 * s, 0.0), Y, 0.62 * s, 1.0 * s, 0.14 * s))
    beam = hull(
        ORANGE,
        disc((0.0, -0.05 * s, 0.0), Y, 0.56 * s, 0.9 * s, 0.14 * s),
        disc((0.55 * tip, -0.05 * s, 0.0), Y, 0.46 * s, 0.8 * s, 0.16 * s),
        disc((tip, -0.05 * s, 0.0), Y, 0.36 * s, 0.7 * s, 0.12 * s),
    )
    tail = hull(
        ORANGE,
        disc((0.0, 0.1 * s, 0.0), Y, 0.56 * s, 0.8 * s, 0.14 * s),
        disc((rear, 0.35 * s, 0.0), Y, 0.34 * s, 0.5 * s, 0.12 * s),
    )
    pins = [
        lathe(DARK, [(0.2 * s, -0.42 * s), (0.2 * s, 0.42 * s)], (x, y, 0.0), Y)
        for x, y in ((rear, 0.35 * s), (tip, -0.05 * s))
    ]
    return [hub, beam, tail, *pins]


def _elbow_plate(g: PalletizerGeometry, s: float) -> list[Body]:
    y = 0.76 * s
    corners = [(0.0, 0.0, 0.36), (_plate(g)[0], _plate(g)[2], 0.24), (_tip(g)[0], _tip(g)[2], 0.24)]
    clouds = [disc((x, y, z), Y, r * s, 0.16 * s, 0.05 * s) for x, z, r in corners]
    pins = [hull(DARK, disc((x, y, z), Y, 0.15 * s, 0.5 * s, 0.04 * s)) for x, z, _ in corners[1:]]
    return [
        hull(ORANGE, *clouds),
        hull(DARK, disc((0.0, 0.4 * s, 0.0), Y, 0.22 * s, 0.9 * s, 0.05 * s)),
        *pins,
    ]


def _head(g: PalletizerGeometry, s: float) -> list[Body]:
    tip, down, ahead = _tip(g), g.flange_down, g.wrist_forward
    cheeks = [
        hull(
            ORANGE,
            disc((0.0, y, 0.0), Y, 0.44 * s, 0.2 * s, 0.06 * s),
            disc((0.8 * ahead, 0.6 * y, -0.3 * down), Y, 0.5 * s, 0.24 * s, 0.08 * s),
            disc((tip[0], 0.5 * s, tip[2]), Y, 0.24 * s, 0.2 * s, 0.06 * s)
            if y > 0.0
            else disc((0.3 * ahead, y, 0.2 * s), Y, 0.3 * s, 0.2 * s, 0.06 * s),
        )
        for y in (0.48 * s, -0.52 * s)
    ]
    body = hull(
        ORANGE,
        disc((ahead, 0.0, -0.35 * down), Z, 0.68 * s, 0.6 * s, 0.16 * s),
        disc((ahead, 0.0, -0.80 * down), Z, 0.60 * s, 0.2 * s, 0.08 * s),
    )
    motor = disc((ahead, 0.0, 0.55 * s), Z, 0.42 * s, 1.3 * s, 0.1 * s)
    pin = disc((tip[0], 0.62 * s, tip[2]), Y, 0.15 * s, 0.5 * s, 0.04 * s)
    return [*cheeks, body, hull(GRAPHITE, motor), hull(DARK, pin)]


def _flange(s: float) -> list[Body]:
    rim = [(0.50 * s, 0.0), (0.52 * s, 0.03 * s), (0.52 * s, 0.22 * s), (0.42 * s, 0.3 * s)]
    mark = block((0.4 * s, 0.0, 0.05 * s), (0.1 * s, 0.1 * s, 0.08 * s), 0.02 * s)
    return [lathe(STEEL, rim, (0.0, 0.0, 0.0), Z), hull(DARK, mark)]


def _lever(g: PalletizerGeometry, s: float) -> list[Body]:
    arm = hull(
        ORANGE,
        disc((0.0, 0.62 * s, 0.0), Y, 0.55 * s, 0.3 * s, 0.08 * s),
        disc((-0.42 * g.c2, 0.55 * s, 0.0), Y, 0.3 * s, 0.3 * s, 0.08 * s),
    )
    return [arm, hull(DARK, disc((-0.42 * g.c2, 0.5 * s, 0.0), Y, 0.18 * s, 0.6 * s, 0.05 * s))]


def _rod(start: Point, end: Point, radius: float) -> Body:
    """A bar with an eye at each end, pinned along Y."""
    eyes = [disc(at, Y, 1.9 * radius, 1.5 * radius, 0.3 * radius) for at in (start, end)]
    along = X if abs(end[0] - start[0]) > abs(end[2] - start[2]) else Z
    middle = tuple(0.5 * (a + b) for a, b in zip(start, end, strict=True))
    length = max(abs(b - a) for a, b in zip(start, end, strict=True))
    bar = disc((middle[0], middle[1], middle[2]), along, radius, length, 0.1 * radius)
    bodies = [hull(ORANGE, cloud) for cloud in (*eyes, bar)]
    mesh = bodies[0].mesh
    for body in bodies[1:]:
        mesh = mesh + body.mesh
    return Body(mesh, ORANGE)
