"""The process that an editor starts: it forwards between the editor and the debuggee.

The program runs in a child process, so that it can go back: see `checkpoints`. What the editor
sends waits here until the debuggee asks for it.
"""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import IO

from rapidsim.dap.debuggee_process import DebuggeeProcess, start_debuggee
from rapidsim.dap.wire import Message, WireError, read_message, write_message

CAPABILITIES: Message = {
    "supportsConfigurationDoneRequest": True,
    "supportsConditionalBreakpoints": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsEvaluateForHovers": True,
    "supportsSetVariable": True,
    "supportsSetExpression": True,
    "supportsStepBack": True,
    "supportsRestartFrame": True,
    "supportsRestartRequest": True,
    "supportsGotoTargetsRequest": False,
    "supportsDataBreakpoints": True,
    "supportsExceptionInfoRequest": True,
    "supportsTerminateRequest": True,
    "supportsLoadedSourcesRequest": True,
    "supportTerminateDebuggee": True,
    "supportsExceptionFilterOptions": True,
    "exceptionBreakpointFilters": [
        {
            "filter": "unhandled",
            "label": "Errors that end the program",
            "default": True,
        },
        {
            "filter": "all",
            "label": "All errors",
            "default": False,
            "supportsCondition": True,
            "conditionDescription": "Names or numbers, such as ERR_DIVZERO, 41617",
        },
    ],
}
_PATIENCE_S = 2.0
"""Time [s] in which a debuggee must end after `disconnect`."""


class Adapter:
    """One session between an editor and a program."""

    def __init__(
        self,
        incoming: IO[bytes],
        outgoing: IO[bytes],
        start: Callable[[str | None], DebuggeeProcess] = start_debuggee,
    ) -> None:
        """Take the streams of the editor.

        Args:
            incoming: Requests.
            outgoing: Answers and events.
            start: Starts a debuggee in a working directory, None for that of this process.
        """
        self._incoming, self._outgoing, self._start = incoming, outgoing, start
        self._waiting: SimpleQueue[Message | None] = SimpleQueue()
        self._seq = 0
        self._process: DebuggeeProcess | None = None
        self._is_over = False

    def run(self) -> None:
        """Serve until the editor disconnects or the program has ended."""
        threading.Thread(target=self._read_all, name="requests", daemon=True).start()
        launch = self._begin()
        if launch is None:
            return
        if launch["command"] == "attach":
            self._attach(launch)
            return
        state: object = None
        while (state := self._follow(launch, state)) is not None:
            pass
        self._answer_rest()

    def _read_all(self) -> None:
        """Put what the editor sends into the queue."""
        while True:
            try:
                message = read_message(self._incoming)
            except WireError:
                continue
            except (OSError, ValueError):
                # The stream has been closed.
                message = None
            if message is None:
                break
            self._waiting.put(message)
            if message.get("command") in ("disconnect", "terminate"):
                self._is_over = True
                impatience = threading.Timer(_PATIENCE_S, self._kill)
                impatience.daemon = True
                impatience.start()
        self._waiting.put(None)
        self._is_over = True
        self._kill()

    def _begin(self) -> Message | None:
        """Answer requests up to `launch` or `attach`, which is returned."""
        while (request := self._waiting.get()) is not None:
            match request.get("command"):
                case "initialize":
                    self._respond(request, CAPABILITIES)
                case "launch" | "attach":
                    return request
                case "disconnect" | "terminate":
                    self._respond(request, {})
                    return None
                case other:
                    self._respond(request, None, f"`{other}` before `launch`")
        return None

    def _attach(self, attach: Message) -> None:
        """Forward between the editor and the debug port of a controller that is served."""
        arguments = attach.get("arguments") or {}
        try:
            place = str(arguments.get("host") or "127.0.0.1"), int(arguments["port"])
            controller = socket.create_connection(place, _PATIENCE_S)
        except (KeyError, TypeError, ValueError, OverflowError):
            self._respond(attach, None, "`port` is that of `rapidsim serve --debug PORT`")
            return
        except OSError as error:
            self._respond(attach, None, f"no controller is debugged there: {error}")
            return
        controller.settimeout(None)
        with controller, controller.makefile("rb") as messages, controller.makefile("wb") as stream:
            pump = threading.Thread(target=self._pump, args=(messages,), name="controller")
            pump.start()
            request: Message | None = attach
            while request is not None:
                is_last = request.get("command") in ("disconnect", "terminate")
                if pump.is_alive():
                    with suppress(OSError):
                        write_message(stream, request)
                else:
                    self._respond(request, {}, None if is_last else "the controller has ended")
                if is_last:
                    break
                request = self._waiting.get()
            if request is None:
                with suppress(OSError):
                    controller.shutdown(socket.SHUT_RDWR)
            pump.join(_PATIENCE_S)

    def _pump(self, messages: IO[bytes]) -> None:
        """Send to the editor what a controller sends, until it ends the session."""
        with suppress(OSError, WireError, ValueError):
            while (message := read_message(messages)) is not None:
                self._send({name: message[name] for name in message if name != "seq"})
        self._send({"type": "event", "event": "terminated", "body": {}})

    def _follow(self, launch: Message, state: object) -> object:
        """Run the debuggee until it ends; return the state of a next one, if it wants one."""
        try:
            process = self._process = self._start(launch.get("arguments", {}).get("cwd"))
        except OSError as error:
            self._respond(launch, None, f"`cwd`: {error.strerror or error}")
            return None
        next_state: object = None
        try:
            write_message(process.requests, {"launch": launch, "state": state})
            while (message := read_message(process.messages)) is not None:
                if "send" in message:
                    self._send(message["send"])
                elif "poll" in message:
                    found = self._requests(wait=message["wait"])
                    write_message(process.requests, {"requests": found})
                else:
                    next_state = message.get("restart")
                    break
            else:
                if not self._is_over:
                    self._send({"type": "event", "event": "terminated", "body": {}})
        except (OSError, WireError):
            pass
        finally:
            process.close()
            self._process = None
        return None if self._is_over else next_state

    def _requests(self, *, wait: bool) -> list[Message]:
        """The next request, if there is one: a debuggee that hands over must not have more."""
        try:
            request = self._waiting.get(block=wait)
        except Empty:
            return []
        return [{"command": "disconnect", "seq": 0} if request is None else request]

    def _answer_rest(self) -> None:
        """Answer what is left once the program has ended."""
        while True:
            try:
                # After `disconnect` no further request comes.
                request = self._waiting.get(block=not self._is_over)
            except Empty:
                return
            if request is None:
                return
            if request.get("command") in ("disconnect", "terminate"):
                self._respond(request, {})
                return
            self._respond(request, None, "the program has ended")

    def _kill(self) -> None:
        if (process := self._process) is not None:
            process.kill()

    def _respond(self, request: Message, body: object, refusal: str | None = None) -> None:
        answer = {
            "type": "response",
            "request_seq": request.get("seq", 0),
            "command": request.get("command", ""),
            "success": refusal is None,
        }
        self._send(answer | ({"message": refusal} if refusal else {"body": body}))

    def _send(self, message: Message) -> None:
        self._seq += 1
        with suppress(OSError):
            write_message(self._outgoing, {"seq": self._seq, **message})
