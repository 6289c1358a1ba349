"""Findings: a source text, a position in it, and a violation of a rule with its facts.

A mistake is a `Violation`: one small frozen dataclass per rule, declared next to the code that
detects it. Everything about the rule that is independent of the facts is the `Rule`, a folder of
text files. A `Diagnostic` is a violation at a position.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import field
from enum import StrEnum
from functools import cache, cached_property
from itertools import accumulate, chain
from typing import TYPE_CHECKING, Any, ClassVar, dataclass_transform

from rapidsim.shipped import shipped
from rapidsim.values import value_class

if TYPE_CHECKING:
    from pathlib import Path

ON_REQUEST = ("F409", "F410", "M514", "S", "T323")
"""Rules and families that `rapidsim check` applies only on request, such as house style."""

# Some tools write line ends as CR CR LF, which is one line end, not two.
LINE_END = re.compile(r"\r+\n|\n|\r")
_LONE_RETURN = re.compile(r"\r(?!\r*\n)")


class Severity(StrEnum):
    """Severity of a finding; only errors prevent a program from running."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@value_class(frozen=True, eq=False, repr=False)
class Source:
    """Text of one file. Positions in it are character offsets; lines are determined on demand."""

    file: str
    """File name as the user specified it."""
    text: str

    @cached_property
    def line_starts(self) -> Sequence[int]:
        """Offset of the first character of each line."""
        if "\r" in self.text and _LONE_RETURN.search(self.text):
            ends = (match.end() for match in LINE_END.finditer(self.text))
            return array("q", chain((0,), ends))
        # Then each line ends with a line feed, which is found faster.
        lines = self.text.split("\n")
        return array("q", accumulate((len(line) + 1 for line in lines[:-1]), initial=0))

    @property
    def written(self) -> Source:
        """The text of the file as written; that of an edited file may be spaced."""
        return self

    def offsets(self, start: int, end: int) -> tuple[int, int]:
        """Offsets in the file of a range of this text; see `workspace/spaced_source.py`."""
        return start, end

    def address(self, offset: int) -> int:
        """Position in this text of an offset in the file."""
        return offset

    def offset(self, address: int) -> int:
        """Offset in the file of a position in this text."""
        return address

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both counted from 1."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def __repr__(self) -> str:
        """Short form of one line."""
        return f"<{self.file[-60:]}, {len(self.text)} characters>"

    def line(self, number: int) -> str:
        """Text of a line, counted from 1, without its line end."""
        starts = self.line_starts
        end = starts[number] if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r\n")


@value_class(frozen=True, slots=True, repr=False)
class Span:
    """A range of a source text, `end` exclusive."""

    source: Source
    start: int
    end: int

    @property
    def file(self) -> str:
        """File name as the user specified it."""
        return self.source.file

    @property
    def line(self) -> int:
        """Line of the first character, from 1."""
        return self.source.position(self.start)[0]

    @property
    def column(self) -> int:
        """Column of the first character, from 1."""
        return self.source.position(self.start)[1]

    @property
    def end_line(self) -> int:
        """Line just past the last character, from 1."""
        return self.source.position(self.end)[0]

    @property
    def end_column(self) -> int:
        """Column just past the last character, from 1."""
        return self.source.position(self.end)[1]

    @property
    def written(self) -> Span:
        """The span in the file as it is written."""
        return Span(self.source.written, *self.source.offsets(self.start, self.end))

    @property
    def text(self) -> str:
        """Text of the span."""
        return self.source.text[self.start : self.end]

    @property
    def one_line(self) -> str:
        """Text of the span on one line, for messages: white space is a single blank."""
        return " ".join(self.text.split())

    def begins_in(self, other: Span) -> bool:
        """Whether its first character is inside another span."""
        return self.file == other.file and other.start <= self.start < other.end

    def __repr__(self) -> str:
        """Short form of one line."""
        return f"{self.file[-60:]}:{self.line}:{self.column}"


