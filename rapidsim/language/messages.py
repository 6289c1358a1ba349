"""RAPID message queues: messages, and the services of the queues for a task.

Each task has a queue to which others send messages; so may clients outside the controller. A
message is text, `string;["a","b"]`, as sent to such clients; from a task it has its value, too.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "RMQSendMessage",
"IRMQMessage"; Application manual Robot communication and I/O control, "RAPID Message Queue".
"""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.types import Type
from rapidsim.values import value_class

NO_USER_DEF = -1.0
r"""Value of \UserDef in a message that was sent without it."""
MOST_BYTES = 3000
"""Largest size of a message that a queue can be configured for."""


class Slot(Protocol):
    """A queue to which messages can be sent: the value of an rmqslot."""

    @property
    def name(self) -> str:
        """Name for RMQFindSlot: `RMQ_T_ROB1`, or the name of a client."""
        ...


@value_class(frozen=True, slots=True)
class MessageKind:
    """Type of the messages for which a task waits: data type, aliases resolved, and dimensions."""

    data_type: str
    """Empty for free text between clients."""
    dimensions: tuple[int, ...] = ()

    @property
    def spelled(self) -> str:
        """Name in RAPID syntax: `string{2}`."""
        sizes = ",".join(map(str, self.dimensions))
        return f"{self.data_type}{{{sizes}}}" if sizes else self.data_type

    def fits(self, other: MessageKind) -> bool:
        """Whether data of the other kind are of this kind."""
        same_name = self.data_type.lower() == other.data_type.lower()
        return same_name and self.dimensions == other.dimensions


@value_class(frozen=True, slots=True, eq=False)
class Message:
    """One message: the value of an rmqmessage."""

    kind: MessageKind
    text: str
    """The data in RAPID syntax."""
    sender: Slot | None = None
    user_def: float = NO_USER_DEF
    value: object = None
    """The data; None if the message arrived as text."""
    of: Type | None = None
    """Their type, without array dimensions; None if the message arrived as text."""

    @property
    def wire(self) -> str:
        """Text that a client outside the controller receives."""
        return f"{self.kind.data_type};{self.text}" if self.kind.data_type else self.text


class Messages(Protocol):
    """The queue of a task, and access to the others."""

    @property
    def queue(self) -> Slot:
        """The task's own queue."""
        ...

    @property
    def is_synchronous(self) -> bool | None:
        """Whether messages wait for RMQReadWait, not for interrupts; None if not configured."""
        ...

    def find_queue(self, name: str) -> Slot | None:
        """The queue of a name, case-sensitive; None if messages cannot be sent there."""
        ...

    def is_open(self, slot: Slot) -> bool:
        """Whether a queue still exists: a client may have disconnected."""
        ...

    def send_message(self, slot: Slot, message: Message) -> None:
        """Send a message to a queue.

        Raises:
            RapidError: ERR_RMQ_INVALID, ERR_RMQ_MSGSIZE or ERR_RMQ_FULL.
        """
        ...

    def await_answer(
        self, slot: Slot, message: Message, answer: MessageKind, *, max_time: float | None
    ) -> Message | None:
        """Send a message to a queue and wait for an answer; None if none arrives in time.

        Raises:
            RapidError: See `send_message`.
        """
        ...

    def await_message(self, *, max_time: float | None) -> Message | None:
        """Wait for the next message and take it; None if none arrives in time."""
        ...

    def next_message(self) -> Message | None:
        """Take the next message; None if the queue is empty."""
        ...

    def empty_queue(self) -> None:
        """Discard all messages."""
        ...

    def order_message(self, interrupt: float, kind: MessageKind) -> None:
        """Raise an interrupt at each message of a kind."""
        ...
