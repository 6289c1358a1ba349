"""Write `docs/commands.md` from the commands: `python scripts/build_commands_page.py`."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

import click
from wrap_markdown import wrap

from rapidsim.cli.group import commands

PAGE = Path(__file__).parents[1] / "docs" / "commands.md"
INTRODUCTION = """\
# Commands

Every command with its arguments and options, as `rapidsim COMMAND --help` prints them. Generated
from the source by `python scripts/build_commands_page.py`. [Run a program](running.md) shows them
in use and lists the exit codes.
"""
EVERYWHERE = ("quiet", "verbose", "no_color", "version", "help")


def page() -> str:
    """The page: what all commands share, then a section a command."""
    context = click.Context(commands, info_name="rapidsim")
    shared = [param for param in commands.get_params(context) if param.name in EVERYWHERE]
    parts = [INTRODUCTION, "## Options of every command\n", *_table(shared, context)]
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command is not None
        parts += _section(command, name, context, "##")
    parts += _index(context)
    return wrap("\n".join(parts) + "\n")


def _index(context: click.Context) -> Iterator[str]:
    """All options in the order of the alphabet, with the commands that have them."""
    holders: dict[str, list[str]] = {}
    for name, option in options_by_command(commands, context):
        holders.setdefault(option.opts[0], []).append(name)
    yield "\n## All options\n"
    yield "| option | commands |\n|---|---|"
    for option_name, names in sorted(holders.items()):
        yield f"| `{option_name}` | {', '.join(f'`{name}`' for name in names)} |"


def options_by_command(
    command: click.Command, context: click.Context, name: str = ""
) -> Iterator[tuple[str, click.Option]]:
    """The options of a command and of those within it, but for those of every command."""
    for param in command.params:
        if isinstance(param, click.Option) and param.name not in EVERYWHERE and not param.hidden:
            yield name, param
    if isinstance(command, click.Group):
        for child_name in command.list_commands(context):
            child = command.get_command(context, child_name)
            assert child is not None
            yield from options_by_command(child, context, f"{name} {child_name}".strip())


def _section(command: click.Command, name: str, parent: click.Context, level: str) -> Iterator[str]:
    context = click.Context(command, info_name=name, parent=parent)
    yield f"\n{level} {context.command_path.removeprefix('rapidsim ')}\n"
    usage = " ".join([context.command_path, *command.collect_usage_pieces(context)])
    yield f"```text\n{usage}\n```\n"
    yield _prose(command.help or "")
    own = [param for param in command.get_params(context) if param.name not in EVERYWHERE]
    yield from _table([param for param in own if isinstance(param, click.Option)], context)
    if isinstance(command, click.Group):
        for child in command.list_commands(context):
            found = command.get_command(context, child)
            assert found is not None
            yield from _section(found, child, context, level + "#")


def _prose(help: str) -> str:
    """The help of a command, paragraph by paragraph."""
    paragraphs = re.split(r"\n\s*\n", help.split("\f")[0])
    return "\n".join(_paragraph(paragraph) for paragraph in paragraphs)


def _paragraph(text: str) -> str:
    """One paragraph; what click is told not to wrap stays as it is."""
    if text.lstrip().startswith("\b"):
        kept = text.split("\b\n", 1)[-1]
        return f"```text\n{kept}\n```\n"
    return _escaped(" ".join(line.strip() for line in text.splitlines())).strip() + "\n"


def _escaped(text: str) -> str:
    """No tags: `<program>` is meant as it stands, outside of code."""
    return re.sub(r"(`[^`]*`)|<", lambda found: found[1] or "&lt;", text)


def _table(options: list[click.Parameter], context: click.Context) -> Iterator[str]:
    rows = [record for option in options if (record := option.get_help_record(context))]
    if not rows:
        return
    yield "| option | |\n|---|---|"
    for names, text in rows:
        yield f"| {_code(names)} | {_cell(text)} |"
    yield ""


def _cell(text: str) -> str:
    return _escaped(text).replace("|", "\\|").replace("  [", " [")


def _code(text: str) -> str:
    """Code in a cell: what divides cells is not written as it stands, in no kind of Markdown."""
    if "|" not in text:
        return f"`{text}`"
    return f"<code>{html.escape(text).replace('|', '&#124;')}</code>"


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
