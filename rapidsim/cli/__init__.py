"""The command line: one file a family of commands; the only package that prints and exits."""

from __future__ import annotations

import sys

from rapidsim.cli.exit_codes import ExitCode


def main() -> None:
    """Run the command line and end the process with its exit code."""
    try:
        from rapidsim.cli.boundary import run_commands
    except KeyboardInterrupt:
        # Ctrl-C while the command line is still being loaded, which takes a tenth of a second.
        sys.stderr.write("interrupted\n")
        sys.exit(ExitCode.INTERRUPTED)
    sys.exit(run_commands(sys.argv[1:]))
