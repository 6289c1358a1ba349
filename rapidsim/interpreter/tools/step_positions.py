"""Positions of a program in its control flow, and the statement at which a step ends.

Routines run as Python code with the lines of RAPID. Statements that share a line are one step.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum, auto
from types import FrameType

from rapidsim.analysis.program import RoutineSymbol
from rapidsim.interpreter.runtime.call_stack import CLAUSES
from rapidsim.interpreter.tools.executable_lines import places_to_stop
from rapidsim.interpreter.tools.inspection import is_rapid, module_of, routine_of
from rapidsim.language.moves import Place
from rapidsim.syntax import tree


class StepGranularity(Enum):
    """Granularity of a step: the statement before which it ends."""

    ANY = auto()
    """The next statement, in any routine."""
    SAME_ROUTINE = auto()
    """The next statement in the routine, or in one of its callers."""
    CALLER = auto()
    """The next statement in one of its callers."""


@dataclass(frozen=True, slots=True)
class StepPosition:
    """Position of a program in its control flow."""

    frame: FrameType
    reached: dict[FrameType, tuple[int, int]]
    """Line of the current statement and Python instruction, for the routine and its callers: a
    statement that runs only once continues with later instructions.
    """
    depth: int
    """Number of routines on the call stack; an ERROR clause belongs to its routine."""
    traps: int
    """Number of traps on the call stack."""
    cycle: FrameType
    """The outermost routine."""

    def has_moved(self, before: StepPosition) -> bool:
        """Whether another statement runs than before, or the same one again."""
        line, instruction = self.reached[self.frame]
        line_before, instruction_before = before.reached.get(self.frame, (0, 0))
        return line != line_before or instruction <= instruction_before

    def ends_step(self, start: StepPosition, reach: StepGranularity) -> bool:
        """Whether a step from an earlier position of the same task ends here."""
        if self.traps > start.traps or not self.has_moved(start):
            return False
        match reach:
            case StepGranularity.ANY:
                return True
            case StepGranularity.SAME_ROUTINE:
                return self.depth <= start.depth
            case StepGranularity.CALLER:
                return self.depth < start.depth or self.cycle is not start.cycle


@dataclass(eq=False)
class FramePositions:
    """Positions of frames; the statements of each module are listed once."""

    _places: dict[tree.Module, dict[int, Place]] = field(default_factory=dict)

    def places(self, frame: FrameType) -> dict[int, Place]:
        """The first statement on each line of a frame's module."""
        module = module_of(frame)
        if module not in self._places:
            self._places[module] = places_to_stop(module)
        return self._places[module]

    def of(self, frame: FrameType) -> StepPosition:
        """Return the position of the routine of a frame."""
        called = list(rapid_frames(frame))
        routines = [one for one in called if one.f_code.co_name not in CLAUSES]
        traps = self.traps(frame)
        reached = {one: (self.line(one), one.f_lasti) for one in called}
        return StepPosition(frame, reached, len(routines), traps, called[-1])

    def traps(self, frame: FrameType) -> int:
        """Number of traps among a frame's routine and its callers."""
        return sum(
            one.f_code.co_name not in CLAUSES and _is_trap(routine_of(one))
            for one in rapid_frames(frame)
        )

    def line(self, frame: FrameType) -> int:
        """Line on which the running statement begins."""
        lines = self.places(frame)
        return max((one for one in lines if one <= frame.f_lineno), default=frame.f_lineno)


def rapid_frames(frame: FrameType | None) -> Iterator[FrameType]:
    """Yield the frames of routines from a frame outwards, the innermost first."""
    while frame is not None:
        if is_rapid(frame):
            yield frame
        frame = frame.f_back


def _is_trap(routine: RoutineSymbol | None) -> bool:
    return routine is not None and isinstance(routine.node, tree.Trap)
