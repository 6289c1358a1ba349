"""Traits of routines: stated in their rows or derived from their parameters."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from enum import Flag, auto


class Trait(Flag):
    """Effects and roles of a call of a routine."""

    MOVE = auto()
    """Moves the robot to a target that the call names."""
    CARTESIAN = auto()
    """The TCP moves on a line or an arc."""
    AXES = auto()
    """The target consists of axis positions: no work object applies."""
    SEARCH = auto()
    """The move ends when a signal changes."""
    SEARCH_PART = auto()
    """Searches for a part; simulated if the station defines the positions of parts."""
    WAIT = auto()
    """May let time pass, which turns a preceding fly-by into a stop."""
    GIVE_UP = auto()
    """The wait has a time limit even if the call specifies none."""
    ASK = auto()
    """Waits for a person."""
    OUTPUT = auto()
    """Sets an output at once."""
    SWITCH_ON = auto()
    """Sets an output to 1 implicitly."""
    SWITCH_OFF = auto()
    """Sets an output to 0 implicitly."""
    TELL = auto()
    """Shows or logs a text without further effects."""
    INSTANT = auto()
    """Takes no time: the program pointer is still at the start of the zone."""
    LEAVE = auto()
    """The next statement is unreachable."""
    RETRY = auto()
    """Ends an ERROR clause as RETRY does."""
    NEXT_TURN = auto()
    """Begins the next iteration of the enclosing loop."""
    CALL_BY_NAME = auto()
    """Calls a procedure whose name the program computes."""
    CALL_ON_THE_WAY = auto()
    """Calls a named procedure when the robot arrives, after later statements."""
    READ_BY_NAME = auto()
    """Reads data whose name the program computes."""
    WRITE_BY_NAME = auto()
    """Writes data whose name the program computes."""
    LOAD = auto()
    """Adds other modules to the program."""
    DISCONNECT = auto()
    """Disconnects an interrupt from its trap."""
    LEAVE_PATH = auto()
    """The next move starts at the robot's position, not at the end of the last move."""
    HOLD_ROBOT = auto()
    """Stops the robot until another call restarts it."""
    HOLD_INTERRUPTS = auto()
    """Defers interrupts until they are enabled again."""
    TIME = auto()
    """Returns a time: a comparison with it becomes true without further action."""
    OPEN = auto()
    """Opens a file, which can be opened again after it has been closed."""
    CLOSE = auto()
    """Closes a file."""
    COUNT_UP = auto()
    """Adds one to its argument."""
    ANGLES = auto()
    """Takes angles [deg]: its parameters Rx, Ry, Rz and those named angle."""
    OFFSET = auto()
    """Returns a target with an offset from its argument."""
    TEST_PRESENT = auto()
    """Returns whether an optional argument is present."""
    READ_ARGUMENT = auto()
    """Read-only: reads the data or signal that it gets by reference."""
    READ_TASK = auto()
    """Read-only: reads state that each task has separately."""
    READ_CELL = auto()
    """Read-only: reads state that all tasks share."""


NO_TRAITS = Trait(0)
ONLY_LOOKS = Trait.READ_ARGUMENT | Trait.READ_TASK | Trait.READ_CELL
"""Traits of calls without side effects."""
LIMITS = frozenset({"maxtime", "maxwait", "timeout"})
"""Parameters that limit the waiting time of a routine."""
_IMPLIED = ((Trait.OUTPUT, Trait.INSTANT), (Trait.TELL, Trait.INSTANT), (Trait.ASK, Trait.WAIT))


def derived(stated: Trait, parameters: AbstractSet[str]) -> Trait:
    """Stated traits, with the traits that follow from them and from folded parameter names."""
    does = stated
    if "tojointpos" in parameters:
        does |= Trait.MOVE | Trait.AXES
    if "topoint" in parameters:
        does |= Trait.MOVE
    if not parameters.isdisjoint(LIMITS):
        does |= Trait.WAIT
    if "breakflag" in parameters:
        does |= Trait.ASK
    for one, other in _IMPLIED:
        if one in does:
            does |= other
    return does
