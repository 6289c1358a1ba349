"""Names of rules that users give: to select, to ignore, to explain."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import all_rules
from rapidsim.files import InputError, did_you_mean


def expect_rules(selectors: Sequence[str]) -> tuple[str, ...]:
    """The selectors, each of which stands for a rule at least.

    Args:
        selectors: Codes, beginnings of codes, or names of rules.

    Raises:
        InputError: If one stands for no rule.
    """
    for selector in selectors:
        if not any(rule.matches(selector) for rule in all_rules()):
            raise unknown_rule(selector)
    return tuple(selectors)


def unknown_rule(given: str) -> InputError:
    """The error for what is neither code nor name of a rule."""
    known = [text for rule in all_rules() for text in (rule.code, rule.name)]
    help = did_you_mean(given, known) or "`rapidsim explain --all` lists the rules"
    return InputError(f"there is no rule `{given}`", help)
