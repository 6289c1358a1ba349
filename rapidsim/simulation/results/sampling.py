"""Sampling of a run's motion that is dense enough to draw it.

Every change that could be missed between two samples gets its own sample: starts and ends of moves,
and the last instant. Repeated samples of an arm at rest are omitted.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.executed_moves import MoveColumns
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_BLOCK = 20_000
"""Number of samples evaluated at once, which bounds the memory of the kinematics."""
MOST_EXACT = 20_000
"""Runs with more moves are sampled to 1e-6 rad, which is invisible; results stay exact."""
_STEP_S = 0.002
"""Distance [s] of an instant from its two neighbours in finite differences."""
_CLOSE_S = 0.004
"""Minimum distance [s] of samples for a slope; closer ones are skipped."""
_STILL = 1e-12
"""Smallest change [rad] between two samples that is a motion."""


@value_class(frozen=True, slots=True, eq=False)
class SampledRun:
    """Motion of one robot in a run, sampled for its pictures."""

    simulation: Simulation
    """The whole run."""
    robot_run: RobotRun
    limits: Limits
    samples: Samples
    joint_speed: Array
    """Shape (k, n) [rad/s]."""
    joint_acceleration: Array
    """Shape (k, n) [rad/s2]."""
    in_corner: npt.NDArray[np.bool_]
    """Shape (k,): the TCP is in a zone."""

    @property
    def end_s(self) -> float:
        """Last instant [s]."""
        return float(self.samples.times[-1])

    @property
    def range_shares(self) -> Array:
        """Position of each joint in its range (k, n) [%]: 0 in the middle, 100 at a limit."""
        robot = self.robot_run.robot
        middle, half = 0.5 * (robot.upper + robot.lower), 0.5 * (robot.upper - robot.lower)
        shares: Array = 100.0 * ((self.samples.joints - middle) / half)
        return shares

    @property
    def speed_shares(self) -> Array:
        """Speed of each joint (k, n) [%] of its limit."""
        # After the joints there are external axes, which have no picture of this kind.
        return 100.0 * (self.joint_speed / self.limits.max_speed[: self.joint_speed.shape[1]])

    @property
    def acceleration_shares(self) -> Array:
        """Acceleration of each joint (k, n) [%] of its limit; for main axes, the torque."""
        limits = self.limits.max_acceleration[: self.joint_acceleration.shape[1]]
        shares = self.joint_acceleration / limits
        for arm in self.limits.arms:
            shares[:, arm.axes] = arm.shares(
                self.robot_run.robot.kinematics.stance(self.samples.joints),
                self.joint_speed,
                self.joint_acceleration,
                self._loads,
            )
        return 100.0 * shares

    @property
    def _loads(self) -> Array:
        """Load on the wrist (k,), in shares of the rated payload."""
        pieces = self.robot_run.trajectory.pieces
        ends = [piece.first + len(piece.path.segments) for piece in pieces]
        loads = np.zeros(max([*ends, int(self.samples.move.max(initial=0)) + 1]))
        for piece, end in zip(pieces, ends, strict=True):
            loads[piece.first : end] = piece.path.programmed.load
        return loads[self.samples.move]


def sampled(
    simulation: Simulation, robot_run: RobotRun, step_s: float, *, most_moves: int | None = None
) -> SampledRun:
    """Sample one robot of a run from its start until all robots are at rest.

    Args:
        simulation: The run.
        robot_run: The robot.
        step_s: Time [s] between samples; starts and ends of moves get additional samples.
        most_moves: With more moves than this, starts and ends get none. None for no limit.
    """
    moves = robot_run.moves.columns
    is_edged = most_moves is None or len(moves.index) <= most_moves
    edged = np.concatenate([moves.start_s, moves.end_s]) if is_edged else np.zeros(0)
    coarse = len(moves.index) > MOST_EXACT
    end_s = simulation.motion_end_s
    samples = motion_samples(robot_run.trajectory, edged, end_s, step_s, coarse=coarse)
    speed, acceleration = rates_between(samples)
    return SampledRun(
        simulation=simulation,
        robot_run=robot_run,
        limits=limits_of(robot_run.robot, simulation.model),
        samples=samples,
        joint_speed=speed,
        joint_acceleration=acceleration,
        in_corner=in_corner(samples, moves),
    )


def motion_samples(
    trajectory: Trajectory,
    edges: Array,
    end_s: float,
    dt: float,
    *,
    coarse: bool = False,
) -> Samples:
    """Sample every `dt` [s] from 0 to `end_s` [s], and at starts and ends of moves, `edges` [s]."""
    grid = np.arange(0.0, end_s, dt)
    times = np.concatenate([grid, np.clip(np.array([0.0, *edges, end_s]), 0.0, end_s)])
    # Viewers count nanoseconds: closer instants would coincide.
    samples = evaluate(trajectory, np.unique(np.round(times, 9)), coarse=coarse)
    return _rows(samples, _worth_keeping(samples, edges))


def evaluate(trajectory: Trajectory, times: Array, *, coarse: bool = False) -> Samples:
    """Samples of a trajectory at `times` (k,) [s], in blocks that fit in memory."""
    blocks = [
        trajectory.at(times[begin : begin + _BLOCK], coarse=coarse)
        for begin in range(0, len(times), _BLOCK)
    ]
    return Samples(
        times=times,
        move=np.concatenate([block.move for block in blocks]),
        joints=np.concatenate([block.joints for block in blocks]),
        base_from_tcp=Transform(
            np.concatenate([block.base_from_tcp.rotation for block in blocks]),
            np.concatenate([block.base_from_tcp.translation for block in blocks]),
        ),
        tcp_speed=np.concatenate([block.tcp_speed for block in blocks]),
        external=np.concatenate([block.external for block in blocks]),
    )


def joint_rates(trajectory: Trajectory, samples: Samples) -> tuple[Array, Array]:
    """Joint speeds [rad/s] and accelerations [rad/s2] (k, n), over 4 ms around each sample."""
    before = evaluate(trajectory, np.maximum(samples.times - _STEP_S, 0.0)).joints
    after = evaluate(trajectory, samples.times + _STEP_S).joints
    speed = (after - before) / (2.0 * _STEP_S)
    acceleration = (after - 2.0 * samples.joints + before) / _STEP_S**2
    return speed, acceleration


def rates_between(samples: Samples) -> tuple[Array, Array]:
    """Joint speeds [rad/s] and accelerations [rad/s2] (k, n), from the samples themselves.

    They are slopes of parabolas through three samples, without neighbours that are closer than
    `_CLOSE_S`: good enough to look at only. At the ends of the run the arm is at rest.
    """
    times, joints = samples.times, samples.joints
    places = np.arange(len(times))
    before = np.minimum(np.searchsorted(times, times - _CLOSE_S, side="right") - 1, places - 1)
    after = np.maximum(np.searchsorted(times, times + _CLOSE_S, side="left"), places + 1)
    speed, acceleration = np.zeros_like(joints), np.zeros_like(joints)
    inner = np.flatnonzero((before >= 0) & (after < len(times)))
    j, k = before[inner], after[inner]
    h, g = (times[inner] - times[j])[:, None], (times[k] - times[inner])[:, None]
    left, right = (joints[inner] - joints[j]) / h, (joints[k] - joints[inner]) / g
    speed[inner] = (left * g + right * h) / (g + h)
    acceleration[inner] = 2.0 * (right - left) / (g + h)
    return speed, acceleration


def in_corner(samples: Samples, moves: MoveColumns) -> npt.NDArray[np.bool_]:
    """Return which samples (k,) are in the zone at either end of their move."""
    if not len(moves.index):
        return np.zeros(len(samples.times), dtype=np.bool_)
    flies_by = np.array([corner is CornerKind.FLY_BY for corner in moves.corners])
    ends, zones = moves.end_m, np.where(flies_by, moves.zone_m, 0.0)
    points = samples.base_from_tcp.translation
    index = np.clip(samples.move, 0, len(ends) - 1)
    before = np.maximum(index - 1, 0)
    at_end = np.linalg.norm(points - ends[index], axis=1) < zones[index]
    at_start = np.linalg.norm(points - ends[before], axis=1) < zones[before]
    inside: npt.NDArray[np.bool_] = at_end | (at_start & (index > 0))
    return inside


def _worth_keeping(samples: Samples, edges: Array) -> npt.NDArray[np.bool_]:
    """Return which samples (k,) differ from one of two neighbours each side, or bound a move.

    At each end of a rest two samples are kept, so that slopes there are zero.
    """
    still = np.abs(np.diff(samples.joints, axis=0)).max(axis=1, initial=0.0) < _STILL
    still &= (samples.tcp_speed[1:] == 0.0) & (samples.tcp_speed[:-1] == 0.0)
    still &= samples.move[1:] == samples.move[:-1]
    keep = np.ones(len(samples.times), dtype=np.bool_)
    keep[2:-2] = ~(still[3:] & still[2:-1] & still[1:-2] & still[:-3])
    keep |= np.isin(samples.times, np.round(edges, 9))
    return keep


def _rows(samples: Samples, rows: npt.NDArray[np.bool_]) -> Samples:
    return Samples(
        times=samples.times[rows],
        move=samples.move[rows],
        joints=samples.joints[rows],
        base_from_tcp=samples.base_from_tcp[rows],
        tcp_speed=samples.tcp_speed[rows],
        external=samples.external[rows] if len(samples.external) else samples.external,
    )
