"""Protocol of one generation of Robot Web Services, as the HTTP frontend uses it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from aiohttp import web

from rapidsim.server.http.bodies import RequestLocation
from rapidsim.server.messages import Answer, ErrorAnswer, Reply


class Users(Protocol):
    """The users that are admitted."""

    @property
    def challenge(self) -> str:
        """Header that requests authentication from a client."""
        ...

    def user(self, header: str, method: str, target: str) -> str | None:
        """Return the user of a header; None if not admitted.

        Args:
            header: `Authorization` of the request.
            method: Method of the request.
            target: Address of the request as it was sent, with the query.
        """
        ...


class Dialect(Protocol):
    """The protocol of one generation."""

    @property
    def generation(self) -> int:
        """1 or 2."""
        ...

    @property
    def users(self) -> Users:
        """The users that are admitted, and how they authenticate."""
        ...

    @property
    def protocol(self) -> str:
        """The subprotocol of its websockets."""
        ...

    @property
    def clients_may_speak(self) -> bool:
        """Whether a client may send anything on a websocket."""
        ...

    def objection(self, request: web.Request) -> web.Response | None:
        """Return the error of a request that is rejected before dispatch; else None."""
        ...

    def represent(self, request: web.Request, reply: Reply) -> web.Response:
        """Return a reply in the requested representation."""
        ...

    def file_refused(self, request: web.Request, refusal: ErrorAnswer) -> web.Response:
        """Return the error of a file request, which controllers write in a special format."""
        ...

    def subscribed(self, request: web.Request, group: int) -> web.Response:
        """Return the answer for a new group of subscriptions, with the address of its websocket."""
        ...


def root_of(request: web.Request) -> str:
    """Return the root of the address that a client has requested."""
    return f"{request.scheme}://{request.host}/"


def location_of(request: web.Request) -> RequestLocation:
    """Return the addresses of a request; the choice of a representation is not part of them."""
    query = [one for one in request.query_string.split("&") if one and one != "json=1"]
    return RequestLocation(root_of(request), request.path.strip("/"), "&".join(query))


def represent(
    request: web.Request,
    reply: Reply,
    body: Callable[[Answer, RequestLocation], str],
    refusal: Callable[[ErrorAnswer, str], str],
    content_type: str,
) -> web.Response:
    """Return a reply in a representation, with its writers of answers and errors."""
    # The whole header is compared by a public client: no charset.
    headers = {"Content-Type": content_type}
    if isinstance(reply, ErrorAnswer):
        text = refusal(reply, root_of(request))
        return web.Response(status=reply.status, body=text.encode(), headers=headers)
    if reply.content is not None:
        return web.Response(body=reply.content, content_type="application/octet-stream")
    if reply.status == 204:
        return web.Response(status=204)
    if reply.location:
        headers["Location"] = reply.location
    text = body(reply, location_of(request))
    return web.Response(status=reply.status, body=text.encode(), headers=headers)
