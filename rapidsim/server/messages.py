"""Messages between the process of the protocols and the process of the controller.

Those that affect the controller are records of its journal. All can be pickled, and are independent
of HTTP headers and representations.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import field, replace
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import Annotated, ClassVar, Final, TypeAlias

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.json_records.declarations import Key, ValueForm
from rapidsim.values import value_class

NETWORK: Final = "network"
"""Kind of an event caused by a peer of a program's socket."""
Fields: TypeAlias = Mapping[str, str]


@value_class(frozen=True, slots=True)
class Item:
    """A list item of a page, or an object of JSON."""

    kind: str
    """Class of the item, such as `rap-task-li`."""
    title: str = ""
    fields: Fields = field(default_factory=dict)
    arguments: tuple[str, ...] = ()
    """Ordered texts, as in an entry of the event log."""
    href: str = ""
    """Address of the item, below the root."""
    parts: tuple[Item, ...] = ()
    """Parts of the item, such as attributes."""
    is_nested: bool = False
    """Whether HAL JSON has the fields in an object of their own, named as the item."""
    error: int = 0
    """Code of the reason why the item has no fields; 0 for none."""


@value_class(frozen=True, slots=True)
class Answer:
    """A successful answer: the requested items or file, or a confirmation."""

    items: tuple[Item, ...] = ()
    resources: tuple[Item, ...] | None = None
    """Items that are resources of their own, which RobotWare 7 lists apart; None for no list."""
    base: str | None = None
    """Address that hrefs are relative to, below the root; None for the service that has a list,
    and otherwise for the requested address."""
    status: int = 200
    links: tuple[str, ...] = ()
    """Resources below this one."""
    content: bytes | None = None
    """Content of a file, instead of items."""
    location: str = ""
    """Address of what the request has begun, below the root; empty for none."""
    following: str = ""
    """Address of the continuation of the list, below the root; empty at its end."""


DONE = Answer(status=204)


class RefusedRequest(Exception):  # noqa: N818 - an answer, not a failure
    """A request that the controller answers with an error."""

    def __init__(
        self, status: int, code: int, message: str, later: tuple[int, int] | None = None
    ) -> None:
        """Store HTTP status, controller's code, text; `later` has both codes of RobotWare 7."""
        super().__init__(message)
        self.refusal = ErrorAnswer(status, code, message)
        self.later = self.refusal if later is None else ErrorAnswer(*later, message)


@value_class(frozen=True, slots=True)
class ErrorAnswer:
    """Error that answers a request."""

    status: int
    code: int
    message: str


@value_class(frozen=True, slots=True)
class Request:
    """A request to the controller."""

    method: str
    path: str
    """Decoded path from the root, without the query."""
    query: Fields = field(default_factory=dict)
    form: Fields = field(default_factory=dict)
    session: int = 0
    generation: Annotated[int, ValueForm.OPTIONAL] = 1
    """Generation of Robot Web Services: 1 or 2."""
    content: Annotated[bytes | memoryview, ValueForm.OPTIONAL] = b""
    """Body that is not a form."""

    @property
    def action(self) -> str:
        """The requested operation; empty for none."""
        return self.query.get("action", "")


@value_class(frozen=True, slots=True)
class Upload:
    """A request whose content is in a file until it is answered."""

    request: Request
    file: Path

    @contextmanager
    def opened(self) -> Iterator[Request]:
        """The request with its content, which is not read into the memory."""
        with self.file.open("rb") as stream:
            if not os.fstat(stream.fileno()).st_size:
                yield self.request
                return
            with (
                mmap(stream.fileno(), 0, access=ACCESS_READ) as mapped,
                memoryview(mapped) as content,
            ):
                yield replace(self.request, content=content)


@value_class(frozen=True, slots=True)
class SessionEnded:
    """End of a session: the resources it holds are released."""

    session: Annotated[int, Key("end_of_session")]


@value_class(frozen=True, slots=True)
class Subscribe:
    """Subscribe a group to changes of resources, from now on."""

    resources: Annotated[tuple[str, ...], Key("subscribe")]
    group: int
    session: Annotated[int, ValueForm.OPTIONAL] = 0
    priorities: Annotated[tuple[int, ...], ValueForm.OPTIONAL] = ()
    """Priority of each resource: 0 low, 1 medium, 2 high, which is also that of a missing one."""


@value_class(frozen=True, slots=True)
class Unsubscribe:
    """End the subscriptions of a group."""

    group: Annotated[int, Key("unsubscribe")]


DATAGRAM: Final = 0
"""Connection number of a datagram, which has no connection."""


@value_class(frozen=True, slots=True)
class FromNetwork:
    """Input from the peer of a program's socket."""

    kind: ClassVar[str] = NETWORK
    number: Annotated[int, Key("connection")]
    """Number of the connection, see `outside_streams`; `DATAGRAM` for a datagram from `peer`."""
    port: int = 0
    """Port of the program to which a client has connected, or at which the datagram has arrived."""
    peer: str = ""
    """Peer that has connected or answered; empty if the connection existed before."""
    data: bytes = b""
    is_over: Annotated[bool, Key("over")] = False


@value_class(frozen=True, slots=True)
class ReadState:
    """Read of the controller's state, which has no effect and takes no time."""

    view: str = "state"
    """The part that is read: see `resources/operator_view.py`."""
    query: Fields = field(default_factory=dict)


@value_class(frozen=True, slots=True)
class BeginFault:
    """Make something fail: keys and values as in a table [[fault]], where a time may lack."""

    fault: Mapping[str, object]


@value_class(frozen=True, slots=True)
class EndFaults:
    """End the faults that last."""

    end_faults: bool = True


Message: TypeAlias = (
    Request | SessionEnded | Subscribe | Unsubscribe | FromNetwork | BeginFault | EndFaults
)
"""Messages that affect the controller: its journal records them all."""
Inquiry: TypeAlias = Message | Upload | ReadState
"""All messages that the engine answers."""
Reply: TypeAlias = Answer | ErrorAnswer


@value_class(frozen=True, slots=True)
class ChangeEvent:
    """A change at a resource, for a subscription group."""

    group: int
    resource: str
    """Subscribed address of the changed resource."""
    items: tuple[Item, ...]


@value_class(frozen=True, slots=True)
class ConsoleLine:
    """A line for the console of the process that started the controller."""

    text: str


@value_class(frozen=True, slots=True)
class ConnectionFaults:
    """The faults of connections that last now."""

    faults: tuple[LastingFault, ...]


@value_class(frozen=True, slots=True)
class Restarted:
    """The controller has restarted: sessions and connections end."""

    down_s: float
    """Real time [s] for which nobody can connect."""


Notification: TypeAlias = ChangeEvent | ConsoleLine | ConnectionFaults | Restarted
