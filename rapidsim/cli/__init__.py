"""The command line: one file a family of commands; the only package that prints and exits."""

from __future__ import annotations


def main() -> None:
    """Run the command line."""
    raise SystemExit(2)
