"""Change the tokens of a file with syntax errors until they parse, with one report per change.

Skipping from an error to the next semicolon finds few errors and blames the wrong lines. Here every
error is corrected by the smallest change of the tokens that lets the parse continue, tried in the
order of `REPAIRS`; the parse then continues from the last statement before the change. The
resulting tokens match the grammar, so the tree builder need not handle errors.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import replace

from rapidsim.diagnostics import Diagnostic, Source
from rapidsim.syntax.block_repairs import stray_block_word, unclosed_block
from rapidsim.syntax.blocks import CLOSERS, nesting
from rapidsim.syntax.head_repairs import broken_head, panic, skip_text_between_modules
from rapidsim.syntax.lexer import Tokens
from rapidsim.syntax.parse_failure import Checkpoint, ParseFailure, Patch, TokenBuffer
from rapidsim.syntax.recognizer import START, advance, in_file, in_list
from rapidsim.syntax.token_repairs import (
    BLOCK_WORDS,
    compound_assignment,
    doubled_token,
    foreign_mark,
    half_readable_word,
    missing_semicolon,
    missing_token,
    misspelt_word,
    name_with_parentheses,
    reserved_name,
    semicolon_before,
    square_index,
    unknown_character,
    wrong_token,
)
from rapidsim.syntax.violations import BrokenSyntax

REPAIRS: tuple[Callable[[ParseFailure], Patch | None], ...] = (
    skip_text_between_modules,
    foreign_mark,
    compound_assignment,
    unknown_character,
    # Before the semicolon, or `EDNIF` would get one and become a call.
    misspelt_word,
    reserved_name,
    missing_semicolon,
    unclosed_block,
    stray_block_word,
    name_with_parentheses,
    square_index,
    doubled_token,
    missing_token,
    wrong_token,
    half_readable_word,
    broken_head,
    panic,
)
"""Repairs in the order in which they are tried."""
MOST_REPAIRS = 200

# After these a statement or declaration may begin in the middle of a line.
_BEFORE_STATEMENT = frozenset(
    {"SEMICOLON", "THEN", "ELSE", "DO", "COLON", "SMT", "BROKEN"} | BLOCK_WORDS
)


def repaired(tokens: Tokens, source: Source) -> tuple[Tokens, tuple[Diagnostic, ...]]:
    """Make tokens parse.

    Returns:
        Tokens that the grammar accepts, and one diagnostic for each change.
    """
    row = TokenBuffer.of(tokens, source)
    diagnostics: list[Diagnostic] = []
    checkpoints = [Checkpoint(0, START, 0)]
    stack = list(START)
    index = 0
    while index < len(row.kinds):
        kind = row.kinds[index]
        if _may_begin(row, index) and index > checkpoints[-1].index:
            if in_file(stack):
                checkpoints.append(Checkpoint(index, tuple(stack), index))
            elif in_list(stack):
                last = checkpoints[-1]
                around = nesting(row.kinds, last.index, index, last.nesting)
                checkpoints.append(Checkpoint(index, tuple(stack), last.module, around))
        if advance(stack, kind):
            index += 1
            continue
        situation = ParseFailure(row, index, tuple(stack), checkpoints)
        if len(diagnostics) == MOST_REPAIRS:
            patch = _give_up(situation)
        else:
            patch = next(p for p in (repair(situation) for repair in REPAIRS) if p is not None)
        diagnostics.append(patch.diagnostic)
        _apply(row, patch)
        while checkpoints[-1].index > patch.start:
            checkpoints.pop()
        index, stack = checkpoints[-1].index, list(checkpoints[-1].stack)
    changed = replace(tokens, kinds=row.kinds, starts=row.starts, ends=row.ends)
    return changed, tuple(diagnostics)


def cut_calls_ended(
    tokens: Tokens, source: Source, offsets: Sequence[int]
) -> tuple[Tokens, tuple[Diagnostic, ...]]:
    """Insert the missing semicolons before arguments that are statements.

    Args:
        tokens: Tokens that parse.
        source: Their text.
        offsets: Offsets of those arguments.
    """
    row = TokenBuffer.of(tokens, source)
    diagnostics = []
    for offset in sorted(offsets, reverse=True):
        index = bisect_left(row.starts, offset)
        while row.ends[index] == offset:
            index += 1  # an inserted token of an earlier repair, without width
        # The name of an interrupted call immediately precedes its first argument.
        patch = semicolon_before(row, index - 1, index)
        diagnostics.append(patch.diagnostic)
        _apply(row, patch)
    changed, found = repaired(
        replace(tokens, kinds=row.kinds, starts=row.starts, ends=row.ends), source
    )
    return changed, (*reversed(diagnostics), *found)


def _may_begin(row: TokenBuffer, index: int) -> bool:
    return (
        (index > 0 and row.kinds[index - 1] in _BEFORE_STATEMENT)
        or row.kinds[index] in BLOCK_WORDS
        or row.first_on_line(index)
    )


def _apply(row: TokenBuffer, patch: Patch) -> None:
    row.kinds[patch.start : patch.stop] = [kind for kind, _, _ in patch.tokens]
    row.starts[patch.start : patch.stop] = [start for _, start, _ in patch.tokens]
    row.ends[patch.start : patch.stop] = [end for _, _, end in patch.tokens]


def _give_up(at: ParseFailure) -> Patch:
    """Drop the rest, and close all open blocks."""
    row = at.row
    blocks = at.blocks(at.statement)
    place = row.place_before(at.statement)
    closers = tuple((CLOSERS[block.kind], place, place) for block in reversed(blocks))
    violation = BrokenSyntax("the rest of the file", f"it follows {MOST_REPAIRS} syntax errors")
    span = row.span(at.index, at.index + 1)
    return Patch(at.statement, len(row.kinds) - 1, closers, Diagnostic(violation, span))
