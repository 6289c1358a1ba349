"""Message queue of one task, and sending to other queues."""

from __future__ import annotations

import math
from collections.abc import Callable

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.message_queues import DeliveryResult, MessageQueue, QueueMode
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.journal.events import MAX_TIME, EventKind
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.findings.runs import MessageDiscarded
from rapidsim.language.messages import Message, MessageKind, Slot
from rapidsim.values import value_class

_SHOWN = 60
"""Number of characters of a message that an event shows."""


@value_class(frozen=True, slots=True, eq=False)
class TaskMessages:
    """Implements `language.messages.Messages`."""

    clock: TaskClock
    cell: Cell
    table: InterruptTable
    journal: Journal
    queue: MessageQueue

    def __post_init__(self) -> None:
        """Let messages raise the interrupts of the task."""
        self.queue.raises_interrupt = self.table.message_received

    @property
    def is_synchronous(self) -> bool | None:
        """Whether messages wait for RMQReadWait, not for interrupts; None if not configured."""
        mode = self.queue.settings.mode
        return None if mode is None else mode is QueueMode.SYNCHRONOUS

    def find_queue(self, name: str) -> Slot | None:
        """The queue of a name, case-sensitive; None if messages cannot be sent there."""
        self.clock.synchronise()
        return self.cell.messages.find(name)

    def is_open(self, slot: Slot) -> bool:
        """Whether a queue still exists: a client may have disconnected."""
        self.clock.synchronise()
        assert isinstance(slot, MessageQueue)
        return slot.is_open

    def send_message(self, slot: Slot, message: Message) -> None:
        """Put a message into a queue, where it arrives at once.

        Raises:
            RapidError: ERR_RMQ_INVALID, ERR_RMQ_MSGSIZE or ERR_RMQ_FULL.
        """
        now_s = self.clock.synchronise()
        assert isinstance(slot, MessageQueue)
        became = slot.put(message, now_s)
        shown = message.wire if len(message.wire) <= _SHOWN else f"{message.wire[:_SHOWN]}..."
        self.clock.event(
            EventKind.MESSAGE, f"sent {shown} to {slot.name}", sent=message.wire, to=slot.name
        )
        if became is DeliveryResult.DISCARDED:
            told = MessageDiscarded(slot.name, message.kind.spelled)
            self.journal.finding(told, self.clock.place, once=told)
        if became is DeliveryResult.LOST:
            lost = f"messages to {slot.name} are lost: its task is not in this run"
            self.journal.unsimulated("RMQSendMessage", lost, self.clock.place)
        self.clock.notify_tasks()
        # A message to the task itself may have raised an interrupt.
        self.clock.pass_time(now_s)

    def await_answer(
        self, slot: Slot, message: Message, answer: MessageKind, *, max_time: float | None
    ) -> Message | None:
        """Send a message to a queue and wait for its answer; None if none arrives in time.

        Raises:
            RapidError: See `send_message`.
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        deadline_s = self._deadline(max_time)
        self.queue.await_answer(slot, answer)
        try:
            self.send_message(slot, message)
            self._wait(
                lambda: self.queue.answer is not None,
                deadline_s,
                f"an answer from {slot.name}",
                f"`RMQSendWait` waits for an answer of type {answer.spelled} from {slot.name}, "
                "and none comes",
            )
            return self.queue.answer
        finally:
            self.queue.forget_answer()

    def await_message(self, *, max_time: float | None) -> Message | None:
        """Take the next message, waiting for it; None if none arrives in time.

        Raises:
            WaitsForever: If the wait has no limit and no known event ends it.
        """
        deadline_s = self._deadline(max_time)
        self._wait(
            lambda: bool(self.queue.messages),
            deadline_s,
            "a message",
            "`RMQReadWait` waits for a message, and none is sent",
        )
        return self.next_message()

    def next_message(self) -> Message | None:
        """Take the next message; None if the queue is empty."""
        self.clock.synchronise()
        return self.queue.messages.pop(0) if self.queue.messages else None

    def empty_queue(self) -> None:
        """Discard all messages."""
        self.clock.synchronise()
        self.queue.messages.clear()

    def order_message(self, interrupt: float, kind: MessageKind) -> None:
        """Raise an interrupt at each message of a kind."""
        self.clock.synchronise()
        self.table.order_message(interrupt, kind)

    def _deadline(self, max_time: float | None) -> float:
        self.clock.note_line()
        now_s = self.clock.synchronise()
        return math.inf if max_time is None else now_s + max(0.0, max_time)

    def _wait(
        self, is_available: Callable[[], bool], deadline_s: float, awaited: str, in_vain: str
    ) -> None:
        """Let time pass until a message has arrived or a deadline [s] has passed."""
        with self.clock.waiting(awaited) as wait:
            while not is_available():
                if self.clock.resolve_time() >= deadline_s:
                    wait.ended_by = MAX_TIME
                    return
                if not self.clock.await_event(deadline_s):
                    raise WaitsForever(
                        in_vain, r"\TimeOut ends the wait; other tasks send messages"
                    )
            wait.ended_by = awaited
