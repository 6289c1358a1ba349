"""How fast and how exact our kinematics are, beside yourdfpy, SciPy, py-opw-kinematics and EAIK.

    python benchmarks/kinematics.py [ROBOT]

Prints one table: poses a second, and the largest error of position and orientation that forward
kinematics finds in what each engine returns. All engines get the same poses in one run, because
numbers of two machines, or of two loads of one machine, do not compare. Engines that are not
installed are left out and named.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from time import perf_counter
from typing import TypeVar

import numpy as np
import yourdfpy
from scipy.spatial.transform import RigidTransform

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.branches import LeastMotion, least_motion
from rapidsim.motion.opw import OrthoParallel
from rapidsim.motion.robot import Robot, load_robot
from rapidsim.motion.scipy_search import METHODS, search

BATCH = 10_000
ONE_BY_ONE = 1_000
SEARCHES = 50
REPEATS = 3

Result = TypeVar("Result")


def main() -> None:
    """Measure one robot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("robot", nargs="?", default="irb120")
    robot = load_robot(parser.parse_args().robot)
    if not isinstance(robot.kinematics, OrthoParallel):
        sys.exit(f"{robot.name}: only ortho-parallel arms have oracles to compare with")
    joints = np.random.default_rng(7).uniform(robot.lower, robot.upper, (BATCH, 6))
    poses = robot.forward(joints)
    print(f"{robot.title}, {BATCH} random poses within the limits, best of {REPEATS}\n")
    print(f"{'what':<52}{'poses/s':>12}  largest error")
    _forward(robot, joints, poses)
    _inverse(robot, poses)
    _following(robot)
    for missing in ("py_opw_kinematics", "eaik"):
        if find_spec(missing) is None:
            print(f"\n{missing} is not installed and was left out")


def _forward(robot: Robot, joints: Array, poses: Transform) -> None:
    seconds, _ = _timed(lambda: robot.forward(joints))
    _line("forward, ours, batch", BATCH, seconds)
    few = joints[:ONE_BY_ONE]
    seconds, _ = _timed(lambda: [robot.forward(row) for row in few])
    _line("forward, ours, one by one", ONE_BY_ONE, seconds)
    if robot.urdf is None:
        return
    model = yourdfpy.URDF.load(str(robot.urdf), load_meshes=False)

    def theirs() -> Array:
        found = np.empty((ONE_BY_ONE, 4, 4))
        for index, row in enumerate(few):
            model.update_cfg(row)
            found[index] = model.get_transform("tool0")
        return found

    seconds, found = _timed(theirs)
    error = float(np.abs(found - poses[:ONE_BY_ONE].matrix).max())
    _line("forward, yourdfpy, one by one", ONE_BY_ONE, seconds, f"{error:.0e}")


def _inverse(robot: Robot, poses: Transform) -> None:
    seconds, branches = _timed(lambda: robot.inverse(poses))
    reached = robot.forward(branches.joints[branches.exists])
    wanted = np.repeat(poses.matrix[:, None], 8, axis=1)[branches.exists]
    error = float(np.abs(reached.matrix - wanted).max())
    _line("all branches, ours, batch", BATCH, seconds, f"{error:.0e}")
    each = [poses[row] for row in range(ONE_BY_ONE)]
    seconds, _ = _timed(lambda: [robot.inverse(pose) for pose in each])
    _line("all branches, ours, one by one", ONE_BY_ONE, seconds)
    if find_spec("py_opw_kinematics"):
        _py_opw(robot, poses)
    if find_spec("eaik"):
        _eaik(robot, poses)
    for method in METHODS:
        seconds, found = _timed(
            lambda method=method: [search(robot, pose, method) for pose in each[:SEARCHES]], 1
        )
        solved = sum(one.solved for one in found)
        _line(f"one solution in limits, SciPy {method}", SEARCHES, seconds, f"{solved} solved")


def _py_opw(robot: Robot, poses: Transform) -> None:
    opw = import_module("py_opw_kinematics")
    assert isinstance(robot.kinematics, OrthoParallel)
    g = robot.kinematics.geometry
    if g.coupling or g.signs != (1,) * 6:
        return
    lengths = {name: getattr(g, name) for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4")}
    model = opw.KinematicModel(**lengths, offsets=g.offsets)
    other = opw.Robot(model, degrees=False)
    rigid = [RigidTransform.from_matrix(matrix) for matrix in poses.matrix[:ONE_BY_ONE]]
    seconds, found = _timed(lambda: [other.inverse(pose) for pose in rigid])
    back = [robot.forward(np.array(solutions)) for solutions in found]
    error = max(
        float(np.abs(pose.matrix - poses[row].matrix).max()) for row, pose in enumerate(back)
    )
    _line("all branches, py-opw-kinematics, one by one", ONE_BY_ONE, seconds, f"{error:.0e}")


def _eaik(robot: Robot, poses: Transform) -> None:
    zero, arm = np.zeros(6), robot.kinematics
    links, flange = arm.link_frames(zero), arm.forward(zero)
    axes = arm.jacobian(zero)[3:].T
    stops = np.vstack(
        [np.zeros(3), links.translation[:5], links.translation[4], flange.translation]
    )
    other = import_module("eaik.IK_HP").HPRobot(axes, np.diff(stops, axis=0))
    # Its last frame is parallel to the base with all joints at 0.
    turned = poses.matrix.copy()
    turned[:, :3, :3] = poses.rotation @ flange.rotation.T
    each = list(turned)
    seconds, found = _timed(lambda: other.IK_batched(each, 1))
    error = max(
        float(np.abs(arm.forward(np.array(one.Q)).matrix - poses[row].matrix).max())
        for row, one in enumerate(found[:ONE_BY_ONE])
    )
    _line("all branches, EAIK, batch, one thread", BATCH, seconds, f"{error:.0e}")


def _following(robot: Robot) -> None:
    """A path on one branch with half a turn of axis 6, and the free choice of branches along it."""
    share = np.linspace(-1.0, 1.0, BATCH)[:, None]
    joints = np.radians([0.0, 10.0, -10.0, 0.0, 45.0, 0.0] + share * [60, 20, 20, 60, 25, 90])
    poses, arm = robot.forward(joints), robot.kinematics
    branches = arm.branch_of(joints)
    seconds, followed = _timed(lambda: arm.inverse_on_branch(poses, int(branches[0]), joints[0]))
    error = float(np.degrees(np.abs(followed.joints - joints).max()))
    _line(f"follow {len(joints)} poses on a branch, ours", len(joints), seconds, f"{error:.0e} deg")
    seconds, best = _timed(lambda: least_motion(robot, poses, joints[0]), 1)
    assert isinstance(best, LeastMotion)
    changed = int(np.count_nonzero(np.diff(best.branch)))
    _line("choose among all branches, ours", len(joints), seconds, f"{changed} changes")


def _timed(work: Callable[[], Result], repeats: int = REPEATS) -> tuple[float, Result]:
    """The least time [s] of some runs, and what the last returned."""
    least = np.inf
    for _ in range(repeats):
        began = perf_counter()
        result = work()
        least = min(least, perf_counter() - began)
    return float(least), result


def _line(what: str, count: int, seconds: float, error: str = "") -> None:
    print(f"{what:<52}{count / seconds:>12,.0f}  {error}")


if __name__ == "__main__":
    main()
