"""Move instructions in a program's text, executed or not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Program, does
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.diagnostics import Span
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

NO_WOBJ = "wobj0"


class RunNotFollowedError(Exception):
    """The moves of bulk statements are unknown or not as written: examine them one by one."""


def written_moves(files: Sequence[tree.File]) -> Iterator[Span]:
    """Yield the source positions of all move instructions; files may have errors."""
    for module, call, run in _calls(files):
        yield module.span(call)
        if run is not None:
            yield from map(module.span, run.rows())


def written_move_count(files: Sequence[tree.File]) -> int:
    """Return the number of move instructions."""
    return sum(1 if run is None else 1 + len(run) for _, _, run in _calls(files))


def _calls(
    files: Sequence[tree.File],
) -> Iterator[tuple[tree.Module, tree.Call, tree.BulkStatements | None]]:
    """Yield the calls of move instructions in the tree, and the bulk statements like them."""
    modules = [module for file in files for module in file.modules]
    runs: dict[tree.Statement, tree.BulkStatements] = {
        run.like: run for module in modules for run in module.runs
    }
    hidden = {routine.name.key for module in modules for routine in module.routines}
    for module in modules:
        for routine in module.routines:
            for node in statements(*clauses(routine)):
                if not isinstance(node, tree.Call) or node.name.key in hidden:
                    continue
                if Trait.MOVE in does(installed_symbol(node.name.key)):
                    yield module, node, runs.get(node)


def targets_by_wobj(program: Program) -> dict[str, tuple[str, ...]]:
    """Declared names of the targets that installed instructions use, by folded work object."""
    found: dict[str, dict[str, None]] = {}
    for module in program.modules:
        for node in descendants(module):
            if isinstance(node, tree.Call) and _is_installed(program, node):
                found.setdefault(_wobj(node), {}).update(dict.fromkeys(_targets(program, node)))
    return {wobj: tuple(names) for wobj, names in found.items()}


def _is_installed(program: Program, call: tree.Call) -> bool:
    return isinstance(program.symbol_of.get(call), LibrarySymbol)


def _wobj(call: tree.Call) -> str:
    for argument in call.arguments:
        match argument:
            case tree.OptionalArgument(
                name=tree.Name(key="wobj"), value=tree.DataReference(name=wobj)
            ):
                return wobj.key
            case _:
                continue
    return NO_WOBJ


def _targets(program: Program, call: tree.Call) -> Iterator[str]:
    """Yield the targets in the arguments, also in calls of functions such as Offs."""
    values = (one.value for one in call.arguments if isinstance(one, tree.RequiredArgument))
    for part in descendants(*values):
        symbol = program.symbol_of.get(part) if isinstance(part, tree.DataReference) else None
        if isinstance(symbol, DataSymbol) and symbol.type.name == "robtarget":
            yield symbol.name
