"""Serve a controller until it is ended."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass

from rapidsim.files import InputError
from rapidsim.server.http.app import HttpFrontend
from rapidsim.server.http.basic import BasicAuthentication
from rapidsim.server.http.digest import DigestAuthentication
from rapidsim.server.http.fault_port import open_fault_port
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.open_port import OpenPort, end_signal, listen
from rapidsim.server.http.rws1 import Rws1Dialect
from rapidsim.server.http.rws2 import Rws2Dialect
from rapidsim.server.memory import give_large_blocks_back
from rapidsim.server.process import EngineProcess
from rapidsim.server.settings import ServerSettings
from rapidsim.syntax.garbage_collection import gc_for_server


@dataclass(frozen=True, slots=True)
class Addresses:
    """Addresses that the server listens at; None for a protocol that is not served."""

    rws1: str | None
    rws2: str | None
    faults: str | None
    """Port for tests."""


def serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[Addresses], None],
    noted: Callable[[str], None],
) -> bool:
    """Serve a controller.

    Args:
        engine: The controller, in its process.
        settings: Addresses and users.
        is_ready: Called with the addresses once it listens at all of them.
        noted: Called with a line at each event that matters to the user.

    Returns:
        Whether it was ended by a signal; False if its engine has died.

    Raises:
        InputError: If a port is taken.
    """
    give_large_blocks_back()
    try:
        with gc_for_server():
            return asyncio.run(_serve(engine, settings, is_ready, noted))
    finally:
        engine.end()


async def _serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[Addresses], None],
    noted: Callable[[str], None],
) -> bool:
    guard = Guard(settings.host, settings.hosts, settings.origins)
    face = HttpFrontend(
        engine,
        guard,
        noted,
        settings.most_sessions,
        settings.session_timeout_s,
        settings.latencies_s,
    )

    engine.listener = face.notify
    engine.attach()
    loop = asyncio.get_running_loop()
    loop.set_exception_handler(lambda _, context: noted(_defect_line(context)))
    over = end_signal()
    first = Rws1Dialect(DigestAuthentication(settings.users))
    second = Rws2Dialect(BasicAuthentication(settings.users))
    listeners: list[OpenPort] = []
    try:
        rws1 = rws2 = faults = None
        if settings.rws1_port is not None:
            wanted, port = face.app(first), settings.rws1_port
            opening = listen(wanted, face.connections, settings.host, port)
            rws1 = await _opened(listeners, opening, settings.host, port, "rws1")
        if settings.rws2_port is not None:
            wanted, port = face.app(second), settings.rws2_port
            opening = listen(wanted, face.connections, settings.host, port, settings.tls)
            rws2 = await _opened(listeners, opening, settings.host, port, "rws2")
        if settings.faults_port is not None:
            opening = open_fault_port(engine, settings.faults_port)
            faults = await _opened(listeners, opening, "127.0.0.1", settings.faults_port, "faults")
        is_ready(Addresses(rws1, rws2, faults))
        waits = [asyncio.create_task(one.wait()) for one in (over, engine.ended)]
        await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
        for one in waits:
            one.cancel()
        return over.is_set()
    finally:
        await asyncio.gather(*(listener.close() for listener in listeners))


def _defect_line(context: Mapping[str, object]) -> str:
    """Return one line about an error outside of any request, where asyncio prints a traceback."""
    return f"error: {context.get('message')}: {context.get('exception')!r}"


async def _opened(
    listeners: list[OpenPort], opening: Awaitable[OpenPort], host: str, port: int, name: str
) -> str:
    """Await that a port is open and return its address; `name` is that of its option.

    Raises:
        InputError: If the port is taken.
    """
    try:
        listeners.append(await opening)
    except OSError as error:
        raise InputError(
            f"{host}:{port} cannot be listened at: {error.strerror or error}",
            f"`--{name}-port 0` takes a free port",
        ) from None
    return listeners[-1].address
