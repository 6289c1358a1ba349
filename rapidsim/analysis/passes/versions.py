"""Features newer than the cell's RobotWare: errors, because its controller rejects them."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.names.name_violations import NotInThisRobotWare
from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Scope
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.diagnostics import Diagnostic
from rapidsim.library.versions import SINCE
from rapidsim.syntax import tree


def find_newer(facts: Facts) -> Iterator[Diagnostic]:
    """Report uses of features newer than the cell's RobotWare; none if its version is unknown."""
    has = facts.analysis.cell.robotware
    if has is None:
        return
    for part in facts.parts:
        for node, name in _installed_names(part, facts):
            since = SINCE.get(name.lower())
            if since is not None and since > has:
                yield part.finding(NotInThisRobotWare(name, str(since), str(has)), node)


def _installed_names(part: ProgramPart, facts: Facts) -> Iterator[tuple[tree.Node, str]]:
    r"""Yield the installed routines, options and data in use; options as `ReadStr\Status`."""
    for call in part.calls:
        symbol = facts.symbol(call)
        if isinstance(symbol, LibrarySymbol):
            yield call.name, symbol.name
            for argument in call.arguments:
                if not isinstance(argument, tree.RequiredArgument):
                    yield argument, f"{symbol.name}\\{argument.name.text}"
    for reference in part.all(tree.DataReference):
        data = facts.symbol(reference)
        if isinstance(data, DataSymbol) and data.scope is Scope.INSTALLED:
            yield reference, data.name
