"""Results of `rapidsim follow` as JSON values: mm, degrees, seconds of the trajectory.

Nothing in it depends on how long the computer took.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np

from rapidsim.applications.follow.follow_tables import Attempt, RequestedPoints
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.motion.waypoints.plan import Refused, Way
from rapidsim.motion.waypoints.reachability import PointReach
from rapidsim.motion.waypoints.solver_seeds import SeededSolve


def follow_json(requested: RequestedPoints, attempts: Sequence[Attempt]) -> dict[str, object]:
    """Points, and the trajectory, or the reason why it failed."""
    (attempt,) = attempts
    profile = None if requested.plan.kind is Way.JOINT_QUINTIC else requested.plan.profile.value
    said = {"path": requested.plan.kind.value, "profile": profile}
    return {**_request_json(requested), **said, **_result(attempt.result)}


def starts_json(tried: Sequence[SeededSolve]) -> dict[str, object]:
    """Cost of numerical solvers from cold and warm starts; empty without `--starts`."""
    if not tried:
        return {}
    rows = [
        {
            "solver": one.solver,
            "start": "warm" if one.warm else "cold",
            "poses": one.poses,
            "found": one.solved_count,
            "starts": one.starts,
            "iterations": one.iterations,
        }
        for one in tried
    ]
    return {"starts": rows}


def compared_json(requested: RequestedPoints, attempts: Sequence[Attempt]) -> dict[str, object]:
    """Points, and each trajectory, or the reason why it failed."""
    profile = {"profile": requested.plan.profile.value}
    compared = [{"path": one.plan.kind.value, **_result(one.result)} for one in attempts]
    return {**_request_json(requested), **profile, "compared": compared}


def _request_json(requested: RequestedPoints) -> dict[str, object]:
    return {
        "schema": 1,
        "robot": requested.robot.name,
        "speed_mm_s": requested.plan.speed * 1000.0,
        "acceleration_mm_s2": requested.plan.acceleration * 1000.0,
        "euler": {
            "convention": requested.convention.value,
            "names": list(requested.convention.names),
        },
        "points": [
            _point(position, point, quaternion, euler)
            for position, point, quaternion, euler in zip(
                requested.positions_mm.tolist(),
                requested.reached,
                requested.quaternions.tolist(),
                requested.euler_deg.tolist(),
                strict=True,
            )
        ],
    }


def _result(result: FollowedTrajectory | Refused) -> dict[str, object]:
    if isinstance(result, Refused):
        return {
            "refused": {
                "message": result.message,
                "help": result.help,
                "other_configurations": [
                    {"conf": list(conf), "possible": message is None, "why": message}
                    for conf, message in result.other_branches
                ],
            },
            "trajectory": None,
        }
    return {"refused": None, "trajectory": _trajectory(result)}


def _trajectory(followed: FollowedTrajectory) -> dict[str, object]:
    """One trajectory: how long, how far off, how fast."""
    joints = followed.samples.joints
    return {
        "dt_s": followed.dt,
        "duration_s": followed.duration,
        "path_mm": followed.path_length * 1000.0,
        "peak_tcp_speed_mm_s": followed.peak_speed * 1000.0,
        "deviation": {
            "from": "path" if followed.plan.kind.of_tcp else "straight lines",
            "rms_mm": followed.deviation_rms * 1000.0,
            "max_mm": followed.deviation_max * 1000.0,
            "max_deg": degrees(followed.turn_deviation),
        },
        "from_straight_lines_max_mm": followed.from_chord * 1000.0,
        "poses_solved": followed.poses_solved,
        "samples": len(followed.samples.times),
        "joints": [
            {
                "name": joint.name,
                "start_deg": start,
                "end_deg": end,
                "peak_deg_s": degrees(peak),
                "limit_deg_s": None if joint.max_speed is None else degrees(joint.max_speed),
                "overshoot_deg": degrees(beyond),
            }
            for joint, start, end, peak, beyond in zip(
                followed.robot.joints,
                np.degrees(joints[0]).tolist(),
                np.degrees(joints[-1]).tolist(),
                followed.joint_peaks.tolist(),
                followed.overshoot.tolist(),
                strict=True,
            )
        ],
    }


def _point(
    position: list[float], reached: PointReach, quaternion: list[float], euler: list[float]
) -> dict[str, object]:
    why = reached.reason
    ranges = None
    if reached.pitches is not None:
        ranges = [degrees(pitch) for pitch in reached.pitches]
    return {
        "position_mm": position,
        "quaternion": quaternion,
        "euler_deg": euler,
        "reachable": reached.reachable,
        "why": reached.message,
        "shortfall_mm": 0.0 if why is None else why.shortfall * 1000.0,
        "joint": None if why is None else why.joint,
        "over_deg": 0.0 if why is None else degrees(why.excess),
        "pitch_deg": None if reached.pitch is None else degrees(reached.pitch),
        "pitch_range_deg": ranges,
    }
