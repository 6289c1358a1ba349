"""`rapidsim dap`: a debug adapter for editors."""

from __future__ import annotations

import sys

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import terminal_options


@click.command(short_help="Debug from an editor, on standard input and output.")
@terminal_options
def dap() -> int:
    """Debug RAPID from an editor: a debug adapter on standard input and output.

    It speaks the Debug Adapter Protocol. Arguments of `launch`: `program` (a module, a folder, a
    .pgf file, or a list), `cwd`, `home`, `station`, `robot`, `answers`, `replay` (a journal of
    `rapidsim serve`), `stopOnEntry`. `attach` is not supported.
    """
    from rapidsim.dap.adapter import Adapter

    Adapter(sys.stdin.buffer, sys.stdout.buffer).run()
    return ExitCode.CLEAN
