"""Conversion of text to a tree: `parse` reads one file and never fails.

A file without syntax errors is lexed and built directly. Only if the builder stops are the
tokens repaired and built again; hence error recovery costs correct programs nothing.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Source, Span
from rapidsim.syntax import tree
from rapidsim.syntax.builder import Builder
from rapidsim.syntax.driver import build_tree
from rapidsim.syntax.garbage_collection import gc_paused
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.limits import bounded, token_limits
from rapidsim.syntax.repair import cut_calls_ended, repaired
from rapidsim.syntax.text_violations import NoModule, UnterminatedString
from rapidsim.syntax.violations import RepeatedClause
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import BulkReading
    from rapidsim.syntax.bulk_statements import SkippedCalls, SkippedSpan


_SHORTEST_MOVE = 60
"""Minimum number of characters of a move with its target written out."""


@value_class(frozen=True, slots=True)
class Parsed:
    """Tree of a file, as far as it could be read, with the findings about its text."""

    file: tree.File
    diagnostics: tuple[Diagnostic, ...]
    """Findings in source order."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.file!r}, {len(self.diagnostics)} findings>"


@gc_paused()
def parse(source: Source, bulk: BulkReading | None = None) -> Parsed:
    """Read a file.

    Args:
        source: Its text.
        bulk: Which bulk statements are columns of their modules instead of nodes of the tree; None
            keeps all in the tree.

    Returns:
        All modules in the text, with `tree.InvalidStatement` for unreadable statements, and every
        error of syntax and of size. Errors that require names or types are not detected.
    """
    if bulk is not None and may_have_runs(source.text, bulk.more_than):
        parsed = _parsed_with_runs(source, bulk)
        if parsed is not None:
            return parsed
    return _parsed(source, ())


def may_have_runs(text: str, runs_of: int) -> bool:
    """Whether a text is long enough for more than a number of bulk moves."""
    return len(text) > runs_of * _SHORTEST_MOVE


def _parsed_with_runs(source: Source, bulk: BulkReading) -> Parsed | None:
    """Parse a file without its bulk statements; None if they are too few, or some do not fit."""
    # Most files have none, and the module imports numpy.
    from rapidsim.syntax.bulk_statements import skipped_spans  # noqa: PLC0415

    found = skipped_spans(source.text, bulk)
    if sum(len(one.numbers) for one in found if not one.names) <= bulk.more_than:
        return None
    parsed = _parsed(source, [(one.begin, one.end) for one in found])
    modules = tuple(_with_runs(module, found) for module in parsed.file.modules)
    homes = [module for module in modules if module.runs]
    # Names that one module declares may be invisible in another.
    if len(homes) > 1 and any(run.names for module in homes for run in module.runs):
        return None
    if sum(len(module.runs) for module in homes) < len(found):
        return None
    return replace(parsed, file=replace(parsed.file, modules=modules))


def _with_runs(module: tree.Module, spans: Sequence[SkippedSpan]) -> tree.Module:
    """Add its bulk statements to a module: declarations at module level, moves outside blocks."""
    lists: list[tuple[int, int, Sequence[tree.Item | tree.Statement]]] = [
        (module.start, module.end, module.items),
        *((one.start, one.end, one.body) for one in module.routines),
    ]
    runs: list[tree.BulkStatements] = []
    for start, end, nodes in lists:
        on_line = _FirstOnLine(module.source.text, nodes)
        first = bisect_left(spans, start, key=_place)
        for one in spans[first : bisect_left(spans, end, key=_place)]:
            run = _run(one, on_line)
            if run is not None:
                runs.append(run)
    return replace(module, runs=tuple(sorted(runs, key=lambda run: run.start)))


def _place(span: SkippedSpan) -> int:
    return span.like


class _FirstOnLine:
    """The nodes of a list that are the first on their lines, by the offsets of these."""

    def __init__(self, text: str, nodes: Sequence[tree.Item | tree.Statement]) -> None:
        """Take the nodes in order."""
        self._text, self._nodes = text, nodes
        self._starts = [node.start for node in nodes]

    def __getitem__(self, line: int) -> tree.Item | tree.Statement | None:
        """Return the node; None if there is none."""
        at = bisect_left(self._starts, line)
        if at == len(self._starts) or self._text[line : self._starts[at]].strip():
            return None
        return self._nodes[at]


