"""Robot Web Services 2.0, RobotWare 7: over TLS; the header `Accept` selects the representation.

Reads answer in HAL JSON or XHTML, writes in XHTML; both name their version, and so must the content
type of a write.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from http import HTTPStatus
from typing import Final

from aiohttp import web

from rapidsim.server.http.bodies import (
    hal_body,
    hal_refusal,
    later_xhtml_refusal,
    subscribed,
    xhtml_body,
)
from rapidsim.server.http.dialect import Users, represent, root_of
from rapidsim.server.messages import ErrorAnswer, Reply
from rapidsim.server.resources.codes import BAD_PARAMETER

_HAL: Final = "application/hal+json"
_XHTML: Final = "application/xhtml+xml"
_LATER_LOG: Final = "2.1"
"""Version whose event log may begin with the newest entry; only the event log has it."""
_FORM: Final = "application/x-www-form-urlencoded;v=2.0"
_ACCEPTED: Final = re.compile(r"(application/(?:hal\+json|xhtml\+xml)|\*/\*)(?:;v=(2\.[01]))?")
"""A representation; only the wildcard may omit the version."""

_NO_LIFO: Final = ErrorAnswer(
    *BAD_PARAMETER,
    "LIFO is not supported in v=2.0, Use v=2.1 to list Elog messages in LIFO order.",
)


@dataclass(frozen=True, slots=True)
class Rws2Dialect:
    """Implementation of `dialect.Dialect` for RobotWare 7."""

    users: Users
    generation: int = 2
    protocol: str = "rws_subscription"
    clients_may_speak: bool = False

    def objection(self, request: web.Request) -> web.Response | None:
        """Reject requests for representations of another version."""
        is_file = request.path.startswith("/fileservice/")
        if request.method == "GET":
            is_socket = request.path.startswith("/poll/")
            if is_file or is_socket:
                return None
            accepted = _accepted(request)
            if accepted is None or (accepted[1] == _LATER_LOG and not _is_log(request)):
                return web.Response(status=406, text=f"Accept is {_HAL};v=2.0 or {_XHTML};v=2.0\n")
            if _is_log(request) and request.query.get("order") == "lifo":
                return None if accepted[1] == _LATER_LOG else self.represent(request, _NO_LIFO)
            return None
        if request.method == "DELETE":
            return None
        written = _squeezed(request.headers.get("Content-Type", ""))
        if written.startswith(_FORM) or (is_file and ";v=2." in written):
            return None
        return web.Response(status=415, text=f"Content-Type is {_FORM}\n")

    def represent(self, request: web.Request, reply: Reply) -> web.Response:
        """See `Dialect`."""
        form, _ = _accepted(request) or (_XHTML, "")
        # Writes answer in XHTML, for any requested representation; calculations do not write.
        is_shown = isinstance(reply, ErrorAnswer) or bool(reply.items)
        if form == _HAL and (request.method == "GET" or is_shown):
            return represent(request, reply, hal_body, hal_refusal, f"{_HAL};v=2.0")
        return represent(request, reply, xhtml_body, later_xhtml_refusal, f"{_XHTML};v=2.0")

    def file_refused(self, request: web.Request, refusal: ErrorAnswer) -> web.Response:
        """Return JSON labelled as HTML if a file is missing, as controllers do."""
        if refusal.status != HTTPStatus.NOT_FOUND:
            return self.represent(request, refusal)
        return represent(request, refusal, hal_body, hal_refusal, "text/html")

    def subscribed(self, request: web.Request, group: int) -> web.Response:
        """Return both addresses: that of the websocket and that of the group."""
        link = f"wss://{request.host}/poll/{group}"
        body = subscribed(group, link, root_of(request))
        headers = {"Location": link, "Content-Type": f"{_XHTML};v=2.0"}
        return web.Response(status=201, headers=headers, body=body.encode())


def _is_log(request: web.Request) -> bool:
    return request.path.startswith("/rw/elog/")


def _accepted(request: web.Request) -> tuple[str, str] | None:
    """Return the first accepted representation that exists, with its version; else None."""
    header = _squeezed(request.headers.get("Accept", "*/*"))
    for one in header.split(","):
        matched = _ACCEPTED.match(one)
        if matched is None:
            continue
        if matched[1] == "*/*":
            return _XHTML, "2.0"
        if matched[2]:
            return matched[1], matched[2]
    return None


def _squeezed(header: str) -> str:
    return header.replace(" ", "").lower()
