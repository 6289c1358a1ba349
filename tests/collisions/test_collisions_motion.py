"""Nothing slips through: a sheet of half a millimetre crossed at full speed is found, and when."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from laws import cases

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.along_motion import search
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import WORLD, Arm, Body, Carried, Frame, Pair, Scene
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.trajectory.trajectory import Samples

ROBOT = load_robot("irb1600-6-1.2")
SPEED = np.array([joint.max_speed for joint in ROBOT.joints], dtype=np.float64)
FLANGE = Frame(0, len(ROBOT.joints) + 1)


def swing(start: Array, end: Array) -> tuple[Callable[[Array], Samples], float]:
    """A motion as fast as the axes can, from rest to rest, and how long [s] it lasts."""
    way = end - start
    lasts = max(float((1.6 * np.abs(way) / SPEED).max()), 0.2)

    def at(times: Array) -> Samples:
        share = np.clip(times / lasts, 0.0, 1.0)
        joints = start + (10.0 * share**3 - 15.0 * share**4 + 6.0 * share**5)[:, None] * way
        still = np.zeros(len(times))
        return Samples(
            times,
            still.astype(np.int64),
            joints,
            ROBOT.forward(joints),
            still,
            np.zeros((len(times), 0)),
        )

    return at, lasts


def test_a_sheet_is_found_at_any_speed_and_in_time() -> None:
    rng = np.random.default_rng(7)
    crossed, wanted = 0, cases(40)
    while crossed < wanted:
        ends = ROBOT.lower + rng.random((2, 6)) * (ROBOT.upper - ROBOT.lower)
        at, lasts = swing(*(0.6 * ends))
        instant = lasts * rng.uniform(0.3, 0.7)
        before, here, after = at(instant + np.array([-1e-4, 0.0, 1e-4])).base_from_tcp.translation
        speed = float(np.linalg.norm(after - before)) / 2e-4
        if speed < 1.0:
            continue
        crossed += 1
        z = (after - before) / (2e-4 * speed)
        x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
        x /= np.linalg.norm(x)
        place = Transform(np.column_stack([x, np.cross(z, x), z]), here)
        sheet = shape.box(np.array([0.06, 0.06, 5e-4]))
        bodies = (
            Body(
                BodyName("tip", 0),
                shape.sphere(0.002),
                (Carried(0.0, FLANGE, Transform.identity()),),
            ),
            Body(BodyName("sheet"), sheet, (Carried(0.0, WORLD, place),)),
        )
        arm = Arm(ROBOT, Transform.identity(), at, ((0.0, lasts),))
        scene = Scene((arm,), bodies, (Pair(0, 1, 0, touch_only=False),))
        found = search(scene, lasts)
        assert found.contacts
        first = found.contacts[0].time_s
        # The same, looked at a thousand times as often.
        times = first + np.linspace(-600.0, 19.0, 620, dtype=np.float64) * 1.6e-5
        tips = place.inverse().apply(at(times).base_from_tcp.translation)
        outside = np.maximum(np.abs(tips) - [0.03, 0.03, 2.5e-4], 0.0)
        touching = np.linalg.norm(outside, axis=1) - 0.002 < -TOUCH_M
        assert abs(first - times[touching.argmax()]) < 1e-4
