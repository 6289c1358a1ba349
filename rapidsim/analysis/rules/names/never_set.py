"""Rule F412: variables that are read and never given a value."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Storage
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of
from rapidsim.analysis.types.data_paths import root_of
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language import types
from rapidsim.language.annotations import Mode
from rapidsim.language.types import ArrayOf, Record, resolved
from rapidsim.syntax import tree

_PATHS = (tree.Reference, tree.Index, tree.Component)


class ReadBeforeSet(Violation, code="F412"):
    data: str


def find_never_set(facts: Facts) -> Iterator[Diagnostic]:
    """The first use of each variable of numbers, texts or records that nothing sets."""
    if not facts.is_read:
        return
    set_somewhere = _set(facts)
    reported: set[DataSymbol] = set()
    for part in facts.parts:
        for node in part.all(tree.Reference):
            symbol = facts.symbol(node)
            if not isinstance(symbol, DataSymbol) or symbol in reported or symbol in set_somewhere:
                continue
            declared = symbol.node
            if declared is None or declared.value is not None or not _has_value(symbol):
                continue
            if symbol.name.lower() in facts.strings or not _all_is_seen(symbol, facts):
                continue
            reported.add(symbol)
            place = facts.part_of.get(part.routine, part) if part.routine else part
            related = place.place(declared.name, "declared without a value here")
            same = symbol.module is None or symbol.module is part.module
            yield part.finding(ReadBeforeSet(symbol.name), node, *((related,) if same else ()))


def _has_value(symbol: DataSymbol) -> bool:
    """Whether data are a variable of a type whose value somebody must give."""
    if symbol.storage is not Storage.VAR:
        return False
    of = resolved(symbol.type)
    if isinstance(of, ArrayOf):
        of = resolved(of.element)
    return isinstance(of, Record) or of in (types.NUM, types.DNUM, types.STRING, types.BOOL)


def _all_is_seen(symbol: DataSymbol, facts: Facts) -> bool:
    """Whether all text that could set the data is here."""
    assert symbol.node is not None
    is_outside = symbol.module is not None and symbol.node in symbol.module.items
    return not is_outside or symbol.node.scope == "LOCAL" or facts.is_whole


def _set(facts: Facts) -> set[object]:
    """Symbols that are assigned, or passed to where they may be."""
    found: set[object] = set()
    for part in facts.parts:
        for assignment in part.all(tree.Assignment):
            if isinstance(assignment.target, _PATHS):
                found.add(facts.symbol(root_of(assignment.target)))
        for connect in part.all(tree.Connect):
            if isinstance(connect.interrupt, _PATHS):
                found.add(facts.symbol(root_of(connect.interrupt)))
        for call in part.calls:
            for formal, value in arguments_of(call, facts):
                if isinstance(value, _PATHS) and (formal is None or formal.mode is not Mode.IN):
                    found.add(facts.symbol(root_of(value)))
        for late in part.all(tree.LateCall):
            for argument in late.arguments:
                if isinstance(argument, tree.Required) and isinstance(argument.value, _PATHS):
                    found.add(facts.symbol(root_of(argument.value)))
    return found
