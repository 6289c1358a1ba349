"""`rapidsim explain`: what a rule means, with an example and a fix."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import current_terminal, say, terminal_options
from rapidsim.diagnostics import Rule, all_rules
from rapidsim.jobs.selectors import unknown_rule
from rapidsim.report.pages.rules import rule_list, rule_page


@click.command()
@click.argument("code", required=False)
@click.option("--all", "everything", is_flag=True, help="List all rules.")
@terminal_options
def explain(code: str | None, everything: bool) -> int:
    """Explain a rule: what it finds and why it matters, with an example and a fix.

    CODE is the code of a rule or its name: `N201` or `undefined-name`. The start of a code, such
    as `K` or `M5`, lists all rules that begin with it. The number of a controller event, such as
    `50050`, explains the matching rules.
    """
    terminal = current_terminal()
    palette = terminal.palette
    if everything:
        say(rule_list(all_rules(), palette), palette=palette)
        return ExitCode.CLEAN
    if code is None:
        raise click.UsageError("name a rule, or list them with --all", click.get_current_context())
    meant = [rule for rule in all_rules() if _means(rule, code)]
    if meant:
        pages = (rule_page(rule, palette, width=terminal.width) for rule in meant)
        say("\n\n".join(pages), palette=palette)
        return ExitCode.CLEAN
    family = [rule for rule in all_rules() if rule.code.startswith(code.upper())]
    if family:
        say(rule_list(family, palette), palette=palette)
        return ExitCode.CLEAN
    raise unknown_rule(code)


def _means(rule: Rule, code: str) -> bool:
    """Whether a rule has a code or name, or stands for an event of the controller."""
    if code.isdecimal():
        return rule.cf == f"ABB {code}"
    return code.upper() == rule.code or code.lower() == rule.name
