"""Repairs of block structure: blocks that are not closed, or closed without having been opened.

A parser detects a missing ENDIF only at the end of the routine. The columns of the lines show which
block it belongs to, as they do to a reader.
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import LINE_END, Diagnostic, Edit, Fix, Related, Span
from rapidsim.syntax.blocks import (
    CLOSERS,
    DIVIDERS,
    ITEMS,
    OPENERS,
    ROUTINES,
    OpenBlock,
    closed_blocks,
)
from rapidsim.syntax.parse_failure import (
    ParseFailure,
    Patch,
    Token,
    TokenBuffer,
    deletion,
    insertion,
)
from rapidsim.syntax.recognizer import accepts, in_list
from rapidsim.syntax.spelling import distance, near_words
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import END
from rapidsim.syntax.token_repairs import respelling, written_fix
from rapidsim.syntax.violations import MissingSymbol, StrayBlockWord, UnclosedBlock

_MOST_SLIPS = 2
_MOST_APART = 8
"""Maximum number of open blocks at one place examined individually; more get one report."""
_FARTHEST = 2000
"""Number of tokens before a word in which the line that should open its block is searched, and of
tokens parsed in the search. Some routines have a hundred thousand.
"""


def unclosed_block(at: ParseFailure) -> Patch | None:
    """Close the block that should have been closed before this word."""
    row = at.row
    index = at.index
    if row.kinds[index] in ITEMS and index and row.kinds[index - 1] == "LOCAL":
        index -= 1  # LOCAL alone could still have begun a declaration
    blocks = at.blocks(index)
    wanted = _wanted(row.kinds[at.index])
    if wanted is None or not blocks:
        return None
    if at.kind in {END, "MODULE"}:
        return _cut_short(at, blocks)
    inner: list[OpenBlock] = []
    for block in reversed(blocks):
        if block.kind in wanted and not (block is blocks[-1] and _is_divided(row, block, at.kind)):
            break
        inner.append(block)
    else:
        return None  # this word matches no open block
    if not inner:
        return None
    if len(inner) > _MOST_APART:
        return _closing_all(row, inner[::-1], index)
    return (
        _misspelt_closer(at, inner[0], index)
        or _by_indentation(row, blocks, index, inner)
        or _closing(row, inner[0], _dedent(row, inner[0], index), index)
    )


def stray_block_word(at: ParseFailure) -> Patch | None:
    """Insert the opening word of the block that this word closes or divides, or drop this word."""
    row, kind = at.row, at.kind
    wanted = _wanted(kind)
    if wanted is None or kind == END or not in_list(at.stack):
        return None
    opener = _misspelt_opener(at, wanted) or _missing_then(at, wanted)
    if opener is not None:
        return opener
    if kind in ITEMS or kind == "MODULE":
        return None
    # A dividing word has a condition or a colon, which must be removed with it.
    brings_more = kind in {"ELSEIF", "CASE", "DEFAULT"}
    stop = row.line_stop(at.index) if brings_more else at.index + 1
    if row.kinds[stop] == "SEMICOLON":
        stop += 1
    names = " or ".join(sorted(wanted))
    return deletion(row, at.index, stop, StrayBlockWord(kind, names))


def _cut_short(at: ParseFailure, blocks: Sequence[OpenBlock]) -> Patch:
    """Close all blocks that are open at the end of the text or module, with a single report."""
    row = at.row
    start = at.index
    tokens: list[Token] = []
    if not in_list(at.stack) and in_list(at.statement_stack):
        start = at.statement
        begin, end = row.starts[start], row.place_before(at.index)
        if accepts(at.statement_stack, ["BROKEN"]):
            tokens.append(("BROKEN", begin, end))
    closing = _closing_all(row, blocks, at.index)
    return Patch(start, at.index, (*tokens, *closing.tokens), closing.diagnostic)


def _closing_all(row: TokenBuffer, blocks: Sequence[OpenBlock], index: int) -> Patch:
    """Close some blocks, outermost first, before a token, with a single report."""
    place = row.place_before(index)
    tokens = tuple((CLOSERS[block.kind], place, place) for block in reversed(blocks))
    outermost = blocks[0]
    related = tuple(
        Related(row.span(block.index, block.index + 1), f"this {block.kind} is open")
        for block in blocks
    )
    line = row.span(outermost.index, outermost.index + 1).line
    violation = UnclosedBlock(outermost.kind, CLOSERS[outermost.kind], line)
    diagnostic = Diagnostic(violation, Span(row.source, place, place), related)
    patch = Patch(index, index, tokens, diagnostic)
    return patch.with_fix(_closing_lines(row, blocks, index))


def _wanted(kind: str) -> frozenset[str] | None:
    """The kinds of block that must be innermost before a word is valid; None for other words."""
    if kind in OPENERS:
        return frozenset({OPENERS[kind]})
    if kind in DIVIDERS:
        return DIVIDERS[kind]
    if kind in ITEMS:
        return frozenset({"MODULE"})
    if kind in {"MODULE", END}:
        return frozenset()
    return None


def _is_divided(row: TokenBuffer, block: OpenBlock, kind: str) -> bool:
    """Whether a block has had its ELSE or DEFAULT, after which it cannot be divided again."""
    final = {"ELSE", "DEFAULT"}
    return kind in {*final, "ELSEIF", "CASE"} and any(row.kinds[i] in final for i in block.dividers)


def _misspelt_closer(at: ParseFailure, block: OpenBlock, stop: int) -> Patch | None:
    """Correct a line that consists of a name similar to the missing word."""
    row = at.row
    word = CLOSERS[block.kind]
    for index in range(block.index + 1, stop):
        if (
            row.kinds[index] == "NAME"
            and row.first_on_line(index)
            and (row.first_on_line(index + 1) or row.kinds[index + 1] in {"SEMICOLON", END})
            and _is_meant(row.text(index).upper(), word)
        ):
            return respelling(row, index, index + 1, word)
    return None


def _is_meant(text: str, word: str) -> bool:
    """Whether a text is the END of other languages, or a misspelt word."""
    return text == "END" or distance(text, word) <= _MOST_SLIPS


def _by_indentation(
    row: TokenBuffer, blocks: tuple[OpenBlock, ...], stop: int, inner: list[OpenBlock]
) -> Patch | None:
    """Close a block one of whose words is in the column of an enclosing block.

    Args:
        row: The tokens.
        blocks: The blocks that are open before `stop`, outermost first.
        stop: The word before which they should have been closed.
        inner: The blocks that should have been closed: the last of `blocks`, innermost first.
    """
    outer = len(blocks) - len(inner)
    candidates = [
        *(
            (c.block, (*c.block.dividers, c.closer), c.around)
            for c in closed_blocks(row.kinds, inner[-1].index, stop, blocks[:outer])
        ),
        *((blocks[k], blocks[k].dividers, blocks[:k]) for k in range(outer, len(blocks))),
    ]
    for block, words, around in candidates:
        own = row.indent(block.index)
        columns = {row.indent(o.index) for o in around if o.kind == block.kind}
        for word in words:
            column = row.column(word)
            if row.first_on_line(word) and column < own and column in columns:
                return _closing(row, block, word, word)
    return None


def _dedent(row: TokenBuffer, block: OpenBlock, stop: int) -> int:
    """Index of the likely closing word: the first line that is not indented deeper."""
    column = row.indent(block.index)
    own = set(block.dividers)
    inside = {
        closed.block.index: closed.closer
        for closed in closed_blocks(row.kinds, block.index + 1, stop)
    }
    indented = False
    index = row.line_stop(block.index)
    while index < stop:
        if row.first_on_line(index) and index not in own:
            if row.column(index) > column:
                indented = True
            elif indented or row.column(index) < column:
                return index
            else:
                return stop  # the body is not indented, so columns give no information
        index = inside.get(index, index) + 1
    return stop


def _closing(row: TokenBuffer, block: OpenBlock, index: int, latest: int) -> Patch:
    """Close a block before a token; if the result does not parse there, at the latest place."""
    if index != latest and row.kinds[index - 1] not in {"SEMICOLON", *OPENERS, "THEN", "DO"}:
        index = latest
    word = CLOSERS[block.kind]
    place = row.place_before(index)
    opener = row.span(block.index, block.index + 1)
    violation = UnclosedBlock(block.kind, word, opener.line)
    related = (Related(opener, f"this {block.kind} is open"),)
    span = Span(row.source, place, place)
    patch = Patch(index, index, ((word, place, place),), Diagnostic(violation, span, related))
    return patch.with_fix(_closing_lines(row, [block], index))


def _closing_lines(row: TokenBuffer, blocks: Sequence[OpenBlock], index: int) -> Fix | None:
    """Write the closing words of blocks, outermost first, on lines of their own before a token.

    Each is as far in as the word that opens its block. None if the token is within a line.
    """
    if not row.first_on_line(index) and row.kinds[index] != END:
        return None
    source, text = row.source, row.source.written.text
    end = LINE_END.search(text, source.offset(row.place_before(index)))
    at = source.address(len(text) if end is None else end.start())
    ending = "\n" if end is None else end[0]
    lines = [
        f"{ending}{' ' * (row.indent(block.index) - 1)}{CLOSERS[block.kind]}"
        for block in reversed(blocks)
    ]
    words = ", ".join(CLOSERS[block.kind] for block in reversed(blocks))
    return Fix(f"Add {words}", (Edit(Span(row.source, at, at), "".join(lines)),), safe=False)


def _misspelt_opener(at: ParseFailure, wanted: frozenset[str]) -> Patch | None:
    """Correct a line above that would open the block if one of its words were spelt right."""
    row, words = at.row, rapid_table().words
    meant = {*wanted, "THEN"} if "IF" in wanted else wanted
    routine = max((b.index for b in at.blocks(at.index) if b.kind in ROUTINES), default=at.module)
    trials = 0
    for index in range(at.index - 1, max(routine, at.index - _FARTHEST), -1):
        if row.kinds[index] != "NAME":
            continue
        for _, word in near_words(row.text(index)):
            if word in meant and trials < _FARTHEST:
                accepted = at.rejected_with(index, index + 1, words[word])
                if accepted is None:
                    return respelling(row, index, index + 1, word)
                trials += accepted
    return None


def _missing_then(at: ParseFailure, wanted: frozenset[str]) -> Patch | None:
    """Add THEN to an IF whose statements begin on the next line, as if it were a short one."""
    row = at.row
    if "IF" not in wanted:
        return None
    trials = 0
    for index in range(at.index - 1, max(at.module, at.index - _FARTHEST), -1):
        if row.kinds[index] in ROUTINES or trials > _FARTHEST:
            return None
        if row.kinds[index] != "IF":
            continue
        stop = row.line_stop(index)
        if row.kinds[stop - 1] == "SEMICOLON" or "THEN" in row.kinds[index:stop]:
            continue
        accepted = at.rejected_with(stop, stop, "THEN")
        if accepted is None:
            patch = insertion(row, stop, "THEN", MissingSymbol("THEN", "the IF statement"))
            return patch.with_fix(written_fix(row.place_before(stop), row, "THEN"))
        trials += accepted
    return None
