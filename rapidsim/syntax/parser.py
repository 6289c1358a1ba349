"""Text to tree: `parse` reads one file and never fails.

A file without syntax errors takes the short way: lex, build. Only if the builder stops are the
tokens repaired, and built again; that is why errors cost correct programs nothing.
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.syntax import tree
from rapidsim.syntax.builder import Builder
from rapidsim.syntax.collection import uncollected
from rapidsim.syntax.driver import build_tree
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.limits import bounded, token_limits
from rapidsim.syntax.repair import cut_calls_ended, repaired
from rapidsim.syntax.text_violations import NoModule, UnterminatedString
from rapidsim.syntax.violations import RepeatedClause
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class Parsed:
    """The tree of a file, as far as it could be read, and what is wrong with its text."""

    file: tree.File
    diagnostics: tuple[Diagnostic, ...]
    """In the order of their places."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.file!r}, {len(self.diagnostics)} findings>"


@uncollected()
def parse(source: Source) -> Parsed:
    """Read a file.

    Returns:
        All modules that the text holds, with `tree.Broken` for statements that could not be read,
        and every error of syntax and of size. Errors that need names or types are not looked for.
    """
    tokens, diagnostics = bounded(lex(source.text), source)
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
    """Without those on the same line as an unterminated string and behind its beginning.

    Where the string was meant to end is a guess, so what seems wrong there follows from the guess.
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
    return tuple(
        Diagnostic(UnterminatedString(), Span(source, start, ends.get(start, start + 1)))
        for start in tokens.unterminated
    )


def _inside(
    modules: tuple[tree.Module, ...], diagnostics: tuple[Diagnostic, ...]
) -> tuple[Diagnostic, ...]:
    """Those that stand in a module; what stands outside has been reported as a whole."""
    return tuple(
        diagnostic
        for diagnostic in diagnostics
        if diagnostic.span
        and any(module.start <= diagnostic.span.start < module.end for module in modules)
    )


def _placed(diagnostic: Diagnostic, modules: tuple[tree.Module, ...]) -> Diagnostic:
    """With the name of the routine it stands in."""
    if diagnostic.span is None:
        return diagnostic
    for module in modules:
        for routine in module.routines:
            if routine.start <= diagnostic.span.start <= routine.end:
                return replace(diagnostic, routine=routine.name.text)
    return diagnostic
