"""Robot Web Services over HTTP: admission, requests, answers.

The engine decides the outcome of a request. Both generations share sessions and subscriptions.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Final
from urllib.parse import unquote

from aiohttp import WSCloseCode, WSMsgType, web

from rapidsim.server.http.bodies import event_text
from rapidsim.server.http.dialect import Dialect
from rapidsim.server.http.event_queue import EventQueue
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.operator_page import serve_operator_page
from rapidsim.server.http.sessions import Session, Sessions
from rapidsim.server.link import EngineEndedError, Link
from rapidsim.server.messages import (
    Answer,
    ChangeEvent,
    ErrorAnswer,
    Notification,
    Request,
    SessionEnded,
    Subscribe,
    Unsubscribe,
)
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND

MOST_BYTES: Final = 64 * 2**20
"""Largest body [bytes]."""
MOST_GROUPS: Final = 64
"""Largest number of subscriptions at one time."""
MOST_RESOURCES: Final = 1000
"""Largest number of resources of one group."""
_PARTING_S: Final = 1.0
"""Time [s] in which a client must confirm that its websocket is closed."""
_LAST_S: Final = 0.2
"""Wall-clock time [s] for active requests at the end, once to finish and once more after they are
cancelled."""
_NO_SPEAKING: Final = b"Client cannot send data."
"""Message of a controller to a client that sends on a websocket although it must not."""

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]
_SESSION: Final = web.RequestKey("session", Session)
_DIALECT: Final = web.AppKey("dialect", Dialect)


_QUIET: Final = logging.getLogger("rapidsim.requests")
"""The library would log each request that it cannot read, with a traceback."""
_QUIET.disabled = True


def runner_of(app: web.Application) -> web.AppRunner:
    """Return the server of an application."""
    return web.AppRunner(
        app, handle_signals=False, access_log=None, shutdown_timeout=_LAST_S, logger=_QUIET
    )


@dataclass(eq=False)
class _Group:
    """A subscription group and the events for its websocket."""

    number: int
    session: int
    waiting: EventQueue = field(default_factory=EventQueue)
    changed: asyncio.Event = field(default_factory=asyncio.Event)
    is_over: bool = False


@dataclass(eq=False)
class HttpFrontend:
    """HTTP frontend of Robot Web Services."""

    link: Link
    guard: Guard
    noted: Callable[[str], None]
    """Called with lines for the console."""
    most_sessions: int = 70
    idle_s: float = 300.0
    sessions: Sessions = field(init=False)
    _groups: dict[int, _Group] = field(default_factory=dict)
    _last_group: int = 0
    _ending: set[asyncio.Task[object]] = field(default_factory=set)

    def __post_init__(self) -> None:
        """Start without sessions."""
        self.sessions = Sessions(self.most_sessions, self.idle_s, self._session_ended)

    def app(self, dialect: Dialect) -> web.Application:
        """Return the application of a generation, whose one handler handles every request."""
        app = web.Application(middlewares=[self._admitted], client_max_size=MOST_BYTES)
        app[_DIALECT] = dialect
        app.router.add_route("*", "/{tail:.*}", self._handled)
        app.on_shutdown.append(self._close)
        return app

    def notify(self, notification: Notification) -> None:
        """Pass a change to the websocket of its group."""
        if not isinstance(notification, ChangeEvent):
            return
        group = self._groups.get(notification.group)
        if group is not None:
            group.waiting.add(notification)
            group.changed.set()

    @property
    def counts(self) -> tuple[int, int]:
        """Number of sessions and of subscriptions."""
        return len(self.sessions), len(self._groups)

    @web.middleware
    async def _admitted(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Admit requests that address this server and come from an authenticated user."""
        if not self.guard.admits(request.headers):
            return web.Response(status=403, text="this server has another name\n")
        session = self.sessions.find(request.cookies)
        fresh = session is None
        if session is None:
            header, users = request.headers.get("Authorization", ""), request.app[_DIALECT].users
            user = users.user(header, request.method, request.raw_path)
            if user is None:
                return web.Response(
                    status=401, headers={"WWW-Authenticate": users.challenge}, text=""
                )
            session = self.sessions.begin(user)
            if session is None:
                return web.Response(status=503, text="too many sessions\n")
        request[_SESSION] = session
        try:
            response = await handler(request)
        except EngineEndedError:
            return web.Response(status=500, text="the controller has ended\n")
        except (UnicodeError, ValueError):
            return web.Response(status=400, text="the request cannot be read\n")
        except ConnectionError:
            # The client has disconnected in mid-request and does not receive this.
            return web.Response(status=400)
        except web.HTTPException:
            raise
        except Exception as error:
            # A defect of rapidsim ends a request, not the server.
            defect = f"rapidsim has a defect: {type(error).__name__}: {error}"
            self.noted(f"error: {defect}; please report it with {request.method} {request.path}")
            return web.Response(status=500, text=f"{defect}\n")
        if fresh and not response.prepared:
            for name, value in session.cookies.items():
                # By hand: one of the names would not pass `set_cookie`.
                response.headers.add("Set-Cookie", f"{name}={value}; path=/; httponly")
        return response

    async def _handled(self, request: web.Request) -> web.StreamResponse:
        dialect = request.app[_DIALECT]
        path = unquote(request.rel_url.raw_path).strip("/")
        first, _, rest = path.partition("/")
        if first == "ui":
            # Browsers are clients of neither generation, and send the headers they like.
            return await serve_operator_page(
                request, rest, request[_SESSION].number, self.link.request
            )
        objection = dialect.objection(request)
        if objection is not None:
            return objection
        match first:
            case "poll":
                return await self._poll(request, rest)
            case "subscription":
                return await self._subscription(request, rest)
            case "logout" if request.method == "GET":
                self.sessions.end(request[_SESSION])
                return dialect.represent(request, Answer())
        is_file = first == "fileservice"
        content, form = b"", dict[str, str]()
        if is_file and request.method == "PUT":
            content = await request.read()
        else:
            form = {key: str(value) for key, value in (await request.post()).items()}
        asked = Request(
            request.method,
            f"/{path}",
            dict(request.query),
            form,
            request[_SESSION].number,
            dialect.generation,
            content,
        )
        reply = await self.link.request(asked)
        if is_file and isinstance(reply, ErrorAnswer):
            return dialect.file_refused(request, reply)
        if is_file and request.method != "GET":
            return web.Response(status=reply.status)
        return dialect.represent(request, reply)

    async def _subscription(self, request: web.Request, rest: str) -> web.StreamResponse:
        dialect = request.app[_DIALECT]
        match request.method, rest:
            case "POST", "":
                return await self._subscribe(request)
            case "DELETE", number if number.isdecimal() and int(number) in self._groups:
                await self._end(self._groups[int(number)])
                return dialect.represent(request, Answer())
        return dialect.represent(
            request, ErrorAnswer(*NOT_FOUND, f"there is no subscription {rest}")
        )

    async def _subscribe(self, request: web.Request) -> web.StreamResponse:
        dialect = request.app[_DIALECT]
        form = {key: str(value) for key, value in (await request.post()).items()}
        # A value is a resource if its key has a priority, whatever its number.
        resources = tuple(value for key, value in form.items() if f"{key}-p" in form)
        if not resources or len(resources) > MOST_RESOURCES or len(self._groups) >= MOST_GROUPS:
            refusal = ErrorAnswer(*BAD_PARAMETER, "none, or too many, subscriptions")
            return dialect.represent(request, refusal)
        self._last_group += 1
        group = _Group(self._last_group, request[_SESSION].number)
        self._groups[group.number] = group
        reply = await self.link.request(Subscribe(resources, group.number))
        if isinstance(reply, ErrorAnswer):
            del self._groups[group.number]
            return dialect.represent(request, reply)
        return dialect.subscribed(request, group.number)

    async def _poll(self, request: web.Request, rest: str) -> web.StreamResponse:
        dialect = request.app[_DIALECT]
        group = self._groups.get(int(rest)) if rest.isdecimal() else None
        if group is None:
            return dialect.represent(
                request, ErrorAnswer(*NOT_FOUND, f"there is no subscription {rest}")
            )
        protocols = (dialect.protocol,)
        socket = web.WebSocketResponse(timeout=_PARTING_S, protocols=protocols, heartbeat=30.0)
        ready = socket.can_prepare(request)
        if not ready.ok or (not dialect.clients_may_speak and ready.protocol is None):
            return dialect.represent(
                request, ErrorAnswer(*BAD_PARAMETER, "this address is for websockets")
            )
        await socket.prepare(request)
        sending = asyncio.create_task(_send(group, socket))
        try:
            async for message in socket:
                if message.type is WSMsgType.ERROR:
                    break
                if not dialect.clients_may_speak:
                    await socket.close(code=WSCloseCode.POLICY_VIOLATION, message=_NO_SPEAKING)
        finally:
            sending.cancel()
            await self._end(group)
        return socket

    async def _end(self, group: _Group) -> None:
        group.is_over = True
        group.changed.set()
        if self._groups.pop(group.number, None) is not None:
            await self.link.request(Unsubscribe(group.number))

    def _session_ended(self, number: int) -> None:
        """Release the resources held by a session, and end its subscriptions."""

        async def end() -> None:
            for group in [one for one in self._groups.values() if one.session == number]:
                await self._end(group)
            await self.link.request(SessionEnded(number))

        task: asyncio.Task[object] = asyncio.get_running_loop().create_task(end())
        self._ending.add(task)
        task.add_done_callback(self._ending.discard)

    async def _close(self, app: web.Application) -> None:
        """End the websockets."""
        del app
        for group in self._groups.values():
            group.is_over = True
            group.changed.set()


async def _send(group: _Group, socket: web.WebSocketResponse) -> None:
    """Send the events of a subscription group in order until it ends."""
    while True:
        await group.changed.wait()
        group.changed.clear()
        while group.waiting:
            await socket.send_str(event_text(group.number, group.waiting.next()))
        if group.is_over:
            await socket.close()
            return
