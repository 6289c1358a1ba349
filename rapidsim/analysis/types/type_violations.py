"""Rules T3 about values: the type of an expression, and the type required.

Rules about arguments are in `argument_violations`, about declarations in `declaration_violations`.
"""

from __future__ import annotations

from rapidsim.diagnostics import Violation

_CONVERSIONS = {
    ("dnum", "num"): "convert it with NumToDnum(...)",
    ("num", "dnum"): "convert it with DnumToNum(...)",
    ("string", "num"): "convert it with NumToStr(...) or ValToStr(...)",
    ("string", "dnum"): "convert it with DnumToStr(...) or ValToStr(...)",
    ("string", "bool"): "convert it with ValToStr(...)",
    ("num", "string"): "convert it with StrToVal, which returns whether it succeeded",
    ("bool", "switch"): "check whether it is present with Present(...)",
    ("bool", "num"): "compare it, as in `x=1`",
    ("bool", "dnum"): "compare it, as in `x=1`",
    ("pos", "robtarget"): "take its position, `.trans`",
    ("orient", "robtarget"): "take its orientation, `.rot`",
    ("robtarget", "jointtarget"): "convert it with CalcRobT(...)",
    ("jointtarget", "robtarget"): "convert it with CalcJointT(...)",
}
"""Suggestion by the expected and the actual type."""


_OPERATORS = {
    **dict.fromkeys(("+", "-"), "+ and -"),
    "*": "*",
    **dict.fromkeys(("/", "DIV", "MOD"), "/, DIV and MOD"),
    **dict.fromkeys(("=", "<>"), "= and <>"),
    **dict.fromkeys(("<", ">", "<=", ">="), "< and >"),
    "NOT": "NOT",
    **dict.fromkeys(("AND", "OR", "XOR"), "AND, OR and XOR"),
}


class TypeMismatch(Violation, code="T301"):
    by: str
    wanted: str
    actual: str
    configured: str = ""
    """Name that only the configuration of the cell declares, with that type; empty without one."""

    @property
    def case(self) -> str:
        """Case of the rule: an aggregate, or any other value."""
        return "aggregate" if self.actual == "an aggregate" else "value"

    @property
    def help(self) -> str | None:
        """Suggestion of the conversion, if RAPID has one."""
        if self.configured:
            return f"the I/O configuration declares `{self.configured}` as {self.actual}"
        return _CONVERSIONS.get((self.wanted, self.actual))


class WriteToReadOnly(Violation, code="T304"):
    target: str
    kind: str

    @property
    def help(self) -> str | None:
        """Suggestion of a writable alternative."""
        if "counter" in self.kind:
            return "use a WHILE loop to step as you like"
        return "declare it as VAR or PERS" if "constant" in self.kind else None


class RecordShape(Violation, code="T305"):
    by: str
    wanted: int
    actual: int
    parts: str
    is_array: bool = False

    @property
    def case(self) -> str:
        """Case of the rule: an array, or a record with too few or too many components."""
        if self.is_array:
            return "array"
        return "too few" if self.actual < self.wanted else "too many"


class ArrayIndexOutOfBounds(Violation, code="T306"):
    index: str
    array: str
    size: int


class WrongOperands(Violation, code="T313"):
    operator: str
    operands: str
    suggestion: str = ""

    @property
    def case(self) -> str:
        """Case of the rule by the operator."""
        return _OPERATORS.get(self.operator.strip("`"), "sign")


class NotAnArray(Violation, code="T314"):
    array: str
    type: str
    wanted: str
    actual: int

    @property
    def case(self) -> str:
        """Case of the rule: no array, or a different number of indices."""
        return "no array" if self.wanted == "no indices" else "indices"


class UntypedAggregate(Violation, code="T316"):
    aggregate: str


class NoValue(Violation, code="T318"):
    type: str
    used: str

    @property
    def case(self) -> str:
        """Case of the rule by the use."""
        return self.used if self.used in ("assigned", "compared", "tested") else "other"


class NumberOutOfRange(Violation, code="T324"):
    number: str
    type: str
