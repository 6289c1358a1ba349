"""Operator page at `/ui` of either generation: its content, and the actions of its buttons.

It is one document with its own script and style, and loads nothing else. Its actions are
requests of Robot Web Services 1.0, so the journal records them, and use POST only.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Final, TypeAlias

from aiohttp import web

from rapidsim.server.http.request_reading import read_form
from rapidsim.server.messages import ErrorAnswer, Inquiry, ReadState, Reply, Request

_FOLDER: Final = Path(__file__).with_name("shipped")
_FILES: Final = MappingProxyType(
    {
        "": ("page.html", "text/html"),
        "page.js": ("page.js", "text/javascript"),
        "style.css": ("style.css", "text/css"),
    }
)
_HEADERS: Final = MappingProxyType(
    {
        "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
        "connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'",
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cache-Control": "no-store",
    }
)
Ask: TypeAlias = Callable[[Inquiry], Awaitable[Reply]]


async def serve_operator_page(
    request: web.Request, rest: str, session: int, move_request: Ask
) -> web.StreamResponse:
    """Answer a request below `/ui`.

    Args:
        request: Request of a browser.
        rest: Address after `/ui/`.
        session: Session of the client.
        move_request: Sends a message to the engine.
    """
    match request.method, rest:
        case "GET", name if name in _FILES:
            if request.path.endswith("/ui/"):
                raise web.HTTPFound("/ui")
            file, kind = _FILES[name]
            return _response(_read(file), kind)
        case "GET", "state":
            return _replied(await move_request(ReadState()))
        case "GET", "text":
            task, module = (request.query.get(name, "") for name in ("task", "module"))
            return _replied(await move_request(ReadState(task, module)))
        case "POST", "do":
            form = await read_form(request)
            path, action = form.pop("path", ""), form.pop("action", "")
            return _replied(
                await move_request(Request("POST", path, {"action": action}, form, session))
            )
        case _:
            return web.Response(status=404, text="there is no such page\n")


@cache
def _read(name: str) -> bytes:
    return (_FOLDER / name).read_bytes()


def _replied(reply: Reply) -> web.Response:
    if isinstance(reply, ErrorAnswer):
        return web.Response(status=reply.status, text=reply.message, headers=_HEADERS)
    return _response(reply.content, "application/json")


def _response(body: bytes | None, kind: str) -> web.Response:
    if body is None:
        return web.Response(status=204, headers=_HEADERS)
    return web.Response(body=body, content_type=kind, charset="utf-8", headers=_HEADERS)
