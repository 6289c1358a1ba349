"""Sections in which the TCP is slower than programmed, their duration and active limit.

For programs of thousands of moves, in which no single line explains the time: a section extends
over lines until the speed is reached. Its limit is the one that is active for most of its time.
Longer waits at stop points separate sections.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.timing.constraints import Quantity
from rapidsim.simulation.results.active_limits import active_limits
from rapidsim.simulation.results.sampling import sampled
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_STEP_S = 0.012
_MOST_SAMPLES = 20_000
_REACHED = 0.95
"""Share of the programmed speed that counts as reached."""
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
    """Active limit for most of the time; see `ActiveLimit`."""

    @property
    def seconds(self) -> float:
        """Duration [s]."""
        return self.end_s - self.start_s


@value_class(frozen=True, slots=True)
class SlowLines:
    """Sections of the same lines with the same limit, as of a loop."""

    sections: tuple[SlowSection, ...]

    @property
    def seconds(self) -> float:
        """Duration [s] of all."""
        return sum(one.seconds for one in self.sections)

    @property
    def lost_s(self) -> float:
        """Time that would be saved at the programmed speed."""
        return sum(one.lost_s for one in self.sections)

    @property
    def moves(self) -> int:
        """Number of moves in all."""
        return sum(one.moves for one in self.sections)

    @property
    def programmed_mm_s(self) -> float:
        """Highest programmed speed."""
        return max(one.programmed_mm_s for one in self.sections)

    @property
    def reached_mm_s(self) -> float:
        """Mean speed."""
        return sum(one.reached_mm_s * one.seconds for one in self.sections) / self.seconds


def slow_sections(simulation: Simulation) -> tuple[SlowSection, ...]:
    """Return the slow sections of all robots, those with the largest loss of time first."""
    return tuple(_all_sections(simulation)[:_MOST])


def slow_lines(simulation: Simulation) -> tuple[SlowLines, ...]:
    """Return the slow sections by lines and limit, the largest loss of time first."""
    found: dict[object, list[SlowSection]] = {}
    for one in _all_sections(simulation):
        ends = (one.first.place.span, one.last.place.span)
        lines = tuple((span.file, span.line) for span in ends)
        found.setdefault((one.task, lines, one.limit), []).append(one)
    merged = [SlowLines(tuple(sections)) for sections in found.values()]
    return tuple(sorted(merged, key=lambda one: -one.lost_s))


def _all_sections(simulation: Simulation) -> list[SlowSection]:
    if not np.isfinite(simulation.motion_end_s):
        return []
    found = [
        stretch
        for number, one in enumerate(simulation.robots)
        if one.moves
        for stretch in _of_robot(simulation, one, simulation.move_offsets[number])
    ]
    return sorted(found, key=lambda one: (-one.lost_s, one.start_s, one.task))


def _of_robot(simulation: Simulation, robot_run: RobotRun, offset: int) -> Iterator[SlowSection]:
    step_s = max(_STEP_S, simulation.motion_end_s / _MOST_SAMPLES)
    run = sampled(simulation, robot_run, step_s, most_moves=0)
    samples, times = run.samples, run.samples.times
    if len(times) < 3:
        return
    move = np.clip(samples.move, 0, len(robot_run.moves) - 1)
    programmed = robot_run.moves.columns.speed_mm_s[move] / 1000.0
    share = samples.tcp_speed / np.maximum(programmed, 1e-9)
    moving = np.abs(run.joint_speed).max(axis=1) > 0.0
    below = moving & (share < _REACHED)
    active = active_limits(simulation, robot_run)
    limits = active.at(times)
    unreached = np.array([one.text == Quantity.TCP_SPEED.value for one in active.limits])
    quantities = list(Quantity)
    kinds = np.array([quantities.index(one.quantity) for one in active.limits])[limits]
    # Samples at rest are omitted.
    widths = np.minimum(np.gradient(times), step_s)
    pieces = [
        (begin, end, (_mode(kinds[begin:end]), float(programmed[begin])))
        for begin, end in _pieces(below, move)
    ]
    for begin, end in _joined(pieces, moving, times):
        rows = np.arange(begin, end)[below[begin:end]]
        held = np.bincount(limits[rows], widths[rows], minlength=len(active.limits))
        # What is below the programmed speed is smoothed: the command has reached it.
        others = np.where(unreached, 0.0, held)
        held = others if others.any() else held
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
            limit=active.limits[int(held.argmax())].text,
        )


def _pieces(below: Mask, move: npt.NDArray[np.int64]) -> Iterator[tuple[int, int]]:
    """Yield begin and end of the sections below the programmed speed, separately for each move."""
    for begin, end in _runs(below):
        inner = np.flatnonzero(np.diff(move[begin:end])) + begin + 1
        yield from pairwise([begin, *inner.tolist(), end])


def _joined(
    pieces: Sequence[tuple[int, int, object]], moving: Mask, times: Array
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


def _mode(kinds: npt.NDArray[np.int64]) -> int:
    return int(np.bincount(kinds).argmax())


def _runs(mask: Mask) -> Iterator[tuple[int, int]]:
    """Yield begin and end of each contiguous range of True in a mask (k,)."""
    padded = np.concatenate([[False], mask, [False]])
    bounds = np.flatnonzero(padded[1:] != padded[:-1]).tolist()
    yield from zip(bounds[::2], bounds[1::2], strict=True)
