"""Active limits along the motion of a robot, as texts: what its speed is limited by, and where.

The planner knows the active limit of each part of a command (`motion/timing/active_constraints`),
and where a ramp of AccSet adds most of the time. In a team, axes and programmed speeds may be those
of another robot.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.time_scaling import Numbers
from rapidsim.motion.trajectory.command import Piece, groups
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_Team = Sequence[tuple[RobotRun, Piece]]

_BELT = "belt that the arm follows"


@value_class(frozen=True, slots=True)
class ActiveLimit:
    """An active limit."""

    quantity: Quantity
    text: str
    """Name such as `torque of axis 2`; if it is of another robot of a team or sets the pace of all,
    such as `TCP speed of T_ROB2, 200 mm/s`."""
    axis: int | None = None
    """Axis of its robot, counted from 1; None if the limit is not of a single axis."""


_NOTHING = ActiveLimit(Quantity.NOTHING, "")


@value_class(frozen=True, slots=True, eq=False)
class _Cells:
    """Cells (k,) of a piece of the motion, and their active limits."""

    piece: Piece
    place: float
    """Position S [m] of the run at the start of the piece."""
    first: int
    """Index of the first cell among those of its timing."""
    numbers: Numbers
    """Shape (k,): index of the active limit."""

    @property
    def nodes(self) -> Array:
        """Positions [m] at the ends of the cells on the path of the piece, shape (k + 1,)."""
        nodes = self.piece.timing.s[self.first : self.first + len(self.numbers) + 1]
        return np.clip(nodes, self.piece.from_s, self.piece.to_s)

    @property
    def starts(self) -> Array:
        """Position S [m] of the run at the start of each cell, shape (k,)."""
        return self.place + self.nodes[:-1] - self.piece.from_s

    @property
    def segments(self) -> Index:
        """Segment of each cell, shape (k,)."""
        return np.searchsorted(self.piece.path.segment_starts, self.nodes[:-1], "right") - 1


@value_class(frozen=True, eq=False)
class ActiveLimits:
    """Active limits of the motion of a robot."""

    trajectory: Trajectory
    limits: tuple[ActiveLimit, ...]
    cells: Sequence[_Cells]
    """Those of each piece, in order."""

    def at(self, times: Array) -> Index:
        """Return indices (m,) of the active limits at times (m,) [s] among `limits`."""
        found = np.zeros(len(times), dtype=np.int64)
        if self.cells:
            places = self.trajectory.place_at(times)
            starts = np.array([cells.starts[0] for cells in self.cells[1:]])
            for number, at in groups(np.searchsorted(starts, places, side="right")):
                cells = self.cells[number]
                cell = np.searchsorted(cells.starts[1:], places[at], side="right")
                found[at] = cells.numbers[cell]
        return found

    @cached_property
    def of_moves(self) -> tuple[str, ...]:
        """Limit that is active for most of the time of each move, empty if it takes no time."""
        ends = (one.piece.first + len(one.piece.path.segments) for one in self.cells)
        kinds = len(self.limits)
        total = np.zeros(max(ends, default=0) * kinds)
        for cells in self.cells:
            moves = cells.piece.first + cells.segments
            times = np.diff(cells.piece.timing.time_at(cells.nodes))
            np.add.at(total, moves * kinds + cells.numbers, times)
        most = total.reshape(-1, kinds).argmax(axis=1).tolist()
        return tuple(self.limits[number].text for number in most)


def active_limits(simulation: Simulation, robot_run: RobotRun) -> ActiveLimits:
    """Return the active limits of a robot's motion."""
    limits: dict[ActiveLimit, int] = {_NOTHING: 0}
    all_cells: list[_Cells] = []
    teams = _teams(simulation, robot_run)
    place = 0.0
    for piece in robot_run.trajectory.command.pieces:
        s, timing = piece.timing.s, piece.timing
        first = max(int(np.searchsorted(s, piece.from_s, side="right")) - 1, 0)
        after = max(int(np.searchsorted(s, piece.to_s, side="left")), first + 1)
        # The last cell ends at the last node.
        after = min(after, len(s) - 1)
        numbers = np.zeros(after - first, dtype=np.int16)
        cells = _Cells(piece, place, first, numbers)
        if timing.active is not None:
            team = teams[id(piece.path), piece.first]
            active = timing.active[first:after]
            kinds = len(timing.limiters)
            # The limits of a robot alone have the same names on all segments.
            is_alone = len(team) == 1 and piece.path.belts is None
            segment = cells.segments
            by_segment = segment * kinds + active
            _, cell, case = np.unique(
                active if is_alone else by_segment, return_index=True, return_inverse=True
            )
            found = np.zeros(len(cell), dtype=np.int16)
            for row in np.argsort(by_segment[cell]).tolist():
                limiter, number = timing.limiters[active[cell[row]]], int(segment[cell[row]])
                limit = _limit(limiter, number, robot_run, team)
                found[row] = limits.setdefault(limit, len(limits))
            numbers[:] = found[case]
        if len(numbers):
            all_cells.append(cells)
        place += piece.to_s - piece.from_s
    return ActiveLimits(robot_run.trajectory, tuple(limits), all_cells)


