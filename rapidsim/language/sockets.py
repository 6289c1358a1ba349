"""Value of a variable of type `socketdev`: state of the socket, and its connections."""

from __future__ import annotations

from collections.abc import Sized
from typing import Final, NamedTuple, Protocol

from rapidsim.values import value_class

CREATED: Final = 1.0
CONNECTED: Final = 2.0
BOUND: Final = 3.0
LISTENING: Final = 4.0
CLOSED: Final = 5.0
"""The constants SOCKET_CREATED to SOCKET_CLOSED."""


class Connection(Protocol):
    """One end of a stream of bytes."""

    peer: str
    """Address of the other end."""
    received: bytearray
    """Received data that no statement has read yet."""
    has_ended: bool
    """Whether the other end has closed, so that nothing more arrives."""


class Datagram(NamedTuple):
    """A datagram that has arrived."""

    data: bytes
    address: str
    """Address of the sender."""
    port: int


class DatagramPort(Protocol):
    """A socket for datagrams (UDP)."""

    port: int
    """0 until SocketBind or the first datagram that it sends assigns one."""

    @property
    def received(self) -> Sized:
        """Datagrams that no statement has read yet."""
        ...


class Listener(Protocol):
    """A port of a program, at which it may wait for clients."""

    port: int


@value_class(frozen=True, slots=True)
class SocketState:
    """A socket that SocketCreate has made and SocketClose has not ended."""

    status: float = CREATED
    address: str = ""
    port: int = 0
    """Port assigned by SocketBind; 0 before."""
    connection: Connection | None = None
    datagrams: DatagramPort | None = None
    """The port of a socket for datagrams; None for a socket of streams."""
    listener: Listener | None = None
    """The port of SocketBind, whether it listens or not."""


class Sockets(Protocol):
    """Connections to other computers, or to their substitutes."""

    def bind_port(self, address: str, port: int) -> Listener:
        """Bind a port; clients cannot connect to it yet.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE if another socket has it already.
        """
        ...

    def open_port(self, listener: Listener) -> None:
        """Let clients connect to a port.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE if another program of the computer has it.
        """
        ...

    def accept_client(self, listener: Listener, *, max_time: float | None) -> Connection | None:
        """Wait `max_time` [s], or indefinitely if None, for a client; None if none connects."""
        ...

    def connect_socket(
        self, address: str, port: int, *, max_time: float | None
    ) -> Connection | None:
        """Connect to a server within `max_time` [s] if not None; None if none answers in time."""
        ...

    def send_bytes(self, connection: Connection, data: bytes) -> None:
        """Send bytes.

        Raises:
            RapidError: ERR_SOCK_CLOSED if the other end has closed.
        """
        ...

    def await_bytes(self, connection: Connection, count: int, *, max_time: float | None) -> bool:
        """Wait until this many bytes have been received or no more will come.

        Returns:
            False if `max_time` [s] ran out first.
        """
        ...

    def close_socket(self, listener: Listener | None, connection: Connection | None) -> None:
        """Close the connection or port of a socket."""
        ...

    def open_datagrams(self) -> DatagramPort:
        """A new socket for datagrams, without a port."""
        ...

    def bind_datagrams(self, socket: DatagramPort, address: str, port: int) -> None:
        """Bind a socket for datagrams to a port.

        Raises:
            RapidError: ERR_SOCK_ADDR_INUSE if another socket has it already.
        """
        ...

    def send_datagram(self, socket: DatagramPort, address: str, port: int, data: bytes) -> None:
        """Send a datagram.

        Raises:
            RapidError: ERR_SOCK_NET_UNREACH if the run may not contact the host.
        """
        ...

    def await_datagram(self, socket: DatagramPort, *, max_time: float | None) -> Datagram | None:
        """Wait `max_time` [s], or indefinitely if None, for a datagram; None if none arrives."""
        ...

    def close_datagrams(self, socket: DatagramPort) -> None:
        """Release the port of a socket for datagrams."""
        ...
