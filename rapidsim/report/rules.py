"""All rules there are, and the manual page of each."""

from __future__ import annotations

import inspect
import pkgutil
import re
import textwrap
from collections.abc import Sequence
from functools import cache
from importlib import import_module

import rapidsim.analysis
import rapidsim.analysis.rules
import rapidsim.language
import rapidsim.motion
import rapidsim.simulation
import rapidsim.syntax
from rapidsim.diagnostics import Violation
from rapidsim.report.palette import Palette

# Each rule is declared next to the code that detects it, in a module whose name ends like this,
# or, where one rule was not worth a module, in one of those listed.
_PACKAGES = (
    rapidsim.language,
    rapidsim.syntax,
    rapidsim.analysis,
    rapidsim.motion,
    rapidsim.simulation,
)
_MODULE_NAME_ENDS_IN = "violations"
# Here every module holds rules.
_RULE_PACKAGES = (rapidsim.analysis.rules,)
_OTHER_MODULES = (
    "rapidsim.analysis.suppressions",
    "rapidsim.interpreter.limits",
    "rapidsim.simulation.load_tasks",
)

_HEADING = re.compile(r"^## *(.+)$", re.MULTILINE)
_FENCED = re.compile(r"^```\w*\n(.*?)\n```$", re.MULTILINE | re.DOTALL)
_BLANK_LINES = re.compile(r"\n{3,}")


@cache
def rules() -> tuple[type[Violation], ...]:
    """Every rule, ordered by code."""
    named = (
        f"{package.__name__}.{module.name}"
        for package in (*_PACKAGES, *_RULE_PACKAGES)
        for module in pkgutil.iter_modules(package.__path__)
        if module.name.endswith(_MODULE_NAME_ENDS_IN) or package in _RULE_PACKAGES
    )
    declared = (
        value
        for module in map(import_module, (*named, *_OTHER_MODULES))
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Violation)
        and value.__module__ == module.__name__
        and "code" in vars(value)
    )
    return tuple(sorted(declared, key=lambda rule: rule.code))


def rule_page(rule: type[Violation], palette: Palette, *, width: int) -> str:
    """The page of a rule: headline, explanation, example, fix.

    Args:
        rule: The rule.
        palette: Colours.
        width: Cells a line of the explanation may take; code is not broken.
    """
    code = palette.paint(rule.code, palette.of(rule.severity))
    headline = f"{code} {palette.paint(rule.name, palette.strong)} ({rule.severity.value})"
    asked = "" if rule.on_by_default else f"\n\nLooked for with `--extend-select {rule.code}`."
    compare = f"\n\nThe controller's event for it: {rule.cf}." if rule.cf else ""
    page = _FENCED.sub(_indented, inspect.cleandoc(rule.__doc__ or ""))
    page = _HEADING.sub(lambda heading: palette.paint(heading.group(1), palette.strong), page)
    page = _BLANK_LINES.sub("\n\n", page).strip()
    page = "\n\n".join(_filled(paragraph, width) for paragraph in page.split("\n\n"))
    return f"{headline}\n\n{page}{asked}{compare}"


def rule_list(listed: Sequence[type[Violation]], palette: Palette) -> str:
    """One line a rule: code, severity, name, first sentence of its page."""
    widest = max(len(rule.name) for rule in listed)
    return "\n".join(
        f"{palette.paint(rule.code, palette.of(rule.severity))} {rule.severity.value:<7} "
        f"{rule.name:<{widest}}  {_first_line(rule)}"
        for rule in listed
    )


def _indented(code: re.Match[str]) -> str:
    return f"\n{textwrap.indent(code.group(1), '    ')}\n"


def _filled(paragraph: str, width: int) -> str:
    """A paragraph of running text broken anew; code, lists and tables stay as they are."""
    if paragraph.startswith((" ", "-", "|", "\x1b")):
        return paragraph
    return textwrap.fill(
        " ".join(paragraph.split()), width, break_long_words=False, break_on_hyphens=False
    )


def _first_line(rule: type[Violation]) -> str:
    return inspect.cleandoc(rule.__doc__ or "").partition("\n")[0]
