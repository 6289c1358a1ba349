"""Key figures of a run, computed from moves and trajectory.

Everything is a function of the simulation alone, so a report of the same run is the same text.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.singularities import per_metre
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.timing.axis_limits import constants_of, limits_of
from rapidsim.simulation.results.acceleration_sensitivity import extra_time_s
from rapidsim.simulation.results.active_limits import limits_of_moves
from rapidsim.simulation.results.sampling import MOST_EXACT
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation
from rapidsim.simulation.results.time_shares import Share, by_line, slowest_lines
from rapidsim.values import value_class

_SAMPLE_S = 0.012
_MOST_SAMPLES = 20_000
_AT_ONCE = 2_000
"""Number of samples per batch, which bounds the memory."""
_SLOWEST = 5
_ON_PATH_MM = 1e-3
_GUESSED_FACTOR = 2.0
_CUT_SHORT = (End.ERROR, End.TIME_LIMIT)


@value_class(frozen=True, slots=True)
class JointMargin:
    """Least margin of a joint to its limit."""

    degrees: float
    """Margin [deg], [mm] for a sliding joint; negative beyond the limit."""
    joint: int
    """From 1."""
    measure: str
    """RAPID's unit of that joint's values."""
    time_s: float
    move: ExecutedMove


@value_class(frozen=True, slots=True)
class SingularityMargin:
    """Least singular value of the run."""

    smallest_singular_value: float
    """Least singular value of the flange's Jacobian in m and rad; 0 in a singularity."""
    time_s: float
    move: ExecutedMove


@value_class(frozen=True, slots=True)
class OffPath:
    """The farthest that smoothing takes the TCP from the path that is commanded."""

    mm: float
    time_s: float
    move: ExecutedMove


@value_class(frozen=True, slots=True)
class Figures:
    """Figures of the summary of a run."""

    moves_by_instruction: tuple[tuple[str, int], ...]
    """In order of first use."""
    moves_by_corner: tuple[tuple[CornerKind, int], ...]
    slowest: tuple[Share, ...]
    """The lines whose moves took longest."""
    slowest_waits: tuple[Share, ...]
    """The lines that waited longest."""
    slowest_robot_waits: tuple[Share, ...]
    """The lines of tasks with a robot."""
    slowest_other_waits: tuple[Share, ...]
    """The lines of tasks without a robot, which tend to wait all the time."""
    joint_margin: JointMargin | None
    """None where nothing moved."""
    singularity: SingularityMargin | None
    off_path: OffPath | None
    """None where the arm stays on its path."""
    limits: Mapping[int, str]
    """Limit that is active for most of the time of a move, by the number of the move."""
    sensitivity: tuple[AccelerationSensitivity, ...]
    """Times of the run with other accelerations; none where nothing moved, or too much.

    Nor where the program did not finish: that is no cycle time.
    """


@value_class(frozen=True, slots=True)
class AccelerationSensitivity:
    """Duration of the run with other accelerations of the axes."""

    factor: float
    """On all accelerations."""
    time_s: float
    of_torques: bool

    @property
    def words(self) -> str:
        """Label, such as `67 % of the torques`."""
        limits = "torques" if self.of_torques else "accelerations"
        return f"{100.0 * self.factor:.0f} % of the {limits}"


def figures(simulation: Simulation) -> Figures:
    """Compute the figures of a run."""
    moves = simulation.moves
    corners = Counter(moves.columns.corners)
    instructions = Counter(one.instruction for one in moves.columns.templates)
    waits, with_robot = by_line(simulation.waits), {one.task for one in simulation.robots}
    found = [
        _along_the_path(robot, offset, simulation.motion_end_s)
        for robot, offset in zip(simulation.robots, simulation.move_offsets, strict=True)
        if robot.moves
    ]
    margins, singularities = [margin for margin, _, _ in found], [place for _, place, _ in found]
    off_path = [off for _, _, off in found if off is not None]
    return Figures(
        moves_by_instruction=tuple(instructions.items()),
        moves_by_corner=tuple((kind, corners[kind]) for kind in CornerKind if kind in corners),
        slowest=slowest_lines(moves, _SLOWEST),
        slowest_waits=waits[:_SLOWEST],
        slowest_robot_waits=tuple(one for one in waits if one.task in with_robot)[:_SLOWEST],
        slowest_other_waits=tuple(one for one in waits if one.task not in with_robot)[:_SLOWEST],
        joint_margin=min(margins, key=lambda one: one.degrees, default=None),
        singularity=min(singularities, key=lambda one: one.smallest_singular_value, default=None),
        off_path=max(off_path, key=lambda one: one.mm, default=None),
        limits=limits_of_moves(simulation),
        # What one robot would save, another may wait away.
        sensitivity=_sensitivity(simulation) if moves and _has_cycle_time(simulation) else (),
    )


