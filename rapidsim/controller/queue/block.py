"""A block: the moves up to a stop, with the part of the motion along them that is fixed."""

from __future__ import annotations

from dataclasses import field, replace
from typing import TypeAlias

from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.values import value_class

Rows: TypeAlias = tuple[list[QueuedMove], ...]
"""Moves of each robot of a queue, equally many: those of one index are made together."""


@value_class(frozen=True, slots=True)
class Commit:
    """End of the fixed path: a distance past the start of one of the block's moves."""

    time_s: float
    move: int
    distance_m: float
    speed_m_s: float
    spent_s: float | None = 0.0
    """Time [s] that the move has taken so far; None if it was stopped."""


@value_class(frozen=True, slots=True)
class BlockPlan:
    """A tentative plan of the open part of the block."""

    path: Path
    timing: TimeScaling
    first: int
    """Index in the block of the path's first segment."""
    from_m: float
    """Position [m] on the path at which the plan starts."""
    start_s: float
    """Command time of that position."""
    lost_corner: int | None = None
    """Index in the block of a move that ends with a stop instead of its programmed corner."""

    def renumbered(self, count: int) -> BlockPlan:
        """The plan after this many moves at the start of the block have been dropped."""
        lost = None if self.lost_corner is None else self.lost_corner - count
        return replace(self, first=self.first - count, lost_corner=lost)

    def time_at(self, s: float) -> float:
        """Command time [s] at a position [m] of the path."""
        return self.start_s + self.timing.time_at(s)

    def start_of(self, index: int) -> float:
        """Position [m] on the path at which a move of the block starts."""
        return float(self.path.segment_starts[index - self.first])


@value_class(slots=True, eq=False)
class MotionBlock:
    """The moves of one block with the state of planning that StorePath keeps."""

    rows: Rows
    commit: Commit = Commit(0.0, 0, 0.0, 0.0)
    plan: BlockPlan | None = None
    """Plan of the part that is not fixed yet; None if it has to be planned again."""
    driven: list[BlockPlan] = field(default_factory=list)
    """Plans of which a section was travelled, in order of time."""
    is_closed: bool = False
    """Whether its end is decided. It is kept until the next block, as it may still be stopped."""
    is_brief: bool = False
    """Whether its only move shares the wait of the stop points at its ends."""
    is_halted: bool = False
    """Whether StopMove holds it until StartMove."""

    @property
    def moves(self) -> list[QueuedMove]:
        """The moves of the first robot; those of the others begin and end with them."""
        return self.rows[0]

    @property
    def is_open(self) -> bool:
        """Whether more moves may follow."""
        return bool(self.rows[0]) and not self.is_closed

    def index_of(self, number: int, queued: QueuedMove) -> int | None:
        """Index of a move of the robot of this number; None for moves of other blocks."""
        row = self.rows[number]
        near = queued.number - row[0].number if row else -1
        if 0 <= near < len(row) and row[near] is queued:
            return near
        # Between two of its moves, the robot may have moved along another path.
        return next((index for index, move in enumerate(row) if move is queued), None)

    def forget(self, before_s: float) -> int:
        """Discard what was travelled before a time [s]; return the number of dropped moves.

        The start of the next plan stays, and so does the part on which the robot might still brake.
        """
        begun = [one.start_s < before_s for one in self.driven]
        driven = self.driven[max(sum(begun) - 1, 0) :]
        plans = driven if self.plan is None else [*driven, self.plan]
        gone = max(0, min([self.commit.move - 1, *(one.first for one in plans)]))
        if gone:
            for row in self.rows:
                del row[:gone]
            self.commit = replace(self.commit, move=self.commit.move - gone)
            self.plan = None if self.plan is None else self.plan.renumbered(gone)
        self.driven = [one.renumbered(gone) for one in driven]
        return gone


def empty_block(count: int, *, is_halted: bool = False) -> MotionBlock:
    """A block without moves of this many robots."""
    return MotionBlock(tuple([] for _ in range(count)), is_halted=is_halted)
