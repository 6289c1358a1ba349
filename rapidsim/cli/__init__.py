"""The command line: one file a family of commands; the only package that prints and exits."""

from __future__ import annotations

import sys


def main() -> None:
    """Run the command line and end the process with its exit code."""
    from rapidsim.cli.boundary import run_commands

    sys.exit(run_commands(sys.argv[1:]))
