"""The counter of the path that the TCP travels.

At PP to main the counter is off and 0. Unverified: no source documents the state of a controller's
counter there.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "PathLengthGet",
"PathLengthReset", "PathLengthStart", "PathLengthStop".
"""

from __future__ import annotations

from rapidsim.language.annotations import Num
from rapidsim.language.path_control import PathLength
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait


def path_length_get(controller: PathLength) -> Num:
    """The length [mm] that the TCP has travelled while the counter was on, along corner paths."""
    return controller.length()


def path_length_reset(controller: PathLength) -> None:
    """Set the counter of the path length to 0."""
    controller.reset()


def path_length_start(controller: PathLength) -> None:
    """Count the path length from here on, in addition to what was counted before."""
    controller.switch_on()


def path_length_stop(controller: PathLength) -> None:
    """Stop counting the path length; PathLengthGet still reads it."""
    controller.switch_off()


PATH_LENGTH = table(
    routine("PathLengthReset", path_length_reset),
    routine("PathLengthStart", path_length_start),
    routine("PathLengthStop", path_length_stop),
    routine("PathLengthGet", path_length_get, does=Trait.READ_TASK),
)
