"""Wording and positions for findings about moves: targets and data as the program names them."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Program, Storage
from rapidsim.controller.moves.target_labels import named_target
from rapidsim.diagnostics import Edit, Fix, Related, Span
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.dataflow.move_instructions import in_tree
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_rows import declaration_of

_TARGETS = ("topoint", "tojointpos")


def argument(program: Program, known_move: KnownMove, *keys: str) -> tree.Expression | None:
    """Return the argument of a move for the first of several folded parameter names that it has."""
    return _argument(program, known_move, known_move.statement, keys)


def _argument(
    program: Program, known_move: KnownMove, statement: tree.Call, keys: Sequence[str]
) -> tree.Expression | None:
    symbol = program.symbol_of[in_tree(known_move.call)]
    assert isinstance(symbol, LibrarySymbol)
    given = match_arguments(statement.arguments, symbol.routine.signature.parameters)
    found = next((given[key] for key in keys if key in given), BoundArgument())
    return None if found.value is None else bare(found.value)


def target_text(program: Program, known_move: KnownMove) -> str:
    """Return the target of a move as findings name it; else the name of the instruction."""
    written = argument(program, known_move, *_TARGETS)
    if written is None:
        return known_move.move.instruction
    return named_target(known_move.module.span(written).one_line)


def target_span(program: Program, known_move: KnownMove) -> Span:
    """Return the source span of the target in a move."""
    written = argument(program, known_move, *_TARGETS)
    return known_move.span if written is None else known_move.module.span(written)


def tool_span(program: Program, known_move: KnownMove) -> Span:
    """Return the source span of the tool in a move."""
    written = argument(program, known_move, "tool")
    return known_move.span if written is None else known_move.module.span(written)


def data_of(program: Program, known_move: KnownMove, *keys: str) -> DataSymbol | None:
    """Return the module data that an argument of a move refers to, if it is just a name."""
    # Only nodes in the tree have symbols.
    written = _argument(program, known_move, in_tree(known_move.call), keys)
    if not isinstance(written, tree.DataReference):
        return None
    symbol = program.symbol_of.get(written)
    return symbol if isinstance(symbol, DataSymbol) else None


def declared(symbol: DataSymbol | None, message: str) -> tuple[Related, ...]:
    """Return the declaration of data, as a location that explains a finding."""
    if symbol is None or symbol.node is None or symbol.module is None:
        return ()
    return (Related(symbol.module.span(symbol.node.name), message.format(name=symbol.name)),)


def confdata_fix(program: Program, known_move: KnownMove, wanted: str) -> Fix | None:
    """Return an edit that stores a configuration in a target's declaration; None if impossible.

    Declarations of variables are not edited: they may have another value when used.
    """
    written = argument(program, known_move, *_TARGETS)
    module = known_move.module
    name = "the target"
    if isinstance(known_move.call, tree.BulkRow) and isinstance(written, tree.DataReference):
        declared_name, literal = declaration_of(known_move.call, module.source.text)
        return _confdata_edit(module.span(literal), f"`{declared_name}`", wanted)
    if isinstance(written, tree.DataReference):
        symbol = data_of(program, known_move, *_TARGETS)
        if symbol is None or symbol.node is None or symbol.storage is Storage.VAR:
            return None
        if symbol.module is None or symbol.node.dimensions:
            return None
        written, module, name = symbol.node.value, symbol.module, f"`{symbol.name}`"
    if not isinstance(written, tree.LiteralAggregate | tree.Aggregate):
        return None
    return _confdata_edit(module.span(written), name, wanted)


def _confdata_edit(literal: Span, name: str, wanted: str) -> Fix | None:
    place = _third_part(literal)
    if place is None:
        return None
    return Fix(f"store {wanted} in {name}", (Edit(place, wanted),), safe=False)


def _third_part(span: Span) -> Span | None:
    """Third bracket inside the outermost one of a literal: the confdata of a robtarget."""
    depth = opened = begin = 0
    text, in_comment = span.text, False
    for at, character in enumerate(text):
        if in_comment or character == "!":
            in_comment = character not in "\r\n"
        elif character == "[":
            depth += 1
            opened += depth == 2
            begin = at if depth == 2 else begin
        elif character == "]":
            if depth == 2 and opened == 3:
                return Span(span.source, span.start + begin, span.start + at + 1)
            depth -= 1
    return None
