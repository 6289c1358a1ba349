r"""Correction generators: offsets of a sensor to paths with \Corr; see `path_offset`.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "CorrCon",
"CorrWrite", "CorrRead", "CorrDiscon", "CorrClear".
"""

from __future__ import annotations

from rapidsim.language.annotations import CorrDescr, Var
from rapidsim.language.controller import Motion
from rapidsim.language.data import Pos
from rapidsim.language.error_numbers import (
    CORR_NOFREE,
    CORR_NOOBJECT,
    CORR_NOTCONN,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.library.path_offset import sum_of
from rapidsim.library.poses import single_pos
from rapidsim.library.table import routine, table

MOST_GENERATORS = 5
"""Maximum number of connected correction generators."""
_NOTHING = Pos(0.0, 0.0, 0.0)


def corr_con(controller: Motion, descr: Var[CorrDescr]) -> None:
    """Connect a correction generator."""
    used = controller.corrections
    if len(used) >= MOST_GENERATORS:
        raise rapid_error(CORR_NOFREE, f"all {MOST_GENERATORS} correction generators are connected")
    descr.value = next(number for number in range(1, MOST_GENERATORS + 1) if number not in used)
    used[descr.value] = _NOTHING


def corr_discon(controller: Motion, descr: Var[CorrDescr]) -> None:
    """Disconnect a correction generator; its correction ends."""
    del controller.corrections[_connected(controller, descr)]
    descr.value = None


def corr_clear(controller: Motion) -> None:
    """Disconnect all correction generators."""
    controller.corrections.clear()


def corr_write(controller: Motion, descr: Var[CorrDescr], data: Pos) -> None:
    """Set the correction of a generator [mm], in the path coordinate system."""
    controller.corrections[_connected(controller, descr)] = data


def corr_read(controller: Motion) -> Pos:
    """The sum of the corrections of all generators [mm]."""
    if not controller.corrections:
        raise rapid_error(CORR_NOOBJECT, "no correction generator is connected")
    return single_pos(sum_of(controller.corrections))


def _connected(controller: Motion, descr: Reference[int | None]) -> int:
    number = descr.value
    if number is None or number not in controller.corrections:
        raise rapid_error(CORR_NOTCONN, "the correction generator is not connected; CorrCon is")
    return number


CORRECTIONS = table(
    routine("CorrCon", corr_con),
    routine("CorrDiscon", corr_discon),
    routine("CorrClear", corr_clear),
    routine("CorrWrite", corr_write),
    routine("CorrRead", corr_read),
)
