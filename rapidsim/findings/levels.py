"""What a run finds about the level on which a statement is executed (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class MoveWithoutStorePath(Violation, code="R130"):
    instruction: str
