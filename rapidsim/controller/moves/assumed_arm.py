"""What becomes of moves that an arm cannot make which nobody has named: the run goes on.

Whether the program is for this arm nobody knows, so nothing is an error that another arm could do.
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.moves.motion_findings import path_violation
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.diagnostics import Violation
from rapidsim.language.moves import Move, Place
from rapidsim.motion.geometry.segments import Geometry

_LEFT_OUT = "left out where the arm that is there by default cannot go; --robot names another"
_IN_JOINTS = (
    "moved in joints where the arm that is there by default cannot follow the way; "
    "--robot names another"
)


def leave_out(journal: Journal, violation: Violation, move: Move, place: Place) -> None:
    """Report a move whose end cannot be reached."""
    journal.finding(violation, place, once=("left out", place.span, violation), assumed=True)
    journal.unsimulated(move.instruction, _LEFT_OUT, place)


def go_in_joints(journal: Journal, error: MotionError) -> bool:
    """Let a move whose way cannot be followed go in joints, and report that.

    Returns:
        False where that does not help: the robot is on the way, or goes in joints already.
    """
    queued = error.queued
    begun = queued.started.time is not None and queued.command_start_s is None
    if begun or queued.length_m or queued.segment.geometry is Geometry.JOINT:
        return False
    violation = path_violation(error)
    journal.finding(
        violation, queued.place, once=("in joints", queued.place.span, violation), assumed=True
    )
    journal.unsimulated(queued.move.instruction, _IN_JOINTS, queued.place)
    queued.segment = replace(queued.segment, geometry=Geometry.JOINT, via=None)
    return True
