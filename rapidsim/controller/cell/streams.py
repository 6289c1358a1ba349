"""Streams of bytes between the program and its peers: scripts and other tasks.

A connection has two ends. Data that one end sends arrives at the other at once; a script answers
after its delay. This module never waits: tasks wait, and later actions are scheduled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Protocol

from rapidsim.controller.cell.socket_scripts import SocketScript, SocketStep
from rapidsim.language.error_numbers import ERR_SOCK_ADDR_INUSE, rapid_error

Schedule = Callable[[float, Callable[[float], None]], None]
"""Schedules a call, with the time as argument, at a virtual time [s]."""

LOCAL = ("localhost", "127.0.0.1", "0.0.0.0", "")
"""Addresses of the controller itself."""


@dataclass(eq=False, slots=True)
class StreamEnd:
    """One end of a connection; implements `language.sockets.Connection`."""

    peer: str
    received: bytearray = field(default_factory=bytearray)
    has_ended: bool = False
    is_open: bool = True
    other_end: StreamEnd | None = None
    notice: Callable[[float], None] | None = None
    """Called with the time [s] when data arrived or the other end closed."""

    def send(self, data: bytes, now_s: float) -> None:
        """Send bytes to the other end."""
        other = self.other_end
        if other is None or self.has_ended:
            return
        other.received += data
        if other.notice is not None:
            other.notice(now_s)

    def close(self, now_s: float) -> None:
        """End the connection; the other end may still read what has arrived."""
        self.is_open = False
        other, self.other_end = self.other_end, None
        if other is not None:
            other.has_ended = True
            if other.notice is not None:
                other.notice(now_s)


def connected(near_peer: str, far_peer: str) -> tuple[StreamEnd, StreamEnd]:
    """Both ends of a new connection, each with the address of the other."""
    near, far = StreamEnd(near_peer), StreamEnd(far_peer)
    near.other_end, far.other_end = far, near
    return near, far


@dataclass(eq=False, slots=True)
class Port:
    """A port that a program has taken, and the clients it has not accepted yet."""

    port: int
    address: str = ""
    waiting: list[StreamEnd] = field(default_factory=list)
    listens: bool = False


@dataclass(eq=False, slots=True)
class ScriptedPeer:
    """A script at one end of a connection, with its progress."""

    script: SocketScript
    end: StreamEnd
    schedule: Schedule
    ended: Callable[[float], None]
    """Called when the connection has ended."""
    _at: int = 0
    _is_busy: bool = False
    """Whether a step waits for its time."""

    def notice(self, now_s: float) -> None:
        """Continue as far as the received data allows."""
        if self.end.has_ended:
            self.ended(now_s)
            return
        while not self._is_busy and self.end.is_open and (step := self._step()) is not None:
            if step.expect:
                place = self.end.received.find(step.expect)
                if place < 0:
                    return
                del self.end.received[: place + len(step.expect)]
            self._at += 1
            if step.after_s > 0.0:
                self._is_busy = True
                self.schedule(now_s + step.after_s, partial(self._later, step))
                return
            self._act(step, now_s)

    def _step(self) -> SocketStep | None:
        steps = self.script.steps
        if self._at >= len(steps) and self.script.repeats:
            self._at = 0
        return steps[self._at] if self._at < len(steps) else None

    def _later(self, step: SocketStep, now_s: float) -> None:
        self._is_busy = False
        self._act(step, now_s)
        self.notice(now_s)

    def _act(self, step: SocketStep, now_s: float) -> None:
        if step.send:
            self.end.send(step.send, now_s)
        if step.close and self.end.is_open:
            self.end.close(now_s)
            self.ended(now_s)


class ExternalPeer(Protocol):
    """Peers beyond the scripts; see `external_streams`."""

    def opened(self, port: Port, address: str) -> None:
        """Handle a program that listens at a port."""
        ...

    def closed(self, port: Port) -> None:
        """Handle a program that stops listening."""
        ...

    def called(self, address: str, port: int) -> StreamEnd | None:
        """The program's end of a requested connection, once it is accepted; None before."""
        ...

    def hung_up(self, address: str, port: int, now_s: float) -> None:
        """Cancel a connection that a program requested."""
        ...


class SocketTable:
    """The ports that programs have bound and the scripts connected to them."""

    def __init__(self, scripts: Sequence[SocketScript], schedule: Schedule) -> None:
        """Make the table; scripts act at their own times."""
        self._scripts = tuple(scripts)
        self._schedule = schedule
        self.external: ExternalPeer | None = None
        """None if the only peers are scripts and tasks."""
        self._ports: dict[int, Port] = {}
        self._busy: set[int] = set()
        """Indices of the scripts that are connected, are connecting, or have ended."""

    def is_scripted(self, port: int, *, serves: bool) -> bool:
        """Whether a script serves a port, or connects to it."""
        return any(one.port == port and one.serves == serves for one in self._scripts)

    def bind(self, port: int, address: str) -> Port:
        """Bind a port, at an address if that matters.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        if port in self._ports:
            raise rapid_error(ERR_SOCK_ADDR_INUSE, f"another socket has port {port} already")
        self._ports[port] = bound = Port(port, address)
        return bound

    def listen(self, port: Port, now_s: float) -> None:
        """Listen at a port; scripts that connect to it start to do so.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        if self.external is not None and not self.is_scripted(port.port, serves=False):
            self.external.opened(port, port.address)
        port.listens = True
        for index, script in enumerate(self._scripts):
            if script.port == port.port and not script.serves and index not in self._busy:
                self._set_out(index, now_s)

    def close_port(self, port: Port) -> None:
        """Release a port."""
        port.listens = False
        if self.external is not None:
            self.external.closed(port)
        if self._ports.get(port.port) is port:
            del self._ports[port.port]

    def connect(self, address: str, port: int, now_s: float) -> StreamEnd | None:
        """Connect to a script that serves or a task that listens; None if neither exists."""
        name = f"{address}:{port}"
        for script in self._scripts:
            if script.serves and script.port == port and script.address in ("", address):
                near, far = connected(name, "the program")
                peer = ScriptedPeer(script, far, self._schedule, lambda _: None)
                far.notice = peer.notice
                peer.notice(now_s)
                return near
        listening = self._listening(port)
        if listening is None:
            return None if self.external is None else self.external.called(address, port)
        host = "127.0.0.1" if address in LOCAL else address
        near, far = connected(name, f"{host}:{port}")
        listening.waiting.append(far)
        return near

    def hang_up(self, address: str, port: int, now_s: float) -> None:
        """Stop trying to connect."""
        if self.external is not None:
            self.external.hung_up(address, port, now_s)

    def _listening(self, port: int) -> Port | None:
        """The port of a number, if a program listens there; else None."""
        found = self._ports.get(port)
        return found if found is not None and found.listens else None

    def _set_out(self, index: int, now_s: float) -> None:
        """Let a script connect to the program's port after its delay."""
        script = self._scripts[index]
        self._busy.add(index)

        def arrive(time_s: float) -> None:
            listening = self._listening(script.port)
            if listening is None:
                self._busy.discard(index)
                return
            near, far = connected(f"{script.address or '127.0.0.1'}:{script.port}", "the program")
            peer = ScriptedPeer(script, far, self._schedule, again)
            far.notice = peer.notice
            listening.waiting.append(near)
            peer.notice(time_s)

        def again(time_s: float) -> None:
            if script.reconnects:
                self._busy.discard(index)
                if self._listening(script.port) is not None:
                    self._set_out(index, time_s)

        self._schedule(now_s + script.after_s, arrive)
