"""Rules F4: the order in which statements are executed."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class UnreachableCode(Violation, code="F401"):
    pass


class MissingReturn(Violation, code="F404"):
    function: str
    type: str
    is_clause: bool = False
    """Whether control reaches the end of the function's ERROR clause instead."""

    @property
    def message(self) -> str:
        """Message about the function, or about its clause."""
        if self.is_clause:
            return f"the ERROR clause of `{self.function}` ends without RETURN"
        return super().message


class GotoTarget(Violation, code="F405"):
    problem: str
    nearest: str | None = None
    is_unknown: bool = True
    """Whether the routine has no such label; otherwise the label is inside another block."""

    @property
    def case(self) -> str:
        """Case of the rule: no label, or a label inside another block."""
        return "unknown" if self.is_unknown else "inside a block"

    @property
    def help(self) -> str | None:
        """Suggestion of the nearest label."""
        return f"did you mean `{self.nearest}`?" if self.nearest else None


class RaiseRetryPlacement(Violation, code="F406"):
    statement: str

    @property
    def case(self) -> str:
        """Case of the rule by the statement."""
        return self.statement.partition(" ")[0]

    @property
    def help(self) -> str | None:
        """Suggestion of an allowed statement."""
        if self.statement == "RAISE without a number":
            return "give RAISE an error number to raise an error of your own"
        return None


class ContinueOutsideLoop(Violation, code="F419"):
    statement: str


class ReturnValue(Violation, code="F415"):
    problem: str
    suggestion: str
    gives_value: bool

    @property
    def case(self) -> str:
        """Case of the rule: an unexpected value, or a missing one."""
        return "value" if self.gives_value else "no value"


class BadConnect(Violation, code="F416"):
    wanted: str
    argument: str
    kind: str

    @property
    def case(self) -> str:
        """Case of the rule: the interrupt variable, or the trap."""
        return "trap" if "TRAP" in self.wanted else "variable"
