"""Findings of a run about the execution level of a statement (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class MoveWithoutStorePath(Violation, code="R130"):
    instruction: str
