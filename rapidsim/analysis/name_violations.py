"""Rules N2: names that nothing declares, that mean two things, or that mean the wrong thing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class UndefinedName(Violation):
    """A name is used that nothing in the task declares.

    Names compare without case. A name is found in the routine, then in its module, then in all
    modules of the task, then among what the controller predefines.

    ## Example

        MODULE example
          VAR num parts:=3;
          PROC main()
            prats:=parts+1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num parts:=3;
          PROC main()
            parts:=parts+1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N201"
    name: ClassVar[str] = "undefined-name"
    template: ClassVar[str] = "`{undefined}` is not declared"
    cf: ClassVar[str] = "ABB 40165"

    undefined: str
    nearest: str | None = None
    reserved: bool = False
    """Whether the nearest is a word of the language."""
    loads_modules: bool = False
    """Whether the task takes in other modules while it runs."""

    @property
    def help(self) -> str:
        """The nearest name, or where to declare one."""
        if self.nearest and self.reserved:
            return f"did you mean the word {self.nearest}?"
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        if self.loads_modules:
            return "read data of a module that is loaded while the program runs with GetDataVal"
        return "declare it, or check the module that declares it together with this one"


@dataclass(frozen=True)
class DuplicateName(Violation):
    """Two things of one scope have the same name.

    Data, routines, types, parameters and labels share their names, without regard to case. Names of
    all modules of a task share one scope unless they are LOCAL.

    ## Example

        MODULE example
          VAR num count;
          VAR bool COUNT;
        ENDMODULE

    ## Fix

        MODULE example
          VAR num count;
          VAR bool counting;
        ENDMODULE
    """

    code: ClassVar[str] = "N202"
    name: ClassVar[str] = "duplicate-name"
    template: ClassVar[str] = "`{duplicate}` is declared twice{where}"
    cf: ClassVar[str] = "ABB 40039"

    duplicate: str
    where: str = ""
    between_modules: bool = False

    @property
    def help(self) -> str:
        """What makes the names differ."""
        if self.between_modules and self.duplicate.lower() == "main":
            return (
                "what is named together is one task: name each program by itself, or give each a "
                "[[task]] in rapidsim.toml"
            )
        if self.between_modules:
            return "rename one of them, or make one LOCAL to its module"
        return "rename one of them; names that differ only in case are the same name"


SKIPS = "skips the call"
LOOKS_FOR_IT = "looks for it among the modules it has loaded by then"
"""What a run does with the call of a routine that no module declares."""


@dataclass(frozen=True)
class UnknownRoutine(Violation):
    """A routine is called that no module of the task declares and no controller installs.

    Programs call routines of neighbouring modules and of add-ins that are not at hand. A run skips
    such a call and says so; what the routine would have done is missing from the result. Only if a
    module that the program has loaded by then declares it, a run calls it.

    ## Example

        MODULE example
          PROC main()
            OpenVacuumGripper;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            OpenVacuumGripper;
          ENDPROC
          PROC OpenVacuumGripper()
            SetDO doVacuum,0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N209"
    name: ClassVar[str] = "unknown-routine"
    template: ClassVar[str] = "`{unknown}` is not declared; a run {instead}"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40166"

    unknown: str
    nearest: str | None = None
    instead: str = SKIPS
    """What a run does with the call."""

    @property
    def help(self) -> str:
        """Where the routine may be, or what it may be."""
        if self.instead != SKIPS:
            return (
                f'a module that is loaded by then may declare it; `%"{self.unknown}"%` says so, '
                "and is called where a controller refuses unresolved references"
            )
        or_slip = f", or did you mean `{self.nearest}`?" if self.nearest else ""
        return f"give the module that declares it as well{or_slip}"


@dataclass(frozen=True)
class UnknownType(Violation):
    """A data type is used that no module declares and no controller has without an option.

    Data of such a type are kept and copied as they are written; their components have no names.

    ## Example

        MODULE example
          TASK PERS gluegundata gun1:=[1,5,[0,0]];
        ENDMODULE

    ## Fix

        MODULE example
          RECORD gluegundata
            num number;
            num pressure;
            glueoffset offset;
          ENDRECORD
          RECORD glueoffset
            num on;
            num off;
          ENDRECORD
          TASK PERS gluegundata gun1:=[1,5,[0,0]];
        ENDMODULE
    """

    code: ClassVar[str] = "N210"
    name: ClassVar[str] = "unknown-type"
    template: ClassVar[str] = "the type `{unknown}` is not declared"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40092"

    unknown: str

    @property
    def help(self) -> str:
        """Where the type may be."""
        return "give the module that declares it as well, if it is not the type of an option"


@dataclass(frozen=True)
class WrongKind(Violation):
    """A name means something that cannot stand here: data that are called, a procedure as a value.

    A procedure is called by a statement and has no value. A function has a value, is called with
    parentheses, and cannot be a statement.

    ## Example

        MODULE example
          VAR num speed;
          PROC main()
            speed 100;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num speed;
          PROC main()
            speed:=100;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N211"
    name: ClassVar[str] = "wrong-kind"
    template: ClassVar[str] = "`{used}` is {kind}, not {wanted}"
    cf: ClassVar[str] = "ABB 40074"

    used: str
    kind: str
    wanted: str
    cure: str = ""

    @property
    def help(self) -> str | None:
        """How the thing is used, when that is what was meant."""
        return self.cure or None


