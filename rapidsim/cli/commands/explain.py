"""`rapidsim explain`: what a rule means, with an example and a fix."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import Terminal, current_terminal, echo, terminal_options
from rapidsim.diagnostics import Rule, all_rules
from rapidsim.files import InputError, did_you_mean
from rapidsim.jobs.inputs.selectors import unknown_rule
from rapidsim.language.error_numbers import NUMBERS
from rapidsim.language.events import EVENT_TITLES
from rapidsim.report.pages.events import error_name, event_of_name, event_page, name_page
from rapidsim.report.pages.rules import rule_list, rule_page


@click.command()
@click.argument("code", required=False)
@click.option("--all", "everything", is_flag=True, help="List all rules.")
@terminal_options
def explain(code: str | None, everything: bool) -> int:
    """Explain a rule: what it finds and why it matters, with an example and a fix.

    CODE is the code of a rule or its name: `N201` or `undefined-name`. The start of a code, such
    as `K` or `M5`, lists all rules that begin with it. The number of a controller event, such as
    `50050`, or an error name, such as `ERR_DIVZERO`, explains the event and the matching rules.
    """
    terminal = current_terminal()
    if everything:
        text = rule_list(all_rules(), terminal.palette)
    elif code is None:
        raise click.UsageError("name a rule, or list them with --all", click.get_current_context())
    else:
        text = _explanation(code, terminal)
    echo(text, palette=terminal.palette)
    return ExitCode.CLEAN


def _explanation(code: str, terminal: Terminal) -> str:
    """Return the text about a code, a number or a name.

    Raises:
        InputError: If nothing has it.
    """
    palette = terminal.palette
    name = error_name(code)
    number = int(code) if code.isdecimal() else None if name is None else event_of_name(name)
    if number is not None:
        rules = [rule for rule in all_rules() if f"ABB {number}" in rule.events.values()]
        if not rules and number not in EVENT_TITLES:
            raise InputError(f"no rule cites the event {number}", "`--all` lists all rules")
        return "\n\n".join((event_page(number, rules, palette), *_pages(rules, terminal)))
    if name is not None:
        return name_page(name, palette)
    if rules := [rule for rule in all_rules() if _means(rule, code)]:
        return "\n\n".join(_pages(rules, terminal))
    if family := [rule for rule in all_rules() if rule.code.startswith(code.upper())]:
        return rule_list(family, palette)
    if code.upper().startswith("ERR_"):
        raise InputError(f"there is no error name `{code}`", did_you_mean(code, NUMBERS))
    raise unknown_rule(code)


def _pages(rules: Iterable[Rule], terminal: Terminal) -> Iterator[str]:
    return (rule_page(rule, terminal.palette, width=terminal.width) for rule in rules)


def _means(rule: Rule, code: str) -> bool:
    """Whether a rule has a code or name."""
    return code.upper() == rule.code or code.lower() == rule.name
