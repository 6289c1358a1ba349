"""A block: the moves up to a stop, and how much of the motion along them is fixed."""

from __future__ import annotations

from dataclasses import field, replace

from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Commit:
    """Up to here the path is fixed: a distance past the start of one of the block's moves."""

    time_s: float
    move: int
    distance_m: float
    speed_m_s: float
    spent_s: float | None = 0.0
    """How long the move has taken so far; None if it was stopped on its way."""


@value_class(frozen=True, slots=True)
class BlockPlan:
    """A tentative plan of the open part of the block."""

    path: Path
    timing: TimeScaling
    first: int
    """Index in the block of the path's first segment."""
    from_m: float
    """Where on the path the plan starts."""
    start_s: float
    """Command time at that place."""
    lost_corner: int | None = None
    """Index in the block of a move that ends with a stop instead of its programmed corner."""

    def renumbered(self, count: int) -> BlockPlan:
        """The same after this many moves at the start of the block have been dropped."""
        lost = None if self.lost_corner is None else self.lost_corner - count
        return replace(self, first=self.first - count, lost_corner=lost)

    def time_at(self, s: float) -> float:
        """Command time [s] at a place of the path."""
        return self.start_s + self.timing.time_at(s)

    def start_of(self, index: int) -> float:
        """Where on the path a move of the block starts [m]."""
        return float(self.path.segment_starts[index - self.first])


@value_class(slots=True, eq=False)
class MotionBlock:
    """The moves of one block and what became of them: what StorePath keeps of the planning."""

    moves: list[QueuedMove] = field(default_factory=list)
    commit: Commit = Commit(0.0, 0, 0.0, 0.0)
    plan: BlockPlan | None = None
    """Of the part that is not fixed yet; None if it has to be planned again."""
    driven: list[BlockPlan] = field(default_factory=list)
    """The plans whose stretches have been travelled, in order of time."""
    is_closed: bool = False
    """It has its end. It is kept until the next block begins, as it may be stopped on its way."""
    is_halted: bool = False
    """StopMove: nothing moves until StartMove."""

    @property
    def is_open(self) -> bool:
        """Whether more moves may follow."""
        return bool(self.moves) and not self.is_closed

    def forget(self, before_s: float) -> int:
        """Forget what was travelled before a time [s]; how many moves are gone.

        What the next plan begins with stays, and so does what the robot might still brake on.
        """
        begun = [one.start_s < before_s for one in self.driven]
        driven = self.driven[max(sum(begun) - 1, 0) :]
        plans = driven if self.plan is None else [*driven, self.plan]
        gone = max(0, min([self.commit.move - 1, *(one.first for one in plans)]))
        if gone:
            del self.moves[:gone]
            self.commit = replace(self.commit, move=self.commit.move - gone)
            self.plan = None if self.plan is None else self.plan.renumbered(gone)
        self.driven = [one.renumbered(gone) for one in driven]
        return gone
