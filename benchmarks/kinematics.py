"""How fast and how exact our kinematics are, beside yourdfpy, SciPy, py-opw-kinematics and EAIK.

    python benchmarks/kinematics.py [ROBOT]

Prints one table: poses a second, and the largest error of position and orientation that forward
kinematics finds in what each engine returns. All engines get the same poses in one run, because
numbers of two machines, or of two loads of one machine, do not compare. Engines that are not
installed are left out, and how to get them is said: EAIK is no part of the development extra,
because it brings a windowing library along and nothing but this table needs it.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from time import perf_counter
from typing import Any, TypeVar

import numpy as np
import yourdfpy
from scipy.spatial.transform import RigidTransform

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.branch_choice import LeastMotion, least_motion
from rapidsim.motion.configurations.scipy_solvers import METHODS, search
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.robot.robot import Robot, load_robot

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
    for module, package in (("py_opw_kinematics", "py-opw-kinematics"), ("eaik", "eaik")):
        if find_spec(module) is None:
            print(f"\n{package} is not installed and was left out: pip install {package}")


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


def _py_opw_robot(robot: Robot) -> Any:
    """Their robot of the same geometry; rods it does not have."""
    opw = import_module("py_opw_kinematics")
    assert isinstance(robot.kinematics, OrthoParallel)
    g = robot.kinematics.geometry
    if g.coupling:
        sys.exit(f"{robot.name}: the other engines have no rods; take an arm without")
    lengths = {name: getattr(g, name) for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4")}
    flipped = tuple(sign < 0 for sign in g.signs)
    model = opw.KinematicModel(**lengths, offsets=g.offsets, flip_axes=flipped)
    return opw.Robot(model, degrees=False)


def _py_opw(robot: Robot, poses: Transform) -> None:
    other = _py_opw_robot(robot)
    together = RigidTransform.from_matrix(poses.matrix)
    seconds, reached = _timed(lambda: other.reach(together).joints)
    there = ~np.isnan(reached).any(axis=-1)
    rows, _ = np.nonzero(there)
    error = float(np.abs(robot.forward(reached[there]).matrix - poses.matrix[rows]).max())
    _line("all branches, py-opw-kinematics, batch", BATCH, seconds, f"{error:.0e}")
    rigid = [RigidTransform.from_matrix(matrix) for matrix in poses.matrix[:ONE_BY_ONE]]
    seconds, found = _timed(lambda: [other.inverse(pose) for pose in rigid])
    back = [robot.forward(np.array(solutions)) for solutions in found]
    error = max(
        float(np.abs(pose.matrix - poses[row].matrix).max()) for row, pose in enumerate(back)
    )
    _line("all branches, py-opw-kinematics, one by one", ONE_BY_ONE, seconds, f"{error:.0e}")


def _eaik_robot(robot: Robot) -> Any:
    """Their robot of the same axes; its last frame is parallel to the base with all joints at 0."""
    zero, arm = np.zeros(6), robot.kinematics
    links, flange = arm.link_frames(zero), arm.forward(zero)
    axes = arm.jacobian(zero)[3:].T
    stops = np.vstack(
        [np.zeros(3), links.translation[:5], links.translation[4], flange.translation]
    )
    return import_module("eaik.IK_HP").HPRobot(axes, np.diff(stops, axis=0))


def _eaik_poses(robot: Robot, poses: Transform) -> list[Array]:
    turned = poses.matrix.copy()
    turned[:, :3, :3] = poses.rotation @ robot.forward(np.zeros(6)).rotation.T
    return list(turned)


def _eaik(robot: Robot, poses: Transform) -> None:
    arm, other, each = robot.kinematics, _eaik_robot(robot), _eaik_poses(robot, poses)
    seconds, found = _timed(lambda: other.IK_batched(each, 1))
    # Where it marks a solution as the nearest it can give, it does not claim to reach the pose.
    exact = [np.array(one.Q)[~np.array(one.is_LS, dtype=bool)] for one in found[:ONE_BY_ONE]]
    error = max(
        float(np.abs(arm.forward(joints).matrix - poses[row].matrix).max())
        for row, joints in enumerate(exact)
        if len(joints)
    )
    _line("all branches, EAIK, batch, one thread", BATCH, seconds, f"{error:.0e}")


def _following(robot: Robot) -> None:
    """A path on one branch with half a turn of axis 6, and the free choice of branches along it."""
    share = np.linspace(-1.0, 1.0, BATCH)[:, None]
    arm = robot.kinematics
    assert isinstance(arm, OrthoParallel)
    # In the angles of the formulas, so that the path is the same whatever the maker calls zero.
    theta = np.radians([0.0, 10.0, 80.0, 0.0, 45.0, 0.0] + share * [60, 20, 20, 60, 25, 90])
    joints = arm.joints_from_theta(theta)
    poses = robot.forward(joints)
    branches = arm.branch_of(joints)
    seconds, followed = _timed(lambda: arm.inverse_on_branch(poses, int(branches[0]), joints[0]))
    error = float(np.degrees(np.abs(followed.joints - joints).max()))
    _line(f"follow {len(joints)} poses on a branch, ours", len(joints), seconds, f"{error:.0e} deg")
    if find_spec("py_opw_kinematics"):
        other, rigid = _py_opw_robot(robot), RigidTransform.from_matrix(poses.matrix)
        seconds, rows = _timed(lambda: other.batch_inverse(rigid, current_joints=joints[0]))
        error = float(np.degrees(np.abs(np.asarray(rows) - joints).max()))
        what = f"follow {len(joints)} poses, py-opw-kinematics, nearest"
        _line(what, len(joints), seconds, f"{error:.0e} deg")
    if find_spec("eaik"):
        engine, each = _eaik_robot(robot), _eaik_poses(robot, poses)

        def nearest() -> Array:
            row, before = np.empty_like(joints), joints[0]
            for index, found in enumerate(engine.IK_batched(each, 1)):
                near = np.array(found.Q)
                near += 2.0 * np.pi * np.round((before - near) / (2.0 * np.pi))
                before = near[np.abs(near - before).sum(axis=-1).argmin()]
                row[index] = before
            return row

        seconds, rows = _timed(nearest)
        error = float(np.degrees(np.abs(rows - joints).max()))
        what = f"follow {len(joints)} poses, EAIK, nearest picked here"
        _line(what, len(joints), seconds, f"{error:.0e} deg")
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
