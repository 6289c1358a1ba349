"""The book leaves no production of the grammar and no node of the tree out."""

import re
from dataclasses import fields
from pathlib import Path

import pytest
from rapid_promises import MODULES, sources
from test_rapid_book import PROGRAMS

from rapidsim.diagnostics import Source
from rapidsim.library.catalogue import ROUTINES
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.limits import bounded
from rapidsim.syntax.parser import parse
from rapidsim.syntax.repair import repaired
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import ACCEPT

WORD = re.compile(rb"[A-Za-z_]\w*")
ABSTRACT = {tree.Node, tree.RoutineNode}
OF_LONG_PROGRAMS = {tree.BulkStatements, tree.BulkRow, tree.RepeatedCall}
"""What a check makes of thousands of moves: tests/check/test_check_runs.py."""

BOOK = [source for program in PROGRAMS for source in sources(program)]


def reduced(kinds: list[str]) -> set[int] | None:
    """The rules that an LALR parse of these terminals reduces; None if it stops on an error."""
    table = rapid_table()
    states = [0]
    rules: set[int] = set()
    position = 0
    while True:
        action = table.actions[states[-1]].get(kinds[position])
        if action is None:
            return None
        if action == ACCEPT:
            return rules
        if action > 0:
            states.append(action - 1)
            position += 1
            continue
        number = -action - 1
        rule = table.rules[number]
        rules.add(number)
        if rule.length:
            del states[-rule.length :]
        states.append(table.gotos[states[-1]][rule.origin])


def rules_of(source: Source) -> set[int]:
    """The rules that reading a file uses; broken files are read after their repair."""
    tokens, _ = bounded(lex(source.text), source)
    rules = reduced(list(tokens.kinds))
    if rules is None:
        tokens, _ = repaired(tokens, source)
        rules = reduced(list(tokens.kinds))
    assert rules is not None
    return rules


def classes_in(part: object) -> set[type]:
    """The node classes below a part of a tree."""
    if isinstance(part, tuple):
        return {found for child in part for found in classes_in(child)}
    if not isinstance(part, tree.Node):
        return set()
    children = tuple(getattr(part, field.name) for field in fields(part))
    return {type(part)} | classes_in(children)


def test_every_production_is_used() -> None:
    used = {rule for source in BOOK for rule in rules_of(source)}
    table = rapid_table()
    unused = [
        f"{rule.origin} of {rule.length} -> {rule.build or 'passed on'} {rule.children}"
        for number, rule in enumerate(table.rules)
        if number not in used
    ]
    assert not unused


def test_every_node_class_is_made() -> None:
    nodes = {
        found
        for found in map(tree.__dict__.get, tree.__all__)
        if isinstance(found, type) and issubclass(found, tree.Node)
    }
    made = {found for source in BOOK for found in classes_in(parse(source).file.modules)}
    missing = nodes - ABSTRACT - OF_LONG_PROGRAMS - made
    assert not sorted(node.__name__ for node in missing)


@pytest.mark.parametrize("word", sorted(rapid_table().words))
def test_every_reserved_word_is_used(word: str) -> None:
    kind = rapid_table().words[word]
    assert any(kind in lex(source.text).kinds for source in BOOK)


def test_no_program_stands_twice() -> None:
    names = [program.stem for program in PROGRAMS if program.is_file()]
    chapters: dict[str, list[Path]] = {}
    for program in PROGRAMS:
        chapters.setdefault(program.parent.name, []).append(program)
    assert all(len(programs) >= 5 for programs in chapters.values())
    assert len({source.text for source in BOOK}) == len(BOOK)
    assert len(names) > 100


def test_every_simulated_routine_is_called_somewhere_in_the_tests() -> None:
    tests = Path(__file__).parents[1]
    programs = MODULES | {".py"}
    texts = [path.read_bytes() for path in tests.rglob("*") if path.suffix in programs]
    words = {word.lower() for text in texts for word in WORD.findall(text)}
    known = [routine.name for routine in ROUTINES.values() if routine.simulated]
    assert not [name for name in known if name.lower().encode() not in words]
