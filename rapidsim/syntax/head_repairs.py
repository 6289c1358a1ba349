"""Last-resort repairs: rebuild a head, drop a statement, skip text outside modules."""

from __future__ import annotations

from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.syntax import wording
from rapidsim.syntax.blocks import ROUTINES
from rapidsim.syntax.parse_failure import ParseFailure, Patch, Token, TokenBuffer, deletion
from rapidsim.syntax.recognizer import accepts, in_file, in_list
from rapidsim.syntax.spelling import distance
from rapidsim.syntax.text_violations import NoModule, TextBehindModule, TextOutsideModule
from rapidsim.syntax.token_repairs import BLOCK_WORDS, respelling
from rapidsim.syntax.violations import BrokenHead, BrokenSyntax, StrayStatement

# Heads of blocks: the word that ends each, and the replacement for its condition.
_BLOCK_HEADS = {
    "IF": ("THEN", ("EXP",)),
    "ELSEIF": ("THEN", ("EXP",)),
    "WHILE": ("DO", ("EXP",)),
    "CASE": ("COLON", ("EXP",)),
    "FOR": ("DO", ("NAME", "FROM", "EXP", "TO", "EXP")),
}
_DECLARES = frozenset({"VAR", "PERS", "CONST", "ALIAS", "RECORD", *ROUTINES})
"""First words of items that a module would lack if they followed its end."""
_BEGIN_ITEM = frozenset({"VAR", "PERS", "CONST", "LOCAL", "TASK", "ALIAS"})


def skip_text_between_modules(at: ParseFailure) -> Patch | None:
    """Skip to the next line that begins with MODULE and a name."""
    if not in_file(at.stack):
        return None
    row = at.row
    begin = _module_begin(row, at.index)
    if begin is None and at.index == 0:
        return _misspelt_module(row) or _no_module(row)
    stop = len(row.kinds) - 1 if begin is None else begin
    lost = any(kind in _DECLARES for kind in row.kinds[at.index : stop])
    if begin is None and not lost:
        return deletion(row, at.index, stop, TextBehindModule())
    return deletion(row, at.index, stop, TextOutsideModule())


def broken_head(at: ParseFailure) -> Patch | None:
    """Rebuild the head of a module, routine or block, so that its body can be read."""
    row, first = at.row, at.statement
    if row.kinds[first] == "LOCAL":
        first += 1
    kind = row.kinds[first]
    if kind == "MODULE" or kind in ROUTINES:
        return _definition_head(at, first)
    heads = [i for i in range(first, at.index + 1) if row.kinds[i] in _BLOCK_HEADS]
    if not heads:
        return None
    head = heads[-1]
    last, substitute = _BLOCK_HEADS[row.kinds[head]]
    stop = head + 1
    while row.kinds[stop] not in {last, "SEMICOLON"} and row.kinds[stop] not in BLOCK_WORDS:
        stop += 1
    if row.kinds[stop] != last or stop == head + 1:
        return None
    before = row.kinds[at.statement : head + 1]
    if not accepts(at.statement_stack, [*before, *substitute, last]):
        return None
    span = row.span(head + 1, stop)
    counter = _first_name(row, head + 1, stop)
    tokens = tuple(
        counter if kind == "NAME" else (kind, span.start, span.end) for kind in substitute
    )
    return Patch(head + 1, stop, tokens, _complaint(at, BrokenHead))


def panic(at: ParseFailure) -> Patch:
    """Drop the statement or declaration, up to its semicolon or the beginning of the next."""
    row, first = at.row, at.statement
    complaint = _complaint(at, BrokenSyntax)
    if not in_list(at.statement_stack) or (first == at.index and at.kind in BLOCK_WORDS):
        return Patch(at.index, at.index + 1, (), complaint)
    if accepts(at.statement_stack, ["RDN"]):
        stop = _statements_end(at)
        if row.kinds[first] not in _BEGIN_ITEM:
            statement = wording.construct(row, first, stop)
            complaint = Diagnostic(StrayStatement(statement), row.span(first, first + 1))
    else:
        stop = _statement_end(at)
    if not accepts(at.statement_stack, ["BROKEN"]):
        return Patch(first, stop, (), complaint)  # a component of a record
    span = row.span(first, stop)
    return Patch(first, stop, (("BROKEN", span.start, span.end),), complaint)


