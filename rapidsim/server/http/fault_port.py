"""Port for tests, which make the controller and its connections fail.

`POST /faults` begins a fault, an object of JSON with the keys of a table [[fault]]; `DELETE
/faults` ends those that last. It listens on this computer only, has no login, and never fails
itself.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from http import HTTPStatus
from typing import Final

from aiohttp import web

from rapidsim.server.http.connections import Connections
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.open_port import OpenPort, listen
from rapidsim.server.link import EngineEndedError, Link
from rapidsim.server.messages import BeginFault, EndFaults, ErrorAnswer

_HOST: Final = "127.0.0.1"
_MOST: Final = 2**16
"""Largest body [bytes]."""


async def open_fault_port(link: Link, port: int) -> OpenPort:
    """Listen at a port of this computer; 0 for a free one.

    Raises:
        OSError: If the port is taken.
    """
    connections, guard = Connections(), Guard(_HOST)

    async def handle(request: web.Request) -> web.Response:
        connection = connections.of(request.protocol)
        connection.begin_request()
        try:
            refused = guard.objection(request.method, request.path, request.headers)
            if refused is not None:
                return _answer(HTTPStatus.FORBIDDEN, refused)
            return await _handled(link, request)
        except EngineEndedError:
            return _answer(HTTPStatus.INTERNAL_SERVER_ERROR, "the controller has ended")
        finally:
            connection.end_request()

    app = web.Application(client_max_size=_MOST)
    app.router.add_route("*", "/{tail:.*}", handle)
    return await listen(app, connections, _HOST, port)


async def _handled(link: Link, request: web.Request) -> web.Response:
    if request.path.rstrip("/") != "/faults":
        return _answer(HTTPStatus.NOT_FOUND, "there is only /faults")
    if request.method == "DELETE":
        await link.request(EndFaults())
        return web.Response(status=HTTPStatus.NO_CONTENT)
    if request.method != "POST":
        return _answer(HTTPStatus.METHOD_NOT_ALLOWED, "/faults takes POST and DELETE")
    try:
        values = json.loads(await request.read())
    except (ValueError, RecursionError):
        values = None
    if not isinstance(values, Mapping):
        return _answer(
            HTTPStatus.BAD_REQUEST, 'the body is no JSON object such as {"kind": "emergency_stop"}'
        )
    reply = await link.request(BeginFault(values))
    if isinstance(reply, ErrorAnswer):
        return _answer(HTTPStatus(reply.status), reply.message)
    return web.Response(status=HTTPStatus.NO_CONTENT)


def _answer(status: HTTPStatus, text: str) -> web.Response:
    return web.Response(status=status, text=f"{text}\n")
