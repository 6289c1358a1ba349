"""Results of `rapidsim kin` as JSON values: mm, degrees, quaternions scalar first."""

from __future__ import annotations

from math import degrees

import numpy as np

from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Postures
from rapidsim.motion.configurations.singularities import Differential, joint_speeds, rapid_speeds
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.tables.axis_tables import matrix_in_mm, plain_numbers
from rapidsim.values import value_class

_DIGITS = 12
"""Decimals of joints [deg], so that 30 is printed as 30."""


@value_class(frozen=True, slots=True)
class SearchCost:
    """Cost of a search."""

    starts: int
    iterations: int
    tolerance: float
    """Residual distance [m] and angle [rad] at which it stops."""
    seconds: float
    """By the clock on the wall; nothing depends on it."""


def forward_json(postures: Postures, convention: Convention) -> dict[str, object]:
    """Poses of the TCP and the links; in the world, if the base is placed in it."""
    robot, joints, stands = postures.robot, postures.rows[0].joints, postures.world_from_base
    tcp = postures.world_from_tcp
    links = stands @ robot.kinematics.link_frames(joints)
    return {
        "schema": 1,
        "robot": robot.name,
        "joints_deg": plain_numbers(np.degrees(joints).round(_DIGITS)),
        **_pose(tcp),
        "euler": {
            "convention": convention.value,
            "names": list(convention.names),
            "degrees": plain_numbers(np.degrees(euler_from_rotation(tcp.rotation, convention))),
        },
        "matrix": plain_numbers(matrix_in_mm(tcp)),
        "base": _pose(stands),
        "links": [
            {"name": f"link_{number}", **_pose(links[number - 1])}
            for number in range(1, len(links) + 1)
        ],
        "conf": confdata_of(robot.kinematics, joints).tolist(),
    }


def inverse_json(
    robot: Robot, solver: str, solutions: PoseSolutions, searched: SearchCost | None
) -> dict[str, object]:
    """The joints that reach a pose, or why none do."""
    report: dict[str, object] = {
        "schema": 1,
        "robot": robot.name,
        "solver": solver,
        "solutions": [
            {
                "joints_deg": plain_numbers(np.degrees(solution.joints)),
                "conf": list(solution.confdata),
                "within_limits": solution.within_limits,
                "residual_mm": solution.distance * 1000.0,
                "residual_deg": degrees(solution.angle),
            }
            for solution in solutions.solutions
        ],
        "reachable": solutions.reason is None,
        "why": solutions.reason,
    }
    if searched:
        report["search"] = {
            "starts": searched.starts,
            "iterations": searched.iterations,
            "tolerance_mm": searched.tolerance * 1000.0,
            "tolerance_deg": degrees(searched.tolerance),
            "time_s": searched.seconds,
        }
    return report


def jacobian_json(
    robot: Robot, differential: Differential, twist: Array | None
) -> dict[str, object]:
    """The Jacobian and what follows from it; with a twist (6,) [m/s, rad/s] also joint speeds."""
    report: dict[str, object] = {
        "schema": 1,
        "robot": robot.name,
        "jacobian": plain_numbers(differential.jacobian),
        "frame": "base",
        "singular_values": plain_numbers(differential.singular_values),
        "manipulability": differential.manipulability,
        "near": list(differential.near),
        "rank": differential.rank,
        "singularities": [
            {"name": s.name, "distance": s.distance, "near": s.near, "reason": s.reason}
            for s in differential.singularities
        ],
    }
    if twist is not None:
        speeds, missed = joint_speeds(differential.jacobian, twist)
        report["joint_speeds_deg_s"] = plain_numbers(rapid_speeds(robot.kinematics, speeds))
        report["missed"] = {
            "velocity_mm_s": plain_numbers(missed[:3] * 1000.0),
            "turning_deg_s": plain_numbers(np.degrees(missed[3:])),
        }
    return report


def _pose(base_from_frame: Transform) -> dict[str, object]:
    return {
        "position_mm": plain_numbers(base_from_frame.translation * 1000.0),
        "quaternion": plain_numbers(base_from_frame.quaternion),
    }
