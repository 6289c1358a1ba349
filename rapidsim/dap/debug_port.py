"""A port at which a debugger attaches to a controller that is served.

It lives in the engine's process. A stop holds the task before a statement, and virtual time with
it, while the engine answers the clients of Robot Web Services. There is no way back: clients and
sensors have seen what was.
"""

from __future__ import annotations

import io
import socket
import sys
import time
from collections.abc import Sequence
from types import MappingProxyType
from typing import Any

from rapidsim.dap.adapter import CAPABILITIES
from rapidsim.dap.link import AdapterEnded
from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.requests import HANDLERS
from rapidsim.dap.session import DapRequestError, DebugSession
from rapidsim.dap.state import SessionState
from rapidsim.dap.wire import Message, WireError, read_message, write_message
from rapidsim.files import InputError
from rapidsim.interpreter.tools.step_positions import rapid_frames
from rapidsim.server.engine import Engine
from rapidsim.server.messages import ConsoleLine
from rapidsim.simulation.progress import RunInProgress

_LOOPBACK = "127.0.0.1"
_PATIENCE_S = 2.0
"""Real time [s] in which a client must take a message."""
_MOST_BYTES = 10_000_000
"""Largest amount of requests that wait to be complete."""
_BACKWARDS = {
    "supportsStepBack": False,
    "supportsRestartFrame": False,
    "supportsRestartRequest": False,
}


def open_debug_port(engine: Engine, *, port: int) -> DebugPort:
    """Listen for a debugger on this computer.

    Args:
        engine: The controller.
        port: The port; 0 for a free one.

    Raises:
        InputError: If the port is taken.
    """
    listener = socket.socket()
    try:
        listener.bind((_LOOPBACK, port))
        listener.listen(1)
    except OSError as error:
        listener.close()
        message = f"{_LOOPBACK}:{port} cannot be listened at: {error.strerror or error}"
        raise InputError(message, "`--debug 0` takes a free port") from None
    return DebugPort(engine, listener)


class DebugPort:
    """The port: one client at a time."""

    def __init__(self, engine: Engine, listener: socket.socket) -> None:
        """Take a socket that listens."""
        self._engine, self._listener = engine, listener
        self._link: SocketLink | None = None
        self._session: LiveSession | None = None

    @property
    def address(self) -> str:
        """Host and port."""
        host, port = self._listener.getsockname()
        return f"{host}:{port}"

    def sockets(self) -> Sequence[socket.socket]:
        """The sockets that may have something to read."""
        return [self._listener if self._link is None else self._link.socket]

    def came(self, readable: Sequence[object]) -> None:
        """Handle what has arrived at these sockets."""
        if self._link is None:
            if self._listener in readable:
                self._link = SocketLink(self._listener.accept()[0])
            return
        if self._link.socket not in readable:
            return
        try:
            for request in self._link.arrived():
                self._handle(request, self._link)
        except (AdapterEnded, OSError, WireError):
            self.close_client()
        except Exception as error:
            # A defect of rapidsim ends the session, not the controller.
            defect = f"rapidsim has a defect: {type(error).__name__}: {error}"
            self._engine.notify(ConsoleLine(f"error: {defect}; the debugger is detached"))
            self.close_client()

    def _handle(self, request: Message, link: SocketLink) -> None:
        command = request.get("command")
        if self._session is not None:
            self._session.handle(request)
        elif command == "initialize":
            link.respond(request, {**CAPABILITIES, **_BACKWARDS})
        elif command == "attach":
            tasks = self._engine.live.tasks.values()
            if any(task.is_stepping for task in tasks):
                link.refuse(request, "a client of Robot Web Services is stepping; try again")
                return
            self._session = LiveSession.attached(link, self._engine)
            link.respond(request)
            link.event("capabilities", capabilities=_BACKWARDS)
            link.event("initialized")
        elif command in ("disconnect", "terminate"):
            link.respond(request)
            raise AdapterEnded
        else:
            link.refuse(request, f"`{command}` before `attach`")

    def close_client(self) -> None:
        """Detach the debugger; the controller continues."""
        session, self._session = self._session, None
        if session is not None:
            session.detach()
        link, self._link = self._link, None
        if link is not None:
            link.socket.close()

    def close(self) -> None:
        """Close the port."""
        self.close_client()
        self._listener.close()


