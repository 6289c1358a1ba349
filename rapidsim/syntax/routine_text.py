"""The text of single items in a file: where they are, and a tree of one of them alone.

A routine whose text is closed by its own last word means the same wherever it is in its file. So
after a change inside it, only it is parsed again. Errors in it are corrected as they are in the
whole file: no correction looks further than a few tokens past the end of a routine.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from rapidsim.diagnostics import LINE_END, Diagnostic, Source
from rapidsim.syntax import tree
from rapidsim.syntax.blocks import CLOSERS, ROUTINES
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.limits import LONGEST_NAME
from rapidsim.syntax.parser import parse_tokens
from rapidsim.syntax.table import END
from rapidsim.values import value_class

_STORAGES = frozenset({"VAR", "PERS", "CONST"})
_SCOPES = frozenset({"LOCAL", "TASK"})
_ENDS = frozenset(CLOSERS[kind] for kind in ROUTINES)


@value_class(frozen=True, slots=True)
class ParsedRoutine:
    """A routine that was parsed alone."""

    routine: tree.Routine
    comments: tuple[tree.Comment, ...]
    diagnostics: tuple[Diagnostic, ...]


@value_class(frozen=True, slots=True)
class ParsedItems:
    """Items of a module that were parsed alone."""

    items: tuple[tree.Item, ...]
    comments: tuple[tree.Comment, ...]
    diagnostics: tuple[Diagnostic, ...]
    last: int
    """The end of the last word or mark."""


def item_ranges(tokens: Tokens, text: str) -> Iterator[tuple[int, int]]:
    """Yield the offsets of what modules consist of, if it is on lines of its own.

    These are routines, data, the line that begins a module and the one that ends it.

    Args:
        tokens: The tokens of a file as written.
        text: The text of the file.

    Yields:
        Where the line of the first word begins, and the end of the last word or semicolon.
    """
    kinds = tokens.kinds
    begin, wanted = 0, ""
    for index, kind in enumerate(kinds):
        if kind == "MODULE":
            begin, wanted = index, kind
            index = _module_head(kinds, index)
        if kind == "ENDMODULE":
            begin, wanted = index, kind
        if kind in ROUTINES:
            begin, wanted = index - (kinds[index - 1] in _SCOPES), CLOSERS[kind]
        elif kind in _STORAGES and wanted not in _ENDS:
            begin, wanted = index - (kinds[index - 1] in _SCOPES), "SEMICOLON"
        elif kind == wanted:
            start, end = tokens.starts[begin], tokens.ends[index]
            line = _line_start(text, start)
            is_head = kind == "MODULE" and LINE_END.search(text, start, end) is not None
            if not (is_head or text[line:start].strip()) and _is_last_on_line(text, end):
                yield line, end
            wanted = ""
        elif kind in _ENDS:
            wanted = ""


def parse_routine(
    source: Source, start: int, end: int, routine: tree.Routine, module: tree.Module
) -> ParsedRoutine | None:
    """Parse the changed text of a routine.

    Args:
        source: The text that contains it.
        start: Where the line of its first word begins.
        end: The end of its last word.
        routine: The routine before the change; its header is not changed.
        module: The module that contains it.

    Returns:
        The routine; None if the text is anything else than one routine with the same header, or if
        a finding in it may depend on other text of the file.
    """
    inside = lex(source.text, [(0, start), (end, len(source.text))])
    if any(len(word) > LONGEST_NAME for word in inside.words):
        # A long name is reported where the file has it first.
        return None
    parsed = parse_tokens(_as_module(inside, end, module), source)
    match parsed.file.modules:
        case (tree.Module(items=(tree.Proc() | tree.Func() | tree.Trap() as found,)),):
            header = (found.start, found.header_end, type(found))
            is_same = header == (routine.start, routine.header_end, type(routine))
        case _:
            return None
    if not is_same or found.end != end:
        return None
    places = [one.span for one in parsed.diagnostics]
    if not all(place is not None and found.header_end <= place.start < end for place in places):
        return None
    return ParsedRoutine(found, inside.comments, parsed.diagnostics)


def parse_data(
    source: Source, start: int, end: int, data: tree.Data, module: tree.Module
) -> tree.Data | None:
    """Parse the changed text of a declaration outside of routines.

    Args:
        source: The text that contains it.
        start: Where the line of its first word begins.
        end: The end of its semicolon.
        data: The declaration before the change, of which only the value changed.
        module: The module that contains it.

    Returns:
        The declaration; None if the text is anything else than one without errors.
    """
    inside = lex(source.text, [(0, start), (end, len(source.text))])
    is_whole = inside.kinds[-2:] == ["SEMICOLON", END] and inside.kinds.count("SEMICOLON") == 1
    if not is_whole or any(len(word) > LONGEST_NAME for word in inside.words):
        return None
    parsed = parse_tokens(_as_module(inside, end, module), source)
    if parsed.diagnostics:
        return None
    match parsed.file.modules:
        case (tree.Module(items=(tree.Data(value=tree.Node() as value) as found,)),):
            before = data.value
            is_same = before is not None and value.start == before.start
            return found if is_same and found.start == data.start else None
        case _:
            return None


def parse_items(
    source: Source, start: int, end: int, module: tree.Module, *, closes: bool = False
) -> ParsedItems | None:
    """Parse the changed text of any number of whole items.

    Args:
        source: The text that contains it.
        start: Where the line of the first word begins, or a blank behind another item.
        end: The end of the last word, or of the last line.
        module: The module that contains it.
        closes: Whether the text ends with the end of the module.

    Returns:
        The items with all errors in them; None if a finding may depend on other text of the file.
    """
    inside = lex(source.text, [(0, start), (end, len(source.text))])
    if any(len(word) > LONGEST_NAME for word in inside.words):
        return None
    if closes and inside.kinds[-2:] != ["ENDMODULE", END]:
        return None
    parsed = parse_tokens(_as_module(inside, end, module, closes=closes), source)
    match parsed.file.modules:
        case (tree.Module(name=name, items=items),) if name.start == module.name.start:
            last = inside.ends[-2] if len(inside.ends) > 1 else start
            return ParsedItems(items, inside.comments, parsed.diagnostics, last)
    return None


def _as_module(tokens: Tokens, end: int, module: tree.Module, *, closes: bool = False) -> Tokens:
    """Tokens of a module that contains only the given ones, which may have its end."""
    name = module.name
    if closes:
        return replace(
            tokens,
            kinds=["MODULE", "NAME", *tokens.kinds],
            starts=[module.start, name.start, *tokens.starts],
            ends=[module.start + len("MODULE"), name.end, *tokens.ends],
        )
    behind = end + 1
    return replace(
        tokens,
        kinds=["MODULE", "NAME", *tokens.kinds[:-1], "ENDMODULE", END],
        starts=[module.start, name.start, *tokens.starts[:-1], behind, behind],
        ends=[module.start + len("MODULE"), name.end, *tokens.ends[:-1], behind, behind],
    )


def _module_head(kinds: Sequence[str], index: int) -> int:
    """Index of the last token of the head of a module."""
    last = index + 1
    if kinds[last : last + 2] == ["NAME", "LPAR"]:
        while kinds[last] not in ("RPAR", "SEMICOLON", END):
            last += 1
    return last


def _line_start(text: str, offset: int) -> int:
    feed = text.rfind("\n", 0, offset)
    return max(feed, text.rfind("\r", feed + 1, offset)) + 1


def _is_last_on_line(text: str, offset: int) -> bool:
    """Whether at most a comment follows on a line that ends."""
    end = LINE_END.search(text, offset)
    if end is None:
        return False
    behind = text[offset : end.start()].strip()
    return not behind or behind.startswith("!")
