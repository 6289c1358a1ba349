"""`rapidsim lsp`: a language server for editors."""

from __future__ import annotations

import click

from rapidsim import __version__
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import terminal_options
from rapidsim.extras import require


@click.command(short_help="Serve an editor, on standard input and output.")
@terminal_options
def lsp() -> int:
    """Serve an editor: a language server on standard input and output.

    It speaks the Language Server Protocol. Findings are updated as you type; moves are checked, and
    programs run, in a second process. `initializationOptions` may have `checkMoves`: false leaves
    the moves unchecked. How to set up an editor: docs/editor.md.
    """
    require("pygls", "rapidsim lsp")
    from rapidsim.lsp.wire import serve

    serve(__version__)
    return ExitCode.CLEAN