class SocketLink:
    """The link to a client over a socket; see `link.ClientLink`."""

    def __init__(self, connection: socket.socket) -> None:
        """Take a connection."""
        self.socket = connection
        connection.settimeout(_PATIENCE_S)
        self._bytes = b""
        self._seq = 0

    def arrived(self) -> list[Message]:
        """Read what has come; return the requests that are complete.

        Raises:
            AdapterEnded: If the client has ended.
            WireError: If it is something else.
        """
        data = self.socket.recv(65536)
        self._bytes += data
        if not data or len(self._bytes) > _MOST_BYTES:
            raise AdapterEnded
        requests = []
        while (end := self._bytes.find(b"\r\n\r\n")) >= 0 or len(self._bytes) > 1000:
            header = self._bytes[:end]
            # A page in a browser can send a request of HTTP here, with a body of its choice.
            if end < 0 or b"\n" in header or not header.lower().startswith(b"content-length:"):
                raise WireError("this is not the Debug Adapter Protocol")
            stream = io.BytesIO(self._bytes)
            request = read_message(stream)
            if request is None:
                break
            requests.append(request)
            self._bytes = self._bytes[stream.tell() :]
        return requests

    def requests(self, *, wait: bool) -> list[Message]:
        """None: requests are handled between two steps of the engine."""
        return []

    def event(self, event: str, **body: Any) -> None:
        """See `ClientLink`."""
        self._send({"type": "event", "event": event, "body": body})

    def output(self, text: str, category: str = "console") -> None:
        """See `ClientLink`."""
        self.event("output", category=category, output=f"{text}\n")

    def respond(self, request: Message, body: object = None) -> None:
        """See `ClientLink`."""
        self._answer(request, success=True, body={} if body is None else body)

    def refuse(self, request: Message, reason: str) -> None:
        """See `ClientLink`."""
        error = {"id": 1, "format": reason, "showUser": True}
        self._answer(request, success=False, message=reason, body={"error": error})

    def restart(self, state: object) -> None:
        """See `ClientLink`; a controller does not begin again."""

    def _answer(self, request: Message, **more: object) -> None:
        numbers = {"request_seq": request.get("seq", 0), "command": request.get("command", "")}
        self._send({"type": "response", **numbers, **more})

    def _send(self, message: Message) -> None:
        """Send a message; it may come from within a program, which must not see an error."""
        self._seq += 1
        stream = io.BytesIO()
        write_message(stream, {"seq": self._seq, **message})
        try:
            self.socket.sendall(stream.getvalue())
        except OSError:
            # Then it also has nothing more to read, which ends the session.
            try:
                self.socket.shutdown(socket.SHUT_RDWR)
            except OSError:
                return


class LiveSession(DebugSession):
    """A session with the programs of a controller that is served."""

    engine: Engine
    _held_since_s: float = 0.0

    @classmethod
    def attached(cls, link: SocketLink, engine: Engine) -> LiveSession:
        """Attach to the programs, which may be running."""
        live = engine.live
        tasks = list(live.tasks.values())
        files = ProgramFiles(tuple(task.name for task in tasks))
        for task in tasks:
            files.take_all(task.program.modules)
        session = cls(link, files, SessionState(), None, _HANDLERS)
        session.engine = engine
        run = RunInProgress(live.cell, lambda: [task.run for task in live.tasks.values()])
        session.take_run(run)
        debugger = session.debugger
        debugger.keeps_history, debugger.poll = False, lambda: None
        for one in run.tasks():
            debugger.follow(rapid_frames(run.frame_of(one)))
        live.scheduler.trace = debugger.entered
        return session

    def detach(self) -> None:
        """Leave the programs, which continue."""
        self.debugger.has_ended = True
        self.engine.live.scheduler.trace = None
        if not self.is_running:
            self.resume()

    def resume(self) -> None:
        """Let the program go on."""
        super().resume()
        self.engine.skip(time.monotonic() - self._held_since_s)
        self.engine.live.scheduler.release()

    def _wait(self) -> None:
        self._held_since_s = time.monotonic()
        # Without this, Python would treat what happens meanwhile as part of the tracing.
        sys.call_tracing(self.engine.live.scheduler.hold, ())

    def _print_events(self) -> None:
        """Print nothing: texts are on the operator's screen, which clients read."""


def _refused(session: DebugSession, arguments: Message) -> object:
    raise DapRequestError("a controller that is served does not go back")


_HANDLERS = MappingProxyType(
    {
        **HANDLERS,
        **dict.fromkeys(("stepBack", "reverseContinue", "restart", "restartFrame"), _refused),
    }
)
