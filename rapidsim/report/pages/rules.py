"""The manual page of each rule, from the files of its folder."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence

from rapidsim.diagnostics import Rule
from rapidsim.report.palette import Palette

_NEXT_PROGRAM = re.compile(rb"^! ---\r?\n", re.MULTILINE)
_MARK = re.compile(r" *! found$", re.MULTILINE)
_HEADING = re.compile(r"^## (.+)$", re.MULTILINE)
_BLANK_LINES = re.compile(r"\n{3,}")


def programs(rule: Rule, file: str) -> tuple[bytes, ...]:
    """The programs of `bad.mod` or `good.mod`, which lines `! ---` part.

    The page shows the first; it is empty if a program would not help a reader.
    """
    return tuple(_NEXT_PROGRAM.split(rule.read(file)))


def explanation(rule: Rule) -> str:
    """Introduction: the mistake in a sentence, why it matters and when it does not."""
    return rule.read("page.md").decode("utf-8").strip()


def first_line(rule: Rule) -> str:
    """The first paragraph of the explanation, a sentence or two, as one line."""
    return " ".join(explanation(rule).partition("\n\n")[0].split())


def shown_programs(rule: Rule) -> dict[str, str]:
    """Examples by heading: a program that breaks the rule, and the corrected one."""
    shown = {
        heading: _MARK.sub("", programs(rule, file)[0].decode("utf-8")).strip("\n")
        for heading, file in (("Example", "bad.mod"), ("Fix", "good.mod"))
    }
    return {heading: program for heading, program in shown.items() if program}


def markdown(rule: Rule) -> str:
    """The page of a rule as Markdown: explanation, example, fix."""
    parts = (
        f"## {heading}\n\n{textwrap.indent(program, '    ')}"
        for heading, program in shown_programs(rule).items()
    )
    return "\n\n".join((explanation(rule), *parts))


def rule_page(rule: Rule, palette: Palette, *, width: int) -> str:
    """The page of a rule: headline, explanation, example, fix.

    Args:
        rule: The rule.
        palette: Colours.
        width: Cells a line of the explanation may take; code is not broken.
    """
    code = palette.paint(rule.code, palette.of(rule.severity))
    headline = f"{code} {palette.paint(rule.name, palette.strong)} ({rule.severity.value})"
    asked = "" if rule.on_by_default else f"\n\nEnabled by `--extend-select {rule.code}`."
    compare = f"\n\nController event: {rule.cf}." if rule.cf else ""
    page = _HEADING.sub(
        lambda heading: palette.paint(heading.group(1), palette.strong), markdown(rule)
    )
    page = _BLANK_LINES.sub("\n\n", page).strip()
    page = "\n\n".join(_filled(paragraph, width) for paragraph in page.split("\n\n"))
    return f"{headline}\n\n{page}{asked}{compare}"


def rule_list(listed: Sequence[Rule], palette: Palette) -> str:
    """One line a rule: code, severity, name, first sentence of its page."""
    widest = max(len(rule.name) for rule in listed)
    return "\n".join(
        f"{palette.paint(rule.code, palette.of(rule.severity))} {rule.severity.value:<7} "
        f"{rule.name:<{widest}}  {first_line(rule)}"
        for rule in listed
    )


def _filled(paragraph: str, width: int) -> str:
    """A paragraph of running text, rewrapped; code, lists and tables are unchanged."""
    if paragraph.startswith((" ", "-", "|", "\x1b")):
        return paragraph
    return textwrap.fill(
        " ".join(paragraph.split()), width, break_long_words=False, break_on_hyphens=False
    )
