"""The way from the process that speaks protocols to the engine."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rapidsim.server.engine import Engine
from rapidsim.server.messages import Inquiry, Notification, Reply


class Link(Protocol):
    """Sends messages to the engine."""

    async def request(self, message: Inquiry) -> Reply:
        """The engine's reply.

        Raises:
            EngineEndedError: If it is there no more.
        """
        ...


class EngineEndedError(Exception):
    """The engine has ended."""


class DirectLink:
    """An engine in this very thread: time passes only when it is told to."""

    def __init__(self, make: Callable[[Callable[[Notification], None]], Engine]) -> None:
        """Make the engine, given the listener for what it tells."""
        self.listener: Callable[[Notification], None] = lambda told: None
        self.engine = make(lambda told: self.listener(told))

    async def request(self, message: Inquiry) -> Reply:
        """See `Link`."""
        return self.engine.reply(message)
