"""Robot Web Services 1.0, RobotWare 6: JSON where the query asks for it, else XHTML."""

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
from rapidsim.server.http.dialect import Users, base
from rapidsim.server.messages import Refusal, Reply


@dataclass(frozen=True, slots=True)
class FirstGeneration:
    """Implements `dialect.Dialect`."""

    users: Users
    generation: int = 1
    protocol: str = "robapi2_subscription"
    clients_may_speak: bool = True

    def objection(self, request: web.Request) -> web.Response | None:
        """There is none: no header is looked at."""
        del request
        return None

    def shown(self, request: web.Request, reply: Reply) -> web.Response:
        """See `Dialect`."""
        as_json = request.query.get("json") == "1"
        if isinstance(reply, Refusal):
            write = json_refusal if as_json else xhtml_refusal
            text, status = write(reply, base(request)), reply.status
        elif reply.content is not None:
            return web.Response(body=reply.content, content_type="application/octet-stream")
        elif reply.status == 204:
            return web.Response(status=204)
        else:
            text = (json_body if as_json else xhtml_body)(reply, base(request))
            status = reply.status
        # The whole header is compared by a public client: no charset.
        headers = {"Content-Type": JSON if as_json else XHTML}
        return web.Response(status=status, body=text.encode(), headers=headers)

    def file_refused(self, request: web.Request, refusal: Refusal) -> web.Response:
        """XHTML whatever was asked for, as controllers do."""
        body = xhtml_refusal(refusal, base(request))
        return web.Response(status=refusal.status, text=body, content_type=XHTML)

    def subscribed(self, request: web.Request, group: int) -> web.Response:
        """XHTML whatever was asked for."""
        link = f"ws://{request.host}/poll/{group}"
        body = subscribed(group, link, base(request))
        return web.Response(status=201, headers={"Location": link}, text=body, content_type=XHTML)
