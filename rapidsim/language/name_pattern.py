r"""Regular expressions for names of data, matched in linear time.

A search for data takes its pattern from a program or a client, and backtracking would let
`(a|a)*!` take forever. A pattern becomes an automaton instead (K. Thompson, "Regular Expression
Search Algorithm", 1968), whose states are followed all at once, and whose transitions are kept.

The notation is that of `re`, without case: `.`, classes, groups, `|`, `* + ? {m,n}`, `^ $`,
`\d \w \s`. Lookahead, back references and flags are refused, as are patterns of too many states.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Final, TypeAlias

MOST_STATES: Final = 5000
"""Largest number of states of an automaton."""
MOST_VISITS: Final = 500_000
"""Largest number of states that one pattern visits in all its matches."""
_MOST_REPEATS: Final = 255
_MOST_DEPTH: Final = 50
"""Largest number of groups in groups."""
_CONTROLS: Final = {"n": "\n", "t": "\t", "r": "\r", "f": "\f", "v": "\v"}
_QUANTIFIERS: Final = {"*": (0, None), "+": (1, None), "?": (0, 1)}

_Test: TypeAlias = Callable[[str], bool]
"""Whether a character matches, in one case."""
_Repeats: TypeAlias = tuple[int, int | None]
_CLASSES: Final[Mapping[str, _Test]] = MappingProxyType(
    {"d": str.isdecimal, "s": str.isspace, "w": lambda c: c.isalnum() or c == "_"}
)
_START, _END = "^", "$"


class PatternError(ValueError):
    """A text is no pattern, or one that is not supported."""


class NamePattern:
    """A pattern that matches whole names, in any case."""

    def __init__(self, text: str) -> None:
        """Build the automaton.

        Raises:
            PatternError: If the text is no pattern.
        """
        self._automaton = _Automaton()
        start, end = _Parser(text, self._automaton).pattern()
        self._end = end
        self._visits = 0
        self._start = self._closure([start], _START)
        self._next: dict[tuple[frozenset[int], str], frozenset[int]] = {}
        self._accepts: dict[frozenset[int], bool] = {}

    def matches(self, name: str) -> bool:
        """Whether the pattern matches a whole name.

        Raises:
            PatternError: If the matches of this pattern take too long.
        """
        states = self._start
        for character in name:
            key = states, character
            following = self._next.get(key)
            if following is None:
                following = self._next[key] = self._follow(states, character)
            states = following
        if states not in self._accepts:
            # An empty name is at its start and at its end.
            anchors = _END if name else _START + _END
            ends = self._closure([*states], anchors)
            if not name:
                return self._end in ends
            self._accepts[states] = self._end in ends
        return self._accepts[states]

    def _follow(self, states: frozenset[int], character: str) -> frozenset[int]:
        tests, targets = self._automaton.tests, self._automaton.targets
        self._visit(len(states))
        return self._closure(
            targets[state][0]
            for state in states
            if (test := tests.get(state)) is not None and test(character)
        )

    def _closure(self, states: Iterable[int], anchors: str = "") -> frozenset[int]:
        """Return the states reached without a character; `anchors` are those that hold here."""
        automaton = self._automaton
        reached, pending = set[int](), list(states)
        while pending:
            state = pending.pop()
            self._visit(1)
            if state in reached:
                continue
            reached.add(state)
            anchor = automaton.anchors.get(state)
            if state not in automaton.tests and (anchor is None or anchor in anchors):
                pending += automaton.targets[state]
        return frozenset(reached)

    def _visit(self, count: int) -> None:
        self._visits += count
        if self._visits > MOST_VISITS:
            raise PatternError("the pattern is too complex")


class _Automaton:
    """States by number; one with a test takes a character, one with an anchor a position."""

    def __init__(self) -> None:
        """Begin without states."""
        self.targets: list[list[int]] = []
        self.tests: dict[int, _Test] = {}
        self.anchors: dict[int, str] = {}

    def add(self) -> int:
        """Add a state."""
        if len(self.targets) >= MOST_STATES:
            raise PatternError("the pattern is too long")
        self.targets.append([])
        return len(self.targets) - 1

    def join(self, source: int, target: int) -> None:
        """Let a state lead to another."""
        self.targets[source].append(target)


_Fragment: TypeAlias = tuple[int, int]
"""First and last state of a part of the pattern."""


class _Parser:
    """Recursive descent over a pattern; a repeated part is read again for each copy."""

    def __init__(self, text: str, automaton: _Automaton) -> None:
        """Begin at the start of the text."""
        self._text = text
        self._at = 0
        self._depth = 0
        self._automaton = automaton

    def pattern(self) -> _Fragment:
        """Read the whole text."""
        fragment = self._alternatives()
        if self._at < len(self._text):
            raise PatternError("a `)` without `(`")
        return fragment

    def _alternatives(self) -> _Fragment:
        start, end = self._automaton.add(), self._automaton.add()
        while True:
            first, last = self._sequence()
            self._automaton.join(start, first)
            self._automaton.join(last, end)
            if not self._accept("|"):
                return start, end

    def _sequence(self) -> _Fragment:
        start = end = self._automaton.add()
        while self._at < len(self._text) and self._text[self._at] not in "|)":
            first, last = self._repeated()
            self._automaton.join(end, first)
            end = last
        return start, end

    def _repeated(self) -> _Fragment:
        begin = self._at
        fragment = self._atom()
        repeats = self._quantifier()
        if repeats is None:
            return fragment
        after = self._at
        if self._at < len(self._text) and (self._text[self._at] in "*+?" or self._quantifier()):
            raise PatternError("a quantifier after a quantifier")
        least, most = repeats
        fragment = self._copies(begin, fragment, least, most)
        self._at = after
        return fragment

    def _copies(self, begin: int, fragment: _Fragment, least: int, most: int | None) -> _Fragment:
        """Return copies of the part that begins at a position; `fragment` is the first one."""
        automaton = self._automaton
        start, end = automaton.add(), automaton.add()
        at, count = start, max(least, 1 if most is None else most)
        for number in range(count):
            if number:
                self._at = begin
                fragment = self._atom()
            if number >= least:
                automaton.join(at, end)
            automaton.join(at, fragment[0])
            at = fragment[1]
            if most is None and number == count - 1:
                automaton.join(at, fragment[0])
        automaton.join(at if count else start, end)
        return start, end

    def _quantifier(self) -> _Repeats | None:
        """Read a quantifier; a following `?` changes nothing where whole names match."""
        repeats = None
        if self._at < len(self._text) and self._text[self._at] in _QUANTIFIERS:
            repeats = _QUANTIFIERS[self._text[self._at]]
            self._at += 1
        elif self._text.startswith("{", self._at):
            inside, closed, _ = self._text[self._at + 1 :].partition("}")
            low, comma, high = inside.partition(",")
            digits = [one for one in (low, high) if one]
            if not closed or not digits or not all(one.isdecimal() for one in digits):
                return None
            if any(len(one) > 3 or int(one) > _MOST_REPEATS for one in digits):
                raise PatternError(f"at most {_MOST_REPEATS} repeats")
            least = int(low or "0")
            most = (int(high) if high else None) if comma else least
            if most is not None and most < least:
                raise PatternError("the least number of repeats is larger than the largest")
            repeats = least, most
            self._at += len(inside) + 2
        if repeats is not None:
            self._accept("?")
        return repeats

    def _atom(self) -> _Fragment:
        character = self._take()
        match character:
            case "(":
                if self._accept("?") and not self._accept(":"):
                    raise PatternError("`(?` is not supported")
                return self._group()
            case "*" | "+" | "?":
                raise PatternError("nothing to repeat")
            case "^" | "$":
                return self._anchor(character)
            case "[":
                return self._test(self._class())
            case ".":
                return self._test(lambda c: c != "\n")
            case "\\":
                return self._test(self._escape())
            case _:
                return self._test(_is(character))

    def _group(self) -> _Fragment:
        self._depth += 1
        if self._depth > _MOST_DEPTH:
            raise PatternError("too many groups in groups")
        fragment = self._alternatives()
        if not self._accept(")"):
            raise PatternError("a `(` without `)`")
        self._depth -= 1
        return fragment

    def _class(self) -> _Test:
        is_negated = self._accept("^")
        tests = list[_Test]()
        while not tests or not self._accept("]"):
            character = self._take()
            if character == "\\":
                tests.append(self._escape())
            elif self._text.startswith("-", self._at) and not self._text.startswith("-]", self._at):
                self._at += 1
                tests.append(_between(character, self._take()))
            else:
                tests.append(_is(character))
        if is_negated:
            return lambda c: not any(test(case) for case in _cases(c) for test in tests)
        return lambda c: any(test(c) for test in tests)

    def _escape(self) -> _Test:
        character = self._take()
        if (test := _CLASSES.get(character.lower())) is not None:
            return test if character.islower() else lambda c: not test(c)
        if character in _CONTROLS:
            return _is(_CONTROLS[character])
        if character.isalnum():
            raise PatternError(f"`\\{character}` is not supported")
        return _is(character)

    def _test(self, test: _Test) -> _Fragment:
        start, end = self._automaton.add(), self._automaton.add()
        self._automaton.tests[start] = lambda c: any(map(test, _cases(c)))
        self._automaton.join(start, end)
        return start, end

    def _anchor(self, anchor: str) -> _Fragment:
        start, end = self._automaton.add(), self._automaton.add()
        self._automaton.anchors[start] = anchor
        self._automaton.join(start, end)
        return start, end

    def _take(self) -> str:
        if self._at >= len(self._text):
            raise PatternError("the pattern ends too early")
        self._at += 1
        return self._text[self._at - 1]

    def _accept(self, character: str) -> bool:
        if self._text.startswith(character, self._at):
            self._at += 1
            return True
        return False


def _cases(character: str) -> tuple[str, str]:
    return character.lower(), character.upper()


def _is(wanted: str) -> _Test:
    return lambda character: character == wanted


def _between(low: str, high: str) -> _Test:
    if high < low:
        raise PatternError(f"`{low}-{high}` is no range")
    return lambda character: low <= character <= high
