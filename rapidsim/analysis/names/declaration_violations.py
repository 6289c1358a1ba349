"""Rules T3 about declarations: invalid sizes, initial values, types and parameters."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class NotConstant(Violation, code="T311"):
    data: str
    wanted: str
    actual: str


class BadArraySize(Violation, code="T317"):
    problem: str
    fault: str
    """`size`, `dimensions` or `not constant`."""

    @property
    def case(self) -> str:
        """Case of the rule by the mistake."""
        return self.fault


class BadAlias(Violation, code="T319"):
    alias: str
    of: str
    kind: str


class BadParameterType(Violation, code="T320"):
    declared: str
    type: str
    reason: str

    @property
    def case(self) -> str:
        """By the reason, and whether it is about a switch."""
        if self.type != "switch":
            return "no value"
        if "optional" in self.reason:
            return "required switch"
        return "mode of a switch"


class MissingInitialValue(Violation, code="T321"):
    constant: str


class CircularDefinition(Violation, code="T322"):
    defined: str
    circle: str
    kind: str = "value"
    """`value` of constants, `record` or `alias`."""

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the declaration."""
        return self.kind
