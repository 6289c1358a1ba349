"""`rapidsim explain`: what a rule means, with an example and a fix."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.selectors import unknown_rule
from rapidsim.cli.terminal import current_terminal, terminal_options
from rapidsim.report.rules import RULES, rule_list, rule_page


@click.command()
@click.argument("code", required=False)
@click.option("--all", "everything", is_flag=True, help="List all rules.")
@terminal_options
def explain(code: str | None, everything: bool) -> int:
    """Explain a rule: what it finds and why it matters, with an example and a fix.

    CODE is the code of a rule or its name: `N201` or `undefined-name`.
    """
    palette = current_terminal().palette
    if everything:
        click.echo(rule_list(RULES, palette))
        return ExitCode.CLEAN
    if code is None:
        raise click.UsageError("name a rule, or list them with --all", click.get_current_context())
    for rule in RULES:
        if code.upper() == rule.code or code.lower() == rule.name:
            click.echo(rule_page(rule, palette))
            return ExitCode.CLEAN
    raise unknown_rule(code)
