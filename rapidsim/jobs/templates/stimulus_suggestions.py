"""Suggested stimuli for inputs that programs wait for and nothing in a station sets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import does
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.controller.cell.description import CellIo, SignalKind
from rapidsim.jobs.checking.undriven_inputs import waited_for
from rapidsim.jobs.inputs.text_identifiers import words_of
from rapidsim.library.traits import Trait
from rapidsim.station.template import SuggestedStimulus
from rapidsim.syntax import tree

_INPUTS = (SignalKind.DI, SignalKind.GI, SignalKind.AI)


def suggested_stimuli(files: Sequence[tree.File], io: CellIo) -> tuple[SuggestedStimulus, ...]:
    """Return a stimulus for each value a program waits for, after the output it sets before."""
    undriven = _undriven(io)
    found: dict[tuple[str, float], SuggestedStimulus] = {}
    for statement, output in _with_outputs(files):
        wait = waited_for(statement)
        if wait is None or wait[0].key not in undriven:
            continue
        name, value = wait[0], float(wait[1].value)
        if undriven[name.key] != value or any(signal == name.key for signal, _ in found):
            found.setdefault((name.key, value), SuggestedStimulus(name.text, value, output))
    return tuple(found.values())


def other_undriven(
    texts: Iterable[str], io: CellIo, stimuli: Iterable[SuggestedStimulus]
) -> tuple[str, ...]:
    """Return inputs that programs use and nothing sets, except those with a suggestion."""
    words = frozenset[str]().union(*(words_of(text) for text in texts))
    told = {one.signal.lower() for one in stimuli}
    undriven = _undriven(io)
    return tuple(
        signal.name
        for signal in io.signals
        if signal.name.lower() in undriven
        and signal.name.lower() in words
        and signal.name.lower() not in told
    )


def _undriven(io: CellIo) -> dict[str, float]:
    """Return the start values of the inputs that nothing sets, by folded name."""
    driven = {name.lower() for name in io.written}
    inputs = (signal for signal in io.signals if signal.kind in _INPUTS and signal.status is None)
    return {one.name.lower(): one.value for one in inputs if one.name.lower() not in driven}


def _with_outputs(files: Iterable[tree.File]) -> Iterator[tuple[tree.Statement, str | None]]:
    """Yield all statements with the last output that was set before them in their routine."""
    for file in files:
        for module in file.modules:
            for routine in module.routines:
                output: str | None = None
                for statement in statements(*clauses(routine)):
                    yield statement, output
                    output = _set_output(statement) or output


def _set_output(statement: tree.Statement) -> str | None:
    """Return the output that a statement sets, as a condition: `doGrip = 1`; else None."""
    if not isinstance(statement, tree.Call):
        return None
    traits = does(installed_symbol(statement.name.key))
    required = [one.value for one in statement.arguments if isinstance(one, tree.RequiredArgument)]
    match required:
        case [tree.DataReference(name=name)] if traits & (Trait.SWITCH_ON | Trait.SWITCH_OFF):
            return f"{name.text} = {1 if Trait.SWITCH_ON in traits else 0}"
        case [tree.DataReference(name=name), tree.NumberLiteral(value=value)] if (
            Trait.OUTPUT in traits
        ):
            return f"{name.text} = {value:g}"
        case _:
            return None
