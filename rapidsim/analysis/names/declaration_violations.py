"""Rules T3 about declarations: invalid sizes, initial values, types and parameters."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class NotConstant(Violation, code="T311"):
    data: str
    wanted: str
    found: str


class BadArraySize(Violation, code="T317"):
    problem: str


class BadAlias(Violation, code="T319"):
    alias: str
    of: str
    kind: str


class BadParameterType(Violation, code="T320"):
    declared: str
    type: str
    why: str


class MissingInitialValue(Violation, code="T321"):
    constant: str


class CircularDefinition(Violation, code="T322"):
    defined: str
    circle: str
