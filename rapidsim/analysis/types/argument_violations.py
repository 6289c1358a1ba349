r"""Rules T3 about arguments: number, order, and the data they refer to."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class BadArguments(Violation, code="T302"):
    problem: str
    fault: str
    """`too few`, `too many`, `swapped`, or the misplaced argument."""
    order: str = ""
    """The declared call."""

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the mistake."""
        return self.fault

    @property
    def help(self) -> str | None:
        """The order of the parameters."""
        return f"the order is {self.order}" if self.order else None


class BadArgumentMode(Violation, code="T303"):
    by: str
    wanted: str
    actual: str

    @property
    def case(self) -> str:
        """Case of the rule by the required kind of argument."""
        return self.wanted.removeprefix("a ").replace("or a ", "or ")

    @property
    def help(self) -> str | None:
        """Suggestion of a valid argument."""
        if self.wanted == "a persistent":
            return "declare it as PERS in a module"
        return "give a variable that holds the value" if self.wanted != "data" else None


class UnknownArgument(Violation, code="T312"):
    routine: str
    argument_kind: str
    argument: str
    nearest: str | None
    candidates: tuple[str, ...]

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the argument."""
        return self.argument_kind

    @property
    def help(self) -> str | None:
        """Suggestion of the nearest argument, or all of them."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return f"it has {', '.join(self.candidates)}" if self.candidates else None


class BadOption(Violation, code="T315"):
    problem: str
    fault: str
    """Case of the rule, in the terms of rule.toml."""
    suggestion: str = ""

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the mistake."""
        return self.fault


class PersistentElement(Violation, code="T323"):
    by: str
