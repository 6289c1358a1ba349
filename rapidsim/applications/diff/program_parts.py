"""Parts of a program for comparison: data, routines and types by name, without layout."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field

from rapidsim.analysis.literals import literal
from rapidsim.analysis.tree_walk import blocks, clauses
from rapidsim.applications.diff.changes import SourcePosition
from rapidsim.syntax import tree
from rapidsim.syntax.printer import print_data, print_expression, print_routine, print_statement
from rapidsim.values import value_class

_TOKEN = re.compile(
    r'"(?:[^"]|"")*"|[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[Ee][+-]?\d+)?|\s+|.', re.DOTALL
)


@value_class(frozen=True, slots=True)
class NormalisedLine:
    """A line of a routine, in normalised layout."""

    text: str
    folded: str
    """Text without details that RAPID ignores: case, blanks, notation of numbers."""
    node: tree.Node
    at: SourcePosition


@value_class(frozen=True, slots=True)
class Routine:
    """A routine."""

    name: str
    lines: tuple[NormalisedLine, ...]
    """Lines, beginning with the header."""
    at: SourcePosition


@value_class(frozen=True, slots=True)
class Declaration:
    """Data, a record or an alias outside routines."""

    name: str
    type: str
    storage: str
    text: str
    folded: str
    value: object
    """Numbers, strings, bools, tuples of them; None if the value is not a literal."""
    at: SourcePosition


@value_class(slots=True)
class ProgramParts:
    """Parts of a program by folded name, prefixed with the module if LOCAL."""

    data: dict[str, Declaration] = field(default_factory=dict)
    routines: dict[str, Routine] = field(default_factory=dict)
    types: dict[str, Declaration] = field(default_factory=dict)
    modules: dict[str, tuple[str, SourcePosition]] = field(default_factory=dict)
    """Name and attributes."""


def parts_of(modules: Sequence[tree.Module]) -> ProgramParts:
    """Return the parts of the modules of a task."""
    parts = ProgramParts()
    for module in modules:
        at = _at(module, module)
        attributes = ",".join(sorted(one.text.upper() for one in module.attributes))
        parts.modules[module.name.key] = (attributes, at)
        for item in module.items:
            match item:
                case tree.Data():
                    parts.data[_key(item.scope, module, item.name)] = _declaration(item, module)
                case tree.Proc() | tree.Func() | tree.Trap():
                    key = _key(item.scope, module, item.name)
                    lines = tuple(_lines(item, module))
                    parts.routines[key] = Routine(item.name.text, lines, _at(item, module))
                case tree.RecordType() | tree.AliasType():
                    text = module.span(item).text
                    parts.types[_key(item.scope, module, item.name)] = Declaration(
                        item.name.text, "", "", text, folded(_plain(text)), None, _at(item, module)
                    )
                case _:
                    pass
    return parts


def folded(text: str, renamed: Mapping[str, str] | None = None) -> str:
    """Return a text without details that RAPID ignores, and with current names.

    Args:
        text: RAPID source text.
        renamed: New folded names by old ones.
    """
    tokens = [token[0] for token in _TOKEN.finditer(text) if not token[0].isspace()]
    parts: list[str] = []
    for before, token in zip(("", *tokens), tokens, strict=False):
        if _is_word(before[-1:]) and _is_word(token[0]):
            parts.append(" ")
        parts.append(_folded_token(token, renamed or {}))
    return "".join(parts)


def _folded_token(token: str, renamed: Mapping[str, str]) -> str:
    if token[0].isalpha() or token[0] == "_":
        return renamed.get(token.lower(), token.lower())
    if token[0].isdigit() or (token[0] == "." and len(token) > 1):
        return repr(float(token))
    return token


def _is_word(character: str) -> bool:
    return character.isalnum() or character == "_"


def _plain(text: str) -> str:
    """Return a text without comments; the texts of its callers contain no strings."""
    return re.sub(r"![^\n]*", "", text)


def _key(scope: str | None, module: tree.Module, name: tree.Name) -> str:
    return f"{module.name.key}/{name.key}" if scope == "LOCAL" else name.key


def _at(node: tree.Node, module: tree.Module) -> SourcePosition:
    span = module.span(node)
    return SourcePosition(span.file, span.line)


def _declaration(item: tree.Data, module: tree.Module) -> Declaration:
    text = print_data(item)
    return Declaration(
        item.name.text,
        item.type.key,
        item.storage,
        text if item.value is None else print_expression(item.value),
        folded(text),
        literal(item.value, None),
        _at(item, module),
    )


def _lines(routine: tree.Routine, module: tree.Module) -> Iterator[NormalisedLine]:
    inner = [statement for body in clauses(routine) for statement in body]
    printed = print_routine(routine, module)
    for text, node in _with_nodes(printed, routine, inner, module):
        yield NormalisedLine(text.strip(), _indent(text) + folded(text), node, _at(node, module))


def _indent(text: str) -> str:
    return text[: len(text) - len(text.lstrip())]


def _with_nodes(
    lines: Sequence[str], of: tree.Node, inner: Sequence[tree.Statement], module: tree.Module
) -> Iterator[tuple[str, tree.Node]]:
    """Yield lines of a node with their nodes; statements inside the node are indented."""
    waiting = list(inner)
    at = 0
    while at < len(lines):
        own = print_statement(waiting[0], module) if waiting else []
        if own and list(lines[at : at + len(own)]) == [f"  {line}" for line in own]:
            statement = waiting.pop(0)
            nested = [part for block in blocks(statement) for part in block]
            for text, node in _with_nodes(own, statement, nested, module):
                yield f"  {text}", node
            at += len(own)
        else:
            yield lines[at], of
            at += 1
