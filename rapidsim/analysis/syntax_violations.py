"""Rules E1 that need the tree: constructs that the parser accepts and RAPID does not."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class LateDataDeclaration(Violation, code="E104"):
    data: str
    location: str


class EqualsForAssignment(Violation, code="E140"):
    target: str


class CallInParentheses(Violation, code="E141"):
    routine: str


class MissingWord(Violation, code="E142"):
    statement: str
    word: str


class MissingParameterList(Violation, code="E143"):
    routine: str


class CaseRange(Violation, code="E144"):
    pass


class LateBoundFunction(Violation, code="E145"):
    pass


class SignInside(Violation, code="E146"):
    operator: str


class ArrayComponent(Violation, code="E147"):
    component: str


class EmptyRecord(Violation, code="E150"):
    record: str


class UnfinishedCode(Violation, code="E148"):
    placeholder: str


_UNFINISHED = {
    "<TDN>": "data type",
    "<PAR>": "parameter",
    "<ALT>": "parameter",
    "<DIM>": "dimension",
}


class UnfinishedDeclaration(Violation, code="E149"):
    placeholder: str

    @property
    def case(self) -> str:
        """By the placeholder."""
        return _UNFINISHED.get(self.placeholder, "value")