@dataclass(frozen=True)
class ComponentOfUnknownType(Violation):
    """A component is named of data whose type no module declares.

    Whether the type has it cannot be told, and a program that uses it cannot run without the
    declaration.

    ## Example

        MODULE example
          TASK PERS gluegundata gun1:=[1,5,[0,0]];
          PROC main()
            gun1.pressure:=6;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          RECORD gluegundata
            num number;
            num pressure;
            glueoffset offset;
          ENDRECORD
          RECORD glueoffset
            num on;
            num off;
          ENDRECORD
          TASK PERS gluegundata gun1:=[1,5,[0,0]];
          PROC main()
            gun1.pressure:=6;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N215"
    name: ClassVar[str] = "component-of-unknown-type"
    template: ClassVar[str] = (
        "`{record}` is {type_name}, whose declaration is missing: `{component}` cannot be checked"
    )
    severity: ClassVar[Severity] = Severity.WARNING

    record: str
    type_name: str
    component: str

    @property
    def help(self) -> str:
        """What is missing."""
        return f"give the module that declares {self.type_name} as well; a run needs it"


@dataclass(frozen=True)
class UnknownComponent(Violation):
    """A component is named that the record does not have, or of data that are no record.

    ## Example

        MODULE example
          VAR robtarget home;
          PROC main()
            home.pos.z:=100;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR robtarget home;
          PROC main()
            home.trans.z:=100;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N212"
    name: ClassVar[str] = "unknown-component"
    template: ClassVar[str] = "{record} has no component `{component}`"
    cf: ClassVar[str] = "ABB 40089"

    record: str
    component: str
    known: tuple[str, ...]
    nearest: str | None = None

    @property
    def help(self) -> str | None:
        """The nearest component, or all of them."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return f"its components are {', '.join(self.known)}" if self.known else None


@dataclass(frozen=True)
class MisplacedScope(Violation):
    """LOCAL, TASK or PERS stands in a routine, where data live only as long as a call.

    ## Example

        MODULE example
          PROC main()
            PERS num parts:=0;
            parts:=parts+1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS num parts:=0;
          PROC main()
            parts:=parts+1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N213"
    name: ClassVar[str] = "misplaced-scope"
    template: ClassVar[str] = "{word} data such as `{data}` cannot be declared inside a routine"
    cf: ClassVar[str] = "ABB 40094"

    word: str
    data: str

    @property
    def help(self) -> str:
        """Where such data belong."""
        if self.word == "PERS":
            return "declare it in the module, outside the routine"
        return f"leave out {self.word}, or declare it in the module, outside the routine"


@dataclass(frozen=True)
class UnknownUnit(Violation):
    """A mechanical unit, task or camera is named that this program does not declare.

    A controller takes such names from its configuration. A run goes on without the unit.

    ## Example

        MODULE example
          PROC main()
            ActUnit Positioner;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            ActUnit ROB_1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N214"
    name: ClassVar[str] = "unknown-unit"
    template: ClassVar[str] = "`{unit}` is not declared; it is taken for a {type} of the controller"
    severity: ClassVar[Severity] = Severity.NOTE

    unit: str
    type: str
