"""Hints in the text: names of parameters, times of moves, corners that became stops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from lsprotocol import types as lsp

from rapidsim.analysis.context import Context
from rapidsim.analysis.parameters import Callee
from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.callees import callee_of
from rapidsim.library.traits import Trait
from rapidsim.lsp.run_results import NO_RESULTS, RunMove, RunResults
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree

_PLAIN = (
    tree.NumberLiteral,
    tree.StringLiteral,
    tree.BoolLiteral,
    tree.LiteralAggregate,
    tree.Aggregate,
    tree.Unary,
)
"""Arguments that do not say themselves what they are."""
_FEWEST = 2
"""Number of required parameters from which their names are shown."""


def inlay_hints(
    document: Document, range_: lsp.Range, results: RunResults = NO_RESULTS
) -> list[lsp.InlayHint]:
    """Return the hints in a range."""
    start, end = document.offset(range_.start), document.offset(range_.end)
    source = document.file.source
    hints = list(_parameter_names(document, source.address(start), source.address(end)))
    moves = [one for one in results.moves.get(document.path, ()) if start <= one.end <= end]
    hints += _times(document, moves)
    return hints


def _parameter_names(document: Document, start: int, end: int) -> Iterator[lsp.InlayHint]:
    facts = document.view.workspace.facts(document.path)
    for module in document.file.modules:
        context = facts.analysis.home_of.get(module)
        items = [one for one in module.items if one.start <= end and one.end >= start]
        for node in descendants(*items) if context is not None else ():
            if not isinstance(node, tree.Call | tree.FunctionCall):
                continue
            if node.end < start or node.start > end:
                continue
            symbol = facts.analysis.symbol_of.get(node)
            assert context is not None
            callee = _explained(symbol, context)
            if callee is not None:
                yield from _names_at(document, node, callee)


def _explained(symbol: object, context: Context) -> Callee | None:
    """Return the routine if the names of its parameters help; those of moves are well known."""
    if isinstance(symbol, LibrarySymbol) and Trait.MOVE in symbol.routine.traits:
        return None
    if not isinstance(symbol, LibrarySymbol | RoutineSymbol):
        return None
    return callee_of(symbol, context)


def _names_at(
    document: Document, call: tree.Call | tree.FunctionCall, callee: Callee
) -> Iterator[lsp.InlayHint]:
    required = [one for one in callee.parameters if not one.optional]
    if len(required) < _FEWEST:
        return
    given = [one for one in call.arguments if isinstance(one, tree.RequiredArgument)]
    for argument, formal in zip(given, required, strict=False):
        if argument.name is None and isinstance(argument.value, _PLAIN):
            yield lsp.InlayHint(
                position=document.node_range(argument).start,
                label=f"{formal.name}:",
                kind=lsp.InlayHintKind.Parameter,
                padding_right=True,
            )


def _times(document: Document, moves: Sequence[RunMove]) -> Iterator[lsp.InlayHint]:
    """Yield the time of each move in the last run, and what became of its zone."""
    ordered = sorted(moves, key=lambda one: (one.end, one.start_s))
    for end, group in groupby(ordered, lambda one: one.end):
        runs = list(group)
        longest = max(one.end_s - one.start_s for one in runs)
        often = f"{len(runs)} x, at most " if len(runs) > 1 else ""
        stopped = [one for one in runs if one.corner_reason and one.corner != "fly-by"]
        label = f"{often}{longest:.2f} s"
        if stopped:
            label += ", the corner is a stop"
        yield lsp.InlayHint(
            position=document.lines.position(_behind_semicolon(document.text, end)),
            label=label,
            tooltip=stopped[0].corner_reason if stopped else "In the last run",
            padding_left=True,
        )


def _behind_semicolon(text: str, end: int) -> int:
    return end + 1 if text[end : end + 1] == ";" else end