def _statement_end(at: ParseFailure) -> int:
    """Index after the semicolon, or of the next construct if the semicolon is missing."""
    row = at.row
    column = row.indent(at.statement)
    stop = at.index
    while row.kinds[stop] not in BLOCK_WORDS:
        if stop > at.statement and row.kinds[stop - 1] == "SEMICOLON" and stop > at.index:
            break
        if stop > at.index and row.first_on_line(stop) and row.column(stop) <= column:
            break
        stop += 1
    return max(stop, at.statement + 1)


def _statements_end(at: ParseFailure) -> int:
    """Index after stray statements between routines, which are often many and count as one."""
    row = at.row
    stop = at.index
    declaration = row.kinds[at.statement] in _BEGIN_ITEM
    while row.kinds[stop] not in BLOCK_WORDS and (
        stop == at.index or declaration or row.kinds[stop] not in _BEGIN_ITEM
    ):
        stop += 1
        if declaration and row.kinds[stop - 1] == "SEMICOLON":
            break
    return max(stop, at.statement + 1)


def _complaint(at: ParseFailure, rule: type[BrokenHead] | type[BrokenSyntax]) -> Diagnostic:
    row, index = at.row, at.index
    construct = wording.construct(row, at.statement, index + 1)
    return Diagnostic(rule(construct, wording.problem(at)), row.span(index, index + 1))


def _definition_head(at: ParseFailure, first: int) -> Patch | None:
    """Reduce the head of a module or routine to its names and an empty parameter list."""
    row = at.row
    stop = row.line_stop(first)
    if at.index > stop:
        stop = row.line_stop(at.index)  # parameters on several lines
    names = [row.token(i) for i in range(first + 1, stop) if row.kinds[i] == "NAME"]
    place = row.ends[first]
    wanted = 2 if row.kinds[first] == "FUNC" else 1
    names = [*names, *[("NAME", place, place)] * wanted][:wanted]
    end = row.ends[stop - 1]
    tokens: list[Token] = list(names)
    if row.kinds[first] != "MODULE":
        tokens += [("LPAR", end, end), ("RPAR", end, end)]
    if [kind for kind, _, _ in tokens] == row.kinds[first + 1 : stop]:
        return None
    return Patch(first + 1, stop, tuple(tokens), _complaint(at, BrokenHead))


def _first_name(row: TokenBuffer, first: int, stop: int) -> Token:
    for index in range(first, stop):
        if row.kinds[index] == "NAME":
            return row.token(index)
    return "NAME", row.starts[first], row.starts[first]


def _module_begin(row: TokenBuffer, index: int) -> int | None:
    for begin in range(index, len(row.kinds) - 1):
        if (
            row.kinds[begin] == "MODULE"
            and row.kinds[begin + 1] == "NAME"
            and row.first_on_line(begin)
        ):
            return begin
    return None


def _misspelt_module(row: TokenBuffer) -> Patch | None:
    """Correct the first line that would begin a module if its first word were spelt right."""
    for index in range(len(row.kinds) - 2):
        if (
            row.kinds[index] == row.kinds[index + 1] == "NAME"
            and row.first_on_line(index)
            and distance(row.text(index).upper(), "MODULE") in {1, 2}
        ):
            return respelling(row, index, index + 1, "MODULE")
    return None


def _no_module(row: TokenBuffer) -> Patch:
    source = row.source
    end = len(source.line(1)) if source.text else 0
    diagnostic = Diagnostic(NoModule(), Span(source, 0, end))
    return Patch(0, len(row.kinds) - 1, (), diagnostic)
