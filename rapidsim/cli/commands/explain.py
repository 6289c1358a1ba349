"""`rapidsim explain`: what a rule means, with an example and a fix."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
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
    palette = terminal.palette
    if everything:
        echo(rule_list(all_rules(), palette), palette=palette)
        return ExitCode.CLEAN
    if code is None:
        raise click.UsageError("name a rule, or list them with --all", click.get_current_context())
    name = error_name(code)
    number = int(code) if code.isdecimal() else None if name is None else event_of_name(name)
    if number is not None:
        meant = [rule for rule in all_rules() if f"ABB {number}" in rule.events.values()]
        if not meant and number not in EVENT_TITLES:
            raise InputError(f"no rule cites the event {number}", "`--all` lists all rules")
        echo(event_page(number, meant, palette), palette=palette)
    elif name is not None:
        echo(name_page(name, palette), palette=palette)
        return ExitCode.CLEAN
    else:
        meant = [rule for rule in all_rules() if _means(rule, code)]
    if meant:
        if number is not None:
            echo("")
        pages = (rule_page(rule, palette, width=terminal.width) for rule in meant)
        echo("\n\n".join(pages), palette=palette)
        return ExitCode.CLEAN
    if number is not None:
        return ExitCode.CLEAN
    family = [rule for rule in all_rules() if rule.code.startswith(code.upper())]
    if family:
        echo(rule_list(family, palette), palette=palette)
        return ExitCode.CLEAN
    if code.upper().startswith("ERR_"):
        raise InputError(f"there is no error name `{code}`", did_you_mean(code, NUMBERS))
    raise unknown_rule(code)


def _means(rule: Rule, code: str) -> bool:
    """Whether a rule has a code or name."""
    return code.upper() == rule.code or code.lower() == rule.name
