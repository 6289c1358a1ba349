"""All rules there are, and the manual page of each."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Sequence
from types import ModuleType

import rapidsim.simulation.violations
from rapidsim.diagnostics import Violation
from rapidsim.report.palette import Palette

# Each rule is declared next to the code that detects it; these are all modules that declare some.
_DECLARED_IN: tuple[ModuleType, ...] = (rapidsim.simulation.violations,)


def _declared(modules: Iterable[ModuleType]) -> tuple[type[Violation], ...]:
    rules = (
        value
        for module in modules
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Violation)
        and value.__module__ == module.__name__
    )
    return tuple(sorted(rules, key=lambda rule: rule.code))


RULES = _declared(_DECLARED_IN)
"""Every rule, ordered by code."""


def rule_page(rule: type[Violation], palette: Palette) -> str:
    """The page of a rule: headline, explanation, example, fix."""
    code = palette.paint(rule.code, palette.of(rule.severity))
    headline = f"{code} {palette.paint(rule.name, palette.strong)} ({rule.severity.value})"
    compare = f"\nThe controller's event for it: {rule.cf}." if rule.cf else ""
    page = re.sub(
        r"^## *(.+)$",
        lambda heading: palette.paint(heading.group(1), palette.strong),
        inspect.cleandoc(rule.__doc__ or ""),
        flags=re.MULTILINE,
    )
    return f"{headline}\n\n{page}{compare}"


def rule_list(rules: Sequence[type[Violation]], palette: Palette) -> str:
    """One line a rule: code, severity, name, first sentence of its page."""
    widest = max(len(rule.name) for rule in rules)
    return "\n".join(
        f"{palette.paint(rule.code, palette.of(rule.severity))} {rule.severity.value:<7} "
        f"{rule.name:<{widest}}  {_first_line(rule)}"
        for rule in rules
    )


def _first_line(rule: type[Violation]) -> str:
    return inspect.cleandoc(rule.__doc__ or "").partition("\n")[0]
