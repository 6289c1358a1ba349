"""Inputs for the programs' sockets, and the faults of these connections.

Faults act here, behind the journal: it has what the network has sent, so that a replay repeats
them.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace

from rapidsim.controller.cell.faults import Channel, FailureKind, Fault
from rapidsim.server.messages import DATAGRAM, FromNetwork
from rapidsim.simulation.live.controller import LiveController


@dataclass(slots=True, eq=False)
class NetworkInputs:
    """Passes inputs from the network on to the programs."""

    live: LiveController
    _used: Counter[int] = field(default_factory=Counter)
    """Number of times that each lasting fault has acted."""

    def receive(self, message: FromNetwork) -> None:
        """Handle an input, as far as faults let it pass."""
        faults = self._acting()
        begins = bool(message.peer) or message.number == DATAGRAM
        if FailureKind.DROP in faults or (FailureKind.REFUSE in faults and begins):
            self._close(message.number)
            return
        if FailureKind.DELAY in faults:
            due_s = self.live.now_s + faults[FailureKind.DELAY].by_s
            self.live.cell.happen(due_s, lambda _: self.live.soon(lambda: self._deliver(message)))
        else:
            self._deliver(message)
        if FailureKind.DUPLICATE in faults and message.data:
            self._deliver(replace(message, peer=message.peer if not message.number else ""))

    def faults_changed(self) -> None:
        """Break the connections of the programs if they drop from now on."""
        lasting = self.live.faults.of(Channel.SOCKET)
        known = {one.number for one in lasting}
        self._used = Counter({key: used for key, used in self._used.items() if key in known})
        if any(one.fault.kind is FailureKind.DROP and not one.fault.count for one in lasting):
            for number in self.live.external_streams.numbers:
                self._close(number)
            self.live.wake_programs()

    def _acting(self) -> dict[FailureKind, Fault]:
        """Return the faults that act on the next input, by kind."""
        acting = dict[FailureKind, Fault]()
        for one in self.live.faults.of(Channel.SOCKET):
            if one.fault.count is None or self._used[one.number] < one.fault.count:
                self._used[one.number] += 1
                acting[one.fault.kind] = one.fault
        return acting

    def _close(self, number: int) -> None:
        """End a connection on both sides."""
        if number != DATAGRAM:
            self.live.external_streams.ended(number, self.live.now_s)
            self.live.wire.close(number)
            self.live.wake_programs()

    def _deliver(self, message: FromNetwork) -> None:
        outside, now_s = self.live.external_streams, self.live.now_s
        if message.number == DATAGRAM:
            self.live.mailboxes.arrived(message.port, message.peer, message.data)
        else:
            if message.peer:
                outside.came(message.number, message.port, message.peer, now_s)
            if message.data:
                outside.arrived(message.number, message.data, now_s)
            if message.is_over:
                outside.ended(message.number, now_s)
        self.live.wake_programs()
