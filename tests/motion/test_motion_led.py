"""Motion that somebody outside decides: what of it is forgotten, and what stays as it was."""

import numpy as np
from motion_programs import ROBOT

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.trajectory.corrected_section import CorrectedSection
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.trajectory import Trajectory

CYCLE_S = 0.004


def test_a_guided_robot_forgets_its_past_and_is_where_it_was_to_the_last_bit() -> None:
    def stretch() -> GuidedSection:
        forward, tool = ROBOT.kinematics.forward, Transform.identity()
        return GuidedSection(1.0, CYCLE_S, forward, tool, np.zeros(0), np.zeros(6))

    forgets, keeps = stretch(), stretch()
    for cycle in range(1, 3000):
        joints = np.full(6, np.sin(0.01 * cycle))
        for one in (forgets, keeps):
            one.append(joints, 2.5 * joints)
        if cycle % 200 == 0:
            forgets.forget(forgets.end_s - 1.0)
            times = forgets.end_s - np.linspace(1.0, -0.1, 23)
            assert np.array_equal(forgets.joints_at(times), keeps.joints_at(times))
            assert np.array_equal(forgets.end, keeps.end)
    assert len(forgets._joints) <= 512 < len(keeps._joints)


def test_a_corrected_path_forgets_its_past_and_is_where_it_was_to_the_last_bit() -> None:
    forgets, keeps = (CorrectedSection(1.0, ROBOT.kinematics) for _ in range(2))
    for cycle in range(1, 3000):
        for one in (forgets, keeps):
            one.append(1.0 + CYCLE_S * cycle, np.full(3, np.sin(0.01 * cycle)))
        if cycle % 200 == 0:
            forgets.forget(forgets.end_s - 1.0)
            times = forgets.end_s - np.linspace(1.0, -0.1, 23)
            assert np.array_equal(forgets.offsets_at(times), keeps.offsets_at(times))
    assert len(forgets._times) < 500 < len(keeps._times)


def test_a_robot_that_is_guided_and_moves_nowhere_else_keeps_the_present_alone() -> None:
    forward, tool = ROBOT.kinematics.forward, Transform.identity()
    start = Waypoint(np.zeros(6), forward(np.zeros(6)), np.zeros(0))
    forgets, keeps = Trajectory(start), Trajectory(start)
    for begin_s in (0.0, 5.0, 10.0):
        for one in (forgets, keeps):
            section = GuidedSection(begin_s, CYCLE_S, forward, tool, np.zeros(0), np.zeros(6))
            one.guide(section)
            for cycle in range(1, 1000):
                section.append(np.full(6, np.sin(0.01 * cycle)), np.zeros(6))
        before_s = begin_s + 3.0
        forgets.forget(before_s)
        times = np.linspace(before_s, begin_s + 6.0, 40)
        assert np.array_equal(forgets.at(times).joints, keeps.at(times).joints)
    assert [len(one._joints) < 300 for one in forgets.guided] == [True]
    assert len(keeps.guided) == 3
