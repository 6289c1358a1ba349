"""The signals of the cell, by name ignoring case: their values and write permissions."""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind
from rapidsim.language.error_numbers import (
    ERR_AO_LIM,
    ERR_GO_LIM,
    ERR_NORUNUNIT,
    ERR_SIG_NAME,
    rapid_error,
)

_ANALOG = (SignalKind.AI, SignalKind.AO)
_INPUTS = (SignalKind.DI, SignalKind.GI, SignalKind.AI)


class SignalTable:
    """The values of all signals; undeclared signals are created, at 0, when first used."""

    def __init__(self, declared: Iterable[SignalDeclaration]) -> None:
        """Start with the declared signals at their start values."""
        self._declared = {signal.name.lower(): signal for signal in declared}
        self._values = {name: signal.value for name, signal in self._declared.items()}
        self.lost: frozenset[str] = frozenset()
        """Folded names of the signals whose device has no contact."""

    def read(self, name: str) -> float:
        """The value of a signal."""
        return self._values.setdefault(name.lower(), 0.0)

    def write(self, name: str, value: float) -> bool:
        """Set a signal; returns whether that changed it."""
        changed = self.read(name) != value
        self._values[name.lower()] = value
        return changed

    def require_contact(self, name: str) -> None:
        """Refuse the use of a signal by a program if its device has no contact.

        Raises:
            RapidError: ERR_NORUNUNIT.
        """
        if self.lost and name.lower() in self.lost:
            raise rapid_error(ERR_NORUNUNIT, f"the I/O device of `{name}` has no contact")

    def is_missing(self, name: str) -> bool:
        """Whether signals are declared, and none of this name."""
        return bool(self._declared) and name.lower() not in self._declared

    def require_output(self, name: str, value: float) -> None:
        """Refuse a write that the I/O configuration forbids to a program.

        Raises:
            RapidError: ERR_SIG_NAME for an input, ERR_GO_LIM or ERR_AO_LIM outside the limits,
                ERR_NORUNUNIT if its device has no contact.
        """
        self.require_contact(name)
        signal = self._declared.get(name.lower())
        if signal is None:
            return
        if signal.kind in _INPUTS:
            raise rapid_error(
                ERR_SIG_NAME, f"`{signal.name}` is an input ({signal.kind}), and is written"
            )
        self.require_within(name, value)

    def require_within(self, name: str, value: float) -> None:
        """Refuse a value outside the limits of a signal.

        Raises:
            RapidError: ERR_GO_LIM or ERR_AO_LIM outside the limits, also for an input.
        """
        signal = self._declared.get(name.lower())
        if signal is None:
            return
        low, high = signal.lowest, signal.highest
        if (low is not None and value < low) or (high is not None and value > high):
            number = ERR_AO_LIM if signal.kind in _ANALOG else ERR_GO_LIM
            least = "" if low is None else f"{low:g}"
            most = "" if high is None else f"{high:.10g}"
            raise rapid_error(
                number, f"`{signal.name}` cannot be {value:.10g}: its limits are {least} .. {most}"
            )
