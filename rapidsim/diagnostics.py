"""What a finding is: a source text, a place in it, and a mistake with its facts.

A mistake is a `Violation`: one small frozen dataclass a rule, declared next to the code that
detects it. Its docstring is its manual page. A `Diagnostic` is a violation at a place.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from typing import ClassVar

# Files that went through careless tools end lines in CR CR LF; that is one line end, not two.
_LINE_END = re.compile(r"\r+\n|\n|\r")


class Severity(StrEnum):
    """How bad a finding is; only errors stop a program from running."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, eq=False)
class Source:
    """The text of one file. Positions in it are character offsets; lines are found on demand."""

    file: str
    """The file as the user named it."""
    text: str

    @cached_property
    def line_starts(self) -> tuple[int, ...]:
        """Offset of the first character of each line."""
        return (0, *(match.end() for match in _LINE_END.finditer(self.text)))

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of an offset, both counted from 1."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def line(self, number: int) -> str:
        """The text of a line, counted from 1, without its line end."""
        starts = self.line_starts
        end = starts[number] if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r\n")


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a source text, `end` exclusive."""

    source: Source
    start: int
    end: int

    @property
    def file(self) -> str:
        """The file as the user named it."""
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
    def text(self) -> str:
        """The characters themselves."""
        return self.source.text[self.start : self.end]


@dataclass(frozen=True)
class Violation:
    """A mistake of the user with its facts; the subclass is the rule, its docstring the page.

    The docstring says what is wrong and why it matters, then holds `## Example` with a module that
    breaks the rule and `## Fix` with one that does not; both are executed as tests.
    """

    code: ClassVar[str]
    """Family letter and number; its meaning never changes once released."""
    name: ClassVar[str]
    """The mistake in kebab case, such as `undefined-name`."""
    template: ClassVar[str]
    """The message as a format string over the fields: one line, no full stop, no blame."""
    severity: ClassVar[Severity] = Severity.ERROR
    on_by_default: ClassVar[bool] = True
    """Whether `rapidsim check` looks for it unasked; house style is for those who select it."""
    cf: ClassVar[str | None] = None
    """The controller's own event number for the same thing, such as `ABB 50050`."""

    @property
    def message(self) -> str:
        """The template with the facts filled in."""
        return self.template.format_map(vars(self))

    @property
    def help(self) -> str | None:
        """The cure, when it is known."""
        return None

    @classmethod
    def matches(cls, selector: str) -> bool:
        """Whether a code, the beginning of a code such as `K6`, or a name means this rule."""
        return cls.code.startswith(selector.upper()) or cls.name == selector.lower()


@dataclass(frozen=True, slots=True)
class Related:
    """Another place that explains a finding, such as the declaration a use disagrees with."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Edit:
    """Replace a span by a text."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """Edits that cure a finding."""

    title: str
    edits: tuple[Edit, ...]
    safe: bool = True


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """A violation at a place; `span` is None only for what has no place, such as a whole folder."""

    violation: Violation
    span: Span | None
    related: tuple[Related, ...] = ()
    fix: Fix | None = None
    routine: str | None = None
    """The routine the place stands in, when it stands in one."""
    assumed: bool = False
    """Whether it holds under an assumption only, such as an arm that nobody named."""
    order: tuple[str, int] = field(init=False, compare=False)
    """Sort key: file, then offset."""

    def __post_init__(self) -> None:
        """Work out the sort key."""
        key = (self.span.file, self.span.start) if self.span else ("", 0)
        object.__setattr__(self, "order", key)

    @property
    def severity(self) -> Severity:
        """The severity of the violation; what is only assumed is no more than a warning."""
        severity = self.violation.severity
        return Severity.WARNING if self.assumed and severity is Severity.ERROR else severity
