"""Messages between the process that speaks protocols and the one in which the controller lives.

All can be pickled, and know nothing of HTTP headers or the format of bodies.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from types import MappingProxyType
from typing import Final, TypeAlias

from rapidsim.values import value_class

Fields: TypeAlias = Mapping[str, str]
NOTHING: Fields = MappingProxyType({})


@value_class(frozen=True, slots=True)
class Item:
    """One thing that is shown: a list item of a page, an object of JSON."""

    kind: str
    """Its class, such as `rap-task-li`."""
    title: str = ""
    fields: Fields = field(default_factory=dict)
    arguments: tuple[str, ...] = ()
    """Texts in an order, as an entry of the event log has."""
    href: str = ""
    """Where it is itself, below the root."""
    parts: tuple[Item, ...] = ()
    """What it consists of, such as attributes."""


@value_class(frozen=True, slots=True)
class Answer:
    """A successful answer: what was asked for, or that it was done."""

    items: tuple[Item, ...] = ()
    status: int = 200
    links: tuple[str, ...] = ()
    """Resources below this one."""
    content: bytes | None = None
    """A file, instead of items."""
    following: str = ""
    """Where the list continues, below the root; empty at its end."""


DONE = Answer(status=204)


class RefusedRequest(Exception):  # noqa: N818 - an answer, not a failure
    """A request that the controller answers with an error."""

    def __init__(
        self, status: int, code: int, message: str, later: tuple[int, int] | None = None
    ) -> None:
        """Give HTTP status, controller's code and a text; `later` has both of RobotWare 7."""
        super().__init__(message)
        self.refusal = ErrorAnswer(status, code, message)
        self.later = self.refusal if later is None else ErrorAnswer(*later, message)


@value_class(frozen=True, slots=True)
class ErrorAnswer:
    """The error that a request is answered with."""

    status: int
    code: int
    message: str


@value_class(frozen=True, slots=True)
class Request:
    """A request to the controller."""

    method: str
    path: str
    """Without the query, decoded, from the root."""
    query: Fields = field(default_factory=dict)
    form: Fields = field(default_factory=dict)
    session: int = 0
    content: bytes = b""
    """A body that is not a form."""
    generation: int = 1
    """Of Robot Web Services: 1 or 2."""

    @property
    def action(self) -> str:
        """The operation that is asked for; empty for none."""
        return self.query.get("action", "")


@value_class(frozen=True, slots=True)
class SessionEnded:
    """A session has ended: what it holds is released."""

    session: int


@value_class(frozen=True, slots=True)
class Subscribe:
    """Tell a group of subscriptions of changes of some resources, from now on."""

    group: int
    resources: tuple[str, ...]


@value_class(frozen=True, slots=True)
class Unsubscribe:
    """Stop telling a group."""

    group: int


DATAGRAM: Final = 0
"""The number of no connection: a datagram has arrived."""


@value_class(frozen=True, slots=True)
class FromNetwork:
    """The peer of a program's socket has done something."""

    number: int
    """Of the connection, see `outside_streams`; `DATAGRAM` for a datagram from `peer`."""
    port: int = 0
    """Of the program, where a client has connected to it, or the datagram has arrived."""
    peer: str = ""
    """Who has connected, or has answered; empty if the connection existed before."""
    data: bytes = b""
    is_over: bool = False


@value_class(frozen=True, slots=True)
class ReadState:
    """Somebody looks at the controller, which has no effect and takes no time."""

    task: str = ""
    module: str = ""
    """The module of that task whose text is wanted; empty for everything but texts."""


Message: TypeAlias = Request | SessionEnded | Subscribe | Unsubscribe | FromNetwork
"""What affects the controller: its journal records them all."""
Inquiry: TypeAlias = Message | ReadState
"""Everything that the engine can be asked."""
Reply: TypeAlias = Answer | ErrorAnswer


@value_class(frozen=True, slots=True)
class ChangeEvent:
    """A change that a group of subscriptions is told."""

    group: int
    resource: str
    """What has changed, by the address that was subscribed to."""
    items: tuple[Item, ...]


@value_class(frozen=True, slots=True)
class ConsoleLine:
    """A line for whoever started the controller."""

    text: str


Notification: TypeAlias = ChangeEvent | ConsoleLine
