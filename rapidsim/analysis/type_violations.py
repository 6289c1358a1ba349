"""Rules T3 about values: what an expression is, and what its place takes.

Rules about arguments are in `argument_violations`, about declarations in `declaration_violations`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation

_CONVERSIONS = {
    ("dnum", "num"): "convert it with NumToDnum(...)",
    ("num", "dnum"): "convert it with DnumToNum(...)",
    ("string", "num"): "convert it with NumToStr(...) or ValToStr(...)",
    ("string", "dnum"): "convert it with DnumToStr(...) or ValToStr(...)",
    ("string", "bool"): "convert it with ValToStr(...)",
    ("num", "string"): "convert it with StrToVal, which says whether it succeeded",
    ("bool", "switch"): "ask whether it was given with Present(...)",
    ("bool", "num"): "compare it, as in `x=1`",
    ("bool", "dnum"): "compare it, as in `x=1`",
    ("pos", "robtarget"): "take its position, `.trans`",
    ("orient", "robtarget"): "take its orientation, `.rot`",
    ("robtarget", "jointtarget"): "convert it with CalcRobT(...)",
    ("jointtarget", "robtarget"): "convert it with CalcJointT(...)",
}
"""The cure, by the type that is wanted and the type that is there."""


@dataclass(frozen=True)
class TypeMismatch(Violation):
    """A value has another type than its place takes.

    RAPID converts nothing by itself, not even num to dnum; only a literal number fits both. Types
    are equal when their names are, once an ALIAS is replaced by what it stands for.

    ## Example

        MODULE example
          VAR bool ready;
          PROC main()
            ready:=1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR bool ready;
          PROC main()
            ready:=TRUE;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T301"
    name: ClassVar[str] = "type-mismatch"
    template: ClassVar[str] = "{by} takes {wanted}, not {found}"
    cf: ClassVar[str] = "ABB 40101"

    by: str
    wanted: str
    found: str

    @property
    def help(self) -> str | None:
        """The conversion, where RAPID has one."""
        return _CONVERSIONS.get((self.wanted, self.found))


@dataclass(frozen=True)
class WriteToReadOnly(Violation):
    """A value is given to something that keeps the one it has: a CONST or the counter of a FOR.

    ## Example

        MODULE example
          CONST num limit:=5;
          PROC main()
            limit:=6;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num limit:=5;
          PROC main()
            limit:=6;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T304"
    name: ClassVar[str] = "write-to-readonly"
    template: ClassVar[str] = "`{target}` cannot be changed, it is {kind}"
    cf: ClassVar[str] = "ABB 40093"

    target: str
    kind: str

    @property
    def help(self) -> str | None:
        """What could be changed instead."""
        if "counter" in self.kind:
            return "use a WHILE loop to step as you like"
        return "declare it as VAR or PERS" if "constant" in self.kind else None


@dataclass(frozen=True)
class RecordShape(Violation):
    """An aggregate has more or fewer values than its record or array.

    ## Example

        MODULE example
          CONST pos corner:=[100,200];
        ENDMODULE

    ## Fix

        MODULE example
          CONST pos corner:=[100,200,0];
        ENDMODULE
    """

    code: ClassVar[str] = "T305"
    name: ClassVar[str] = "record-shape"
    template: ClassVar[str] = "{by} takes {wanted} values ({parts}), {found} given"
    cf: ClassVar[str] = "ABB 40067"

    by: str
    wanted: int
    found: int
    parts: str


@dataclass(frozen=True)
class ArrayIndexOutOfBounds(Violation):
    """An index is a constant outside the array. The statement fails when it is executed.

    Indices count from 1.

    ## Example

        MODULE example
          VAR num heights{3};
          PROC main()
            heights{4}:=10;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num heights{3};
          PROC main()
            heights{3}:=10;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T306"
    name: ClassVar[str] = "array-index-out-of-bounds"
    template: ClassVar[str] = "index {index} is outside `{array}`, which has 1 to {size}"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40204"

    index: str
    array: str
    size: int


@dataclass(frozen=True)
class WrongOperands(Violation):
    """An operator stands between values it is not made for.

    `+` and `-` take num, dnum and pos (`+` string as well), `*` also scales a pos and multiplies
    two pos or two orient, `/`, DIV and MOD take numbers, `<` and its like numbers, `=` and `<>` two
    values of one type, AND, OR, XOR and NOT bool. Both operands have the same type, except in
    num times pos.

    ## Example

        MODULE example
          VAR num count:=3;
          PROC main()
            TPWrite "parts: "+count;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num count:=3;
          PROC main()
            TPWrite "parts: "+NumToStr(count,0);
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T313"
    name: ClassVar[str] = "wrong-operands"
    template: ClassVar[str] = "{operator} is not made for {operands}"
    cf: ClassVar[str] = "ABB 40050"

    operator: str
    operands: str
    cure: str = ""

    @property
    def help(self) -> str | None:
        """The usual way to write it."""
        return self.cure or None


@dataclass(frozen=True)
class NotAnArray(Violation):
    """Braces stand behind something that has no elements, or hold too many or too few indices.

    ## Example

        MODULE example
          VAR num grid{3,4};
          PROC main()
            grid{2}:=5;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num grid{3,4};
          PROC main()
            grid{2,1}:=5;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T314"
    name: ClassVar[str] = "not-an-array"
    template: ClassVar[str] = "`{array}` is {type}: it takes {wanted}, {found} given"
    cf: ClassVar[str] = "ABB 40036"

    array: str
    type: str
    wanted: str
    found: int


@dataclass(frozen=True)
class UntypedAggregate(Violation):
    """An aggregate stands where nothing says what record or array it is.

    `[1,2,3]` has no type of its own; it takes the type of the data or parameter it is given to.

    ## Example

        MODULE example
          PROC main()
            TPWrite ValToStr([1,2,3]);
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR pos corner;
            corner:=[1,2,3];
            TPWrite ValToStr(corner);
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T316"
    name: ClassVar[str] = "untyped-aggregate"
    template: ClassVar[str] = "nothing says what type `{aggregate}` has"
    cf: ClassVar[str] = "ABB 40108"

    aggregate: str

    @property
    def help(self) -> str:
        """How to give it a type."""
        return "give it to data of the type you mean, and use those data here"


@dataclass(frozen=True)
class NoValue(Violation):
    """Data of a type without values are used as a value.

    Clocks, devices, signals and their like are handles. They are passed to instructions; they
    cannot be assigned, compared, initialised, returned, or passed by value.

    ## Example

        MODULE example
          VAR clock first;
          VAR clock second;
          PROC main()
            second:=first;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR clock first;
          VAR num seconds;
          PROC main()
            seconds:=ClkRead(first);
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T318"
    name: ClassVar[str] = "no-value"
    template: ClassVar[str] = "{type} has no value that could be {used}"
    cf: ClassVar[str] = "ABB 40119"

    type: str
    used: str


@dataclass(frozen=True)
class NumberOutOfRange(Violation):
    """A literal is larger than its type can be.

    num is single precision and ends at 3.4E+38; dnum is double precision.

    ## Example

        MODULE example
          VAR num far:=1E39;
        ENDMODULE

    ## Fix

        MODULE example
          VAR dnum far:=1E39;
        ENDMODULE
    """

    code: ClassVar[str] = "T324"
    name: ClassVar[str] = "number-out-of-range"
    template: ClassVar[str] = "{number} is beyond the range of {type}"
    cf: ClassVar[str] = "ABB 40140"

    number: str
    type: str
