"""A client of the debug adapter for tests: requests in, answers and events out."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.reduction import DupFd
from pathlib import Path
from typing import Any

from rapidsim.dap.adapter import Adapter
from rapidsim.dap.debuggee import main
from rapidsim.dap.debuggee_process import DebuggeeProcess
from rapidsim.dap.wire import Message, read_message, write_message

_CONTEXT = get_context("forkserver")
_CONTEXT.set_forkserver_preload(["rapidsim.dap.debuggee"])


def _debuggee(folder: str, incoming: Any, outgoing: Any, alive: Any) -> None:
    os.setsid()
    os.chdir(folder)
    main(incoming.detach(), outgoing.detach(), alive.detach())


def quickly_started(folder: str | None) -> DebuggeeProcess:
    """A debuggee forked from a process that has imported everything: a session takes 0.1 s."""
    incoming, requests = os.pipe()
    messages, outgoing = os.pipe()
    reader, alive = os.pipe()
    ends = (incoming, outgoing, reader)
    process = _CONTEXT.Process(target=_debuggee, args=(folder or ".", *map(DupFd, ends)))
    process.start()
    for end in ends:
        os.close(end)
    assert process.pid is not None
    return DebuggeeProcess(os.fdopen(requests, "wb"), os.fdopen(messages, "rb"), process.pid, alive)


class RefusedError(Exception):
    """A request that the adapter refused."""


class Client:
    """One session with a debug adapter, in a thread, or in a process of its own as for editors."""

    def __init__(self, folder: Path, *, in_process: bool = False) -> None:
        self.folder = folder
        self.events: list[Message] = []
        self._answers: dict[int, Message] = {}
        self._seq = 0
        self._process: subprocess.Popen[bytes] | None = None
        if in_process:
            self._process = process = subprocess.Popen(
                [sys.executable, "-m", "rapidsim", "dap"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                cwd=folder,
            )
            assert process.stdin is not None
            assert process.stdout is not None
            self._requests, self._messages = process.stdin, process.stdout
            return
        (incoming, requests), (messages, outgoing) = os.pipe(), os.pipe()
        self._requests, self._messages = os.fdopen(requests, "wb"), os.fdopen(messages, "rb")
        self._ends = os.fdopen(incoming, "rb"), os.fdopen(outgoing, "wb")
        self._thread = threading.Thread(target=Adapter(*self._ends, quickly_started).run)
        self._thread.start()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *error: object) -> None:
        with suppress(OSError):
            self.send("disconnect")
        if self._process is not None:
            self._process.communicate(timeout=20)
            return
        with suppress(OSError):
            self._requests.close()
        self._thread.join(20)
        for stream in (self._messages, *self._ends):
            with suppress(OSError):
                stream.close()

    def send(self, command: str, **arguments: Any) -> int:
        """Send a request; return its number."""
        self._seq += 1
        message = {"seq": self._seq, "type": "request", "command": command, "arguments": arguments}
        write_message(self._requests, message)
        return self._seq

    def receive(self) -> Message:
        """The next message."""
        message: Message | None = read_message(self._messages)
        assert message is not None, "the adapter has ended"
        return message

    def answer(self, number: int) -> Message:
        """The body of the answer to a request; events before it are kept."""
        while number not in self._answers:
            self._sort(self.receive())
        message = self._answers.pop(number)
        if not message["success"]:
            raise RefusedError(message["message"])
        body: Message = message.get("body", {})
        return body

    def request(self, command: str, **arguments: Any) -> Message:
        """Send a request and return the body of its answer."""
        return self.answer(self.send(command, **arguments))

    def event(self, name: str, holds: Callable[[Message], bool] = lambda body: True) -> Message:
        """Wait for an event; return its body."""
        seen = 0
        while True:
            while seen < len(self.events):
                one = self.events[seen]
                if one["event"] == name and holds(one["body"]):
                    del self.events[seen]
                    body: Message = one["body"]
                    return body
                seen += 1
            assert not any(one["event"] == "terminated" for one in self.events), self.events
            self._sort(self.receive())

    def _sort(self, message: Message) -> None:
        if message["type"] == "event":
            self.events.append(message)
        else:
            self._answers[message["request_seq"]] = message

    # Conveniences.

    def launch(
        self, program: str, *breaks: int | Message, filters: tuple[str, ...] = (), **more: Any
    ) -> None:
        """Launch a program with breakpoints in its file, and let it run."""
        self.request("initialize", adapterID="rapidsim", linesStartAt1=True)
        launched = self.send("launch", program=program, cwd=str(self.folder), **more)
        self.event("initialized")
        if breaks:
            self.breaks(program, *breaks)
        self.request("setExceptionBreakpoints", filters=list(filters))
        self.request("configurationDone")
        self.answer(launched)

    def breaks(self, file: str, *wanted: int | Message) -> list[Message]:
        """Set the breakpoints of a file."""
        lines = [{"line": one} if isinstance(one, int) else one for one in wanted]
        source = {"path": str(self.folder / file)}
        found: list[Message] = self.request("setBreakpoints", source=source, breakpoints=lines)[
            "breakpoints"
        ]
        return found

    def stopped(self) -> Message:
        """Wait for a stop."""
        return self.event("stopped")

    def stops(self) -> bool:
        """Wait for a stop, or for the end of the program; whether it was a stop."""
        while True:
            for one in self.events:
                if one["event"] in ("stopped", "terminated"):
                    self.events.remove(one)
                    return bool(one["event"] == "stopped")
            self._sort(self.receive())

    def go(self, command: str, thread: int = 1) -> Message:
        """Continue or step, and wait for the stop."""
        self.request(command, threadId=thread)
        return self.stopped()

    def stack(self, thread: int = 1) -> list[Message]:
        """The routines of a task, without the line about its time."""
        frames: list[Message] = self.request("stackTrace", threadId=thread)["stackFrames"]
        return [one for one in frames if one.get("presentationHint") != "label"]

    def place(self, thread: int = 1) -> tuple[str, int]:
        """Routine and line at which a task stopped."""
        top = self.stack(thread)[0]
        return top["name"], top["line"]

    def label(self, thread: int = 1) -> str:
        """The line about time and robot."""
        frames = self.request("stackTrace", threadId=thread)["stackFrames"]
        return str(frames[-1]["name"])

    def value(self, expression: str, **more: Any) -> str:
        """The value of an expression at the stop."""
        return str(self.request("evaluate", expression=expression, **more)["result"])

    def scope(self, name: str, thread: int = 1) -> dict[str, str]:
        """The lines of a scope of the innermost routine."""
        return {one["name"]: one["value"] for one in self.lines(name, thread)}

    def lines(self, name: str, thread: int = 1) -> list[Message]:
        """The lines of a scope of the innermost routine, as the adapter gives them."""
        scopes = self.request("scopes", frameId=self.stack(thread)[0]["id"])["scopes"]
        number = next(one["variablesReference"] for one in scopes if one["name"] == name)
        found: list[Message] = self.request("variables", variablesReference=number)["variables"]
        return found

    def output(self) -> str:
        """All that has been printed, once the program has ended."""
        self.event("terminated")
        return "".join(one["body"]["output"] for one in self.events if one["event"] == "output")
