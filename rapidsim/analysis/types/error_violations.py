"""Rules F about error numbers in programs."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class RawErrorNumber(Violation, code="F414"):
    number: str
