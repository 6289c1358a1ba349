"""Limits of a controller, and limits that keep this program from exhausting its stack.

Names, strings and numbers that are too large are reported and kept. Nesting is limited before the
tokens are parsed: every later pass traverses the tree recursively, so a tree that is too deep must
never be built.

Source: Technical reference manual RAPID Kernel, "Lexical elements"; events ABB 40141, 40148.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace

from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.syntax import literals
from rapidsim.syntax.lexer import Tokens
from rapidsim.syntax.parse_failure import TokenBuffer
from rapidsim.syntax.table import END
from rapidsim.syntax.text_violations import BadEscape, LimitExceeded

LONGEST_NAME = 32
LONGEST_STRING = 80
DEEPEST = 200

_ROLES = {
    **dict.fromkeys(("LPAR", "LSQB", "LBRACE"), "open"),
    **dict.fromkeys(("RPAR", "RSQB", "RBRACE"), "close"),
    # Each of these increases the depth of the expression tree by one.
    **dict.fromkeys(
        [
            "PLUS",
            "MINUS",
            "STAR",
            "SLASH",
            "DIV",
            "MOD",
            "AND",
            "OR",
            "XOR",
            "NOT",
            "EQUAL",
            "UNEQUAL",
            "LESS",
            "LESS_EQUAL",
            "GREATER",
            "GREATER_EQUAL",
            "DOT",
        ],
        "chain",
    ),
    **dict.fromkeys(("COMMA", "BECOMES"), "part"),
    **dict.fromkeys(("SEMICOLON", "ELSE", "ELSEIF", "CASE", "DO", "IF"), "statement"),
    **dict.fromkeys(("THEN", "FOR", "WHILE", "TEST"), "block"),
    **dict.fromkeys(("ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST"), "end"),
    **dict.fromkeys(
        ("PROC", "FUNC", "TRAP", "ENDPROC", "ENDFUNC", "ENDTRAP", "ENDMODULE", END), "routine"
    ),
}
_WITH_LIMITS = frozenset({"STRING", "LITERALS", "NUMBER"})
_BEFORE_EXPRESSION = frozenset({"BECOMES", "COMMA", "IF", "ELSEIF", "WHILE", "TEST", "CASE"})
# Only a text with one of these can contain a number too large for a dnum. They are searched
# separately, because each pattern alone is many times as fast as all together.
_LARGE_EXPONENT = re.compile(r"[eE]\+?[0-9]{3}")
_LONG_PREFIXED = re.compile(r"0[xXoObB]\w{200}")
_FEW_TOKENS = 2_000
_EVERY = 10
_MANY_DIGITS = re.compile(f"[0-9]{{{300 // _EVERY}}}")
"""Stride of a quick test: 300 consecutive digits are visible at this stride, little else is."""


def bounded(tokens: Tokens, source: Source) -> tuple[Tokens, tuple[Diagnostic, ...]]:
    """Replace too deeply nested parts by gaps, each with a report."""
    kinds = tokens.kinds
    gaps: list[tuple[int, int, str]] = []
    stop = 0
    blocks: list[int] = []
    while (found := _too_deep(kinds, stop, blocks)) is not None:
        start, stop, gap = found
        gaps.append(found)
    if not gaps:
        return tokens, ()
    diagnostics = []
    row = TokenBuffer.of(tokens, source)
    for start, stop, gap in reversed(gaps):
        span = row.span(start, stop)
        violation = LimitExceeded("what begins here", "is nested too deep", f"{DEEPEST} levels")
        diagnostics.append(Diagnostic(violation, Span(source, span.start, span.start + 1)))
        row.kinds[start:stop] = [gap]
        row.starts[start:stop] = [span.start]
        row.ends[start:stop] = [span.end]
    return replace(tokens, kinds=row.kinds, starts=row.starts, ends=row.ends), tuple(diagnostics)


def _too_deep(kinds: list[str], begin: int, blocks: list[int]) -> tuple[int, int, str] | None:
    """Find the next span that is nested too deeply, with the kind of token to replace it.

    Args:
        kinds: The kinds of all tokens.
        begin: Index where the search begins.
        blocks: The tokens that open the blocks around that index; updated to those around the span.
    """
    chains = [0]  # operators so far, for each open bracket
    depth = 0  # depth of brackets and operators
    part = begin
    divides = False  # whether the next THEN belongs to an ELSEIF
    for index in range(begin, len(kinds)):
        role = _ROLES.get(kinds[index])
        if role is None:
            continue
        if role == "chain":
            chains[-1] += 1
            depth += 1
        elif role == "open":
            chains.append(0)
            depth += 1
        elif role == "close":
            if len(chains) > 1:
                depth -= chains.pop() + 1
        elif role == "part":
            depth -= chains[-1]
            chains[-1] = 0
            if len(chains) == 1:
                part = index + 1
        else:
            chains = [0]
            depth = 0
            part = index + 1
            if role == "block":
                if not (divides and kinds[index] == "THEN"):
                    blocks.append(index)
            elif role == "end":
                if blocks:
                    blocks.pop()
            elif role == "routine":
                blocks.clear()
            divides = kinds[index] == "ELSEIF"
        if depth + len(blocks) > DEEPEST:
            if len(blocks) < depth:
                return _deep_expression(kinds, part, index)
            return _deep_block(kinds, blocks.pop())
    return None


def _deep_expression(kinds: list[str], part: int, index: int) -> tuple[int, int, str]:
    stop = index
    while _ROLES.get(kinds[stop]) in {None, "open", "close", "chain", "part"}:
        stop += 1
    if kinds[part - 1] in _BEFORE_EXPRESSION:
        return part, stop, "EXP"
    return part, stop + (kinds[stop] == "SEMICOLON"), "BROKEN"


def _deep_block(kinds: list[str], index: int) -> tuple[int, int, str]:
    """Span of a block with its contents, up to its closing word."""
    start = index
    while kinds[index] == "THEN" and kinds[start] != "IF":
        start -= 1
    stop = index + 1
    depth = 1
    while depth and _ROLES.get(kinds[stop]) != "routine":
        role = _ROLES.get(kinds[stop])
        depth += (role == "block") - (role == "end")
        stop += 1
    return start, stop, "BROKEN"


def token_limits(tokens: Tokens, source: Source) -> tuple[Diagnostic, ...]:
    """Report names, strings and numbers that are too large, and invalid escapes."""
    found: list[Diagnostic] = []
    if any(len(word) > LONGEST_NAME for word in tokens.words):
        found += _long_names(tokens, source)
    # Few tokens are examined more quickly than the text.
    huge_numbers = len(tokens.kinds) < _FEW_TOKENS or _may_hold_huge_numbers(source.text)
    strings = '"' in source.text
    if not (huge_numbers or strings):
        return tuple(found)
    unterminated = set(tokens.unterminated)
    for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
        if kind not in _WITH_LIMITS or start in unterminated:
            continue  # the intended contents of an unterminated string are unknown
        if kind != "NUMBER":
            for offset, text in literals.parts(source.text[start:end]):
                if text[0] == '"':
                    found += _string_faults(source, start + offset, text)
                elif huge_numbers:
                    found += _number_faults(source, start + offset, text)
        elif huge_numbers:
            found += _number_faults(source, start, source.text[start:end])
    return tuple(found)


def _may_hold_huge_numbers(text: str) -> bool:
    if _LARGE_EXPONENT.search(text) or _LONG_PREFIXED.search(text):
        return True
    return _MANY_DIGITS.search(text[::_EVERY]) is not None


def _long_names(tokens: Tokens, source: Source) -> list[Diagnostic]:
    """Report each name once, at its first occurrence."""
    seen: set[str] = set()
    found = []
    for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
        name = source.text[start:end]
        if kind == "NAME" and end - start > LONGEST_NAME and name.lower() not in seen:
            seen.add(name.lower())
            violation = LimitExceeded(
                f"the name `{name}`", f"has {len(name)} characters", str(LONGEST_NAME)
            )
            found.append(Diagnostic(violation, Span(source, start, end)))
    return found


def _string_faults(source: Source, start: int, text: str) -> list[Diagnostic]:
    found = []
    if "\\" in text:
        escape = literals.bad_escape(text)
        if escape is not None:
            place = Span(source, start + escape, start + escape + 1)
            found.append(Diagnostic(BadEscape(), place))
    if len(text) > LONGEST_STRING:
        length = len(literals.string(text))
        if length > LONGEST_STRING:
            violation = LimitExceeded("the string", f"has {length} characters", str(LONGEST_STRING))
            found.append(Diagnostic(violation, Span(source, start, start + len(text))))
    return found


def _number_faults(source: Source, start: int, text: str) -> list[Diagnostic]:
    if not text[0].isalpha() and math.isinf(literals.number(text.lstrip("+-"))):
        violation = LimitExceeded("the number", "is larger than a dnum", "1.8E308")
        return [Diagnostic(violation, Span(source, start, start + len(text)))]
    return []
