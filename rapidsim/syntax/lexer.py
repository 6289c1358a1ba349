"""Conversion of text to tokens: three parallel lists without an object per token.

One regular expression made from the terminals of the grammar matches every token. Lexing never
fails: a character that begins no token becomes a token of kind `UNKNOWN`, a string without closing
quote becomes a STRING that ends where the code of its line seems to continue; the parser reports
both.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from itertools import pairwise

from rapidsim.syntax import tree
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.table import END
from rapidsim.values import value_class

UNKNOWN = "UNKNOWN"
"""Kind of a character that begins no token; the grammar has no such terminal."""

# Deeper aggregates of literals are parsed bracket by bracket.
_LITERAL_DEPTH = 6
# After a backslash these words are parameter modes; other words are names of options.
_MODES = frozenset({"VAR", "PERS", "INOUT"})
_CODE_AFTER_STRING = (";", ")", "]", " ", "\t")
_WORDS_AFTER_STRING = ("THEN", "DO")
_LAST_WORD = re.compile(r"(?<!\w)[A-Za-z]{2,4}$")


@value_class(frozen=True, eq=False, slots=True)
class Tokens:
    """Tokens of a text; the last is `END`, with zero width."""

    kinds: list[str]
    """Terminals of the grammar, or `UNKNOWN`."""
    starts: list[int]
    """Offsets of the first characters."""
    ends: list[int]
    """Offsets past the last characters."""
    comments: tuple[tree.Comment, ...]
    unterminated: tuple[int, ...]
    """Offsets of unterminated strings."""
    words: frozenset[str]
    """Every name and reserved word, as written."""


@value_class(frozen=True, eq=False, slots=True)
class _Lexicon:
    pattern: re.Pattern[str]
    header: re.Pattern[str]
    marks: dict[str, str]
    words: dict[str, str]


def lex(text: str, left_out: Sequence[tuple[int, int]] = ()) -> Tokens:
    """Split a text into tokens.

    Args:
        text: The text.
        left_out: Intervals of whole lines to skip, in order.
    """
    lexicon = _lexicon()
    words: dict[str, str] = {}
    kinds: list[str] = []
    starts: list[int] = []
    ends: list[int] = []
    comments: list[tree.Comment] = []
    unterminated: list[int] = []
    header = lexicon.header.match(text)
    begin = header.end() if header else 0
    pieces = [(0, begin), *left_out, (len(text), len(text))]
    for (_, begin), (stop, _) in pairwise(pieces):
        matches = lexicon.pattern.finditer(text, begin, stop)
        while found := next(matches, None):
            kind = found.lastgroup or UNKNOWN
            start, end = found.span(kind)
            if kind == "WORD":
                word = text[start:end]
                known = words.get(word)
                if known is None:
                    known = words[word] = lexicon.words.get(word.upper(), "NAME")
                kind = known
                if kind != "NAME" and kinds and kinds[-1] == "BACKSLASH" and kind not in _MODES:
                    kind = "NAME"
            elif kind == "MARK":
                kind = lexicon.marks[text[start:end].upper()]
            elif kind == "COMMENT":
                comments.append(tree.Comment(start, text[start:end]))
                continue
            elif kind == "UNCLOSED":
                kind = "STRING"
                end = _string_end(text, start, end)
                unterminated.append(start)
                matches = lexicon.pattern.finditer(text, end, stop)
            kinds.append(kind)
            starts.append(start)
            ends.append(end)
    kinds.append(END)
    starts.append(len(text))
    ends.append(len(text))
    return Tokens(kinds, starts, ends, tuple(comments), tuple(unterminated), frozenset(words))


def literal_pattern() -> str:
    """Pattern of one literal in an aggregate: a number with its sign, a string or a truth value."""
    patterns = rapid_table().patterns
    return rf"[+-]?(?:{patterns['NUMBER']})|{patterns['STRING']}|\b(?:TRUE|FALSE)\b"


def _string_end(text: str, start: int, line_end: int) -> int:
    """Likely end of a string without closing quote: before the text that ends the statement."""
    end = line_end
    while end > start + 1:
        if text[end - 1] in _CODE_AFTER_STRING:
            end -= 1
            continue
        word = _LAST_WORD.search(text, start + 1, end)
        if word is None or word.group().upper() not in _WORDS_AFTER_STRING:
            break
        end = word.start()
    return end


@cache
def _lexicon() -> _Lexicon:
    table = rapid_table()
    patterns = table.patterns
    marks = sorted(table.marks, key=lambda mark: (-len(mark), mark))
    # Atomic groups: a matched element is final, so a long aggregate that fails at its end fails
    # once. A comma must be followed by an element.
    literal = element = literal_pattern()
    literals = ""
    for _ in range(_LITERAL_DEPTH):
        literals = rf"\[(?>(?:\s*(?>{element})\s*(?:,\s*(?!\])|(?=\])))+)\]"
        element = f"{literal}|{literals}"
    alternatives = (
        ("WORD", patterns["NAME"]),
        ("LITERALS", literals),
        ("NUMBER", patterns["NUMBER"]),
        ("STRING", patterns["STRING"]),
        ("UNCLOSED", r'"[^\r\n]*'),
        ("COMMENT", patterns["COMMENT"]),
        ("MARK", "|".join(map(re.escape, marks))),
        (UNKNOWN, r"[^\w\s]|\w+"),
    )
    tokens = "|".join(f"(?P<{kind}>{text})" for kind, text in alternatives)
    pattern = rf"(?>(?:{patterns['BLANK']})*)(?:{tokens})"
    return _Lexicon(
        pattern=re.compile(pattern, re.IGNORECASE),
        header=re.compile(rf"(?:{patterns['BLANK']})?{patterns['HEADER']}"),
        marks=table.marks,
        words=table.words,
    )
