"""Rules I8 that need no run: names of signals."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class UnknownSignal(Violation, code="I801"):
    signal: str
    type: str
