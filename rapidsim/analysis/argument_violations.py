r"""Rules T3 about arguments: how many, in which order, what they refer to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class BadArguments(Violation):
    r"""A call has too many or too few arguments, or has them in another order than declared.

    Arguments stand in the order of the parameters. Optional ones keep their place among the
    required ones: `\Conc` of MoveL comes first, `\WObj` comes last.

    ## Example

        MODULE example
          CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveL p1,v100,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveL p1,v100,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T302"
    name: ClassVar[str] = "bad-argument-count-or-order"
    template: ClassVar[str] = "{problem}"
    cf: ClassVar[str] = "ABB 40013"

    problem: str
    order: str = ""
    """The call as it is declared."""

    @property
    def help(self) -> str | None:
        """The order of the parameters."""
        return f"the order is {self.order}" if self.order else None


@dataclass(frozen=True)
class BadArgumentMode(Violation):
    """A parameter that the routine changes or refers to is given something it cannot change.

    VAR takes a variable, PERS a persistent, INOUT either of them. Tools, work objects and loads of
    moves are PERS parameters.

    ## Example

        MODULE example
          CONST num start:=3;
          PROC main()
            Incr start;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num start:=3;
          PROC main()
            Incr start;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T303"
    name: ClassVar[str] = "bad-argument-mode"
    template: ClassVar[str] = "{by} takes {wanted}, {found}"
    cf: ClassVar[str] = "ABB 40123"

    by: str
    wanted: str
    found: str

    @property
    def help(self) -> str | None:
        """What could be given instead."""
        if self.wanted == "a persistent":
            return "declare it as PERS in a module"
        return "give a variable that holds the value" if self.wanted != "data" else None


@dataclass(frozen=True)
class UnknownArgument(Violation):
    r"""An argument is named that the routine does not have.

    ## Example

        MODULE example
          CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveL p1,v100,fine,tool0\Wobject:=wobj0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p1:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveL p1,v100,fine,tool0\WObj:=wobj0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T312"
    name: ClassVar[str] = "unknown-argument"
    template: ClassVar[str] = "`{routine}` has no {argument_kind} `{argument}`"
    cf: ClassVar[str] = "ABB 40008"

    routine: str
    argument_kind: str
    argument: str
    nearest: str | None
    known: tuple[str, ...]

    @property
    def help(self) -> str | None:
        """The nearest argument, or all of them."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return f"it has {', '.join(self.known)}" if self.known else None


@dataclass(frozen=True)
class BadOption(Violation):
    r"""An optional argument is given twice, beside its alternative, or with a wrong value.

    A switch is given by its name alone; every other optional argument has a value, `\Name:=value`.
    Of alternatives, written `\On | \Off` in the manual, a call gives at most one. `\Name?option`
    passes on an optional parameter of the routine that it stands in.

    ## Example

        MODULE example
          PROC main()
            ConfL\On\Off;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            ConfL\Off;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T315"
    name: ClassVar[str] = "bad-option"
    template: ClassVar[str] = "{problem}"
    cf: ClassVar[str] = "ABB 40012"

    problem: str
    cure: str = ""

    @property
    def help(self) -> str | None:
        """How it is written."""
        return self.cure or None


@dataclass(frozen=True)
class PersistentElement(Violation):
    """Part of a persistent is passed to a routine that may change it.

    Older controllers take only whole persistents for PERS and INOUT parameters; whether yours takes
    elements and components, its program check tells.

    ## Example

        MODULE example
          PERS num counts{3}:=[0,0,0];
          PROC main()
            Incr counts{2};
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS num counts{3}:=[0,0,0];
          PROC main()
            counts{2}:=counts{2}+1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T323"
    name: ClassVar[str] = "persistent-element"
    template: ClassVar[str] = "{by} takes a whole persistent on older controllers, not a part of it"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40155"

    by: str
