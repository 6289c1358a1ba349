"""Positions of a program in its control flow, and the statement at which a step ends.

Routines run as Python code with the lines of RAPID. Statements that share a line are one step.
"""

from __future__ import annotations

import dis
from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass, field
from enum import Enum, auto
from types import CodeType, FrameType
from weakref import WeakKeyDictionary

from rapidsim.analysis.program import RoutineSymbol
from rapidsim.interpreter.runtime.call_stack import CLAUSES
from rapidsim.interpreter.tools.executable_lines import places_to_stop
from rapidsim.interpreter.tools.inspection import is_rapid, module_of, routine_of
from rapidsim.language.moves import Place
from rapidsim.syntax import tree


class StepGranularity(Enum):
    """Granularity of a step: the statement before which it ends."""

    ANY_WITH_TRAPS = auto()
    """The next statement, in any routine or trap."""
    ANY = auto()
    """The next statement, in any routine."""
    SAME_ROUTINE = auto()
    """The next statement in the routine, or in one of its callers."""
    CALLER = auto()
    """The next statement in one of its callers."""


@dataclass(frozen=True, slots=True)
class StepPosition:
    """Position of a program in its control flow."""

    depth: int
    """Number of routines on the call stack; an ERROR clause belongs to its routine."""
    traps: int
    """Number of traps on the call stack."""
    cycle: FrameType
    """The outermost routine."""

    def ends_step(self, start: StepPosition, reach: StepGranularity) -> bool:
        """Whether a step from an earlier statement of the same task ends here."""
        if reach is StepGranularity.ANY_WITH_TRAPS:
            return True
        if self.traps > start.traps:
            return False
        match reach:
            case StepGranularity.ANY:
                return True
            case StepGranularity.SAME_ROUTINE:
                return self.depth <= start.depth
            case StepGranularity.CALLER:
                return self.depth < start.depth or self.cycle is not start.cycle


class StatementStarts:
    """Recognises the begin of statements from the line events of one frame."""

    __slots__ = ("_before", "_jump", "_line", "_loops", "_places", "_seen", "_start", "has_failed")

    def __init__(
        self, places: Mapping[int, Place], code: CodeType, line: int = 0, instruction: int = 0
    ) -> None:
        """Create it for a frame.

        Args:
            places: The first statement on each line.
            code: Python code of the frame.
            line: Line of the statement that the frame executes; 0 before the first one.
            instruction: Python instruction of the frame.
        """
        self._places, self._line, self._seen = places, line, line
        self._loops = _loops(code)
        self._before = self._start = instruction
        self._jump = -1
        """The jump back that the last event has reached from another line; -1 if none."""
        self.has_failed = False
        """Whether the statement has raised an error since it began."""

    def start(self, frame: FrameType) -> Place | None:
        """The statement that begins with a line event; None if another one continues."""
        line, instruction = frame.f_lineno, frame.f_lasti
        seen, self._seen = self._seen, line
        place = self._places.get(line)
        if place is None:
            return None
        before, self._before = self._before, instruction
        jump, self._jump = self._jump, -1
        is_whole = self._loops.jumps.get(instruction)
        if is_whole is not None and seen == line:
            # From Python 3.12 on, a jump back to its own line is an event, with its instruction.
            # Behind the condition of WHILE it leads to the body, whose turn has begun.
            begins = is_whole or self.has_failed or not _is_while(place)
            self.has_failed = False
            return place if begins and jump != instruction else None
        if is_whole is not None:
            self._jump = instruction
        if line != self._line:
            self._line, self._start, self.has_failed = line, instruction, False
            return place
        if instruction < self._start and _is_while(place):
            # Python evaluates the condition behind the body, from the second turn on, and then
            # jumps to the begin of the body, which has instructions of this line.
            self._start = 0
            return None
        # A statement that runs once continues with later instructions of its line, also in the
        # search for an ERROR clause. One that is repeated begins with an earlier one, or in the
        # first turn of a loop on a single line with that to which the loop jumps.
        is_turn = seen == line and instruction in self._loops.targets
        return place if instruction <= before or is_turn else None


@dataclass(eq=False)
class FramePositions:
    """Positions of frames; the statements of each module are listed once."""

    _places: WeakKeyDictionary[tree.Module, dict[int, Place]] = field(
        default_factory=WeakKeyDictionary
    )

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
        traps = sum(_is_trap(routine_of(one)) for one in routines)
        return StepPosition(len(routines), traps, called[-1])

    def within(self, frame: FrameType, caller: StepPosition) -> StepPosition:
        """Return the position of a frame that the routine at a position has called."""
        is_routine = frame.f_code.co_name not in CLAUSES
        is_trap = is_routine and _is_trap(routine_of(frame))
        return StepPosition(caller.depth + is_routine, caller.traps + is_trap, caller.cycle)

    def traced(self, frame: FrameType) -> StepPosition:
        """Return what `of` does, from the position that the tracer of the caller has.

        A deep stack is thus not counted again for each routine on it.
        """
        caller = next(rapid_frames(frame.f_back), None)
        tracer = None if caller is None else getattr(caller.f_trace, "__self__", None)
        position = getattr(tracer, "position", None)
        if isinstance(position, StepPosition):
            return self.within(frame, position)
        return self.of(frame)

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


def _is_while(place: Place) -> bool:
    return place.span.text[:5].upper() == "WHILE"


@dataclass(frozen=True, slots=True)
class _Loops:
    """Loops of the Python code of a routine."""

    jumps: Mapping[int, bool]
    """Instructions that jump back, each with whether to the first one of its own line."""
    targets: Set[int]
    """Instructions to which they jump."""


_LOOPS: WeakKeyDictionary[CodeType, _Loops] = WeakKeyDictionary()
"""Loops of each routine, for as long as its module is loaded."""


def _loops(code: CodeType) -> _Loops:
    if (known := _LOOPS.get(code)) is not None:
        return known
    jumps, targets = dict[int, bool](), set[int]()
    begins = dict[int | None, int]()
    for one in dis.get_instructions(code):
        line = None if one.positions is None else one.positions.lineno
        begin = begins.setdefault(line, one.offset)
        if one.opcode in dis.hasjrel and one.argval <= one.offset:
            jumps[one.offset] = one.argval <= begin
            targets.add(one.argval)
    loops = _LOOPS[code] = _Loops(jumps, targets)
    return loops


def _is_trap(routine: RoutineSymbol | None) -> bool:
    return routine is not None and isinstance(routine.node, tree.Trap)
