"""Connections of programs with real peers, whose actions take effect at instants of virtual time.

A `Wire` carries out actions of programs; the owner of the clock passes in those of peers. Both
identify a connection by one number. To a program such a connection is like one with a script.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Final, Protocol

from rapidsim.controller.cell.outside_datagrams import DatagramWire
from rapidsim.controller.cell.streams import Port, StreamEnd, connected

MOST_UNREAD: Final = 1_000_000
"""Maximum number of bytes that wait for a program; a peer that sends more has to wait."""


class Wire(DatagramWire, Protocol):
    """Network side of the connections of programs."""

    def listen(self, port: int, address: str) -> None:
        """Let clients connect to a port.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        ...

    def unlisten(self, port: int) -> None:
        """Stop accepting connections at a port."""
        ...

    def connect(self, number: int, address: str, port: int) -> None:
        """Try to reach a server until it answers or the connection is closed.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH for a host that programs may not contact.
        """
        ...

    def send(self, number: int, data: bytes) -> None:
        """Send bytes."""
        ...

    def close(self, number: int) -> None:
        """Close a connection once everything has been sent."""
        ...


class NullWire:
    """A wire without peers: actions of programs have no effect."""

    def listen(self, port: int, address: str) -> None:
        """See `Wire`."""

    def unlisten(self, port: int) -> None:
        """See `Wire`."""

    def connect(self, number: int, address: str, port: int) -> None:
        """See `Wire`."""

    def send(self, number: int, data: bytes) -> None:
        """See `Wire`."""

    def close(self, number: int) -> None:
        """See `Wire`."""

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        """See `DatagramWire`."""

    def close_mailbox(self, port: int) -> None:
        """See `DatagramWire`."""

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        """See `DatagramWire`."""


@dataclass(slots=True)
class _Stream:
    """A connection: the program's end and the peer's."""

    near: StreamEnd
    far: StreamEnd


@dataclass(slots=True, eq=False)
class ExternalStreams:
    """The streams of a cell, numbered from 1 up if programs requested them, else from -1 down."""

    wire: Wire
    _ports: dict[int, Port] = field(default_factory=dict)
    _streams: dict[int, _Stream] = field(default_factory=dict)
    _calls: dict[tuple[str, int], int] = field(default_factory=dict)
    """Requested connections that are not answered yet, by address and port."""
    _answered: dict[tuple[str, int], StreamEnd] = field(default_factory=dict)
    _last: int = 0

    def opened(self, port: Port, address: str) -> None:
        """A program listens at a port; raises as `Wire.listen` does."""
        self.wire.listen(port.port, address)
        self._ports[port.port] = port

    def closed(self, port: Port) -> None:
        """A program stops listening at a port."""
        if self._ports.get(port.port) is port:
            del self._ports[port.port]
            self.wire.unlisten(port.port)

    def called(self, address: str, port: int) -> StreamEnd | None:
        """The program's end of a requested connection, once it is answered; None before."""
        where = (address, port)
        end = self._answered.pop(where, None)
        if end is None and where not in self._calls:
            self.wire.connect(self._last + 1, address, port)
            self._last += 1
            self._calls[where] = self._last
        return end

    def hung_up(self, address: str, port: int, now_s: float) -> None:
        """Cancel a connection that a program requested."""
        number = self._calls.pop((address, port), None)
        if number is not None:
            self.wire.close(number)
        end = self._answered.pop((address, port), None)
        if end is not None:
            end.close(now_s)

    @property
    def numbers(self) -> tuple[int, ...]:
        """Numbers of the open connections."""
        return tuple(self._streams)

    def unread(self, number: int) -> int:
        """Bytes of a connection that wait for its program."""
        stream = self._streams.get(number)
        return 0 if stream is None else len(stream.near.received)

    def came(self, number: int, port: int, peer: str, now_s: float) -> None:
        """Handle a client that connects to a port, or a server that answers a request."""
        del now_s
        listening = self._ports.get(port)
        where = next((key for key, called in self._calls.items() if called == number), None)
        if number > 0 and where is not None:
            del self._calls[where]
            self._answered[where] = self._stream(number, f"{where[0]}:{where[1]}").near
        elif number < 0 and listening is not None:
            listening.waiting.append(self._stream(number, peer).near)
        else:
            self.wire.close(number)

    def arrived(self, number: int, data: bytes, now_s: float) -> None:
        """Deliver bytes to the program."""
        if stream := self._streams.get(number):
            stream.far.send(data, now_s)

    def ended(self, number: int, now_s: float) -> None:
        """The peer has closed a connection."""
        if stream := self._streams.pop(number, None):
            stream.far.close(now_s)

    def _stream(self, number: int, peer: str) -> _Stream:
        near, far = connected(peer, "the program")
        made = self._streams[number] = _Stream(near, far)
        far.notice = partial(self._noticed, number)
        return made

    def _noticed(self, number: int, now_s: float) -> None:
        """Handle data that the program has sent, or its end of the connection."""
        del now_s
        stream = self._streams.get(number)
        if stream is None:
            return
        if stream.far.received:
            self.wire.send(number, bytes(stream.far.received))
            stream.far.received.clear()
        if stream.far.has_ended:
            del self._streams[number]
            self.wire.close(number)
