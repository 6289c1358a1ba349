"""Many programmed lines and arcs at once: can the arm follow each, and where is it held up?

A survey for checking: each way is taken by itself, from its start joints on their branch, without
corners and without dynamics. Poses are put as densely as the joints turn. What looks broken here is
told exactly by `path.build_path`, which takes one way at a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.arms import Arms, arms_of
from rapidsim.motion.confdata import told_apart
from rapidsim.motion.curves import Curves, curves_of
from rapidsim.motion.kinematics import Mask
from rapidsim.motion.reach import limit_excess
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Segment
from rapidsim.motion.turns import vector_from_rotation

Index = npt.NDArray[np.int64]

_BATCH = 2000
_LONGEST_CELL = 0.05
_WIDEST_CELL = 0.2
_MOST_CELLS = 200
_LARGEST_STEP = 0.15
_JUMP = 0.5
_ROUNDS = 14
"""Halvings of a steep cell: 50 mm become 3 micrometres."""
_PAST_LIMIT = 1e-6
_NEAR = {"wrist": np.sin(np.radians(10.0)), "elbow": np.sin(np.radians(6.0)), "shoulder": 0.15}
"""`Singularity.distance` from which an axis may be held up by a singularity."""


@dataclass(frozen=True, slots=True)
class HoldUp:
    """Where an axis keeps the arm from the programmed speed most."""

    axis: int
    """Counted from 1."""
    share: float
    """Of the programmed speed, what this axis allows; below 1."""
    fraction: float
    """Where on the way, 0 to 1."""
    singularity: str | None
    """Which singularity is near there."""


@dataclass(frozen=True, slots=True, eq=False)
class SurveyedWay:
    """What a survey saw of one line or arc."""

    travel: float
    """Way of the TCP [m]."""
    turned: float
    """Reorientation [rad]."""
    arrival: Array | None
    """Joints (n,) [rad] at the end, whole turns followed; None where the branch ends before."""
    broken: bool
    """The branch ends, jumps, or passes a joint limit on the way."""
    hold_up: HoldUp | None
    """None where the axes allow the programmed speed all along."""


@dataclass(slots=True, eq=False)
class _Samples:
    """Places on curves in order, with the joints there."""

    row: Index
    share: Array
    """Of the curve, 0 to 1."""
    pose: Transform
    """base_from_flange."""
    joints: Array
    exists: Mask


def survey_ways(
    robot: Robot, segments: Sequence[Segment], max_speed: Array | None
) -> tuple[SurveyedWay, ...]:
    """Survey lines and arcs that have passed `circle_fault`, each by itself.

    Args:
        robot: The arm.
        segments: What is surveyed; the joints at their ends do not count.
        max_speed: Axis speeds (n,) [rad/s]; None where they are not known.
    """
    found: list[SurveyedWay] = []
    for first in range(0, len(segments), _BATCH):
        found += _survey(robot, segments[first : first + _BATCH], max_speed)
    return tuple(found)


def _survey(
    robot: Robot, segments: Sequence[Segment], max_speed: Array | None
) -> list[SurveyedWay]:
    curves = curves_of(segments, robot.kinematics)
    arms = arms_of(segments, robot.kinematics, curves.joint_travel, curves.length)
    samples = _refined(curves, arms, _first_samples(curves, arms))
    joints = _continuous(samples)
    row, last = samples.row, np.append(np.flatnonzero(np.diff(samples.row)), len(samples.row) - 1)
    same = row[1:] == row[:-1]
    step = np.where(same[:, None], np.abs(np.diff(joints, axis=0)), 0.0).max(axis=-1)
    jumps = (step > _JUMP) & samples.exists[1:] & samples.exists[:-1]
    past = (np.abs(limit_excess(robot, joints)) > _PAST_LIMIT).any(axis=-1) | ~samples.exists
    broken = np.zeros(len(segments), dtype=bool)
    np.logical_or.at(broken, row, past)
    np.logical_or.at(broken, row[1:], jumps)
    hold_ups = _hold_ups(robot, segments, samples, joints, max_speed)
    return [
        SurveyedWay(
            travel=float(curves.travel[i]),
            turned=float(curves.angle[i]),
            arrival=joints[at] if samples.exists[at] else None,
            broken=bool(broken[i]),
            hold_up=None if broken[i] else hold_ups.get(i),
        )
        for i, at in enumerate(last.tolist())
    ]


def _first_samples(curves: Curves, arms: Arms) -> _Samples:
    turn = np.linalg.norm(curves.tool_turn, axis=-1) + np.linalg.norm(curves.frame_turn, axis=-1)
    cells = np.ceil(np.maximum(curves.travel / _LONGEST_CELL, turn / _WIDEST_CELL))
    count = np.clip(cells, 2, _MOST_CELLS).astype(np.int64) + 1
    row = np.repeat(np.arange(len(count)), count)
    number = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
    return _sampled(curves, arms, row, number / (count[row] - 1.0))


def _sampled(curves: Curves, arms: Arms, row: Index, share: Array) -> _Samples:
    """Solve places (k,) of curves (k,) on the branch of each."""
    motion, near = curves.at(row, share * curves.length[row]), curves.start_joints[row]
    joints, exists = arms.joints(motion, row, near)
    return _Samples(row, share, arms.base_from_flange(motion, row, near), joints, exists)


def _refined(curves: Curves, arms: Arms, samples: _Samples) -> _Samples:
    """Put places between those where the joints turn far."""
    for _ in range(_ROUNDS):
        same = samples.row[1:] == samples.row[:-1]
        step = np.abs(_short_way(np.diff(samples.joints, axis=0))).max(axis=-1)
        steep = same & samples.exists[1:] & samples.exists[:-1] & (step > _LARGEST_STEP)
        at = np.flatnonzero(steep)
        if not at.size:
            break
        middle = 0.5 * (samples.share[at] + samples.share[at + 1])
        new = _sampled(curves, arms, samples.row[at], middle)
        samples = _Samples(
            np.insert(samples.row, at + 1, new.row),
            np.insert(samples.share, at + 1, new.share),
            Transform(
                np.insert(samples.pose.rotation, at + 1, new.pose.rotation, axis=0),
                np.insert(samples.pose.translation, at + 1, new.pose.translation, axis=0),
            ),
            np.insert(samples.joints, at + 1, new.joints, axis=0),
            np.insert(samples.exists, at + 1, new.exists),
        )
    return samples


def _short_way(step: Array) -> Array:
    short: Array = step - 2.0 * np.pi * np.round(step / (2.0 * np.pi))
    return short


def _continuous(samples: _Samples) -> Array:
    """Joints with the whole turns made since the start of each way."""
    step = np.diff(samples.joints, axis=0)
    turns = np.cumsum(np.round((step - _short_way(step)) / (2.0 * np.pi)), axis=0)
    turns = np.concatenate([np.zeros((1, samples.joints.shape[1])), turns])
    first = np.searchsorted(samples.row, samples.row, side="left")
    joints: Array = samples.joints - 2.0 * np.pi * (turns - turns[first])
    return joints


def _hold_ups(
    robot: Robot,
    segments: Sequence[Segment],
    samples: _Samples,
    joints: Array,
    max_speed: Array | None,
) -> dict[int, HoldUp]:
    """By way, where an axis would have to turn fastest beyond what it can."""
    if max_speed is None or len(joints) < 2:
        return {}
    row = samples.row[1:]
    tcp_from_flange = Transform(
        np.array([segment.tcp_from_flange.rotation for segment in segments]),
        np.array([segment.tcp_from_flange.translation for segment in segments]),
    )
    tcp = samples.pose @ tcp_from_flange[samples.row].inverse()
    way = np.linalg.norm(np.diff(tcp.translation, axis=0), axis=-1)
    before, after = tcp.rotation[:-1], tcp.rotation[1:]
    turn = np.linalg.norm(vector_from_rotation(after @ np.swapaxes(before, -1, -2)), axis=-1)
    speed = np.array([[s.speed.tcp, s.speed.reorientation] for s in segments])[row]
    time = np.maximum(way / speed[:, 0], turn / speed[:, 1])
    timed = np.array([segment.duration is not None for segment in segments])[row]
    counts = (row == samples.row[:-1]) & (time > 0.0) & ~timed
    usage = np.abs(np.diff(joints, axis=0)) / max_speed / np.where(counts, time, np.inf)[:, None]
    worst = usage.max(axis=-1)
    found: dict[int, HoldUp] = {}
    # From small to large, so that the largest of each way stays.
    for k in np.argsort(worst, kind="stable")[np.searchsorted(np.sort(worst), 1.0, side="right") :]:
        at, axis = int(k), int(usage[k].argmax())
        middle = 0.5 * (joints[at] + joints[at + 1])
        found[int(row[at])] = HoldUp(
            axis + 1,
            1.0 / float(worst[at]),
            0.5 * float(samples.share[at] + samples.share[at + 1]),
            near_singularity(robot, middle),
        )
    return found


def near_singularity(robot: Robot, joints: Array) -> str | None:
    """Which singularity joints (n,) [rad] are near; None if none, or the arm is one of searches."""
    if not told_apart(robot.kinematics):
        return None
    found = robot.kinematics.singularities(joints)
    return next((one.name for one in found if one.distance < _NEAR[one.name]), None)