@value_class(frozen=True)
class Rule:
    """Text of a rule: its folder `CODE-name` in `rapidsim/rules`, read on demand.

    `rule.toml` contains the message and the other attributes of this class; `page.md` explains the
    mistake and its consequences. The programs of `bad.mod` break the rule, the ones of `good.mod`
    do not.
    """

    code: str
    """Family letter and number; its meaning never changes once released."""

    @property
    def name(self) -> str:
        """The mistake in kebab case, such as `undefined-name`."""
        return self._folder.name.partition("-")[2]

    @property
    def severity(self) -> Severity:
        """Default severity of its findings."""
        return Severity(self._table["severity"])

    @property
    def message(self) -> str:
        """Format string over the fields of the violation: one line, no full stop, no blame."""
        return str(self._table["message"])

    @property
    def help(self) -> str:
        """Constant suggestion, if any; a format string over the fields as well."""
        return str(self._table.get("help", ""))

    @property
    def events(self) -> Mapping[str, str]:
        """Corresponding event of the controller, such as `ABB 50050`, by case.

        A rule with one event for all cases has it under the empty string.
        """
        found = self._table.get("cf", {})
        return {"": found} if isinstance(found, str) else found

    @property
    def cf(self) -> str | None:
        """All its events in one line; None without any."""
        listed = (f"{event} ({case})" if case else event for case, event in self.events.items())
        return ", ".join(listed) or None

    @property
    def on_by_default(self) -> bool:
        """Whether `rapidsim check` applies it by default."""
        return not self.code.startswith(ON_REQUEST)

    def matches(self, selector: str) -> bool:
        """Whether a code, the beginning of a code such as `K6`, or a name selects this rule."""
        return self.code.startswith(selector.upper()) or self.name == selector.lower()

    def read(self, file: str) -> bytes:
        """Contents of a file in its folder; empty if there is no such file."""
        found = self.path(file)
        return found.read_bytes() if found.is_file() else b""

    def path(self, file: str) -> Path:
        """Path of a file in its folder, whether or not there is one."""
        return self._folder / file

    @property
    def _folder(self) -> Path:
        return _rule_folders()[self.code]

    @cached_property
    def _table(self) -> dict[str, Any]:
        # Imported here like the one below, to save time in commands without findings.
        import tomllib  # noqa: PLC0415

        return tomllib.loads(self.read("rule.toml").decode("utf-8"))


@cache
def all_rules() -> tuple[Rule, ...]:
    """Return every rule, ordered by code."""
    return tuple(map(Rule, sorted(_rule_folders())))


@cache
def _rule_folders() -> Mapping[str, Path]:
    """Return the folder of each code."""
    # All other names next to the folders are Python's.
    names = (one for one in shipped("rules").iterdir() if "-" in one.name)
    return {folder.name.partition("-")[0]: folder for folder in names}


