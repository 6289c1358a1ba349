"""What a server needs to know of a generation of Robot Web Services."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from aiohttp import web

from rapidsim.server.messages import Answer, ErrorAnswer, Reply


class Users(Protocol):
    """The users that are admitted."""

    @property
    def challenge(self) -> str:
        """The header that asks a client to authenticate."""
        ...

    def user(self, header: str, method: str, target: str) -> str | None:
        """The user that a header names; None if not admitted.

        Args:
            header: `Authorization` of the request.
            method: Of the request.
            target: Its address as it was sent, with the query.
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
        """The refusal of a request that is not even looked at; None if it is."""
        ...

    def represent(self, request: web.Request, reply: Reply) -> web.Response:
        """A reply in the form that was asked for."""
        ...

    def file_refused(self, request: web.Request, refusal: ErrorAnswer) -> web.Response:
        """The refusal of a file, which controllers write in a form of its own."""
        ...

    def subscribed(self, request: web.Request, group: int) -> web.Response:
        """A new group of subscriptions, with the address of its websocket."""
        ...


def base(request: web.Request) -> str:
    """The root of the address that a client has called."""
    return f"{request.scheme}://{request.host}/"


def represent(
    request: web.Request,
    reply: Reply,
    body: Callable[[Answer, str], str],
    refusal: Callable[[ErrorAnswer, str], str],
    content_type: str,
) -> web.Response:
    """A reply in a form, given the writers of its answers and refusals."""
    if isinstance(reply, ErrorAnswer):
        text = refusal(reply, base(request))
    elif reply.content is not None:
        return web.Response(body=reply.content, content_type="application/octet-stream")
    elif reply.status == 204:
        return web.Response(status=204)
    else:
        text = body(reply, base(request))
    # The whole header is compared by a public client: no charset.
    headers = {"Content-Type": content_type}
    return web.Response(status=reply.status, body=text.encode(), headers=headers)
