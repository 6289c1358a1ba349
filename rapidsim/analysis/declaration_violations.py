"""Rules T3 about declarations: sizes, initial values, types and parameters that cannot be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Violation


@dataclass(frozen=True)
class NotConstant(Violation):
    """An initial value must be known before the program runs, and is not.

    Initial values of VAR and CONST are made of literals, constants and operators, those of PERS of
    literals alone. Functions and variables are for statements.

    ## Example

        MODULE example
          VAR num count:=3;
          VAR num twice:=count*2;
        ENDMODULE

    ## Fix

        MODULE example
          CONST num count:=3;
          VAR num twice:=count*2;
        ENDMODULE
    """

    code: ClassVar[str] = "T311"
    name: ClassVar[str] = "not-constant"
    template: ClassVar[str] = "the initial value of `{data}` must be {wanted}, {found}"
    cf: ClassVar[str] = "ABB 40020"

    data: str
    wanted: str
    found: str

    @property
    def help(self) -> str:
        """Where the value can be given instead."""
        return f"assign it to `{self.data}` in a routine"


@dataclass(frozen=True)
class BadArraySize(Violation):
    """The size of an array is no whole constant number above 0, or there are too many of them.

    Arrays have one to three dimensions.

    ## Example

        MODULE example
          VAR num heights{0};
        ENDMODULE

    ## Fix

        MODULE example
          VAR num heights{10};
        ENDMODULE
    """

    code: ClassVar[str] = "T317"
    name: ClassVar[str] = "bad-array-size"
    template: ClassVar[str] = "{problem}"
    cf: ClassVar[str] = "ABB 40015"

    problem: str


@dataclass(frozen=True)
class BadAlias(Violation):
    """ALIAS gives another name to an alias, or to itself.

    ## Example

        MODULE example
          ALIAS num level;
          ALIAS level height;
        ENDMODULE

    ## Fix

        MODULE example
          ALIAS num level;
          ALIAS num height;
        ENDMODULE
    """

    code: ClassVar[str] = "T319"
    name: ClassVar[str] = "bad-alias"
    template: ClassVar[str] = "`{alias}` names `{of}`, which is {kind}"
    cf: ClassVar[str] = "ABB 40114"

    alias: str
    of: str
    kind: str

    @property
    def help(self) -> str:
        """What an alias may name."""
        return "name the type behind it"


@dataclass(frozen=True)
class BadParameterType(Violation):
    r"""Data or a parameter has a type that its place cannot have.

    `switch` is the type of an optional parameter, passed by value, and of nothing else. `anytype`
    belongs to installed routines. Types without values, such as clock, are passed as VAR.

    ## Example

        MODULE example
          PROC pick(switch fast)
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC pick(\switch fast)
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T320"
    name: ClassVar[str] = "bad-parameter-type"
    template: ClassVar[str] = "`{declared}` cannot be {type}: {why}"
    cf: ClassVar[str] = "ABB 40098"

    declared: str
    type: str
    why: str


@dataclass(frozen=True)
class MissingInitialValue(Violation):
    """A constant has no value.

    ## Example

        MODULE example
          CONST num limit;
        ENDMODULE

    ## Fix

        MODULE example
          CONST num limit:=10;
        ENDMODULE
    """

    code: ClassVar[str] = "T321"
    name: ClassVar[str] = "missing-initial-value"
    template: ClassVar[str] = "the constant `{constant}` has no value"

    constant: str

    @property
    def help(self) -> str:
        """How to give it one."""
        return f"write `:=` and the value behind `{self.constant}`, or declare it as VAR"


@dataclass(frozen=True)
class CircularDefinition(Violation):
    """A constant or a record is made of itself.

    ## Example

        MODULE example
          CONST num first:=second+1;
          CONST num second:=first-1;
        ENDMODULE

    ## Fix

        MODULE example
          CONST num first:=2;
          CONST num second:=first-1;
        ENDMODULE
    """

    code: ClassVar[str] = "T322"
    name: ClassVar[str] = "circular-definition"
    template: ClassVar[str] = "`{defined}` is defined by itself: {circle}"
    cf: ClassVar[str] = "ABB 40104"

    defined: str
    circle: str
