"""Faults that a test requests."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.files import InputError
from rapidsim.server.resources.codes import BAD_PARAMETER, as_answered, refused
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.states import RequestRefused
from rapidsim.station.faults import read_fault


def begin_fault(live: LiveController, values: Mapping[str, object]) -> None:
    """Make something fail, now unless the values have a time or a condition.

    Raises:
        RefusedRequest: If the values are no fault, or too many faults last.
    """
    try:
        live.faults.add(read_fault(values))
    except InputError as error:
        help = f" ({error.help})" if error.help else ""
        text = f"{error.message}{help}".replace("\n", "; ")
        raise refused(BAD_PARAMETER, text) from None
    except RequestRefused as refusal:
        raise as_answered(refusal, 1) from None
    live.settle()
