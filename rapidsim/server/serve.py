"""Serving a controller until somebody ends it."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from contextlib import suppress

from aiohttp import web

from rapidsim.files import InputError
from rapidsim.server.http.app import Face
from rapidsim.server.http.digest import DigestAuthentication
from rapidsim.server.http.guard import Guard
from rapidsim.server.messages import Note, Told
from rapidsim.server.process import EngineProcess
from rapidsim.server.settings import ServerSettings


def serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[str], None],
    noted: Callable[[str], None],
) -> bool:
    """Serve a controller.

    Args:
        engine: The controller, in its process.
        settings: Where, and to whom.
        is_ready: Told the address, once it listens.
        noted: Told a line at each event that matters to whoever started it.

    Returns:
        Whether it was ended from outside; else its engine has died.

    Raises:
        InputError: If the port is taken.
    """
    try:
        return asyncio.run(_serve(engine, settings, is_ready, noted))
    finally:
        engine.end()


async def _serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[str], None],
    noted: Callable[[str], None],
) -> bool:
    face = Face(
        engine,
        DigestAuthentication(settings.users),
        Guard(settings.host),
        settings.most_sessions,
        settings.session_timeout_s,
    )

    def told(what: Told) -> None:
        if isinstance(what, Note):
            noted(what.text)
        else:
            face.told(what)

    engine.listener = told
    engine.attach()
    over = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        # Windows has none in a loop; Ctrl-C raises KeyboardInterrupt there.
        with suppress(NotImplementedError):
            loop.add_signal_handler(number, over.set)
    runner = web.AppRunner(face.app(), handle_signals=False, access_log=None, shutdown_timeout=1.0)
    await runner.setup()
    try:
        site = web.TCPSite(runner, settings.host, settings.rws1_port)
        try:
            await site.start()
        except OSError as error:
            where = f"{settings.host}:{settings.rws1_port}"
            raise InputError(
                f"{where} cannot be listened at: {error.strerror or error}",
                "`--rws1-port 0` takes a free port",
            ) from None
        port = runner.addresses[0][1]
        shown = f"[{settings.host}]" if ":" in settings.host else settings.host
        is_ready(f"http://{shown}:{port}")
        waits = [asyncio.create_task(one.wait()) for one in (over, engine.ended)]
        await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
        for one in waits:
            one.cancel()
        return over.is_set()
    finally:
        await runner.cleanup()
