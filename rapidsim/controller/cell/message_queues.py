"""The RAPID message queues of a cell: one per task, and one for each external client.

Servers of such clients use `MessageQueues`: `connect` returns the queue of a client, `find` that of
a task, and `MessageQueue.put` delivers at an instant of virtual time.

Source: Technical reference manual System parameters, "RMQ Type", "RMQ Mode", "RMQ Max Message
Size", "RMQ Max No Of Messages". The length of a message being that of its text is our reading.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import field
from enum import StrEnum
from typing import Annotated

from rapidsim.json_records.declarations import Key, noun, whole_number
from rapidsim.language.error_numbers import (
    ERR_RMQ_FULL,
    ERR_RMQ_INVALID,
    ERR_RMQ_MSGSIZE,
    rapid_error,
)
from rapidsim.language.messages import MOST_BYTES, Message, MessageKind, Slot
from rapidsim.values import value_class

LEAST_BYTES = 400
MOST_MESSAGES = 10


class QueueType(StrEnum):
    """Senders whose messages a task accepts."""

    NONE = "none"
    INTERNAL = "internal"
    """Other tasks."""
    REMOTE = "remote"
    """Other tasks and clients outside the controller."""


class QueueMode(StrEnum):
    """Reception of messages by a task."""

    INTERRUPT = "interrupt"
    SYNCHRONOUS = "synchronous"


@value_class(frozen=True, slots=True)
class QueueSettings:
    """Settings of a task's queue as in the system parameters: `rmq` of a table [[task]]."""

    type: Annotated[QueueType, noun("a type")] = QueueType.REMOTE
    """Senders that it accepts."""
    mode: Annotated[QueueMode | None, noun("a mode")] = None
    """None if not configured: then it follows from the instructions that the program uses."""
    max_bytes: Annotated[int, Key("size"), whole_number(LEAST_BYTES, MOST_BYTES)] = LEAST_BYTES
    """Largest size of a message [bytes]."""
    max_messages: Annotated[int, Key("messages"), whole_number(1, MOST_MESSAGES)] = 5
    """Most messages that wait in it."""


class DeliveryResult(StrEnum):
    """Result of a delivery."""

    KEPT = "kept"
    ANSWERS = "answers"
    DISCARDED = "discarded"
    LOST = "lost"


@value_class(slots=True, eq=False)
class _PendingReply:
    """Message for which RMQSendWait waits."""

    sender: Slot
    kind: MessageKind
    answer: Message | None = None


@value_class(slots=True, eq=False)
class MessageQueue:
    """The messages for a task or a client; implements `language.messages.Slot`."""

    name: str
    settings: QueueSettings
    messages: list[Message] = field(default_factory=list)
    is_open: bool = True
    is_absent: bool = False
    """Whether its task is not in the run: messages to it are lost."""
    raises_interrupt: Callable[[Message, float], bool] = lambda message, now_s: False
    """Raises the interrupts that wait for a message; returns whether there are any."""
    _awaited: _PendingReply | None = None

    def put(self, message: Message, now_s: float) -> DeliveryResult:
        """Deliver a message at a time [s] to which all tasks are synchronised.

        Raises:
            RapidError: ERR_RMQ_INVALID, ERR_RMQ_MSGSIZE or ERR_RMQ_FULL.
        """
        if self.is_absent:
            return DeliveryResult.LOST
        size, most = len(message.wire.encode("iso-8859-1", "replace")), self.settings.max_bytes
        if not self.is_open:
            raise rapid_error(ERR_RMQ_INVALID, f"{self.name} has disconnected")
        if size > most:
            raise rapid_error(
                ERR_RMQ_MSGSIZE, f"the message has {size} bytes; {self.name} takes {most}"
            )
        awaited = self._awaited
        if (
            awaited is not None
            and awaited.answer is None
            and message.sender is awaited.sender
            and awaited.kind.fits(message.kind)
        ):
            awaited.answer = message
            return DeliveryResult.ANSWERS
        if len(self.messages) >= self.settings.max_messages:
            raise rapid_error(
                ERR_RMQ_FULL, f"{self.name} holds {len(self.messages)} messages and takes no more"
            )
        mode = self.settings.mode
        raised = mode is not QueueMode.SYNCHRONOUS and self.raises_interrupt(message, now_s)
        if mode is QueueMode.INTERRUPT and not raised:
            return DeliveryResult.DISCARDED
        self.messages.append(message)
        return DeliveryResult.KEPT

    def await_answer(self, sender: Slot, kind: MessageKind) -> None:
        """Keep the next message of a kind from a sender for RMQSendWait."""
        self._awaited = _PendingReply(sender, kind)

    @property
    def answer(self) -> Message | None:
        """The answer that RMQSendWait waits for, once it has arrived."""
        return None if self._awaited is None else self._awaited.answer

    def forget_answer(self) -> None:
        """Stop waiting for an answer."""
        self._awaited = None


@value_class(slots=True)
class MessageQueues:
    """All queues of a cell, by name, case-sensitive."""

    absent: frozenset[str] = frozenset()
    """Names of queues of tasks of the cell that are not in this run."""
    _queues: dict[str, MessageQueue] = field(default_factory=dict)

    def open_for(self, task: str, settings: QueueSettings) -> MessageQueue:
        """Open the queue of a starting task; its earlier queue is disconnected."""
        self.disconnect(f"RMQ_{task}")
        queue = MessageQueue(f"RMQ_{task}", settings)
        self.absent -= {queue.name}
        if settings.type is not QueueType.NONE:
            self._queues[queue.name] = queue
        return queue

    def connect(self, client: str, max_messages: int = MOST_MESSAGES) -> MessageQueue:
        """The queue of a client, which keeps messages until the client fetches them."""
        settings = QueueSettings(
            mode=QueueMode.SYNCHRONOUS, max_bytes=MOST_BYTES, max_messages=max_messages
        )
        return self._queues.setdefault(client, MessageQueue(client, settings))

    def disconnect(self, client: str) -> None:
        """Close the queue of a client; later senders to it get an error."""
        if queue := self._queues.pop(client, None):
            queue.is_open = False

    def find(self, name: str, *, is_external: bool = False) -> MessageQueue | None:
        """Return the queue of a name or None; clients find tasks only if they are remote."""
        queue = self._queues.get(name)
        if queue is None and name in self.absent and not is_external:
            return MessageQueue(name, QueueSettings(), is_absent=True)
        if queue is not None and is_external and queue.settings.type is not QueueType.REMOTE:
            return None
        return queue
