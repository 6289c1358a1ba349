"""What a variable of type `socketdev` holds: how far the socket is, and what it is tied to."""

from __future__ import annotations

from collections.abc import Sized
from typing import Final, NamedTuple, Protocol

from rapidsim.values import dataclass

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
    """What has arrived and nobody has read yet."""
    has_ended: bool
    """Whether the other end has closed, so that nothing more arrives."""


class Datagram(NamedTuple):
    """A datagram that has arrived."""

    data: bytes
    address: str
    """Of the sender."""
    port: int


class DatagramPort(Protocol):
    """A socket for datagrams (UDP)."""

    port: int
    """0 until SocketBind or the first datagram that it sends gives it one."""

    @property
    def received(self) -> Sized:
        """Datagrams that no statement has read yet."""
        ...


class Listener(Protocol):
    """A port of a program, where it may wait for clients."""

    port: int


@dataclass(frozen=True, slots=True)
class SocketState:
    """A socket that SocketCreate has made and SocketClose has not ended."""

    status: float = CREATED
    address: str = ""
    port: int = 0
    """What SocketBind gave it; 0 before."""
    connection: Connection | None = None
    datagrams: DatagramPort | None = None
    """The port of a socket for datagrams; None for one of streams."""
    listener: Listener | None = None
    """The port that SocketBind gave it, whether it listens or not."""
