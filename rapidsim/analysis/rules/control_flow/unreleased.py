"""Rules F420 and F422: interrupts disabled or the robot stopped, and not released on every path."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.modes_in_force import (
    UnrestoredMode,
    settings_of,
    unrestored_modes,
)
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


class InterruptsLeftOff(Violation, code="F422"):
    routine: str
    ends: str


class RobotLeftStopped(Violation, code="F420"):
    trap: str
    ends: str


def find_interrupts_left_off(facts: Facts) -> Iterator[Diagnostic]:
    """Report exits of a routine at which interrupts stay disabled."""
    for part, _ in facts.in_parts(settings_of):
        for left in _unreleased_in(part, facts, Trait.HOLD_INTERRUPTS):
            assert part.routine is not None
            violation = InterruptsLeftOff(part.routine.name.text, left.ends)
            yield part.finding(violation, left.call)


def find_robot_left_stopped(facts: Facts) -> Iterator[Diagnostic]:
    """Report exits of a trap at which the robot stays stopped."""
    for part, _ in facts.in_parts(settings_of):
        if isinstance(part.routine, tree.Trap):
            for left in _unreleased_in(part, facts, Trait.HOLD_ROBOT):
                violation = RobotLeftStopped(part.routine.name.text, left.ends)
                yield part.finding(violation, left.call)


def _unreleased_in(part: ProgramPart, facts: Facts, holds: Trait) -> Iterator[UnrestoredMode]:
    """Modes that a routine sets and should release itself.

    A routine that never releases may be the first of a pair, if another one does.
    """
    for left in unrestored_modes(part, facts, lambda row: holds in row.traits):
        homes = [one for one in facts.parts if _releases(one, left.back)]
        if not homes or part in homes:
            yield left


def _releases(part: ProgramPart, back: str) -> bool:
    return any(call.name.key == back.lower() for call in part.all(tree.Call))
