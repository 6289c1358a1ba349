"""The peers of a program's sockets that follow a script.

Plain data, read from the station file or the file that `--io` names.
"""

from __future__ import annotations

from typing import Annotated

from rapidsim.json_records.declarations import Key, NotNegative
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SocketStep:
    """One of the `steps` of a [[socket]]: wait for data of the program, wait a while, then act."""

    expect: bytes = b""
    """The step waits until the program has sent this; anything before it is skipped."""
    after_s: Annotated[NotNegative, Key("after")] = 0.0
    """Time from then, or from the end of the step before, to the action."""
    send: bytes = b""
    """Data that the program receives."""
    close: bool = False
    """End the connection."""


@value_class(frozen=True, slots=True)
class SocketScript:
    """A peer of a program's sockets."""

    port: int
    steps: tuple[SocketStep, ...]
    serves: bool
    """Whether it is a server that the program connects to; otherwise it connects to the program."""
    is_datagrams: bool = False
    """Whether it sends and receives datagrams (UDP) instead of streams."""
    address: str = ""
    """The address of a server, if it distinguishes it from others; empty for any."""
    after_s: float = 0.0
    """The time from the program's listening to the peer's connection, or to the server's answer."""
    repeats: bool = False
    """Whether the steps repeat after the last one."""
    reconnects: bool = False
    """Whether a peer that connects does so again when its connection has ended."""
