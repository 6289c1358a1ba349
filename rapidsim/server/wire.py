"""Network of programs' sockets: real ports, polled by the loop that runs the engine.

No call blocks. Inputs of peers are collected (`came`) when one of `sockets` is ready, and take
effect when the engine dispatches them. Only this computer is reachable, unless other hosts are
named.
"""

from __future__ import annotations

import socket
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from itertools import count
from queue import Empty, SimpleQueue
from threading import Event, Thread
from typing import Final

from rapidsim.controller.cell.external_streams import MOST_UNREAD, NullWire, Wire
from rapidsim.controller.cell.network import Network
from rapidsim.language.error_numbers import ERR_SOCK_NET_UNREACH, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.server.messages import DATAGRAM, FromNetwork

_AT_ONCE: Final = 65536
_MOST_CONNECTIONS: Final = 100
"""Largest number of connections at one time; others wait at the port."""
_MOST_UNSENT: Final = 16 * 2**20
"""Largest number of unsent bytes; a peer with more is considered gone."""
_AGAIN_S: Final = 0.25
"""Time [s] after which a server that did not answer is tried again."""
_LOOK_S: Final = 0.01
"""Period [s] at which unsent data are retried."""


@dataclass(slots=True)
class RecordingWire:
    """Wire that reports refusals by the number of the operation, so that they can be replayed."""

    wire: Wire
    refused: Callable[[int, RapidError], None] = lambda act, error: None
    _acts: int = 0

    def listen(self, port: int, address: str) -> None:
        """See `Wire`."""
        with self._noted():
            self.wire.listen(port, address)

    def unlisten(self, port: int) -> None:
        """See `Wire`."""
        self.wire.unlisten(port)

    def connect(self, number: int, address: str, port: int) -> None:
        """See `Wire`."""
        with self._noted():
            self.wire.connect(number, address, port)

    def send(self, number: int, data: bytes) -> None:
        """See `Wire`."""
        self.wire.send(number, data)

    def close(self, number: int) -> None:
        """See `Wire`."""
        self.wire.close(number)

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        """See `DatagramWire`."""
        with self._noted():
            self.wire.open_mailbox(port, address, is_bound=is_bound)

    def close_mailbox(self, port: int) -> None:
        """See `DatagramWire`."""
        self.wire.close_mailbox(port)

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        """See `DatagramWire`."""
        with self._noted():
            self.wire.send_datagram(port, address, to_port, data)

    @contextmanager
    def _noted(self) -> Iterator[None]:
        self._acts += 1
        try:
            yield
        except RapidError as error:
            self.refused(self._acts, error)
            raise


@dataclass(slots=True)
class ReplayedWire(NullWire):
    """Wire that repeats recorded refusals: errors by the number of the operation."""

    refusals: Mapping[int, tuple[float, str]]
    _acts: int = 0

    def listen(self, port: int, address: str) -> None:
        """See `Wire`."""
        del port, address
        self._act()

    def connect(self, number: int, address: str, port: int) -> None:
        """See `Wire`."""
        del number, address, port
        self._act()

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        """See `DatagramWire`."""
        del port, address, is_bound
        self._act()

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        """See `DatagramWire`."""
        del port, address, to_port, data
        self._act()

    def _act(self) -> None:
        self._acts += 1
        if self._acts in self.refusals:
            raise RapidError(*self.refusals[self._acts])


@dataclass(slots=True)
class _Connection:
    stream: socket.socket
    unsent: bytearray = field(default_factory=bytearray)
    closes: bool = False
    """Whether it closes once all data are sent."""


