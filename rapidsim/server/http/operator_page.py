"""Operator page at `/ui` of either generation: its content, and the actions of its buttons.

It is one document with its own script and style, and loads nothing else. Its actions are
requests of Robot Web Services 1.0, so the journal records them, and use POST only.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import cache
from types import MappingProxyType
from typing import Final, TypeAlias

from aiohttp import web

from rapidsim.server.http.page_files import HEADERS, framed, page_file
from rapidsim.server.http.request_reading import read_file, read_form
from rapidsim.server.messages import ErrorAnswer, Inquiry, ReadState, Reply, Request, Upload

_STYLE: Final = "style.css"
_SCRIPTS: Final = ("links.js", "arm.js", "jog.js", "page.js")
_FILES: Final = MappingProxyType({_STYLE: "text/css", **dict.fromkeys(_SCRIPTS, "text/javascript")})
"""Kind of each file that the page loads."""
_JSON: Final = "application/json"
_VIEWS: Final = MappingProxyType(
    dict.fromkeys(("state", "text", "arm", "joints", "jog", "task", "rule"), _JSON)
    | {"module": "text/plain", "backup.zip": "application/zip"}
)
"""Kind of each part that the engine answers."""
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
        case "GET", "":
            if request.path.endswith("/"):
                raise web.HTTPFound("/ui")
            return _response(_page(), "text/html")
        case "GET", name if name in _FILES:
            return _response(page_file(name), _FILES[name])
        case "GET", view if view in _VIEWS:
            return _replied(await move_request(ReadState(view, dict(request.query))), _VIEWS[view])
        case "POST", "do":
            form = await read_form(request)
            path, action = form.pop("path", ""), form.pop("action", "")
            return _replied(
                await move_request(Request("POST", path, {"action": action}, form, session))
            )
        case "POST", "upload":
            # The address of the file is that of HOME, whatever folders its name claims.
            name = request.query.get("name", "").replace("\\", "/").rpartition("/")[2]
            upload = Request("PUT", f"/fileservice/$HOME/{name}", session=session)
            async with read_file(request) as received:
                return _replied(await move_request(Upload(upload, received)))
        case _:
            return web.Response(status=404, text="there is no such page\n")


@cache
def _page() -> bytes:
    styles, scripts = ([f"/ui/{one}" for one in names] for names in ((_STYLE,), _SCRIPTS))
    return framed("rapidsim controller", page_file("page.html"), styles, scripts)


def _replied(reply: Reply, kind: str = _JSON) -> web.Response:
    if isinstance(reply, ErrorAnswer):
        return web.Response(status=reply.status, text=reply.message, headers=HEADERS)
    return _response(reply.content, kind)


def _response(body: bytes | None, kind: str) -> web.Response:
    if body is None:
        return web.Response(status=204, headers=HEADERS)
    return web.Response(body=body, content_type=kind, charset="utf-8", headers=HEADERS)
