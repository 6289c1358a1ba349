"""A controller in lock-step in front of an aiohttp client: no process, no thread, no wall clock."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import aiohttp

from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine
from rapidsim.server.http.app import HttpFrontend
from rapidsim.server.http.basic import BasicAuthentication
from rapidsim.server.http.digest import DigestAuthentication
from rapidsim.server.http.fault_port import open_fault_port
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.open_port import listen
from rapidsim.server.http.rws1 import Rws1Dialect
from rapidsim.server.http.rws2 import Rws2Dialect
from rapidsim.server.link import DirectLink
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.settings import DEFAULT_USERS, EngineSettings

T = TypeVar("T")
STEP_S = 0.05


@dataclass
class Served:
    """A served controller, and a client that has come in."""

    base: str
    client: aiohttp.ClientSession
    engine: Engine
    face: HttpFrontend
    second: str = ""
    """Where Robot Web Services 2.0 is."""
    faults: str = ""
    """Where faults are requested."""

    async def fail(self, **fault: object) -> tuple[int, str]:
        """Request a fault; status and text of the answer."""
        keys = {key.rstrip("_"): value for key, value in fault.items()}
        async with (
            aiohttp.ClientSession() as tester,
            tester.post(f"{self.faults}/faults", json=keys) as response,
        ):
            return response.status, await response.text()

    async def mend(self) -> int:
        """End the faults."""
        async with (
            aiohttp.ClientSession() as tester,
            tester.delete(f"{self.faults}/faults") as response,
        ):
            return response.status

    async def get(self, path: str) -> list[dict[str, Any]]:
        """The items of a resource, as JSON."""
        join = "&" if "?" in path else "?"
        async with self.client.get(f"{self.base}/{path}{join}json=1") as response:
            body = await response.json()
            assert response.status == 200, body
            items: list[dict[str, Any]] = body["_embedded"]["_state"]
            return items

    async def post(self, path: str, **form: str) -> tuple[int, int]:
        """Status and code of an action; code 0 where it was done."""
        fields = {key.replace("_", "-"): value for key, value in form.items()}
        join = "&" if "?" in path else "?"
        url = f"{self.base}/{path}{join}json=1"
        async with self.client.post(url, data=fields) as response:
            text = await response.text()
            if response.status < 400:
                return response.status, 0
            # No refusal names a place on this computer.
            home = self.engine.live.options.home
            assert home is not None
            assert str(home.parent) not in text
            body = await response.json()
            return response.status, body["_embedded"]["status"]["code"]

    async def status(self, path: str) -> tuple[int, int]:
        """Status and code of a refusal."""
        join = "&" if "?" in path else "?"
        async with self.client.get(f"{self.base}/{path}{join}json=1") as response:
            return response.status, (await response.json())["_embedded"]["status"]["code"]

    async def search(self, path: str, **form: str) -> list[dict[str, Any]]:
        """The items that an action answers with."""
        async with self.client.post(f"{self.base}/{path}&json=1", data=form) as response:
            assert response.status == 200
            items: list[dict[str, Any]] = (await response.json())["_embedded"]["_state"]
            return items

    async def second_client(self) -> Served:
        """The same controller for another client, who must close it."""
        return Served(self.base, _client(), self.engine, self.face)

    async def executes(self) -> bool:
        (state,) = await self.get("rw/rapid/execution")
        return bool(state["ctrlexecstate"] == "running")

    async def value(self, name: str) -> str:
        (state,) = await self.get(f"rw/rapid/symbol/data/RAPID/T_ROB1/{name}")
        return str(state["value"])


def serve(
    folder: Path, program: str | None, use: Callable[[Served], Awaitable[T]], **limits: Any
) -> T:
    """Serve a program on a free port of this computer and let a client use it.

    Args:
        folder: Where program and home lie.
        program: A module; None serves the folder `cell` that is there.
        use: The client.
        limits: Of the face.
    """
    file = folder / ("cell" if program is None else "main.mod")
    if program is not None:
        file.write_text(program, encoding="utf-8")
    return asyncio.run(_serve(file, folder / "home", use, limits))


async def _serve(
    file: Path, home: Path, use: Callable[[Served], Awaitable[T]], limits: dict[str, Any]
) -> T:
    home.mkdir(exist_ok=True)
    made = ready(RunRequest(paths=(str(file),), home=str(home), may_be_empty=True))
    journal = limits.pop("journal", None)
    settings = EngineSettings(request_s=STEP_S)
    link = DirectLink(lambda told: engine_of(made, settings, told, journal))
    users = DigestAuthentication(DEFAULT_USERS)
    guard = limits.pop("guard", Guard("127.0.0.1"))
    face = HttpFrontend(link, guard, print, **limits)
    link.listener = face.notify
    # Both without TLS, whose package and key have tests of their own.
    dialects = (
        Rws1Dialect(users),
        Rws2Dialect(BasicAuthentication(DEFAULT_USERS)),
    )
    listeners = [await listen(face.app(one), face.connections, "127.0.0.1", 0) for one in dialects]
    listeners.append(await open_fault_port(link, 0))
    try:
        first, second, faults = (one.address for one in listeners)
        async with _client() as client:
            return await use(Served(first, client, link.engine, face, second, faults))
    finally:
        for listener in listeners:
            await listener.close()


def _client() -> aiohttp.ClientSession:
    digest = aiohttp.DigestAuthMiddleware("Default User", "robotics")
    # Cookies of addresses in figures are kept only so.
    jar = aiohttp.CookieJar(unsafe=True)
    return aiohttp.ClientSession(middlewares=(digest,), cookie_jar=jar)
