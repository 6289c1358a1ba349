"""The grammar has no conflict, its table is current, and small files are read without Lark."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import lark
import pytest
from lark.lexer import Lexer, LexerState, Token

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree
from rapidsim.syntax.build_table import GrammarConflictError, export, written
from rapidsim.syntax.builder import Builder
from rapidsim.syntax.driver import build_tree
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.parser import parse
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import END, GRAMMAR_FILE, TABLE_FILE
from rapidsim.syntax.terminals import TERMINALS

ROOT = Path(__file__).parents[2]
GRAMMARS = ROOT / "grammars"
PROGRAMS = sorted((Path(__file__).parent / "programs").iterdir())


def grammar() -> str:
    return (GRAMMARS / GRAMMAR_FILE).read_text(encoding="utf-8")


def test_the_stored_table_is_the_grammars() -> None:
    stored = (GRAMMARS / TABLE_FILE).read_text(encoding="utf-8")
    assert stored == written(export(grammar())), "run python -m rapidsim.syntax.build_table"


def test_a_conflict_is_refused() -> None:
    ambiguous = 'file: sum\nsum: sum "+" sum | NUMBER\nNUMBER: /[0-9]+/\n'
    with pytest.raises(GrammarConflictError, match=r"(?i)shift/reduce"):
        export(ambiguous)


def test_every_rule_and_kept_terminal_has_its_function() -> None:
    table = rapid_table()
    builder = Builder(Source("", ""))
    for rule in table.rules:
        if rule.build:
            assert hasattr(builder, rule.build) or hasattr(builder, f"{rule.build}_"), rule
    known = {*table.words.values(), *table.marks.values(), *table.patterns, "LITERALS", "BROKEN"}
    assert set(TERMINALS) <= known


@pytest.mark.process
def test_reading_a_file_does_not_import_lark() -> None:
    code = (
        "import sys\n"
        "from rapidsim.diagnostics import Source\n"
        "from rapidsim.syntax.parser import parse\n"
        "assert parse(Source('m', 'MODULE m\\nENDMODULE')).file.modules\n"
        "assert parse(Source('m', 'MODULE m\\nPORC p()\\nENDMODULE')).diagnostics\n"
        "assert 'lark' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_lark_alone_accepts_what_we_accept() -> None:
    """The grammar stands by itself: words in any case, options with the names of words.

    Where only a name can stand, Lark takes a reserved word for one.
    """
    parser = lark.Lark(grammar(), parser="lalr", start="file")
    files = sorted(ROOT.glob("programs/**/*.mod")) + sorted(ROOT.glob("tests/**/*.mod"))
    found = {path: _findings(path) for path in files}
    for path, codes in found.items():
        if codes & {"E121"}:
            continue
        text = path.read_bytes().decode("utf-8-sig", "replace")
        try:
            parser.parse(text)
        except lark.exceptions.UnexpectedInput:
            assert codes, path
        else:
            assert not codes, path
    assert sum(not codes for codes in found.values()) > 600


def _findings(path: Path) -> set[str]:
    """Codes of what our parser repairs in a file; empty if it reads the file as it stands."""
    text = path.read_bytes().decode("utf-8-sig", "replace")
    tokens = lex(text)
    if not tokens.unterminated and build_tree(tokens, Builder(Source("", text))) is not None:
        return set()
    return {one.code for one in parse(Source(str(path), text)).diagnostics}


class OurTokens(Lexer):
    """Our tokens, as Lark wants them."""

    __future_interface__ = True

    def __init__(self, lexer_conf: object) -> None:
        pass

    def lex(self, lexer_state: LexerState, parser_state: object):  # type: ignore[no-untyped-def]
        text = str(lexer_state.text.text)
        tokens = lex(text)
        for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
            if kind != END:
                yield Token(kind, text[start:end], start)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_larks_own_engine_reads_the_same_statements(program: Path) -> None:
    text = program.read_text()
    engine = lark.Lark(grammar(), parser="lalr", lexer=OurTokens, start="file")
    theirs = engine.parse(text)
    modules = parse(Source(program.name, text)).file.modules
    for node, rules in {
        "Module": ("module",),
        "Proc": ("proc",),
        "Data": ("data", "data_equals"),
        "Call": ("call", "call_in_parentheses"),
        "CompactIf": ("compact_if",),
        "Branch": ("branch", "branch_without_then", "branch_placeholder"),
        "OptionalArgument": ("optional",),
        "Binary": ("binary",),
        "DataReference": ("reference",),
        "ComponentAccess": ("component",),
    }.items():
        theirs_count = sum(len(list(theirs.find_data(rule))) for rule in rules)
        assert count_nodes(modules, node) == theirs_count, node


def count_nodes(part: object, name: str) -> int:
    """How many nodes of a class a tree has."""
    if isinstance(part, tuple):
        return sum(count_nodes(child, name) for child in part)
    if not isinstance(part, tree.Node):
        return 0
    children = [getattr(part, field.name) for field in fields(part)]
    return (type(part).__name__ == name) + sum(count_nodes(child, name) for child in children)
