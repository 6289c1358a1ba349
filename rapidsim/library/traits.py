"""What routines do, as far as anybody asks: the words of the rows, and what parameters say."""

from __future__ import annotations

from collections.abc import Set as AbstractSet
from enum import Flag, auto


class Trait(Flag):
    """What a call of a routine does."""

    MOVE = auto()
    """Sends the robot to a target that the call names."""
    CARTESIAN = auto()
    """The TCP is led on a line or an arc."""
    AXES = auto()
    """The target is made of axis positions: no work object counts."""
    SEARCH = auto()
    """The move ends where a signal changes."""
    SEARCH_PART = auto()
    """Finds a part; it is simulated where the station says where parts are."""
    WAIT = auto()
    """May let time pass, in which a fly-by corner before it becomes a stop."""
    GIVE_UP = auto()
    """The wait has an end of its own, also where no limit is given."""
    ASK = auto()
    """Waits for a person."""
    OUTPUT = auto()
    """Sets an output at once."""
    SWITCH_ON = auto()
    """Sets it to 1, which the call does not say."""
    SWITCH_OFF = auto()
    """Sets it to 0, which the call does not say."""
    TELL = auto()
    """Shows or logs a text, and changes nothing."""
    INSTANT = auto()
    """Takes no time: the program pointer stays where the zone began."""
    LEAVE = auto()
    """The next statement is never reached."""
    RETRY = auto()
    """Ends an ERROR clause as RETRY does."""
    NEXT_TURN = auto()
    """Begins the next turn of the loop around it."""
    CALL_BY_NAME = auto()
    """Calls a procedure whose name it puts together."""
    CALL_ON_THE_WAY = auto()
    """Calls a procedure by its name when the robot is there: after later statements."""
    READ_BY_NAME = auto()
    """Reaches data by a name that the program puts together."""
    WRITE_BY_NAME = auto()
    """Writes data by such a name."""
    LOAD = auto()
    """Takes other modules into the program."""
    DISCONNECT = auto()
    """Takes an interrupt away from its trap."""
    LEAVE_PATH = auto()
    """What comes next begins where the robot stands, not at the end of the last move."""
    HOLD_ROBOT = auto()
    """The robot stands still until it is told to go on."""
    HOLD_INTERRUPTS = auto()
    """Interrupts are kept until they are let through again."""
    TIME = auto()
    """Answers how late it is: what compares it becomes true by itself."""
    OPEN = auto()
    """Opens a file, which can be opened again when it has been closed."""
    CLOSE = auto()
    """Closes it."""
    COUNT_UP = auto()
    """Adds one to what it is given."""
    ANGLES = auto()
    """Takes angles [deg]: its parameters Rx, Ry, Rz and those that are called angle."""
    OFFSET = auto()
    """Answers a target beside the one it is given."""
    TEST_PRESENT = auto()
    """Answers whether an optional argument was given."""
    READ_ARGUMENT = auto()
    """Only looks, at the data or signal it is given by reference."""
    READ_TASK = auto()
    """Only looks, at what each task has for itself."""
    READ_CELL = auto()
    """Only looks, at what all tasks share."""


NO_TRAITS = Trait(0)
ONLY_LOOKS = Trait.READ_ARGUMENT | Trait.READ_TASK | Trait.READ_CELL
"""Changes nothing."""
LIMITS = frozenset({"maxtime", "maxwait", "timeout"})
"""Parameters that limit how long a routine waits."""
_IMPLIED = ((Trait.OUTPUT, Trait.INSTANT), (Trait.TELL, Trait.INSTANT), (Trait.ASK, Trait.WAIT))


def derived(stated: Trait, parameters: AbstractSet[str]) -> Trait:
    """What a row states, with what follows from it and from folded names of parameters."""
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
