"""The link from a debuggee to its adapter.

The debuggee asks for requests when it can handle them, and reads nothing in between: so a copy of
the process that takes over finds no half-read request, and none is lost.
"""

from __future__ import annotations

from contextlib import suppress
from typing import IO, Any, Protocol

from rapidsim.dap.wire import Message, WireError, read_message, write_message
from rapidsim.values import value_class


class AdapterEnded(BaseException):
    """The client has ended the session."""


class ClientLink(Protocol):
    """The link from a session to its client."""

    def requests(self, *, wait: bool) -> list[Message]:
        """Return the next request in a list, which is empty if there is none yet.

        Args:
            wait: Whether to wait for one.

        Raises:
            AdapterEnded: If there will be none.
        """
        ...

    def event(self, event: str, **body: Any) -> None:
        """Send an event to the client; raises as `requests` does."""
        ...

    def output(self, text: str, category: str = "console") -> None:
        """Print a line in the client's console."""
        ...

    def respond(self, request: Message, body: object = None) -> None:
        """Answer a request."""
        ...

    def refuse(self, request: Message, reason: str) -> None:
        """Answer a request that cannot be fulfilled."""
        ...

    def restart(self, state: object) -> None:
        """Begin again in a new process with a state."""
        ...


@value_class(frozen=True, slots=True)
class AdapterLink:
    """The two pipes of a debuggee."""

    incoming: IO[bytes]
    outgoing: IO[bytes]

    def requests(self, *, wait: bool) -> list[Message]:
        """See `ClientLink`."""
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
        """See `ClientLink`."""
        self._send({"type": "event", "event": event, "body": body})

    def output(self, text: str, category: str = "console") -> None:
        """See `ClientLink`."""
        self.event("output", category=category, output=f"{text}\n")

    def respond(self, request: Message, body: object = None) -> None:
        """See `ClientLink`."""
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
        """See `ClientLink`."""
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
        """See `ClientLink`."""
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
