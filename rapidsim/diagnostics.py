"""What a finding is: a source text, a place in it, and a mistake with its facts.

A mistake is a `Violation`: one small frozen dataclass a rule, declared next to the code that
detects it. What can be said of the rule without the facts is the `Rule`, a folder of text files.
A `Diagnostic` is a violation at a place.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import field
from enum import StrEnum
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, ClassVar, dataclass_transform

from rapidsim.shipped import shipped
from rapidsim.values import value_class

if TYPE_CHECKING:
    from pathlib import Path

ON_REQUEST = ("F409", "F410", "M514", "S", "T323")
"""Rules and families that `rapidsim check` looks for only when asked, such as house style."""

# Files that went through careless tools end lines in CR CR LF; that is one line end, not two.
_LINE_END = re.compile(r"\r+\n|\n|\r")


class Severity(StrEnum):
    """How bad a finding is; only errors stop a program from running."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@value_class(frozen=True, eq=False, repr=False)
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

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.file[-60:]}, {len(self.text)} characters>"

    def line(self, number: int) -> str:
        """The text of a line, counted from 1, without its line end."""
        starts = self.line_starts
        end = starts[number] if number < len(starts) else len(self.text)
        return self.text[starts[number - 1] : end].rstrip("\r\n")


@value_class(frozen=True, slots=True, repr=False)
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

    def begins_in(self, other: Span) -> bool:
        """Whether its first character lies in another span."""
        return self.file == other.file and other.start <= self.start < other.end

    def __repr__(self) -> str:
        """One line."""
        return f"{self.file[-60:]}:{self.line}:{self.column}"


@value_class(frozen=True)
class Rule:
    """What is written of a rule: its folder `CODE-name` in `rapidsim/rules`, read when asked for.

    `rule.toml` holds the message and what else this class gives; `page.md` says what is wrong and
    why it matters. The programs of `bad.mod` break the rule, those of `good.mod` do not.
    """

    code: str
    """Family letter and number; its meaning never changes once released."""

    @property
    def name(self) -> str:
        """The mistake in kebab case, such as `undefined-name`."""
        return self._folder.name.partition("-")[2]

    @property
    def severity(self) -> Severity:
        """How bad it is."""
        return Severity(self._table["severity"])

    @property
    def message(self) -> str:
        """A format string over the fields of the violation: one line, no full stop, no blame."""
        return str(self._table["message"])

    @property
    def help(self) -> str:
        """The cure, where it is always the same; a format string over the fields too."""
        return str(self._table.get("help", ""))

    @property
    def events(self) -> Mapping[str, str]:
        """The controller's event for the same thing, such as `ABB 50050`, by case.

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
        """Whether `rapidsim check` looks for it unasked."""
        return not self.code.startswith(ON_REQUEST)

    def matches(self, selector: str) -> bool:
        """Whether a code, the beginning of a code such as `K6`, or a name means this rule."""
        return self.code.startswith(selector.upper()) or self.name == selector.lower()

    def read(self, file: str) -> bytes:
        """A file of its folder; empty if the folder has none of that name."""
        found = self._folder / file
        return found.read_bytes() if found.is_file() else b""

    @property
    def _folder(self) -> Path:
        return _rule_folders()[self.code]

    @cached_property
    def _table(self) -> dict[str, Any]:
        # Like the import below: not for those commands that find nothing.
        import tomllib  # noqa: PLC0415

        return tomllib.loads(self.read("rule.toml").decode("utf-8"))


@cache
def all_rules() -> tuple[Rule, ...]:
    """Every rule, ordered by code."""
    return tuple(map(Rule, sorted(_rule_folders())))


@cache
def _rule_folders() -> Mapping[str, Path]:
    """The folder of each code."""
    # Beside the folders there is no name but those of Python.
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
        """Whether all of them, in all files, are one finding where findings are merged."""
        return False

    def with_others(self, merged: Sequence[Violation]) -> Violation:
        """One violation that says this and others of its rule; for those that are told once."""
        del merged
        return self

    facts: ClassVar[tuple[str, ...]] = ()
    """The names of its fields, in order."""

    def __init_subclass__(cls, *, code: str) -> None:
        """Note the fields of the subclass.

        What a frozen dataclass would have is written once, below: to generate it for each of some
        hundred classes takes longer than checking a file.
        """
        cls.rule = Rule(code)
        own = (name for name, of in cls.__annotations__.items() if not of.startswith("ClassVar"))
        cls.facts = (*cls.facts, *own)

    def __init__(self, *values: object, **named: object) -> None:
        """Take the facts in the order of the fields, or by their names."""
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
        """Refuse: facts stay as they are."""
        raise AttributeError(f"cannot change `{name}` of a violation")

    def __eq__(self, other: object) -> bool:
        """Whether it is of the same rule with the same facts."""
        if type(other) is not type(self):
            return NotImplemented
        return vars(self) == vars(other)

    def __hash__(self) -> int:
        """That of the facts."""
        return hash((type(self), *(getattr(self, name) for name in self.facts)))

    def __repr__(self) -> str:
        """The class and its facts."""
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
        """How bad it is."""
        return self.rule.severity

    @property
    def case(self) -> str:
        """The case of its rule, where the controller's event depends on it."""
        return ""

    @property
    def cf(self) -> str | None:
        """The controller's event for the same thing."""
        return self.rule.events.get(self.case)

    @property
    def message(self) -> str:
        """The message with the facts filled in."""
        return self.rule.message.format_map(vars(self))

    @property
    def help(self) -> str | None:
        """The cure, when it is known."""
        return self.rule.help.format_map(vars(self)) or None