def _has_cycle_time(simulation: Simulation) -> bool:
    """Whether the time of the run is that of a whole cycle, and of one robot."""
    return simulation.end not in _CUT_SHORT and len(simulation.robots) == 1


def _sensitivity(simulation: Simulation) -> tuple[AccelerationSensitivity, ...]:
    """The times with less and more acceleration, which is the assumption that counts most."""
    only = simulation.only
    limits = limits_of(only.robot, simulation.model)
    model = simulation.model
    has_own = model.own_accelerations and model.acceleration is None
    either_way = constants_of(only.robot, model).factor if has_own else _GUESSED_FACTOR
    times = []
    for factor in (1.0 / either_way, either_way):
        extra_s = extra_time_s(only.trajectory, limits, factor)
        if extra_s is None:
            return ()
        times.append(
            AccelerationSensitivity(factor, simulation.time_s + extra_s, bool(limits.arms))
        )
    return tuple(times)


def _along_the_path(
    run: RobotRun, offset: int, end_s: float
) -> tuple[JointMargin, SingularityMargin, OffPath | None]:
    robot = run.robot
    times = _sample_times(run, min(run.trajectory.duration, end_s))
    parts = np.array_split(times, len(times) // _AT_ONCE + 1)
    looks = [_looked_at(run, part) for part in parts]
    under_way, left, smallest, off_m = map(np.concatenate, zip(*looks, strict=True))
    indices = run.moves.columns.index

    def move_at(row: int) -> ExecutedMove:
        """Number of the active move among the moves of all robots.

        If the run ends where a move begins, the move before it.
        """
        before = int(np.searchsorted(indices, under_way[row], side="right")) - 1
        move = run.moves[max(before, 0)]
        return replace(move, index=offset + move.index)

    # Of places that differ by rounding only, as in each round of a loop, the first.
    row, joint = (int(i) for i in np.unravel_index(np.argmin(np.round(left, 9)), left.shape))
    margin = JointMargin(
        degrees=float(np.degrees(left[row, joint])),
        joint=joint + 1,
        measure=robot.joints[joint].measure,
        time_s=float(times[row]),
        move=move_at(row),
    )
    row = int(np.argmin(np.round(smallest, 9)))
    singularity = SingularityMargin(
        smallest_singular_value=float(smallest[row]),
        time_s=float(times[row]),
        move=move_at(row),
    )
    row = int(np.argmax(np.round(off_m, 9)))
    off_path = OffPath(round(1000.0 * float(off_m[row]), 3), float(times[row]), move_at(row))
    return margin, singularity, off_path if off_path.mm > _ON_PATH_MM else None


def _looked_at(run: RobotRun, times: Array) -> tuple[Index, Array, np.ndarray, Array]:
    """State of the arm at times (k,) [s].

    Returns:
        The move under way (k,), what is left to the nearer limit of each joint (k, n) [rad], the
        smallest singular value (k,), and how far the TCP is off the path (k,) [m].
    """
    robot, samples = run.robot, run.trajectory.at(times, coarse=len(run.moves) > MOST_EXACT)
    left = np.minimum(samples.joints - robot.lower, robot.upper - samples.joints)
    jacobians = per_metre(robot.kinematics, robot.kinematics.jacobian(samples.joints))
    smallest = np.linalg.svd(jacobians, compute_uv=False)[:, -1]
    return samples.move, left, smallest, run.trajectory.off_path(samples)


def _sample_times(run: RobotRun, end: float) -> Array:
    """Sample times during motion, without the rest before the first move.

    The ends of moves are among them, unless there are more than instants.
    """
    moves = run.moves.columns
    start = float(moves.start_s[0])
    count = min(_MOST_SAMPLES, int((end - start) / _SAMPLE_S) + 2)
    ends = moves.end_s if len(moves.end_s) <= _MOST_SAMPLES else np.zeros(0)
    return np.unique(np.concatenate([np.linspace(start, end, count), ends.clip(start, end)]))
