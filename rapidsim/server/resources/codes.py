"""Error codes of controllers, status and number: recorded answers of RobotWare 6.16."""

from __future__ import annotations

from typing import Final

from rapidsim.server.messages import RefusedRequest
from rapidsim.simulation.live.states import RefusalReason, RequestRefused

NOT_FOUND: Final = (404, -1073414146)
NO_SYMBOL: Final = (400, -1073414146)
NO_SIGNAL: Final = (404, -1073445866)
BAD_PARAMETER: Final = (400, -1073445879)
BAD_STATE: Final = (400, -1073442809)
HELD_BY_ANOTHER: Final = (403, -1073445862)
NOT_HELD: Final = (403, -1073445859)
NOT_ALLOWED: Final = (403, -1073445867)
NO_WRITE_ACCESS: Final = (403, -1073435873)
WRITE_ACCESS_TAKEN: Final = (403, -1073435870)
GONE: Final = (410, -1073414146)
READ_ONLY: Final = (403, -1073445881)
NO_PAGE: Final = (400, -1073445883)
NO_POINTER: Final = -1073414145

# Codes of RobotWare 7 for "not found" and "no such symbol" of 6.16.
LATER_NO_SYMBOL: Final = (404, -1073442816)
LATER_NO_TASK: Final = (404, -1073445879)
LATER_NO_MODULE: Final = (400, -1073442813)
LATER_NO_FILE: Final = (404, -1073438713)
LATER_NO_VOLUME: Final = (400, -1073438716)

NO_FILE_TO_LOAD: Final = (400, -1073438708)
NO_MODULE_TO_UNLOAD: Final = (400, -1073442816)

_OF: Final = {
    RefusalReason.STATE: BAD_STATE,
    RefusalReason.VALUE: BAD_PARAMETER,
    RefusalReason.NO_TASK: NOT_FOUND,
    RefusalReason.NO_SYMBOL: NO_SYMBOL,
    RefusalReason.NO_SIGNAL: NO_SIGNAL,
    RefusalReason.NO_UNIT: NOT_FOUND,
    RefusalReason.NO_FILE: NO_FILE_TO_LOAD,
    RefusalReason.NO_MODULE: NO_MODULE_TO_UNLOAD,
    RefusalReason.READ_ONLY: READ_ONLY,
}


def refused(
    reason: tuple[int, int], message: str, later: tuple[int, int] | None = None
) -> RefusedRequest:
    """Return the error of a request; `later` is the code of RobotWare 7 if it differs."""
    return RefusedRequest(*reason, message, later)


_OF_SECOND: Final = {
    **_OF,
    RefusalReason.NO_MODULE: LATER_NO_MODULE,
    RefusalReason.NO_TASK: LATER_NO_TASK,
    RefusalReason.NO_SYMBOL: LATER_NO_SYMBOL,
}
"""Codes of RobotWare 7 by reason."""


def as_answered(refusal: RequestRefused, generation: int) -> RefusedRequest:
    """Return a refusal of the controller as the answer to a request."""
    why = (_OF if generation == 1 else _OF_SECOND)[refusal.why]
    return RefusedRequest(*why, refusal.message)