@dataclass(eq=False, slots=True)
class SocketWire:
    """Implementation of `external_streams.Wire` with sockets."""

    hosts: frozenset[str] = frozenset()
    """Hosts other than this computer that sockets may bind or connect to."""
    unread: Callable[[int], int] = lambda number: 0
    """Bytes of a connection that wait for its program."""
    _network: Network = field(init=False)
    _servers: dict[int, socket.socket] = field(default_factory=dict)
    _connections: dict[int, _Connection] = field(default_factory=dict)
    _mailboxes: dict[int, socket.socket] = field(default_factory=dict)
    """Sockets for datagrams, by the ports that programs use for them."""
    _calls: dict[int, Event] = field(default_factory=dict)
    """Connection attempts without an answer; set once their programs no longer wait."""
    _answers: SimpleQueue[tuple[int, str, socket.socket]] = field(default_factory=SimpleQueue)
    """Number, peer and stream of answered attempts; a peer may be gone again by now."""
    _lost: list[int] = field(default_factory=list)
    _incoming: count[int] = field(default_factory=lambda: count(-1, -1))
    _wake_pipe: tuple[socket.socket, socket.socket] = field(default_factory=socket.socketpair)
    """Wake-up pipe, written to when an attempt is answered or a connection is lost."""

    def __post_init__(self) -> None:
        """Start without ports."""
        self._network = Network(self.hosts)
        for one in self._wake_pipe:
            one.setblocking(False)

    def listen(self, port: int, address: str) -> None:
        """See `Wire`."""
        # A separate network each time: a shared one would keep every port that was ever open.
        opened = Network(self.hosts).bind(address, port)
        opened.listen()
        opened.server.setblocking(False)
        self._servers[port] = opened.server

    def unlisten(self, port: int) -> None:
        """See `Wire`."""
        server = self._servers.pop(port, None)
        if server is not None:
            server.close()

    def connect(self, number: int, address: str, port: int) -> None:
        """See `Wire`."""
        if not self._network.may_reach(address):
            raise rapid_error(
                ERR_SOCK_NET_UNREACH,
                f"{address} is another computer; `--network-host {address}` lets programs use it",
            )
        over = self._calls[number] = Event()
        call = Thread(target=self._call, args=(number, address, port, over), daemon=True)
        call.start()

    def send(self, number: int, data: bytes) -> None:
        """See `Wire`."""
        if connection := self._connections.get(number):
            connection.unsent += data
            self._flush(number, connection)

    def close(self, number: int) -> None:
        """See `Wire`."""
        if call := self._calls.pop(number, None):
            call.set()
        if connection := self._connections.get(number):
            connection.closes = True
            self._flush(number, connection)

    def open_mailbox(self, port: int, address: str, *, is_bound: bool) -> None:
        """See `DatagramWire`."""
        opened = Network(self.hosts).open_mailbox(address, port if is_bound else 0)
        opened.socket.setblocking(False)
        self._mailboxes[port] = opened.socket

    def close_mailbox(self, port: int) -> None:
        """See `DatagramWire`."""
        mailbox = self._mailboxes.pop(port, None)
        if mailbox is not None:
            mailbox.close()

    def send_datagram(self, port: int, address: str, to_port: int, data: bytes) -> None:
        """See `DatagramWire`; a datagram that the network does not accept is lost."""
        self._network.require_reachable(address)
        with suppress(OSError):
            self._mailboxes[port].sendto(data, (address or "127.0.0.1", to_port))

    def shut(self) -> None:
        """Close all ports and connections."""
        for mailbox in self._mailboxes.values():
            mailbox.close()
        for server in self._servers.values():
            server.close()
        for connection in self._connections.values():
            connection.stream.close()
        for call in self._calls.values():
            call.set()
        for one in self._wake_pipe:
            one.close()

    def sockets(self) -> list[socket.socket]:
        """Return the sockets to wait for."""
        room = len(self._connections) < _MOST_CONNECTIONS
        readable = [
            one.stream
            for number, one in self._connections.items()
            if not one.closes and self.unread(number) < MOST_UNREAD
        ]
        waiting = self._servers.values() if room else ()
        return [self._wake_pipe[0], *waiting, *self._mailboxes.values(), *readable]

    def patience_s(self, wait_s: float | None) -> float | None:
        """Return the time [s] to wait for the sockets, at most `wait_s`; None for no limit."""
        if not any(one.unsent for one in self._connections.values()):
            return wait_s
        return _LOOK_S if wait_s is None else min(wait_s, _LOOK_S)

    def came(self, ready: Collection[object]) -> Iterator[FromNetwork]:
        """Yield the inputs of the ready peers; also send data that could not be sent before."""
        for number, connection in tuple(self._connections.items()):
            if connection.unsent:
                self._flush(number, connection)
        lost, self._lost = self._lost, []
        yield from (FromNetwork(number, is_over=True) for number in lost)
        if self._wake_pipe[0] in ready:
            yield from self._answered()
        for port, server in tuple(self._servers.items()):
            if server in ready:
                yield from self._accepted(port, server)
        for number, connection in tuple(self._connections.items()):
            if connection.stream in ready:
                yield from self._read(number, connection)
        for port, mailbox in tuple(self._mailboxes.items()):
            if mailbox in ready:
                # An error reports that an earlier datagram reached a port without a socket.
                with suppress(OSError):
                    data, address = mailbox.recvfrom(_AT_ONCE)
                    if self._network.may_reach(address[0]):
                        yield FromNetwork(DATAGRAM, port, _name(address), data)

    def _answered(self) -> Iterator[FromNetwork]:
        with suppress(BlockingIOError):
            self._wake_pipe[0].recv(_AT_ONCE)
        while True:
            try:
                number, peer, stream = self._answers.get_nowait()
            except Empty:
                return
            if self._calls.pop(number, None) is None:
                stream.close()
                continue
            stream.setblocking(False)
            self._connections[number] = _Connection(stream)
            yield FromNetwork(number, peer=peer)

    def _accepted(self, port: int, server: socket.socket) -> Iterator[FromNetwork]:
        with suppress(OSError):
            stream, address = server.accept()
            stream.setblocking(False)
            number = next(self._incoming)
            self._connections[number] = _Connection(stream)
            yield FromNetwork(number, port, _name(address))

    def _read(self, number: int, connection: _Connection) -> Iterator[FromNetwork]:
        try:
            data = connection.stream.recv(_AT_ONCE)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            self._drop(number, connection)
        yield FromNetwork(number, data=data, is_over=not data)

    def _flush(self, number: int, connection: _Connection) -> None:
        """Send as much as the peer accepts."""
        try:
            while connection.unsent:
                sent = connection.stream.send(connection.unsent)
                del connection.unsent[:sent]
        except BlockingIOError:
            if len(connection.unsent) <= _MOST_UNSENT:
                return
            self._lose(number, connection)
        except OSError:
            self._lose(number, connection)
        if connection.closes:
            self._drop(number, connection)

    def _lose(self, number: int, connection: _Connection) -> None:
        """Drop a peer that has gone during a send; its program is notified later."""
        connection.unsent.clear()
        if not connection.closes:
            self._drop(number, connection)
            self._lost.append(number)
            self._wake()

    def _drop(self, number: int, connection: _Connection) -> None:
        connection.stream.close()
        self._connections.pop(number, None)

    def _call(self, number: int, address: str, port: int, over: Event) -> None:
        """Try until a server answers or the program no longer waits; runs in its own thread."""
        while not over.is_set():
            stream = self._network.reached(address, port, 1.0)
            if stream is None:
                over.wait(_AGAIN_S)
                continue
            self._answers.put((number, _name((address, port)), stream))
            self._wake()
            return

    def _wake(self) -> None:
        with suppress(OSError):
            self._wake_pipe[1].send(b"!")


def _name(address: tuple[object, ...]) -> str:
    return f"{address[0]}:{address[1]}"
