"""Rule N219: what the station's RobotWare does not have yet."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Scope
from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language.robotware import RobotWare
from rapidsim.library.versions import SINCE
from rapidsim.syntax import tree


class NotInThisRobotWare(Violation, code="N219"):
    used: str
    since: str
    station: str


def find_newer(station: RobotWare) -> Find:
    """A detector of what came after the RobotWare of a station."""

    def find(facts: Facts) -> Iterator[Diagnostic]:
        for part in facts.parts:
            for node, name in _installed_names(part, facts):
                since = SINCE.get(name.lower())
                if since is not None and since > station:
                    yield part.finding(NotInThisRobotWare(name, str(since), str(station)), node)

    return find


def _installed_names(part: Part, facts: Facts) -> Iterator[tuple[tree.Node, str]]:
    r"""The installed routines, options and data that are named; options as `ReadStr\Status`."""
    for call in part.calls:
        symbol = facts.symbol(call)
        if isinstance(symbol, LibrarySymbol):
            yield call.name, symbol.name
            for argument in call.arguments:
                if not isinstance(argument, tree.Required):
                    yield argument, f"{symbol.name}\\{argument.name.text}"
    for reference in part.all(tree.Reference):
        data = facts.symbol(reference)
        if isinstance(data, DataSymbol) and data.scope is Scope.INSTALLED:
            yield reference, data.name
