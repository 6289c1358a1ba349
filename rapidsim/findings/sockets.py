"""Findings of a run about sockets (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class NobodyAnswers(Violation, code="R112"):
    place: str


class NobodyConnects(Violation, code="R115"):
    port: int
