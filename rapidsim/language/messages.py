"""RAPID message queues: what a message holds, and what a task may ask of the queues.

Each task has a queue that others send messages to; so may clients outside the controller. A message
is text, `string;["a","b"]`, as it travels to such clients; from a task it has its value, too.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "RMQSendMessage",
"IRMQMessage"; Application manual Robot communication and I/O control, "RAPID Message Queue".
"""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.types import Type
from rapidsim.values import value_class

NO_USER_DEF = -1.0
r"""What \UserDef gives of a message that was sent without it."""


class Slot(Protocol):
    """A queue that messages can be sent to: the value of an rmqslot."""

    @property
    def name(self) -> str:
        """What RMQFindSlot finds it by: `RMQ_T_ROB1`, or the name of a client."""
        ...


@value_class(frozen=True, slots=True)
class MessageKind:
    """What a task waits for or has ordered: a type behind its aliases, and array dimensions."""

    data_type: str
    dimensions: tuple[int, ...] = ()

    @property
    def spelled(self) -> str:
        """As RAPID writes it: `string{2}`."""
        sizes = ",".join(map(str, self.dimensions))
        return f"{self.data_type}{{{sizes}}}" if sizes else self.data_type

    def fits(self, other: MessageKind) -> bool:
        """Whether data of the other kind are data of this one."""
        same_name = self.data_type.lower() == other.data_type.lower()
        return same_name and self.dimensions == other.dimensions


@value_class(frozen=True, slots=True, eq=False)
class Message:
    """One message: the value of an rmqmessage."""

    kind: MessageKind
    text: str
    """The data as RAPID writes them."""
    sender: Slot | None = None
    user_def: float = NO_USER_DEF
    value: object = None
    """The data; None where the message came as text."""
    of: Type | None = None
    """Their type, without array dimensions; None where the message came as text."""

    @property
    def wire(self) -> str:
        """What a client outside the controller is given."""
        return f"{self.kind.data_type};{self.text}"


class Messages(Protocol):
    """The queue of a task, and its way to the others."""

    @property
    def queue(self) -> Slot:
        """The task's own."""
        ...

    @property
    def is_synchronous(self) -> bool | None:
        """Whether messages wait for RMQReadWait, not for interrupts; None where nobody says."""
        ...

    def find_queue(self, name: str) -> Slot | None:
        """The queue of a name, as it is spelled; None where nobody can send to one."""
        ...

    def is_open(self, slot: Slot) -> bool:
        """Whether a queue is still there: a client may have gone."""
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
        """Send a message to a queue and wait for an answer; None if none came in time.

        Raises:
            RapidError: See `send_message`.
        """
        ...

    def await_message(self, *, max_time: float | None) -> Message | None:
        """Wait for the next message and take it; None if none came in time."""
        ...

    def next_message(self) -> Message | None:
        """Take the next message; None if there is none."""
        ...

    def empty_queue(self) -> None:
        """Discard all messages."""
        ...

    def order_message(self, interrupt: float, kind: MessageKind) -> None:
        """Raise an interrupt at each message of a kind."""
        ...