@dataclass_transform(frozen_default=True)
class Violation:
    """A mistake of the user; a subclass has the facts as fields, and the code of its rule."""

    rule: ClassVar[Rule]

    @property
    def qualifies(self) -> bool:
        """Whether it is a reservation about the result, which fails a strict check."""
        return False

    @property
    def is_reported_once(self) -> bool:
        """Whether all such findings, in all files, are merged into one if findings are merged."""
        return False

    def with_others(self, merged: Sequence[Violation]) -> Violation:
        """Return a violation that represents this and the merged ones, if reported once."""
        del merged
        return self

    facts: ClassVar[tuple[str, ...]] = ()
    """Names of its fields, in order."""

    def __init_subclass__(cls, *, code: str) -> None:
        """Record the fields of the subclass.

        The methods of a frozen dataclass are written once, below: generating them for each of some
        hundred classes takes longer than checking a file.
        """
        cls.rule = Rule(code)
        own = (name for name, of in cls.__annotations__.items() if not of.startswith("ClassVar"))
        cls.facts = (*cls.facts, *own)

    def __init__(self, *values: object, **named: object) -> None:
        """Take the facts in the order of the fields, or by name."""
        facts = dict(zip(self.facts, values, strict=False))
        if len(values) > len(self.facts) or facts.keys() & named.keys():
            raise TypeError(f"{type(self).__name__} takes each of {self.facts} once")
        facts |= named
        for name in self.facts:
            if name not in facts:
                facts[name] = getattr(type(self), name)
        if len(facts) != len(self.facts):
            raise TypeError(f"{type(self).__name__} has only the facts {self.facts}")
        vars(self).update(facts)

    def __setattr__(self, name: str, value: object) -> None:
        """Raise, because facts are immutable."""
        raise AttributeError(f"cannot change `{name}` of a violation")

    def __eq__(self, other: object) -> bool:
        """Whether both violate the same rule with the same facts."""
        if type(other) is not type(self):
            return NotImplemented
        return vars(self) == vars(other)

    def __hash__(self) -> int:
        """Hash of the facts."""
        return hash((type(self), *(getattr(self, name) for name in self.facts)))

    def __repr__(self) -> str:
        """Class name and facts."""
        facts = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.facts)
        return f"{type(self).__name__}({facts})"

    @property
    def code(self) -> str:
        """The code of the rule."""
        return self.rule.code

    @property
    def name(self) -> str:
        """The name of the rule."""
        return self.rule.name

    @property
    def severity(self) -> Severity:
        """Severity of the finding."""
        return self.rule.severity

    @property
    def case(self) -> str:
        """Case of its rule, which selects the event of the controller."""
        return ""

    @property
    def cf(self) -> str | None:
        """Corresponding event of the controller; None without one."""
        return self.rule.events.get(self.case)

    @property
    def message(self) -> str:
        """Message with the facts filled in."""
        return self.rule.message.format_map(vars(self))

    @property
    def help(self) -> str | None:
        """Suggestion; None if there is no known one."""
        return self.rule.help.format_map(vars(self)) or None


@value_class(frozen=True, slots=True)
class Related:
    """Another position that explains a finding, such as the declaration of a misused name."""

    span: Span
    message: str


@value_class(frozen=True, slots=True)
class Edit:
    """Replacement of a span by a text."""

    span: Span
    text: str


@value_class(frozen=True, slots=True)
class Fix:
    """Edits that correct a finding."""

    title: str
    edits: tuple[Edit, ...]
    safe: bool = True


@value_class(frozen=True, slots=True, repr=False)
class Diagnostic:
    """A violation at a position; `span` is None only for a subject such as a whole folder."""

    violation: Violation
    span: Span | None
    related: tuple[Related, ...] = ()
    fix: Fix | None = None
    routine: str | None = None
    """Routine that contains the position, if any."""
    assumed: bool = False
    """Whether it depends on an assumption, such as a default arm, or a continuation of the run that
    the station requests.
    """
    order: tuple[str, int] = field(init=False, compare=False)
    """Sort key: file, then offset."""

    def __post_init__(self) -> None:
        """Compute the sort key."""
        key = (self.span.file, self.span.start) if self.span else ("", 0)
        object.__setattr__(self, "order", key)

    @property
    def code(self) -> str:
        """Code of its rule, such as `K603`."""
        return self.violation.code

    @property
    def message(self) -> str:
        """Message with the facts, in one line."""
        return self.violation.message

    @property
    def help(self) -> str | None:
        """Suggestion; None if there is no known one."""
        return self.violation.help

    @property
    def file(self) -> str | None:
        """File name as the user specified it; None without a position."""
        return self.span.file if self.span else None

    @property
    def line(self) -> int | None:
        """Line, from 1; None without a position."""
        return self.span.line if self.span else None

    @property
    def column(self) -> int | None:
        """Column, from 1; None without a position."""
        return self.span.column if self.span else None

    def __repr__(self) -> str:
        """Short form of one line, because a source may be long."""
        where = f" {self.span!r}" if self.span else ""
        text = f"<{self.severity} {self.code}{where}: {self.message}"
        return f"{text if len(text) < 120 else f'{text[:116]}...'}>"

    @property
    def severity(self) -> Severity:
        """Severity of the violation, at most a warning if it depends on an assumption."""
        severity = self.violation.severity
        return Severity.WARNING if self.assumed and severity is Severity.ERROR else severity
