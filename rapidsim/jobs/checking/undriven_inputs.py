"""Rule I803: waits for inputs that nothing in the station file ever sets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import does
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.controller.cell.description import CellIo, SignalKind
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.findings.runs import EndlessWait
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_INPUTS = (SignalKind.DI, SignalKind.GI, SignalKind.AI)


class NeverDrivenInput(Violation, code="I803"):
    signal: str
    value: str


def find_never_driven(files: Iterable[tree.File], io: CellIo) -> Iterator[Diagnostic]:
    """Yield waits for values of digital, group and analog inputs.

    Args:
        files: The program.
        io: Signals, connections and stimuli of the station.
    """
    begins_with = {
        signal.name.lower(): signal.value for signal in io.signals if signal.kind in _INPUTS
    }
    driven = {name.lower() for stimulus in io.stimuli for name in stimulus.values}
    driven |= {cross.result.lower() for cross in io.crosses}
    for file in files:
        for module in file.modules:
            for routine in module.routines:
                for call in statements(*clauses(routine)):
                    wait = waited_for(call)
                    if wait is None or wait[0].key not in begins_with or wait[0].key in driven:
                        continue
                    name, value = wait
                    if begins_with[name.key] != value.value:
                        violation = NeverDrivenInput(name.text, value.text)
                        span = module.span(name)
                        yield Diagnostic(violation, span, routine=routine.name.text)


def unreported_waits(
    undriven: Iterable[Diagnostic], reported: Iterable[Diagnostic]
) -> Iterator[Diagnostic]:
    """Yield the waits except those at which a run has ended: that finding is more precise."""
    ends = [one.span for one in reported if isinstance(one.violation, EndlessWait) and one.span]
    for one in undriven:
        span = one.span
        if span is None or not any(span.begins_in(end) for end in ends):
            yield one


def waited_for(statement: tree.Statement) -> tuple[tree.Name, tree.NumberLiteral] | None:
    """Return the signal and the value that a statement waits for; None if it does not wait."""
    if not isinstance(statement, tree.Call):
        return None
    required = [one.value for one in statement.arguments if isinstance(one, tree.RequiredArgument)]
    match required[:1] + required[-1:]:
        case [tree.DataReference(name=name), tree.NumberLiteral() as value]:
            waits = Trait.WAIT in does(installed_symbol(statement.name.key))
            return (name, value) if waits else None
        case _:
            return None
