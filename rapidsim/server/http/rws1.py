"""Robot Web Services 1.0, RobotWare 6: JSON if the query requests it, else XHTML."""

from __future__ import annotations

from dataclasses import dataclass

from aiohttp import web

from rapidsim.server.http.bodies import (
    JSON,
    XHTML,
    json_body,
    json_refusal,
    subscribed,
    xhtml_body,
    xhtml_refusal,
)
from rapidsim.server.http.dialect import Users, represent, root_of
from rapidsim.server.messages import ErrorAnswer, Reply


@dataclass(frozen=True, slots=True)
class Rws1Dialect:
    """Implementation of `dialect.Dialect` for RobotWare 6."""

    users: Users
    generation: int = 1
    protocol: str = "robapi2_subscription"
    clients_may_speak: bool = True

    def objection(self, request: web.Request) -> web.Response | None:
        """Return None: no header is checked."""
        del request
        return None

    def represent(self, request: web.Request, reply: Reply) -> web.Response:
        """See `Dialect`."""
        if request.query.get("json") == "1":
            return represent(request, reply, json_body, json_refusal, JSON)
        return represent(request, reply, xhtml_body, xhtml_refusal, XHTML)

    def file_refused(self, request: web.Request, refusal: ErrorAnswer) -> web.Response:
        """Return XHTML for any requested representation, as controllers do."""
        return represent(request, refusal, xhtml_body, xhtml_refusal, XHTML)

    def subscribed(self, request: web.Request, group: int) -> web.Response:
        """Return XHTML for any requested representation."""
        link = f"ws://{request.host}/poll/{group}"
        body = subscribed(group, link, root_of(request))
        headers = {"Location": link, "Content-Type": XHTML}
        return web.Response(status=201, headers=headers, body=body.encode())
