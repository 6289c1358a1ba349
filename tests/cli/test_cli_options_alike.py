"""Options of all commands: one name for one thing, one thing under one name."""

from __future__ import annotations

from collections import defaultdict

import click

from rapidsim.cli.group import commands

OF_TWO_KINDS = {
    "--all": "solutions of kin, rules of explain",
    "--profile": "of the interpreter, of a speed",
    "--robotware": "the generation that is served, the version in a file of parameters",
    "--speed": "of virtual time, of a TCP",
}
"""Names that mean something else in another command, in the words of each field."""


def options() -> list[tuple[str, click.Option]]:
    """The options of each command."""
    context = click.Context(commands)
    found: list[tuple[str, click.Option]] = []

    def look(command: click.Command, name: str) -> None:
        found.extend((name, one) for one in command.params if isinstance(one, click.Option))
        if isinstance(command, click.Group):
            for child in command.list_commands(context):
                inner = command.get_command(context, child)
                assert inner is not None
                look(inner, f"{name} {child}".strip())

    look(commands, "")
    return found


def test_a_name_takes_the_same_kind_of_value_everywhere() -> None:
    kinds = defaultdict(set)
    for _, option in options():
        if option.is_flag:
            kinds[option.opts[0]].add("flag")
        else:
            value = option.metavar or type(option.type).__name__
            kinds[option.opts[0]].add(value.split("|")[0].split("[")[0].upper())
    several = {name for name, values in kinds.items() if len(values) > 1}
    assert several - OF_TWO_KINDS.keys() == set(), {name: kinds[name] for name in several}


def test_one_thing_has_one_name() -> None:
    names = defaultdict(set)
    for _, option in options():
        names[option.help].add(option.opts[0])
    assert {help: found for help, found in names.items() if len(found) > 1} == {}
