"""Control stations, which in RobotWare 8 take the place of masterships.

A session registers as a control station, and requests write access for it. As recorded on RobotWare
8.1.1: a write that succeeds clears the mark that the access is held, but not the right to write,
and the end of a session neither: a client that forgets to release keeps others out, unless it has
registered with `release-write-access-when-lost`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final

from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import (
    BAD_PARAMETER,
    GONE,
    NO_WRITE_ACCESS,
    WRITE_ACCESS_TAKEN,
    refused,
)
from rapidsim.server.resources.context import ControlStation, RequestContext, required_value

_ID: Final = re.compile(r"\{[0-9A-Fa-f]{8}(-[0-9A-Fa-f]{4}){3}-[0-9A-Fa-f]{12}\}")


def no_mastership(context: RequestContext, request: Request, rest: str = "") -> Answer:
    """Refuse: there are no masterships.

    Raises:
        RefusedRequest: Always.
    """
    del context, request, rest
    raise refused(GONE, "masterships have been replaced by control stations")


def register(context: RequestContext, request: Request) -> Answer:
    """Register the session as a remote control station."""
    form = request.form
    name, identity = (required_value(form, f"control-station-{one}") for one in ("name", "id"))
    required_value(form, "pincode")
    if _ID.fullmatch(identity) is None:
        raise refused(BAD_PARAMETER, "Control station id not allowed")
    releases = form.get("release-write-access-when-lost") == "true"
    context.stations[request.session] = ControlStation(identity, name, releases)
    return DONE


def request_access(context: RequestContext, request: Request) -> Answer:
    """Take the write access for the station of the session.

    Raises:
        RefusedRequest: If the session is not registered, or another station holds the access.
    """
    station = _station(context, request)
    if context.is_access_exclusive and context.writer != station:
        raise refused(
            WRITE_ACCESS_TAKEN, "Remote Control Station cannot take SPoC when it is taken."
        )
    context.writer, context.is_access_exclusive = station, True
    return DONE


def release_access(context: RequestContext, request: Request) -> Answer:
    """Release the write access of the station of the session.

    Raises:
        RefusedRequest: If the session is not registered, or its station does not hold the access.
    """
    if context.writer != _station(context, request) or not context.is_access_exclusive:
        raise refused(NO_WRITE_ACCESS, "The control station does not have SPoC.")
    context.writer, context.is_access_exclusive = None, False
    return DONE


def appeal(context: RequestContext, request: Request) -> Answer:
    """Ask the holder to release the write access."""
    _station(context, request)
    context.appeals += 1
    return DONE


def access_status(context: RequestContext, request: Request) -> Answer:
    """The station that holds the write access."""
    del request
    holder = context.writer if context.is_access_exclusive else None
    fields = {
        "control-station-write-access-held": str(context.is_access_exclusive).lower(),
        # So spelt by controllers.
        "held-by-control-station-Id": "none" if holder is None else holder.identity,
        "held-by-control-station-name": "none" if holder is None else holder.name,
        "control-station-external-control-enabled": "true",
    }
    return _state("controlstation-write-access-status", "write-access-status", fields)


def appeals(context: RequestContext, request: Request) -> Answer:
    """The number of appeals."""
    del request
    fields = {"changecount": str(context.appeals)}
    return _state("controlstation-release-write-access-appeal-change-count", "changecount", fields)


def type_(context: RequestContext, request: Request) -> Answer:
    """The type of the session's station."""
    kind = "Remote" if request.session in context.stations else "none"
    return _state("controlstation-type", "type", {"control-station-type": kind})


def identity(context: RequestContext, request: Request) -> Answer:
    """The identity of the session's station."""
    station = context.stations.get(request.session)
    shown = "none" if station is None else station.identity
    return _state("control-station", "id", {"control-station-Id": shown})


def constant(kind: str, title: str, field: str, value: str) -> Callable[..., Answer]:
    """Return the function of a resource that never changes here."""

    def answer(context: RequestContext, request: Request) -> Answer:
        del context, request
        return _state(kind, title, {field: value})

    return answer


def _station(context: RequestContext, request: Request) -> ControlStation:
    station = context.stations.get(request.session)
    if station is None:
        raise refused(NO_WRITE_ACCESS, "Session is not part of a Control Station")
    return station


def _state(kind: str, title: str, fields: dict[str, str]) -> Answer:
    return Answer((Item(kind, title, fields),))
