"""`rapidsim mcp`: tools for agents that write RAPID."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import terminal_options
from rapidsim.extras import require


@click.command(short_help="Serve tools to agents that write RAPID.")
@terminal_options
def mcp() -> int:
    """Serve tools for agents on standard input and output (Model Context Protocol).

    The tools check, run, fix and compare programs that are sent as texts, and answer questions
    about reach, rules and the library. Nothing is read from the disk, and nothing is kept.
    """
    require("mcp", "`rapidsim mcp`")
    from rapidsim.agents.server import serve

    serve()
    return ExitCode.CLEAN
