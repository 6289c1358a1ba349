"""A tree with some of its nodes replaced."""

from __future__ import annotations

from collections.abc import Container, Mapping
from dataclasses import fields, is_dataclass, replace
from operator import is_
from typing import Any

from rapidsim.syntax import tree


def rebuilt(part: Any, replacements: Mapping[int, tree.Node]) -> Any:
    """A subtree with some of its nodes replaced, matched by identity.

    Subtrees that contain none of them remain the same objects.
    """
    if isinstance(part, tuple):
        parts = tuple(rebuilt(one, replacements) for one in part)
        return part if all(map(is_, part, parts)) else parts
    if not is_dataclass(part) or isinstance(part, type):
        return part
    if id(part) in replacements:
        return replacements[id(part)]
    old = {one.name: getattr(part, one.name) for one in fields(part) if one.init}
    new = {name: rebuilt(value, replacements) for name, value in old.items()}
    changed = {name: value for name, value in new.items() if value is not old[name]}
    return replace(part, **changed) if changed else part


def without_runs(file: tree.File, replaced: Container[int]) -> tree.File:
    """A file without the runs represented by statements that are to be replaced.

    Args:
        file: The file.
        replaced: Identities of the statements.
    """
    modules = tuple(
        replace(module, runs=tuple(run for run in module.runs if id(run.like) not in replaced))
        if module.runs
        else module
        for module in file.modules
    )
    return replace(file, modules=modules) if any(one.runs for one in file.modules) else file
