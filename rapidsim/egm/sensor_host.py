"""Lookup of a sensor's host beside the cycles of the robot.

A name server may take seconds, again and again where the host does not run yet, as in a network of
containers. So a name is looked up by a thread until it is known; messages before that are lost, as
they are to a computer that is off.
"""

from __future__ import annotations

import socket
from contextlib import suppress
from dataclasses import dataclass, field
from threading import Event, Thread
from typing import Final

from rapidsim.egm.devices import Address

PATIENCE_S: Final = 0.05
"""Time [s] that the first lookup may take before the robot goes on without the address."""
_AGAIN_S: Final = 1.0
"""Time [s] from a failed lookup to the next one."""


@dataclass(slots=True, eq=False)
class SensorHost:
    """Address of a sensor with its numeric host, once that is known."""

    address: Address
    numeric: Address | None = None
    """None until the host has been found."""
    _was_tried: Event = field(default_factory=Event)
    _is_over: Event = field(default_factory=Event)

    def begin(self, patience_s: float | None) -> None:
        """Look the host up, in the background if that takes longer.

        Args:
            patience_s: Time [s] to wait for the first attempt; None for no limit.
        """
        with suppress(OSError):
            host = socket.inet_ntoa(socket.inet_aton(self.address.host))
            self.numeric = Address(host, self.address.port)
            return
        Thread(target=self._resolve, name="rapidsim host lookup", daemon=True).start()
        self._was_tried.wait(patience_s)

    def end(self) -> None:
        """Look for it no longer."""
        self._is_over.set()

    def _resolve(self) -> None:
        while self.numeric is None and not self._is_over.is_set():
            with suppress(OSError):
                host = socket.gethostbyname(self.address.host)
                self.numeric = Address(host, self.address.port)
            self._was_tried.set()
            if self.numeric is None:
                self._is_over.wait(_AGAIN_S)
