"""How an ortho-parallel arm looks, from its lengths, reach, payload and maker alone.

One likeness for all arms that have none of their own: a foot with a turning shoulder, a lower arm
beside it, an arm house with the wrist's motors behind, a tapering forearm and a fork that holds the
wrist. Radii follow from reach and payload as they do in the arms drawn by hand; large arms carry a
balancing cylinder, small ones hide their motors. Bodies are drawn in the frames of the formulas
(z along the arm, the arm straight up) and turned into the frames of the links.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import solids
from solids import DARK, GRAPHITE, KUKA_ORANGE, ORANGE, STEEL, Body, Paint, X, Y, Z, hull, mirrored

from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.catalogue import CatalogueEntry, arm_from_geometry

# A third of the points of the arms drawn by hand: there are fifty of these.
disc = partial(solids.disc, around=22, fillet_steps=2)
block = partial(solids.block, fillet_steps=2)
lathe = partial(solids.lathe, around=22)

COMPACT_REACH = 1.2
"""Arms shorter than this [m] hide their motors in the castings."""
BALANCED_PAYLOAD = 60.0
"""From this payload [kg] on, a cylinder carries the weight of the arm."""


@dataclass(frozen=True)
class Livery:
    """The paints of a maker."""

    casting: Paint
    foot: Paint
    motor: Paint
    wrist: Paint


LIVERIES = {
    "ABB": Livery(ORANGE, ORANGE, GRAPHITE, ORANGE),
    "KUKA": Livery(KUKA_ORANGE, GRAPHITE, DARK, GRAPHITE),
}


@dataclass(frozen=True)
class Build:
    """What the links of an arm have in common."""

    geometry: OpwGeometry
    livery: Livery
    shoulder: float
    """Radius [m] of the hub on axis 2."""
    elbow: float
    """Radius [m] of the hub on axis 3."""
    wrist: float
    """Radius [m] of the cheeks on axis 5."""
    compact: bool
    balanced: bool

    @property
    def turntable(self) -> float:
        """Height [m] at which the arm turns on its foot."""
        c1 = self.geometry.c1
        return max(0.35 * c1, c1 - 2.05 * self.shoulder)


def links(entry: CatalogueEntry, geometry: OpwGeometry) -> dict[str, list[Body]]:
    """The bodies of each link, in its frame."""
    build = build_of(entry, geometry)
    drawn = [_shoulder(build), _lower_arm(build), _arm_house(build)]
    drawn += [_forearm(build), _wrist(build), _flange(build)]
    link_from_opw = arm_from_geometry(geometry).opw_from_link.inverse()
    shapes = {"base_link": _foot(build)}
    for number, bodies in enumerate(drawn, start=1):
        frame = link_from_opw[number - 1]
        shapes[f"link_{number}"] = [
            solids.moved(body, frame.rotation, frame.translation) for body in bodies
        ]
    return shapes


def build_of(entry: CatalogueEntry, geometry: OpwGeometry) -> Build:
    """The proportions of an arm: powers of reach and payload that fit the arms drawn by hand."""
    reach = entry.reach_m or geometry.a1 + geometry.reach
    payload = entry.payload_kg or 5.0 * reach**2
    shoulder = min(0.108 * reach**0.66, 0.36 * geometry.c1, 0.33 * geometry.c2)
    wrist = min(0.030 * payload**0.243, 0.8 * geometry.c4, geometry.c3 / 7.5, 0.7 * shoulder)
    return Build(
        geometry=geometry,
        livery=LIVERIES[entry.maker],
        shoulder=shoulder,
        elbow=0.80 * shoulder,
        wrist=wrist,
        compact=reach < COMPACT_REACH,
        balanced=payload >= BALANCED_PAYLOAD and not geometry.coupling,
    )


def _foot(build: Build) -> list[Body]:
    s, top, paint = build.shoulder, build.turntable, build.livery.foot
    low = 0.16 * s
    corners = [(x * s, y * s) for x in (-1.75, 1.45) for y in (-1.6, 1.6)]
    plate = hull(paint, *(disc((x, y, low), Z, 0.4 * s, 2.0 * low, 0.06 * s) for x, y in corners))
    bolts = [
        lathe(STEEL, [(0.13 * s, 0.0), (0.13 * s, 0.10 * s)], (x, y, 2.0 * low), Z, around=8)
        for x, y in corners
    ]
    column = hull(
        paint,
        disc((-0.05 * s, 0.0, 2.2 * low), Z, 1.72 * s, 2.0 * low, 0.12 * s),
        disc((0.0, 0.0, top - 0.25 * s), Z, 1.5 * s, 0.3 * s, 0.10 * s),
    )
    rear = block((-1.6 * s, 0.0, 0.5 * top), (1.0 * s, 2.0 * s, max(0.6 * top, 0.5 * s)), 0.16 * s)
    plugs = [
        hull(DARK, disc((-2.12 * s, y * s, 0.5 * top), X, 0.24 * s, 0.2 * s, 0.04 * s))
        for y in (-0.45, 0.45)
    ]
    ring = lathe(DARK, [(1.44 * s, -0.12 * s), (1.44 * s, 0.0)], (0.0, 0.0, top), Z)
    return [plate, *bolts, column, hull(paint, rear), *plugs, ring]


def _shoulder(build: Build) -> list[Body]:
    s, top, paint = build.shoulder, build.turntable, build.livery.casting
    a1, c1 = build.geometry.a1, build.geometry.c1
    drum = lathe(
        paint,
        [(1.55 * s, 0.0), (1.64 * s, 0.06 * s), (1.64 * s, 0.45 * s), (1.35 * s, 0.8 * s)],
        (0.0, 0.0, top),
        Z,
    )
    casting = hull(
        paint,
        disc((0.0, 0.10 * s, top + 0.5 * s), Z, 1.35 * s, 0.5 * s, 0.2 * s),
        disc((a1, 0.37 * s, c1), Y, 1.05 * s, 1.55 * s, 0.24 * s),
        disc((a1 - 0.8 * s, 0.37 * s, c1 - 0.4 * s), Y, 0.75 * s, 1.25 * s, 0.3 * s),
    )
    collar = lathe(DARK, [(0.92 * s, -0.56 * s), (0.92 * s, -0.38 * s)], (a1, 0.0, c1), Y)
    gearbox = hull(paint, disc((a1, 1.19 * s, c1), Y, 0.8 * s, 0.42 * s, 0.14 * s))
    bodies = [drum, casting, collar, gearbox]
    if build.compact:
        lid = disc((a1, 1.42 * s, c1), Y, 0.62 * s, 0.12 * s, 0.04 * s)
        return [*bodies, hull(build.livery.motor, lid)]
    bodies += _motor(build, (a1, 1.35 * s, c1), Y, 0.55 * s, 0.95 * s)
    bodies += _motor(build, (-0.95 * s, 0.75 * s, top + 0.5 * s), Z, 0.5 * s, 1.3 * s)
    if build.balanced:
        behind, under = (a1 - 3.0 * s, c1 - 1.05 * s), (a1 - 0.9 * s, c1 - 0.85 * s)
        cylinder = hull(
            paint,
            *(disc((x, -0.3 * s, z), X, 0.5 * s, 0.5 * s, 0.14 * s) for x, z in (behind, under)),
        )
        cap = disc((behind[0] - 0.28 * s, -0.3 * s, behind[1]), X, 0.38 * s, 0.16 * s, 0.05 * s)
        bodies += [cylinder, hull(DARK, cap)]
    return bodies


def _lower_arm(build: Build) -> list[Body]:
    s, e, paint, length = build.shoulder, build.elbow, build.livery.casting, build.geometry.c2
    y, waist = -0.9 * s, 0.5 * s
    middle = disc((0.0, y, 0.52 * length), Y, waist, 0.62 * s, 0.2 * s)
    bodies = [
        hull(paint, disc((0.0, y, 0.0), Y, s, 0.72 * s, 0.18 * s)),
        hull(paint, disc((0.0, y, length), Y, e, 0.70 * s, 0.18 * s)),
        hull(paint, disc((0.0, y, 0.1 * s), Y, 0.84 * s, 0.64 * s, 0.22 * s), middle),
        hull(paint, middle, disc((0.0, y, length), Y, 0.8 * e, 0.64 * s, 0.22 * s)),
    ]
    for z, radius in ((0.0, 0.58 * s), (length, 0.56 * e)):
        rim = [(radius, 0.0), (radius, -0.06 * s), (0.88 * radius, -0.09 * s)]
        bodies.append(lathe(build.livery.motor, rim, (0.0, y - 0.35 * s, z), Y))
    return bodies


def _arm_house(build: Build) -> list[Body]:
    s, e, a2, paint = build.shoulder, build.elbow, build.geometry.a2, build.livery.casting
    front = _front_of_house(build)
    hub = hull(
        paint,
        disc((0.0, 0.15 * s, 0.0), Y, 0.98 * e, 1.25 * s, 0.2 * s),
        disc((a2, 0.05 * s, 0.0), Y, 0.75 * e, 1.0 * s, 0.25 * s),
    )
    house = hull(
        paint,
        disc((a2, 0.05 * s, -0.75 * s), Z, 0.76 * s, 0.5 * s, 0.2 * s),
        disc((a2, 0.0, front - 0.2 * s), Z, 0.70 * s, 0.4 * s, 0.16 * s),
        disc((a2, 0.10 * s, 0.0), Y, 0.76 * s, 1.1 * s, 0.25 * s),
    )
    collar = lathe(DARK, [(0.84 * e, -0.58 * s), (0.84 * e, -0.42 * s)], (0.0, 0.0, 0.0), Y)
    ring = lathe(DARK, [(0.63 * s, 0.0), (0.63 * s, 0.14 * s)], (a2, 0.0, front), Z)
    hump = hull(
        paint,
        disc((a2, 0.05 * s, -0.8 * s), Z, 0.74 * s, 0.4 * s, 0.16 * s),
        disc((a2, 0.05 * s, -1.3 * s), Z, 0.62 * s, 0.24 * s, 0.11 * s),
    )
    bodies = [hub, house, collar, hump, ring]
    if build.compact:
        lid = disc((a2, 0.05 * s, -1.42 * s), Z, 0.48 * s, 0.12 * s, 0.04 * s)
        side = disc((0.0, 0.80 * s, 0.0), Y, 0.6 * e, 0.14 * s, 0.05 * s)
        return [*bodies, hull(build.livery.motor, lid), hull(build.livery.motor, side)]
    for x, y in ((-0.34, 0.38), (-0.34, -0.28), (0.32, 0.05)):
        bodies += _motor(build, (a2 + x * s, y * s, -1.4 * s), Z, 0.29 * s, -0.85 * s)
    return [*bodies, *_motor(build, (0.0, 0.74 * s, 0.0), Y, 0.45 * s, 0.8 * s)]


def _forearm(build: Build) -> list[Body]:
    s, w, c3, paint = build.shoulder, build.wrist, build.geometry.c3, build.livery.casting
    start = _front_of_house(build) + 0.12 * s
    neck = max(c3 - 4.35 * w, start + 0.05 * c3)
    thin = min(1.30 * w, 0.66 * s)
    tube = hull(
        paint,
        disc((0.0, 0.0, start + 0.1 * s), Z, 0.68 * s, 0.2 * s, 0.08 * s),
        disc((0.0, 0.0, neck), Z, thin, 0.6 * w, 0.25 * w),
    )
    fork = hull(
        paint,
        disc((0.0, 0.0, neck), Z, thin, 0.6 * w, 0.25 * w),
        block((0.0, 0.0, c3 - 2.04 * w), (1.9 * w, 2.57 * w, 1.1 * w), 0.35 * w),
    )
    cheek = hull(
        paint,
        disc((0.0, 1.09 * w, c3), Y, w, 0.56 * w, 0.2 * w),
        disc((0.0, 1.00 * w, c3 - 1.95 * w), Y, 0.93 * w, 0.56 * w, 0.2 * w),
    )
    rim = [(0.74 * w, 0.0), (0.74 * w, 0.09 * w), (0.63 * w, 0.17 * w)]
    cap = lathe(build.livery.motor, rim, (0.0, 1.35 * w, c3), Y)
    return [tube, fork, cheek, mirrored(cheek), cap, mirrored(cap)]


def _wrist(build: Build) -> list[Body]:
    w, c4 = build.wrist, build.geometry.c4
    return [
        hull(
            build.livery.wrist,
            disc((0.0, 0.0, 0.0), Y, 0.91 * w, 1.52 * w, 0.2 * w),
            disc((0.0, 0.0, c4 - 0.74 * w), Z, 0.76 * w, 0.5 * w, 0.15 * w),
        )
    ]


def _flange(build: Build) -> list[Body]:
    w, at = build.wrist, (0.0, 0.0, build.geometry.c4)
    rim = [(0.62 * w, -0.48 * w), (0.73 * w, -0.43 * w), (0.73 * w, -0.05 * w), (0.69 * w, 0.0)]
    bolt = [(0.09 * w, 0.0), (0.09 * w, 0.02 * w)]
    bolts = [
        lathe(STEEL, bolt, (x * w, y * w, at[2]), Z, around=8)
        for x, y in ((0.38, 0.38), (-0.38, 0.38), (0.38, -0.38), (-0.38, -0.38))
    ]
    boss = lathe(STEEL, [(0.32 * w, 0.0), (0.32 * w, 0.02 * w)], at, Z)
    return [lathe(DARK, rim, at, Z), boss, *bolts]


def _front_of_house(build: Build) -> float:
    """How far [m] the arm house reaches along axis 4, where the forearm begins to turn."""
    return min(1.2 * build.shoulder, 0.34 * build.geometry.c3)


def _motor(
    build: Build, foot: tuple[float, float, float], axis: int, radius: float, length: float
) -> list[Body]:
    """A servo motor: a drum with a dark end cap, `length` along the axis, either way."""
    middle, end = list(foot), list(foot)
    middle[axis] += 0.5 * length
    end[axis] += length
    x, y, z = middle
    drum = disc((x, y, z), axis, radius, abs(length), 0.15 * radius, around=16)
    x, y, z = end
    cap = disc((x, y, z), axis, 0.86 * radius, 0.4 * radius, 0.15 * radius, around=16)
    return [hull(build.livery.motor, drum), hull(DARK, cap)]
