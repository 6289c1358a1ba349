"""Findings of a run about sensors that guide robots (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class NobodyGuides(Violation, code="R150"):
    device: str
