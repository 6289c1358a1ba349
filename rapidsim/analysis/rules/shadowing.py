"""Rules N203 and N206: names that hide other names."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, LibrarySymbol
from rapidsim.analysis.rules.facts import Facts
from rapidsim.diagnostics import Diagnostic, Related, Severity, Violation
from rapidsim.syntax import tree

_OF_MOTION = frozenset({"speeddata", "zonedata", "tooldata", "wobjdata", "loaddata"})
"""Types whose predefined data a reader knows by name; `low` and `edge` may well name something."""


@dataclass(frozen=True)
class ShadowedName(Violation):
    """Data of a routine or LOCAL data hide data of the task with the same name.

    Whoever touches up the global target or changes the global value wonders why nothing happens.

    ## Example

        MODULE example
          PERS num height:=250;
          PROC main()
            VAR num height:=100;
            WaitTime height/1000;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS num height:=250;
          PROC main()
            VAR num low_height:=100;
            WaitTime low_height/1000;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N203"
    name: ClassVar[str] = "shadowed-name"
    template: ClassVar[str] = "`{hidden}` hides the {type} of the same name in {where}"
    severity: ClassVar[Severity] = Severity.WARNING

    hidden: str
    type: str
    where: str

    @property
    def help(self) -> str:
        """The cure."""
        return "give one of them another name"


@dataclass(frozen=True)
class RedefinedBuiltin(Violation):
    """A name of the controller's own is declared again: `v100`, `tool0`, `fine`, `Offs`.

    From then on it means something else than every reader expects, in part of the program only if
    it is LOCAL.

    ## Example

        MODULE example
          CONST speeddata v100:=[120,500,5000,1000];
          PROC main()
            WaitTime v100.v_tcp/1000;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST speeddata v120:=[120,500,5000,1000];
          PROC main()
            WaitTime v120.v_tcp/1000;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "N206"
    name: ClassVar[str] = "redefined-builtin"
    template: ClassVar[str] = "`{defined}` is {what} of the controller"
    severity: ClassVar[Severity] = Severity.WARNING

    defined: str
    what: str

    @property
    def help(self) -> str:
        """The cure."""
        return "choose a name that the controller does not have"


def find_shadowed(facts: Facts) -> Iterator[Diagnostic]:
    """Data declared inside that hide data declared outside."""
    outside: dict[str, list[tuple[tree.Module, tree.Data]]] = {}
    for part in facts.parts:
        if part.routine is None:
            for node in part.all(tree.Data):
                outside.setdefault(node.name.key, []).append((part.module, node))
    for part in facts.parts:
        for node in part.all(tree.Data):
            if part.routine is None and node.scope != "LOCAL":
                continue
            for module, hidden in outside.get(node.name.key, ()):
                here = module is part.module
                if hidden is node or (hidden.scope == "LOCAL" and not here):
                    continue
                if part.routine is None and here:
                    continue
                place = Related(module.span(hidden.name), "this one is hidden")
                where = "this module" if here else f"module {module.name.text}"
                violation = ShadowedName(node.name.text, hidden.type.text, where)
                yield part.finding(violation, node.name, place)
                break


def find_redefined(facts: Facts) -> Iterator[Diagnostic]:
    """Declarations of names that the controller predefines."""
    for part in facts.parts:
        declared: list[tree.Name] = [node.name for node in part.all(tree.Data)]
        if part.routine is not None:
            declared.append(part.routine.name)
        for name in declared:
            match installed_symbol(name.key):
                case DataSymbol(type=of) if part.routine is None or of.name in _OF_MOTION:
                    what = f"a {of.name}"
                case LibrarySymbol(routine=routine):
                    is_function = routine.signature.result is not None
                    what = "a function" if is_function else "an instruction"
                case _:
                    continue
            if not _is_their_home(part.module):
                yield part.finding(RedefinedBuiltin(name.text, what), name)


def _is_their_home(module: tree.Module) -> bool:
    """Whether a module is one that the controller itself ships predefined data in."""
    return module.name.key in ("base", "user")
