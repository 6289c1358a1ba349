"""Link from the process of the protocols to the engine."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rapidsim.server.engine import Engine
from rapidsim.server.messages import Inquiry, Notification, Reply


class Link(Protocol):
    """Sends messages to the engine."""

    async def request(self, message: Inquiry) -> Reply:
        """Send a message to the engine and return its reply.

        Raises:
            EngineEndedError: If the engine has ended.
        """
        ...


class EngineEndedError(Exception):
    """The engine has ended."""


class DirectLink:
    """Link to an engine in the same thread, whose time passes only on command."""

    def __init__(self, make: Callable[[Callable[[Notification], None]], Engine]) -> None:
        """Make the engine, with a listener for its notifications."""
        self.listener: Callable[[Notification], None] = lambda told: None
        self.engine = make(lambda told: self.listener(told))

    async def request(self, message: Inquiry) -> Reply:
        """See `Link`."""
        return self.engine.reply(message)
