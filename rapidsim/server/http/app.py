"""Robot Web Services over HTTP: admission, requests, answers.

The engine decides the outcome of a request. Both generations share sessions and subscriptions.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from typing import Final

from aiohttp import web

from rapidsim.controller.cell.faults import Channel, FailureKind
from rapidsim.server.http.client_faults import REQUEST_KINDS, ClientFaults
from rapidsim.server.http.connections import ClientConnection, Connections
from rapidsim.server.http.dialect import Dialect
from rapidsim.server.http.failed_logins import FailedLogins
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.operator_page import serve_operator_page
from rapidsim.server.http.request_reading import decoding, path_of, read_form, read_request
from rapidsim.server.http.sessions import Session, Sessions
from rapidsim.server.http.subscription_groups import SubscriptionGroups
from rapidsim.server.link import EngineEndedError, Link
from rapidsim.server.messages import (
    DONE,
    Answer,
    ChangeEvent,
    ConnectionFaults,
    ConsoleLine,
    ErrorAnswer,
    Notification,
    Restarted,
    SessionEnded,
)
from rapidsim.server.resources.codes import NOT_FOUND
from rapidsim.server.settings import NO_LATENCIES

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]
_SESSION: Final = web.RequestKey("session", Session)
_IS_REPEATED: Final = web.RequestKey("is_repeated", bool)
"""Whether the request arrives twice."""
_DIALECT: Final = web.AppKey("dialect", Dialect)


@dataclass(eq=False)
class HttpFrontend:
    """HTTP frontend of Robot Web Services."""

    link: Link
    guard: Guard
    noted: Callable[[str], None]
    """Called with lines for the console."""
    most_sessions: int = 70
    idle_s: float = 300.0
    latencies_s: Mapping[str, float] = field(default_factory=lambda: NO_LATENCIES)
    """Time [s] until an operation is answered, by its name."""
    connections: Connections = field(default_factory=Connections)
    faults: ClientFaults = field(default_factory=ClientFaults)
    sessions: Sessions = field(init=False)
    groups: SubscriptionGroups = field(init=False)
    _failed_logins: FailedLogins = field(default_factory=FailedLogins)
    _ending: set[asyncio.Task[object]] = field(default_factory=set)

    def __post_init__(self) -> None:
        """Start without sessions."""
        self.sessions = Sessions(self.most_sessions, self.idle_s, self._session_ended)
        self.groups = SubscriptionGroups(self.link.request, self.faults)
        self.connections.refuses = self.faults.refuses_connection

    def app(self, dialect: Dialect) -> web.Application:
        """Return the application of a generation, whose one handler handles every request."""
        app = web.Application(middlewares=[self._connected])
        app[_DIALECT] = dialect
        app.router.add_route("*", "/{tail:.*}", self._handled)
        app.on_shutdown.append(self._close)
        return app

    def notify(self, notification: Notification) -> None:
        """Pass a change to the websocket of its group; let connections fail."""
        match notification:
            case ChangeEvent():
                self.groups.notify(notification)
            case ConnectionFaults(faults):
                self.faults.begin(faults)
                self.groups.break_dropped()
            case Restarted(down_s):
                self.faults.go_down(down_s)
                self.sessions.end_all()
                self.connections.abort_all()
            case ConsoleLine():
                self.noted(notification.text)

    @property
    def counts(self) -> tuple[int, int]:
        """Number of sessions and of subscriptions."""
        return len(self.sessions), len(self.groups)

    @web.middleware
    async def _connected(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Mark the connection as serving a request, whose outcome is always an answer."""
        connection = self.connections.of(request.protocol)
        connection.begin_request()
        acting = self.faults.acting(Channel.HTTP, *REQUEST_KINDS)
        if FailureKind.DROP in acting:
            connection.abort()
            return web.Response(status=400)
        request[_IS_REPEATED] = FailureKind.DUPLICATE in acting
        try:
            response = await self._admitted(request, handler, connection)
            if FailureKind.DELAY in acting:
                await asyncio.sleep(acting[FailureKind.DELAY].by_s)
            if not response.prepared:
                response.headers.update(self._cross_origin_headers(request))
            return response
        except EngineEndedError:
            return web.Response(status=500, text="the controller has ended\n")
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
        finally:
            connection.end_request()

    async def _admitted(
        self, request: web.Request, handler: Handler, connection: ClientConnection
    ) -> web.StreamResponse:
        """Admit requests that address this server and come from an authenticated user."""
        with decoding():
            refused = self.guard.objection(request.method, request.path, request.headers)
            if refused is not None:
                return web.Response(status=403, text=f"{refused}\n")
            if request.method == "OPTIONS" and self.guard.allows(request.headers.get("Origin")):
                # Browsers ask, without a login, whether a page may send what it wants to.
                return web.Response(status=204)
            cookies = request.cookies
        session = self.sessions.find(cookies, request.scheme)
        is_fresh = session is None
        if session is None:
            users = request.app[_DIALECT].users
            user = await self._authenticate(request, connection.address)
            if user is None:
                return web.Response(
                    status=401, headers={"WWW-Authenticate": users.challenge}, text=""
                )
            session = self.sessions.begin(user, request.scheme)
            if session is None:
                return web.Response(status=503, text="too many sessions\n")
        connection.admit(session.number)
        request[_SESSION] = session
        response = await handler(request)
        if is_fresh and not response.prepared:
            attributes = "; path=/; httponly; SameSite=Strict"
            if request.scheme == "https":
                attributes += "; Secure"
            for name, value in session.cookies.items():
                # By hand: one of the names would not pass `set_cookie`.
                response.headers.add("Set-Cookie", f"{name}={value}{attributes}")
        return response

    def _cross_origin_headers(self, request: web.Request) -> Mapping[str, str]:
        """Return the headers that let a page of an admitted origin read an answer (CORS)."""
        origin = request.headers.get("Origin")
        if origin is None or not self.guard.allows(origin):
            return {}
        return {
            "Access-Control-Allow-Origin": origin,
            "Access-Control-Allow-Credentials": "true",
            "Access-Control-Allow-Methods": "GET, POST, PUT, DELETE",
            "Access-Control-Allow-Headers": "Accept, Authorization, Content-Type",
            "Access-Control-Expose-Headers": "Location",
            "Vary": "Origin",
        }

    async def _authenticate(self, request: web.Request, address: str) -> str | None:
        """Return the user of a request without a session; None if not admitted."""
        header = request.headers.get("Authorization", "")
        if not header:
            return None
        delay_s = self._failed_logins.delay_s(address)
        if delay_s:
            await asyncio.sleep(delay_s)
        with decoding():
            user = request.app[_DIALECT].users.user(header, request.method, request.raw_path)
        if user is None:
            self._failed_logins.add(address)
        return user

    async def _handled(self, request: web.Request) -> web.StreamResponse:
        dialect, session = request.app[_DIALECT], request[_SESSION]
        path = path_of(request)
        first, _, rest = path.partition("/")
        if first == "ui":
            # Browsers are clients of neither generation, and send the headers they like.
            return await serve_operator_page(request, rest, session.number, self.link.request)
        with decoding():
            objection = dialect.objection(request)
        if objection is not None:
            return objection
        match first, request.method:
            case "poll", _:
                with self.sessions.listening(session):
                    return await self.groups.poll(request, dialect, rest, session.number)
            case "subscription", "POST" if not rest:
                form = await read_form(request)
                return await self.groups.subscribe(request, dialect, form, session.number)
            case "subscription", "DELETE":
                return await self.groups.unsubscribe(request, dialect, rest, session.number)
            case "subscription", _:
                refusal = ErrorAnswer(*NOT_FOUND, f"there is no subscription {rest}")
                return dialect.represent(request, refusal)
            case "logout", "GET":
                self.sessions.end(session)
                return dialect.represent(request, Answer() if dialect.generation == 1 else DONE)
            case "fileservice", _:
                async with session.transfer:
                    return await self._resource(request, path, is_file=True)
            case _:
                return await self._resource(request, path, is_file=False)

    async def _resource(
        self, request: web.Request, path: str, *, is_file: bool
    ) -> web.StreamResponse:
        dialect = request.app[_DIALECT]
        has_content = is_file and request.method == "PUT"
        reading = read_request(
            request, path, request[_SESSION].number, dialect.generation, is_file=has_content
        )
        async with reading as message:
            reply = await self.link.request(message)
            if request[_IS_REPEATED]:
                reply = await self.link.request(message)
        operation = request.query.get("action") or path.rpartition("/")[2]
        if request.method == "POST" and operation in self.latencies_s:
            await asyncio.sleep(self.latencies_s[operation])
        if is_file and isinstance(reply, ErrorAnswer):
            return dialect.file_refused(request, reply)
        if is_file and request.method != "GET":
            return web.Response(status=reply.status)
        return dialect.represent(request, reply)

    def _session_ended(self, number: int) -> None:
        """Release the resources held by a session, and end its subscriptions."""

        async def end() -> None:
            await self.groups.end_session(number)
            await self.link.request(SessionEnded(number))

        task: asyncio.Task[object] = asyncio.get_running_loop().create_task(end())
        self._ending.add(task)
        task.add_done_callback(self._ending.discard)

    async def _close(self, app: web.Application) -> None:
        """End the websockets."""
        del app
        self.groups.close()