def limits_of_moves(simulation: Simulation) -> Mapping[int, str]:
    """Return the limit that is active for most of the time of each move that takes time.

    Moves have their numbers in `Simulation.moves`.
    """
    return {
        offset + number: text
        for robot, offset in zip(simulation.robots, simulation.move_offsets, strict=True)
        for number, text in enumerate(active_limits(simulation, robot).of_moves)
        if text
    }


def most_frequent(limits: Mapping[int, str], moves: Iterable[int]) -> str:
    """Return the limit of most of some moves; empty if none is known."""
    counted = Counter(limits[number] for number in moves if number in limits)
    return next((text for text, _ in counted.most_common(1)), "")


def _teams(simulation: Simulation, robot_run: RobotRun) -> Mapping[tuple[int, int], _Team]:
    """Return, by path (its identity) and first move of pieces of a robot, the robots of its team.

    They are in the order of the team, with the same piece of their motion as planned.
    """
    teams: dict[int, list[tuple[RobotRun, Piece]]] = {}
    for robot in simulation.robots:
        first = {id(one.timing): one for one in reversed(robot.trajectory.pieces)}
        for timing, piece in first.items():
            teams.setdefault(timing, []).append((robot, piece))
    pieces = robot_run.trajectory.pieces
    return {(id(one.path), one.first): teams[id(one.timing)] for one in reversed(pieces)}


def _limit(limiter: Limiter, segment: int, robot_run: RobotRun, team: _Team) -> ActiveLimit:
    """Return the limit of a segment of a piece, from the point of view of one robot of a team."""
    text, axis = limiter.text(robot_run.robot.axes), limiter.axis
    if any(
        one is robot_run and piece.path.belts and piece.path.segments[segment].slowed_for_belt
        for one, piece in team
    ):
        text = _BELT
    elif limiter.robot is not None:
        setter, piece = team[limiter.robot]
        move = setter.move(piece.first + segment)
        if move is not None:
            text = f"{limiter} of {setter.task}, {_programmed(limiter.quantity, move)}"
    elif axis is not None and len(team) > 1:
        for robot, piece in team:
            own = piece.path.axis_count
            if axis <= own:
                own_text = Limiter(limiter.quantity, axis).text(robot.robot.axes)
                text = own_text if robot is robot_run else f"{own_text} of {robot.task}"
                break
            axis -= own
    return ActiveLimit(limiter.quantity, text, axis)


def _programmed(quantity: Quantity, move: ExecutedMove) -> str:
    match quantity:
        case Quantity.DURATION:
            return f"{move.move.duration_s:g} s"
        case Quantity.REORIENTATION_SPEED:
            return f"{move.move.speed.v_ori:g} deg/s"
        case _:
            return f"{move.move.speed.v_tcp:g} mm/s"
