"""Sections in which the TCP is slower than programmed, their duration and active limit.

For programs of thousands of moves, in which no single line explains the time: a section extends
over lines until the speed is reached. Its limit is read from the motion itself: the limit with the
highest use for most of the section. Longer waits at stop points separate sections.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array
from rapidsim.simulation.results.sampling import SampledRun, sampled
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.simulation.results.team_pace import pace_setters
from rapidsim.values import value_class

_STEP_S = 0.012
_MOST_SAMPLES = 20_000
_REACHED = 0.95
"""Share of the programmed speed that counts as reached."""
_AT_LIMIT = 0.95
"""Share of an axis' speed or of the reorientation speed from which on it is the active limit."""
_MOST = 200
_SHORT_STOP_S = 0.3
"""Stops up to this long [s] do not separate sections: stitches between fine points form one."""


@value_class(frozen=True, slots=True)
class SlowSection:
    """A section of a robot's motion below the programmed speed."""

    task: str
    start_s: float
    end_s: float
    lost_s: float
    """Time that would be saved at the programmed speed."""
    first: ExecutedMove
    last: ExecutedMove
    moves: int
    """Number of moves in the section."""
    programmed_mm_s: float
    """Highest programmed speed in the section."""
    reached_mm_s: float
    """Mean speed in the section."""
    limit: str
    """Active limit, such as `acceleration of axis 2`; where a robot of a team sets the pace of all,
    such as `TCP speed of T_ROB2, 200 mm/s`."""

    @property
    def seconds(self) -> float:
        """Duration [s]."""
        return self.end_s - self.start_s


def slow_sections(simulation: Simulation) -> tuple[SlowSection, ...]:
    """Return the slow sections of all robots, those with the largest loss of time first."""
    if not np.isfinite(simulation.motion_end_s):
        return ()
    found = [
        stretch
        for number, one in enumerate(simulation.robots)
        if one.moves
        for stretch in _of_robot(simulation, one, simulation.move_offsets[number])
    ]
    return tuple(sorted(found, key=lambda one: (-one.lost_s, one.start_s, one.task))[:_MOST])


def _of_robot(simulation: Simulation, robot_run: RobotRun, offset: int) -> Iterator[SlowSection]:
    step_s = max(_STEP_S, simulation.motion_end_s / _MOST_SAMPLES)
    run = sampled(simulation, robot_run, step_s, most_moves=0)
    samples, times = run.samples, run.samples.times
    if len(times) < 3:
        return
    move = np.clip(samples.move, 0, len(robot_run.moves) - 1)
    programmed = np.array([each.move.speed.v_tcp for each in robot_run.moves])[move] / 1000.0
    turning = np.radians([each.move.speed.v_ori for each in robot_run.moves])[move]
    share = samples.tcp_speed / np.maximum(programmed, 1e-9)
    moving = np.abs(run.joint_speed).max(axis=1) > 0.0
    below = moving & (share < _REACHED)
    limits, names = _limits(run, turning, np.array(pace_setters(simulation, robot_run))[move])
    # Samples at rest are omitted.
    widths = np.minimum(np.gradient(times), step_s)
    kinds = limits // run.joint_speed.shape[1]
    pieces = [
        (begin, end, (_mode(kinds[begin:end]), float(programmed[begin])))
        for begin, end in _pieces(below, move)
    ]
    for begin, end in _joined(pieces, moving, times):
        rows = np.arange(begin, end)[below[begin:end]]
        held = np.bincount(limits[rows], widths[rows], minlength=len(names))
        first, last = robot_run.moves[int(move[begin])], robot_run.moves[int(move[end - 1])]
        if end == begin + 1:
            continue
        yield SlowSection(
            task=robot_run.task,
            start_s=float(times[begin]),
            end_s=float(times[end - 1]),
            lost_s=float((widths[rows] * (1.0 - np.clip(share[rows], 0.0, 1.0))).sum()),
            first=first,
            last=last,
            moves=int(move[end - 1] - move[begin]) + 1,
            programmed_mm_s=1000.0 * float(programmed[rows].max()),
            reached_mm_s=1000.0 * float(np.average(samples.tcp_speed[rows], weights=widths[rows])),
            limit=names[int(held.argmax())],
        )


def _pieces(below: Array, move: npt.NDArray[np.int64]) -> Iterator[tuple[int, int]]:
    """Yield begin and end of the sections below the programmed speed, separately for each move."""
    for begin, end in _runs(below):
        inner = np.flatnonzero(np.diff(move[begin:end])) + begin + 1
        yield from pairwise([begin, *inner.tolist(), end])


def _joined(
    pieces: Sequence[tuple[int, int, object]], moving: Array, times: Array
) -> list[tuple[int, int]]:
    """Join consecutive pieces with only short stops between, of one kind of limit and one speed."""
    found: list[tuple[int, int]] = []
    held: object = None
    for begin, end, kind in pieces:
        last = found[-1][1] if found else 0
        follows = not moving[last:begin].any() and times[begin] - times[last - 1] <= _SHORT_STOP_S
        if found and kind == held and follows:
            found[-1] = (found[-1][0], end)
        else:
            found.append((begin, end))
        held = kind
    return found


def _mode(kinds: Array) -> int:
    return int(np.bincount(kinds).argmax())


def _limits(run: SampledRun, turning: Array, paces: Array) -> tuple[Array, tuple[str, ...]]:
    """Return the active limit (k,) of each sample, as an index into the names.

    Args:
        run: The samples.
        turning: Programmed reorientation speeds (k,) [rad/s].
        paces: Texts (k,) of what sets the pace of a team; empty if nothing does.
    """
    speeds, accelerations = np.abs(run.speed_shares), np.abs(run.acceleration_shares)
    count = speeds.shape[1]
    setters, setter = np.unique(paces, return_inverse=True)
    names = (
        *(f"speed of axis {k + 1}" for k in range(count)),
        *(f"acceleration of axis {k + 1}" for k in range(count)),
        "reorientation speed",
        *setters.tolist(),
    )
    fast = np.nan_to_num(speeds) / 100.0
    loads = np.nan_to_num(accelerations)
    held = count + loads.argmax(axis=1)
    paced = (paces != "") & (loads.max(axis=1) < 100.0 * _AT_LIMIT)
    held = np.where(paced, 2 * count + 1 + setter, held)
    turns = (_turning(run) >= _AT_LIMIT * np.maximum(turning, 1e-9)) & ~paced
    held = np.where(turns, 2 * count, held)
    held = np.where(fast.max(axis=1) >= _AT_LIMIT, fast.argmax(axis=1), held)
    return held.astype(np.int64), names


def _turning(run: SampledRun) -> Array:
    """Turning speed of the tool (k,) [rad/s]."""
    rotation, times = run.samples.base_from_tcp.rotation, run.samples.times
    steps = vector_from_rotation(np.swapaxes(rotation[:-1], -1, -2) @ rotation[1:])
    rate = np.linalg.norm(steps, axis=-1) / np.maximum(np.diff(times), 1e-9)
    return np.append(rate, 0.0)


def _runs(mask: Array) -> Iterator[tuple[int, int]]:
    """Yield begin and end of each contiguous range of True in a mask (k,)."""
    padded = np.concatenate([[False], mask, [False]])
    bounds = np.flatnonzero(padded[1:] != padded[:-1]).tolist()
    yield from zip(bounds[::2], bounds[1::2], strict=True)
