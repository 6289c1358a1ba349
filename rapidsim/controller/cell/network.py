"""Real sockets, for runs that may use the network; only this computer unless other hosts are named.

Answers of the network take no virtual time; a wait without an answer takes its full time on both
clocks. A run that uses the network is as reproducible as its peers.
"""

from __future__ import annotations

import socket
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from time import monotonic
from typing import TypeVar

from rapidsim.controller.cell.sensors import GuidanceSensors
from rapidsim.language.error_numbers import (
    ERR_SOCK_ADDR_INUSE,
    ERR_SOCK_CLOSED,
    ERR_SOCK_NET_UNREACH,
    rapid_error,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.sockets import Datagram

T = TypeVar("T")

_LOOPBACK = "127.0.0.1"
_LOCAL = ("", "localhost", _LOOPBACK)
_AT_ONCE = 65536
_LOOK_S = 0.5
"""Time [s] for which a wait without limit ignores Ctrl-C."""


@dataclass(eq=False, slots=True)
class NetworkConnection:
    """A connection over the network; implements `language.sockets.Connection`."""

    stream: socket.socket
    peer: str
    received: bytearray = field(default_factory=bytearray)
    has_ended: bool = False

    def send(self, data: bytes, seconds: float | None) -> bool:
        """Send bytes; False if the other end did not take all of them within `seconds`.

        Raises:
            RapidError: ERR_SOCK_CLOSED.
        """
        try:
            self.stream.settimeout(seconds)
            self.stream.sendall(data)
        except TimeoutError:
            return False
        except OSError as error:
            raise rapid_error(ERR_SOCK_CLOSED, f"{self.peer}: {_reason(error)}") from None
        return True

    def wait(self, count: int, patience: Callable[[], float | None]) -> None:
        """Wait until `count` bytes have arrived or no more will.

        Args:
            count: The number of bytes to wait for, including those that have arrived.
            patience: Called after each arrival: returns the time [s] to wait for more; None for no
                limit.
        """
        while len(self.received) < count and not self.has_ended:
            data = _tried(lambda: self.stream.recv(_AT_ONCE), self.stream, patience())
            if data is None:
                return
            self.received += data
            self.has_ended = not data

    def close(self) -> None:
        """End the connection."""
        self.stream.close()


@dataclass(eq=False, slots=True)
class NetworkPort:
    """A port of this computer that the program has bound, to listen on."""

    server: socket.socket
    address: str
    port: int

    def has(self, address: str, port: int) -> bool:
        """Whether it is this port and not yet released."""
        return (self.address, self.port) == (address, port) and self.server.fileno() >= 0

    def listen(self) -> None:
        """Let clients connect.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        try:
            self.server.listen()
        except OSError as error:
            raise _in_use(self.address, self.port, error) from None

    def accept(self, seconds: float | None) -> NetworkConnection | None:
        """Wait `seconds`, or indefinitely if None, for a client; None if none connects."""
        found = _tried(self.server.accept, self.server, seconds)
        if found is None:
            return None
        stream, (host, port, *_) = found
        return NetworkConnection(stream, f"{host}:{port}")

    def close(self) -> None:
        """Stop listening."""
        self.server.close()


@dataclass(eq=False, slots=True)
class NetworkMailbox:
    """A real socket for datagrams, which drops those of hosts that the run may not contact."""

    socket: socket.socket
    is_reachable: Callable[[str], bool]

    def send(self, address: str, port: int, data: bytes) -> None:
        """Send a datagram; one that the network refuses is lost."""
        with suppress(OSError):
            self.socket.settimeout(_LOOK_S)
            self.socket.sendto(data, (address or _LOOPBACK, port))

    def receive(self, seconds: float | None) -> Datagram | None:
        """Wait `seconds`, or indefinitely if None, for a datagram; None if none arrives."""
        until = None if seconds is None else monotonic() + seconds
        while True:
            wait_s = None if until is None else max(until - monotonic(), 0.0)
            try:
                got = _tried(lambda: self.socket.recvfrom(_AT_ONCE), self.socket, wait_s)
                if got is None:
                    return None
                data, (address, port, *_) = got
                if self.is_reachable(address):
                    return Datagram(data, str(address), int(port))
            except RapidError:
                # An earlier datagram was sent to a port without a receiver.
                pass
            if until is not None and monotonic() >= until:
                return None

    def close(self) -> None:
        """Release the port."""
        self.socket.close()


@dataclass(slots=True)
class Network:
    """The network as far as a run may use it."""

    hosts: frozenset[str] = frozenset()
    """Hosts other than this computer that sockets may bind or connect to."""
    sensors: GuidanceSensors | None = None
    """The sensors that guide robots; None if there are no sensors."""
    _opened: list[NetworkConnection | NetworkPort | NetworkMailbox] = field(default_factory=list)

    def bind(self, address: str, port: int) -> NetworkPort:
        """Bind a port: at the address if it is an allowed host, else only for this computer.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        host = address if address in self.hosts else _LOOPBACK
        if any(isinstance(one, NetworkPort) and one.has(host, port) for one in self._opened):
            # With two sockets of one program, some systems notice it only when both listen.
            raise rapid_error(ERR_SOCK_ADDR_INUSE, f"another socket has {host}:{port} already")
        server = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            server.bind((host, port))
        except OSError as error:
            server.close()
            raise _in_use(host, port, error) from None
        bound = NetworkPort(server, host, port)
        self._opened.append(bound)
        return bound

    def open_mailbox(self, address: str, port: int) -> NetworkMailbox:
        """Bind a port for datagrams, 0 for any: only for this computer if no host is allowed.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE.
        """
        # A socket of the loopback reaches no other host.
        host = address if address in self.hosts else "" if self.hosts else _LOOPBACK
        opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            opened.bind((host, port))
        except OSError as error:
            opened.close()
            raise _in_use(host, port, error) from None
        mailbox = NetworkMailbox(opened, self.may_reach)
        self._opened.append(mailbox)
        return mailbox

    def require_reachable(self, address: str) -> None:
        """Refuse a host that the run may not contact.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH.
        """
        if not self.may_reach(address):
            raise rapid_error(
                ERR_SOCK_NET_UNREACH,
                f"{address} is another computer; `--network-host {address}` lets the run use it",
            )

    def connect(self, address: str, port: int, seconds: float | None) -> NetworkConnection | None:
        """Connect to a server; None if it does not answer.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH for a host that the run may not contact.
        """
        self.require_reachable(address)
        stream = self.reached(address, port, seconds)
        if stream is None:
            return None
        connection = NetworkConnection(stream, f"{address}:{port}")
        self._opened.append(connection)
        return connection

    def may_reach(self, address: str) -> bool:
        """Whether sockets may connect to a host."""
        return address in self.hosts or address in _LOCAL

    def reached(self, address: str, port: int, seconds: float | None) -> socket.socket | None:
        """A connection to a server; None if it does not answer."""
        try:
            return socket.create_connection((address or _LOOPBACK, port), timeout=seconds)
        except OSError:
            return None

    def close(self) -> None:
        """Close all sockets that the program has open."""
        for one in self._opened:
            one.close()


def _tried(act: Callable[[], T], of: socket.socket, seconds: float | None) -> T | None:
    """Try a blocking call; None if the time ran out. A broken connection counts as ended."""
    while True:
        of.settimeout(_LOOK_S if seconds is None else max(seconds, 1e-3))
        try:
            return act()
        except TimeoutError:
            if seconds is not None:
                return None
        except ConnectionError as error:
            raise rapid_error(ERR_SOCK_CLOSED, _reason(error)) from None


def _in_use(host: str, port: int, error: OSError) -> RapidError:
    return rapid_error(ERR_SOCK_ADDR_INUSE, f"{host}:{port}: {_reason(error)}")


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()
