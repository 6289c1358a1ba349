"""The link from a debuggee to its adapter.

The debuggee asks for requests when it can handle them, and reads nothing in between: so a copy of
the process that takes over finds no half-read request, and none is lost.
"""

from __future__ import annotations

from contextlib import suppress
from typing import IO, Any

from rapidsim.dap.wire import Message, WireError, read_message, write_message
from rapidsim.values import value_class


class AdapterEnded(BaseException):
    """The adapter has closed the link."""


@value_class(frozen=True, slots=True)
class AdapterLink:
    """The two pipes of a debuggee."""

    incoming: IO[bytes]
    outgoing: IO[bytes]

    def requests(self, *, wait: bool) -> list[Message]:
        """Return the next request in a list, which is empty if there is none yet.

        Args:
            wait: Whether to wait for one.

        Raises:
            AdapterEnded: If nobody will send any.
        """
        try:
            write_message(self.outgoing, {"poll": True, "wait": wait})
            answer = read_message(self.incoming)
        except (OSError, WireError):
            answer = None
        if answer is None:
            raise AdapterEnded
        found: list[Message] = answer["requests"]
        return found

    def event(self, event: str, **body: Any) -> None:
        """Send an event to the client; raises as `requests` does."""
        self._send({"type": "event", "event": event, "body": body})

    def output(self, text: str, category: str = "console") -> None:
        """Print a line in the client's console."""
        self.event("output", category=category, output=f"{text}\n")

    def respond(self, request: Message, body: object = None) -> None:
        """Answer a request."""
        self._send(
            {
                "type": "response",
                "request_seq": request["seq"],
                "command": request["command"],
                "success": True,
                "body": {} if body is None else body,
            }
        )

    def refuse(self, request: Message, reason: str) -> None:
        """Answer a request that cannot be fulfilled."""
        self._send(
            {
                "type": "response",
                "request_seq": request["seq"],
                "command": request["command"],
                "success": False,
                "message": reason,
                "body": {"error": {"id": 1, "format": reason, "showUser": True}},
            }
        )

    def restart(self, state: object) -> None:
        """Ask the adapter for a new process that begins with a state."""
        write_message(self.outgoing, {"restart": state})

    def ended(self) -> None:
        """Tell the adapter that the session is over."""
        with suppress(OSError):
            write_message(self.outgoing, {"ended": True})

    def _send(self, message: Message) -> None:
        try:
            write_message(self.outgoing, {"send": message})
        except OSError:
            raise AdapterEnded from None
