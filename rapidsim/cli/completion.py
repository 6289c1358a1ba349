"""Shell completion: the possible values of a parameter, by its metavar."""

from __future__ import annotations

import re
from collections.abc import Iterable
from copy import copy

import click
from click.shell_completion import CompletionItem, shell_complete

from rapidsim.cli.group import commands
from rapidsim.shipped import shipped

COMPLETE = "_RAPIDSIM_COMPLETE"
"""Environment variable by which a shell requests completions; see click's page."""

_FILE = re.compile(r"\b(?:PATH|FILE|LOG|JOB|POINTS)\b|^[AB]$")
_FOLDER = re.compile(r"\bDIR\b")
_CODES = re.compile(r"\bCODES?\b")
_ROBOT = re.compile(r"^NAME\|FILE\.urdf$")


def complete(instruction: str) -> int:
    """Answer a shell; returns the exit code."""
    return shell_complete(
        _CompletingGroup("rapidsim", commands), {}, "rapidsim", COMPLETE, instruction
    )


class _CompletingGroup(click.Group):
    """A group whose commands know what their parameters take."""

    def __init__(self, name: str | None, group: click.Group) -> None:
        super().__init__(name, params=group.params)
        self._group = group

    def list_commands(self, ctx: click.Context) -> list[str]:
        return self._group.list_commands(ctx)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        command = self._group.get_command(ctx, cmd_name)
        if isinstance(command, click.Group):
            return _CompletingGroup(cmd_name, command)
        if command is not None:
            command = copy(command)
            command.params = [_with_completion(param, cmd_name) for param in command.params]
        return command


def _with_completion(param: click.Parameter, command: str) -> click.Parameter:
    metavar = param.metavar or (isinstance(param, click.Argument) and (param.name or "").upper())
    if not metavar or isinstance(param.type, click.Choice):
        return param
    param = copy(param)
    is_robot = _ROBOT.search(metavar) or (command, metavar) == ("robots", "NAME")
    param.type = _MetavarType(metavar, bool(is_robot))
    return param


class _MetavarType(click.types.StringParamType):
    """A parameter with the completions of its metavar."""

    def __init__(self, metavar: str, is_robot: bool) -> None:
        self._metavar = metavar
        self._is_robot = is_robot

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        found = []
        # Printed before the words: it clears the completions that a shell has.
        if _FILE.search(self._metavar):
            found.append(CompletionItem(incomplete, type="file"))
        if _FOLDER.search(self._metavar):
            found.append(CompletionItem(incomplete, type="dir"))
        if self._is_robot:
            found += _beginning(incomplete, (one.name for one in shipped("robots").glob("*-*")))
        if _CODES.search(self._metavar):
            # Of several the last is begun.
            before, comma, last = incomplete.rpartition(",")
            codes = (one.name.partition("-")[0] for one in shipped("rules").glob("*-*"))
            found += _beginning(last, codes, f"{before}{comma}")
        return found


def _beginning(incomplete: str, words: Iterable[str], before: str = "") -> list[CompletionItem]:
    fit = (word for word in words if word.startswith(incomplete))
    return [CompletionItem(before + word) for word in sorted(fit)]
