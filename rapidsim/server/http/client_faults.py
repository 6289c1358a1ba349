"""Faults of the connections of clients: of requests, and of the events of websockets."""

from __future__ import annotations

import asyncio
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field

from rapidsim.controller.cell.faults import Channel, FailureKind, Fault, LastingFault


@dataclass(slots=True, eq=False)
class ClientFaults:
    """The lasting faults of clients' connections."""

    lasting: tuple[LastingFault, ...] = ()
    _used: Counter[int] = field(default_factory=Counter)
    """Number of times that each fault has acted."""
    _down_until_s: float = 0.0
    """Time [s] of the loop until which the controller restarts."""

    def begin(self, lasting: tuple[LastingFault, ...]) -> None:
        """Replace the faults."""
        known = {one.number for one in lasting}
        self._used = Counter({key: used for key, used in self._used.items() if key in known})
        self.lasting = lasting

    def go_down(self, time_s: float) -> None:
        """Refuse connections for a time [s]."""
        self._down_until_s = asyncio.get_running_loop().time() + time_s

    def refuses_connection(self) -> bool:
        """Whether a new connection is refused."""
        is_down = asyncio.get_running_loop().time() < self._down_until_s
        return is_down or FailureKind.REFUSE in self.acting(Channel.HTTP, FailureKind.REFUSE)

    def acting(self, channel: Channel, *kinds: FailureKind) -> Mapping[FailureKind, Fault]:
        """Return the faults of some kinds that act now, each of which has then acted once more."""
        acting = dict[FailureKind, Fault]()
        for number, fault in ((one.number, one.fault) for one in self.lasting):
            is_spent = fault.count is not None and self._used[number] >= fault.count
            if fault.on is channel and fault.kind in kinds and not is_spent:
                self._used[number] += 1
                acting[fault.kind] = fault
        return acting


REQUEST_KINDS = (FailureKind.DROP, FailureKind.DELAY, FailureKind.DUPLICATE)
"""Kinds that act on a request or an event; one that is refused never begins."""
