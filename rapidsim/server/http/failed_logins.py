"""Wrong passwords: who has sent some waits before the next one is compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic
from typing import Final

FREE: Final = 5
"""Number of wrong passwords that cost no time: a client may have an old one, or a stale nonce."""
DELAY_S: Final = 0.4
"""Time [s] before a further one is compared: right ones wait, too, or who guesses would not."""
_FORGOTTEN_S: Final = 60.0
_MOST_ADDRESSES: Final = 1000


@dataclass(slots=True)
class FailedLogins:
    """Number of wrong passwords by address, until one has sent none for a minute."""

    now_s: Callable[[], float] = monotonic
    _failures: dict[str, tuple[int, float]] = field(default_factory=dict)

    def delay_s(self, address: str) -> float:
        """Return the time [s] before a password from an address may be compared."""
        count, last_s = self._failures.get(address, (0, 0.0))
        return DELAY_S if count >= FREE and self.now_s() - last_s < _FORGOTTEN_S else 0.0

    def add(self, address: str) -> None:
        """Count a wrong password."""
        now_s = self.now_s()
        count, last_s = self._failures.pop(address, (0, now_s))
        self._failures[address] = (count + 1 if now_s - last_s < _FORGOTTEN_S else 1), now_s
        if len(self._failures) > _MOST_ADDRESSES:
            del self._failures[next(iter(self._failures))]
