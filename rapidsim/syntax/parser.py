"""Text to tree: `parse` reads one file and never fails."""

from __future__ import annotations

from dataclasses import dataclass

from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.syntax import tree
from rapidsim.syntax.builder import Builder
from rapidsim.syntax.driver import build_tree
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.violations import SyntaxError_


@dataclass(frozen=True, slots=True)
class Parsed:
    """The tree of a file, as far as it could be read, and what is wrong with its text."""

    file: tree.File
    diagnostics: tuple[Diagnostic, ...]


def parse(source: Source) -> Parsed:
    """Parse a file."""
    tokens = lex(source.text)
    modules = build_tree(tokens, Builder(source))
    diagnostics: tuple[Diagnostic, ...] = ()
    if modules is None:
        modules = ()
        diagnostics = (Diagnostic(SyntaxError_("syntax error"), Span(source, 0, 0)),)
    return Parsed(tree.File(source, modules, tokens.comments), diagnostics)
