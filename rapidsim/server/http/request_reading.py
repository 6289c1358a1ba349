"""Requests of clients as messages to the engine.

Everything that a client has sent is decoded here, so that one boundary separates what is wrong with
a request, an answer of 4xx, from what is wrong with rapidsim.
"""

from __future__ import annotations

import asyncio
import os
import tempfile
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Final
from urllib.parse import parse_qsl, unquote

from aiohttp import web

from rapidsim.server.messages import Request, Upload

MOST_BYTES: Final = 64 * 2**20
"""Largest file [bytes] that a client may send."""
MOST_FORM_BYTES: Final = 2**20
"""Largest form [bytes]."""
_MOST_FIELDS: Final = 5000
_PAUSE_S: Final = 10.0
"""Longest time [s] without a byte of a body that is not complete."""
_FORMS: Final = ("", "application/x-www-form-urlencoded")


@contextmanager
def decoding() -> Iterator[None]:
    """Convert every error to an answer of 400, but for the loss of the connection.

    Raises:
        web.HTTPException: If the request cannot be read.
    """
    try:
        yield
    except (web.HTTPException, ConnectionError):
        raise
    except TimeoutError:
        raise web.HTTPRequestTimeout(text="the request has not ended\n") from None
    except Exception:
        raise web.HTTPBadRequest(text="the request cannot be read\n") from None


def path_of(request: web.Request) -> str:
    """Return the decoded path, without slashes at its ends."""
    with decoding():
        return unquote(request.rel_url.raw_path).strip("/")


async def read_form(request: web.Request) -> dict[str, str]:
    """Return the fields of a form; of several with one name, the last.

    Raises:
        web.HTTPException: If it cannot be read.
    """
    with decoding():
        body = await _read_body(request, MOST_FORM_BYTES)
        if request.content_type not in _FORMS and "Content-Type" in request.headers:
            return {}
        charset = request.charset or "utf-8"
        text = body.rstrip().decode(charset)
        return dict(
            parse_qsl(text, keep_blank_values=True, encoding=charset, max_num_fields=_MOST_FIELDS)
        )


@asynccontextmanager
async def read_request(
    request: web.Request, path: str, session: int, generation: int, *, is_file: bool
) -> AsyncIterator[Request | Upload]:
    """Read a request as a message to the engine; a file is on the disk until the context ends.

    Args:
        request: Request of a client.
        path: Its decoded path.
        session: Number of the client's session.
        generation: Generation of Robot Web Services: 1 or 2.
        is_file: Whether the body is a file, not a form.

    Raises:
        web.HTTPException: If it cannot be read.
    """
    with decoding():
        form = {} if is_file else await read_form(request)
        query = dict(request.query)
    message = Request(request.method, f"/{path}", query, form, session, generation)
    if not is_file:
        yield message
        return
    async with read_file(request) as file:
        yield Upload(message, file)


@asynccontextmanager
async def read_file(request: web.Request) -> AsyncIterator[Path]:
    """Read the body of a request into a file, which is removed when the context ends.

    Raises:
        web.HTTPException: If it cannot be read, or is too long.
    """
    with decoding():
        handle, name = tempfile.mkstemp(prefix="rapidsim-upload-")
    file = Path(name)
    try:
        with decoding(), os.fdopen(handle, "wb") as stream:
            async for part in _parts(request, MOST_BYTES):
                stream.write(part)
        yield file
    finally:
        file.unlink(missing_ok=True)


async def _read_body(request: web.Request, most: int) -> bytes:
    """Return the body of a request, of so many bytes at most.

    Raises:
        HTTPRequestEntityTooLarge: If it is longer, or says so.
    """
    return b"".join([part async for part in _parts(request, most)])


async def _parts(request: web.Request, most: int) -> AsyncIterator[bytes]:
    """Yield the body of a request, of so many bytes at most, as it arrives.

    Raises:
        HTTPRequestEntityTooLarge: If it is longer, or says so.
    """
    size = request.content_length or 0
    if size <= most:
        size = 0
        while True:
            async with asyncio.timeout(_PAUSE_S):
                part = await request.content.readany()
            if not part:
                return
            size += len(part)
            if size > most:
                break
            yield part
    raise web.HTTPRequestEntityTooLarge(max_size=most, actual_size=size)
