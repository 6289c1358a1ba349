"""A page for the person at this computer: files, answers to reads, and changes by POST.

It is served on the loopback only, to who knows its key: other users of the computer and other
pages of the browser do not.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Mapping
from hmac import compare_digest
from typing import Final, TypeAlias

from aiohttp import web

from rapidsim.files import InputError
from rapidsim.server.http.connections import Connections
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.open_port import end_signal, listen
from rapidsim.server.http.page_files import HEADERS
from rapidsim.server.http.request_reading import decoding, path_of, read_form
from rapidsim.values import value_class

_HOST: Final = "127.0.0.1"
_ONLY_SESSION: Final = 1
Answering: TypeAlias = Callable[[Mapping[str, str]], object]
"""From the fields of a query or a form to JSON values; `InputError` refuses them."""


@value_class(frozen=True, slots=True, eq=False)
class LocalPage:
    """Content of a page."""

    files: Mapping[str, tuple[bytes, str]]
    """Bytes and type of each file by name; the page itself has the empty name."""
    reads: Mapping[str, Answering]
    """Answers without effect by name."""
    changes: Mapping[str, Answering]
    """Actions by name."""


def serve_page(page: LocalPage, key: str, port: int, is_ready: Callable[[str], None]) -> None:
    """Serve a page until Ctrl-C or SIGTERM.

    Args:
        page: Its content.
        key: First part of all of its addresses.
        port: Port, 0 for a free one.
        is_ready: Receives the address of the page.

    Raises:
        InputError: If the port is taken.
    """
    asyncio.run(_serve(page, key, port, is_ready))


async def _serve(page: LocalPage, key: str, port: int, is_ready: Callable[[str], None]) -> None:
    connections = Connections()
    try:
        listener = await listen(application(page, key, connections), connections, _HOST, port)
    except OSError as error:
        raise InputError(f"--port {port}: {error.strerror}", "0 picks a free one") from error
    try:
        is_ready(f"{listener.address}/{key}/")
        await end_signal().wait()
    finally:
        await listener.close()


def application(page: LocalPage, key: str, connections: Connections) -> web.Application:
    """Return the application that serves a page."""
    guard = Guard(_HOST)

    @web.middleware
    async def guarded(
        request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        connection = connections.of(request.protocol)
        connection.begin_request()
        try:
            with decoding():
                objection = guard.objection(request.method, request.path, request.headers)
            if objection is not None:
                return web.Response(status=403, text=f"{objection}\n", headers=HEADERS)
            first, _, rest = path_of(request).partition("/")
            if not compare_digest(first.encode(), key.encode()):
                return web.Response(status=404, text="there is no such page\n", headers=HEADERS)
            connection.admit(_ONLY_SESSION)
            return await _answered(page, request, rest)
        except ConnectionError:
            return web.Response(status=400)
        finally:
            connection.end_request()

    app = web.Application(middlewares=[guarded])
    app.router.add_route("*", "/{tail:.*}", _nothing)
    return app


async def _nothing(request: web.Request) -> web.StreamResponse:
    """Answer what the middleware leaves, which is nothing."""
    return web.Response(status=404)


async def _answered(page: LocalPage, request: web.Request, name: str) -> web.Response:
    if request.method == "GET" and name in page.files:
        body, kind = page.files[name]
        return web.Response(body=body, content_type=kind, charset="utf-8", headers=HEADERS)
    try:
        if request.method == "GET" and name in page.reads:
            return _json(await asyncio.to_thread(page.reads[name], dict(request.query)))
        if request.method == "POST" and name in page.changes:
            # One after the other, for each reads what the one before has written.
            return _json(page.changes[name](await read_form(request)))
    except InputError as refusal:
        return web.Response(status=400, text=str(refusal), headers=HEADERS)
    return web.Response(status=404, text="there is no such page\n", headers=HEADERS)


def _json(content: object) -> web.Response:
    body = json.dumps(content, ensure_ascii=False, allow_nan=False)
    return web.Response(text=body, content_type="application/json", headers=HEADERS)