def _run(span: SkippedSpan, on_line: _FirstOnLine) -> tree.BulkStatements | None:
    """Build bulk statements between two others; None if lines parsed differently."""
    match on_line[span.like], on_line[span.end]:
        case (tree.Data(value=tree.LiteralAggregate()) as like, tree.Data()):
            kind = bool(span.names)
        case (
            tree.Call(arguments=(tree.RequiredArgument(value=target, name=None), *_)) as like,
            tree.Call(),
        ):
            literal = tree.LiteralAggregate if span.declared is None else tree.DataReference
            kind = isinstance(target, literal) and not span.names
        case _:
            return None
    between = tuple(one for of in span.calls if (one := _repeated(of, on_line)) is not None)
    if not kind or like.end >= span.begin or len(between) < len(span.calls):
        return None
    return tree.BulkStatements(
        span.begin,
        span.end,
        like,
        span.starts + (like.start - span.like),
        span.ends - (span.begin - like.end),
        span.numbers,
        span.numbers_of_like,
        span.names,
        span.declared,
        between,
    )


def _repeated(of: SkippedCalls, on_line: _FirstOnLine) -> tree.RepeatedCall | None:
    """Build the repetitions of a call between bulk moves; None if lines parsed differently."""
    match on_line[of.like], on_line[of.move]:
        case (tree.Call() as call, tree.Call() as move):
            starts = of.starts + (call.start - of.like)
            end = int(starts[-1]) + call.end - call.start
            return tree.RepeatedCall(int(starts[0]), end, call, move, starts, of.rows)
        case _:
            return None


def _parsed(source: Source, left_out: Sequence[tuple[int, int]]) -> Parsed:
    return parse_tokens(lex(source.text, left_out), source)


@gc_paused()
def parse_tokens(tokens: Tokens, source: Source) -> Parsed:
    """Build the tree of the tokens of a source; see `parse`."""
    tokens, diagnostics = bounded(tokens, source)
    builder = Builder(source)
    modules = build_tree(tokens, builder)
    if modules is None:
        tokens, found = repaired(tokens, source)
        diagnostics += _not_behind_lost_quotes(found, tokens, source)
        builder, modules = _built(tokens, source)
    if builder.cut_calls:
        tokens, found = cut_calls_ended(tokens, source, builder.cut_calls)
        diagnostics += found
        builder, modules = _built(tokens, source)
    if not modules and not diagnostics:
        diagnostics += (Diagnostic(NoModule(), Span(source, 0, len(source.line(1)))),)
    diagnostics += _inside(modules, token_limits(tokens, source) + _unterminated(tokens, source))
    diagnostics += tuple(
        Diagnostic(RepeatedClause(keyword), Span(source, place.start, place.end))
        for keyword, place in builder.repeated_clauses
    )
    return Parsed(
        tree.File(source, modules, tokens.comments),
        tuple(sorted((_placed(d, modules) for d in diagnostics), key=lambda d: d.order)),
    )


def _built(tokens: Tokens, source: Source) -> tuple[Builder, tuple[tree.Module, ...]]:
    builder = Builder(source)
    modules = build_tree(tokens, builder)
    assert modules is not None, "repair leaves tokens that the grammar describes"
    return builder, modules


def _not_behind_lost_quotes(
    diagnostics: tuple[Diagnostic, ...], tokens: Tokens, source: Source
) -> tuple[Diagnostic, ...]:
    """Drop diagnostics behind the start of an unterminated string on the same line.

    The intended end of the string is a guess, so errors after it may only result from the guess.
    """
    lost = {source.position(start)[0]: start for start in reversed(tokens.unterminated)}
    return tuple(
        diagnostic
        for diagnostic in diagnostics
        if diagnostic.span is None
        or diagnostic.span.start < lost.get(diagnostic.span.line, len(source.text) + 1)
    )


def _unterminated(tokens: Tokens, source: Source) -> tuple[Diagnostic, ...]:
    if not tokens.unterminated:
        return ()
    ends = dict(zip(tokens.starts, tokens.ends, strict=True))
    spans = [Span(source, start, ends.get(start, start + 1)) for start in tokens.unterminated]
    return tuple(Diagnostic(UnterminatedString(), span, fix=_closed_string(span)) for span in spans)


def _closed_string(span: Span) -> Fix:
    """Close a string at its presumable end."""
    return Fix('Add `"`', (Edit(Span(span.source, span.end, span.end), '"'),), safe=False)


def _inside(
    modules: tuple[tree.Module, ...], diagnostics: tuple[Diagnostic, ...]
) -> tuple[Diagnostic, ...]:
    """Diagnostics inside modules; text outside has been reported as a whole."""
    return tuple(
        diagnostic
        for diagnostic in diagnostics
        if diagnostic.span
        and any(module.start <= diagnostic.span.start < module.end for module in modules)
    )


def _placed(diagnostic: Diagnostic, modules: tuple[tree.Module, ...]) -> Diagnostic:
    """Diagnostic with the name of the routine that contains it."""
    if diagnostic.span is None:
        return diagnostic
    for module in modules:
        for routine in module.routines:
            if routine.start <= diagnostic.span.start <= routine.end:
                return replace(diagnostic, routine=routine.name.text)
    return diagnostic