@value_class(frozen=True, slots=True)
class Related:
    """Another place that explains a finding, such as the declaration a use disagrees with."""

    span: Span
    message: str


@value_class(frozen=True, slots=True)
class Edit:
    """Replace a span by a text."""

    span: Span
    text: str


@value_class(frozen=True, slots=True)
class Fix:
    """Edits that cure a finding."""

    title: str
    edits: tuple[Edit, ...]
    safe: bool = True


@value_class(frozen=True, slots=True, repr=False)
class Diagnostic:
    """A violation at a place; `span` is None only for what has no place, such as a whole folder."""

    violation: Violation
    span: Span | None
    related: tuple[Related, ...] = ()
    fix: Fix | None = None
    routine: str | None = None
    """The routine around the place, if it is in one."""
    assumed: bool = False
    """Whether it holds under an assumption only, such as an arm that nobody named, or the station
    says that a run goes on."""
    order: tuple[str, int] = field(init=False, compare=False)
    """Sort key: file, then offset."""

    def __post_init__(self) -> None:
        """Work out the sort key."""
        key = (self.span.file, self.span.start) if self.span else ("", 0)
        object.__setattr__(self, "order", key)

    @property
    def code(self) -> str:
        """The code of its rule, such as `K603`."""
        return self.violation.code

    @property
    def message(self) -> str:
        """What is wrong, with the facts: one line."""
        return self.violation.message

    @property
    def help(self) -> str | None:
        """The cure, where it is known."""
        return self.violation.help

    @property
    def file(self) -> str | None:
        """The file as the user named it; None without a place."""
        return self.span.file if self.span else None

    @property
    def line(self) -> int | None:
        """From 1."""
        return self.span.line if self.span else None

    @property
    def column(self) -> int | None:
        """From 1."""
        return self.span.column if self.span else None

    def __repr__(self) -> str:
        """One line: a source may be long."""
        where = f" {self.span!r}" if self.span else ""
        text = f"<{self.severity} {self.code}{where}: {self.message}"
        return f"{text if len(text) < 120 else f'{text[:116]}...'}>"

    @property
    def severity(self) -> Severity:
        """The severity of the violation; what is only assumed is no more than a warning."""
        severity = self.violation.severity
        return Severity.WARNING if self.assumed and severity is Severity.ERROR else severity
