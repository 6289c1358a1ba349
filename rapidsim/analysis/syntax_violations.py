"""Rules E1 that need the tree: what the parser reads and RAPID does not allow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class LateDataDeclaration(Violation):
    """Data of a routine are declared after a statement, or inside a block.

    All declarations of a routine come before its first statement. Their initial values are given
    at each call.

    ## Example

        MODULE example
          PROC main()
            TPErase;
            VAR num count:=3;
            Incr count;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num count:=3;
            TPErase;
            Incr count;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E104"
    name: ClassVar[str] = "late-data-declaration"
    template: ClassVar[str] = "`{data}` is declared {where}"
    cf: ClassVar[str] = "ABB 40135"

    data: str
    where: str

    @property
    def help(self) -> str:
        """Where declarations go."""
        return "move the declaration before the first statement of the routine"


@dataclass(frozen=True)
class EqualsForAssignment(Violation):
    """`=` compares; a value is given with `:=`.

    ## Example

        MODULE example
          PROC main()
            reg1=5;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            reg1:=5;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E140"
    name: ClassVar[str] = "equals-for-assignment"
    template: ClassVar[str] = "`=` compares and gives `{target}` no value"

    target: str

    @property
    def help(self) -> str:
        """What to write."""
        return "write `:=`"


@dataclass(frozen=True)
class CallInParentheses(Violation):
    """The arguments of a procedure stand in parentheses. Only functions are called with them.

    ## Example

        MODULE example
          PROC main()
            wait_for(1,2);
          ENDPROC
          PROC wait_for(num part,num seconds)
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            wait_for 1,2;
          ENDPROC
          PROC wait_for(num part,num seconds)
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E141"
    name: ClassVar[str] = "call-in-parentheses"
    template: ClassVar[str] = "the call of `{routine}` has its arguments in parentheses"

    routine: str

    @property
    def help(self) -> str:
        """What to write."""
        return f"write `{self.routine}` and the arguments without parentheses"


@dataclass(frozen=True)
class MissingWord(Violation):
    """A word of a block is missing: THEN of an ELSEIF, DO of a WHILE.

    ## Example

        MODULE example
          PROC main()
            WHILE reg1<5
              Incr reg1;
            ENDWHILE
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            WHILE reg1<5 DO
              Incr reg1;
            ENDWHILE
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E142"
    name: ClassVar[str] = "missing-word"
    template: ClassVar[str] = "{statement} without {word}"

    statement: str
    word: str

    @property
    def help(self) -> str:
        """What to write."""
        return f"write {self.word} behind the condition"


@dataclass(frozen=True)
class MissingParameterList(Violation):
    """PROC or FUNC has no parentheses. They stand even where there are no parameters.

    ## Example

        MODULE example
          PROC main
            TPErase;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPErase;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E143"
    name: ClassVar[str] = "missing-parameter-list"
    template: ClassVar[str] = "`{routine}` is declared without parentheses"

    routine: str

    @property
    def help(self) -> str:
        """What to write."""
        return f"write `{self.routine}()`"


@dataclass(frozen=True)
class CaseRange(Violation):
    """CASE has a range. RAPID lists the values of a case.

    ## Example

        MODULE example
          PROC main()
            TEST reg1
            CASE 1 TO 3:
              TPErase;
            ENDTEST
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TEST reg1
            CASE 1,2,3:
              TPErase;
            ENDTEST
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E144"
    name: ClassVar[str] = "case-range"
    template: ClassVar[str] = "CASE takes values, not a range"

    @property
    def help(self) -> str:
        """What to write."""
        return "list the values with commas, or use IF with >= and <="


@dataclass(frozen=True)
class LateBoundFunction(Violation):
    """A function is called by a name in a string. Only procedures are.

    ## Example

        MODULE example
          PROC main()
            reg1:=%"count"%();
          ENDPROC
          FUNC num count()
            RETURN 1;
          ENDFUNC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            %"count"%;
          ENDPROC
          PROC count()
            reg1:=1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E145"
    name: ClassVar[str] = "late-bound-function"
    template: ClassVar[str] = "a function cannot be called by a name in a string"

    @property
    def help(self) -> str:
        """What to write."""
        return "call a procedure that puts its result into data"


@dataclass(frozen=True)
class SignInside(Violation):
    """A sign or NOT stands where the strict syntax of RAPID has none, such as after `*`.

    Some controllers read it. Parentheses make it valid everywhere.

    ## Example

        MODULE example
          PROC main()
            reg1:=reg2*-2;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            reg1:=reg2*(-2);
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E146"
    name: ClassVar[str] = "sign-inside"
    template: ClassVar[str] = "{operator} stands after another operator without parentheses"
    severity: ClassVar[Severity] = Severity.NOTE

    operator: str

    @property
    def help(self) -> str:
        """What to write."""
        return f"put {self.operator} and what follows it in parentheses"


@dataclass(frozen=True)
class ArrayComponent(Violation):
    """A component of a record is declared as an array.

    ## Example

        MODULE example
          RECORD pallet
            num heights{4};
          ENDRECORD
        ENDMODULE

    ## Fix

        MODULE example
          RECORD pallet
            num height1;
            num height2;
            num height3;
            num height4;
          ENDRECORD
        ENDMODULE
    """

    code: ClassVar[str] = "E147"
    name: ClassVar[str] = "array-component"
    template: ClassVar[str] = "the component `{component}` cannot be an array"

    component: str

    @property
    def help(self) -> str:
        """What to declare instead."""
        return "declare one component for each element, or an array of records"


@dataclass(frozen=True)
class EmptyRecord(Violation):
    """A record is declared without a component, so it could hold nothing.

    ## Example

        MODULE example
          RECORD pallet
          ENDRECORD
        ENDMODULE

    ## Fix

        MODULE example
          RECORD pallet
            num rows;
          ENDRECORD
        ENDMODULE
    """

    code: ClassVar[str] = "E150"
    name: ClassVar[str] = "empty-record"
    template: ClassVar[str] = "the record `{record}` has no component"

    record: str


@dataclass(frozen=True)
class UnfinishedCode(Violation):
    """A placeholder of the program editor was left in the code. Executing it stops the program.

    ## Example

        MODULE example
          PROC main()
            <SMT>
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPErase;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E148"
    name: ClassVar[str] = "unfinished-code"
    template: ClassVar[str] = "{placeholder} is not filled in"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40196"

    placeholder: str


@dataclass(frozen=True)
class UnfinishedDeclaration(Violation):
    """A placeholder of the program editor stands in a declaration, which then declares nothing.

    ## Example

        MODULE example
          VAR num heights{<DIM>};
        ENDMODULE

    ## Fix

        MODULE example
          VAR num heights{4};
        ENDMODULE
    """

    code: ClassVar[str] = "E149"
    name: ClassVar[str] = "unfinished-declaration"
    template: ClassVar[str] = "{placeholder} is not filled in"
    cf: ClassVar[str] = "ABB 40059"

    placeholder: str
