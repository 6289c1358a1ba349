"""Faults of the datagrams from and to a sensor; delays are in virtual time."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from rapidsim.controller.cell.faults import FailureKind, LastingFault

T = TypeVar("T")


@dataclass(slots=True, eq=False)
class DatagramFaults:
    """The lasting faults of all sensors of a controller, in the order in which they began."""

    lasting: tuple[LastingFault, ...] = ()
    _used: Counter[int] = field(default_factory=Counter)
    """Number of times that each fault has acted."""

    def begin(self, lasting: tuple[LastingFault, ...]) -> None:
        """Replace the faults."""
        known = {one.number for one in lasting}
        self._used = Counter({key: used for key, used in self._used.items() if key in known})
        self.lasting = lasting

    def acting(self) -> Iterator[LastingFault]:
        """Yield the faults that act on the next datagram."""
        for one in self.lasting:
            if one.fault.count is None or self._used[one.number] < one.fault.count:
                self._used[one.number] += 1
                yield one


@dataclass(slots=True, eq=False)
class DatagramLine(Generic[T]):
    """One direction between the controller and a sensor."""

    faults: DatagramFaults
    is_outgoing: bool
    _late: deque[tuple[float, T]] = field(default_factory=deque)
    """Delayed datagrams and the times [s] when they are due."""

    def passed(self, data: T | None, time_s: float) -> Iterator[T]:
        """Yield the datagrams that pass at a time [s], among them the new one if there is one."""
        if data is not None and self.faults.lasting:
            yield from self._new(data, time_s)
        elif data is not None:
            yield data
        while self._late and self._late[0][0] <= time_s:
            yield self._late.popleft()[1]

    def _new(self, data: T, time_s: float) -> Iterator[T]:
        kinds = {one.fault.kind: one.fault for one in self.faults.acting()}
        is_refused = FailureKind.REFUSE in kinds and not self.is_outgoing
        if FailureKind.DROP in kinds or is_refused:
            return
        copies = 2 if FailureKind.DUPLICATE in kinds else 1
        if (delay := kinds.get(FailureKind.DELAY)) is not None:
            self._late.extend([(time_s + delay.by_s, data)] * copies)
        else:
            yield from [data] * copies
