"""Rule selectors of users: to select, to ignore, to explain."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Rule, all_rules
from rapidsim.files import InputError, did_you_mean


def expect_rules(selectors: Sequence[str]) -> tuple[str, ...]:
    """Return the selectors, each of which must match at least one rule.

    Args:
        selectors: Codes, prefixes of codes, or names of rules.

    Raises:
        InputError: If a selector matches no rule.
    """
    for selector in selectors:
        if not any(rule.matches(selector) for rule in all_rules()):
            raise unknown_rule(selector)
    return tuple(selectors)


def unknown_rule(given: str) -> InputError:
    """Return the error for a selector that is neither code nor name of a rule."""
    known = [text for rule in all_rules() for text in (rule.code, rule.name)]
    help = did_you_mean(given, known) or "`rapidsim explain --all` lists the rules"
    return InputError(f"there is no rule `{given}`", help)


def is_selected(
    rule: Rule,
    select: Sequence[str] = (),
    ignore: Sequence[str] = (),
    also: Sequence[str] = (),
) -> bool:
    """Whether a rule is selected.

    Args:
        rule: The rule.
        select: Codes, prefixes of codes such as `K6`, or names of rules; if empty, the rules that
            are on by default.
        ignore: Selectors of rules to remove afterwards.
        also: Selectors of rules to add to the selection.
    """
    chosen = any(rule.matches(one) for one in select) if select else rule.on_by_default
    chosen = chosen or any(rule.matches(one) for one in also)
    return chosen and not any(rule.matches(one) for one in ignore)
