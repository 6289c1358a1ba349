"""Who is at the other end of a program's sockets: peers that follow a script.

Plain data, read from the station file or the file that `--io` names.
"""

from __future__ import annotations

from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class SocketStep:
    """One step of a script: wait for what the program sends, wait a while, then act."""

    expect: bytes = b""
    """The step waits until the program has sent this; what came before it is skipped."""
    after_s: float = 0.0
    send: bytes = b""
    close: bool = False
    """End the connection."""


@dataclass(frozen=True, slots=True)
class SocketScript:
    """A peer of a program's sockets."""

    port: int
    steps: tuple[SocketStep, ...]
    serves: bool
    """It is a server that the program connects to; otherwise it connects to the program."""
    address: str = ""
    """Of a server, where it differs from others by its address; empty serves any."""
    after_s: float = 0.0
    """From the program's listening to the peer's connecting, or the server's answer."""
    repeats: bool = False
    """The steps begin again after the last one."""
    reconnects: bool = False
    """A peer that connects does so again when its connection has ended."""
