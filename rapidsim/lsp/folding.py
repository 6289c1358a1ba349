"""Foldable blocks, and selections that grow."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.locate import locate
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree


def folding_ranges(document: Document) -> list[lsp.FoldingRange]:
    """Return modules, routines, blocks, records, long data and comments of several lines."""
    found: list[lsp.FoldingRange] = []
    lines = document.lines
    for node in _blocks(document.file):
        start, end = document.offsets(node)
        first, last = lines.position(start).line, lines.position(end).line
        if last > first:
            found.append(lsp.FoldingRange(first, last, kind=lsp.FoldingRangeKind.Region))
    found += _comments(document)
    return found


def selection_range(document: Document, position: lsp.Position) -> lsp.SelectionRange:
    """Return the name or node at a position, with the nodes around it."""
    spans = [(0, len(document.text))]
    location = locate(document.file, document.address(position))
    if location is not None:
        spans += [document.offsets(node) for node in location.path]
        found = document.name_at(position)
        if found is not None:
            spans.append(document.offsets(found.name))
    selection: lsp.SelectionRange | None = None
    last: tuple[int, int] | None = None
    for start, end in spans:
        # A node of a repaired text may be outside of the one around it.
        if last is not None and not (last[0] <= start <= end <= last[1] and last != (start, end)):
            continue
        last = start, end
        selection = lsp.SelectionRange(document.range(start, end), selection)
    assert selection is not None
    return selection


def _blocks(file: tree.File) -> Iterator[tree.Node]:
    for module in file.modules:
        yield module
        for item in module.items:
            yield item
            if isinstance(item, tree.RoutineNode):
                if item.error is not None:
                    yield item.error
                yield from _in_routine(item)


def _in_routine(routine: tree.RoutineNode) -> Iterator[tree.Node]:
    for statement in statements(*clauses(routine)):
        match statement:
            case tree.If(branches=branches):
                yield statement
                yield from branches[1:]
            case tree.Test(cases=cases):
                yield statement
                yield from cases
            case tree.For() | tree.While() | tree.Data():
                yield statement
            case _:
                pass


def _comments(document: Document) -> Iterator[lsp.FoldingRange]:
    """Yield comments that follow each other, each on a line of its own."""
    lines, text = document.lines, document.text
    first: int | None = None
    last = -2
    for comment in document.file.comments:
        start = document.file.source.offset(comment.start)
        line = lines.position(start).line
        if text[lines.starts[line] : start].strip():
            continue
        if line != last + 1:
            if first is not None and last > first:
                yield lsp.FoldingRange(first, last, kind=lsp.FoldingRangeKind.Comment)
            first = line
        last = line
    if first is not None and last > first:
        yield lsp.FoldingRange(first, last, kind=lsp.FoldingRangeKind.Comment)
