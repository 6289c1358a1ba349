"""A tree with some of its nodes replaced."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from operator import is_
from typing import Any

from rapidsim.syntax import tree


def rebuilt(part: Any, instead: Mapping[int, tree.Node]) -> Any:
    """A subtree with some of its nodes replaced, matched by identity.

    Subtrees that contain none of them remain the same objects.
    """
    if isinstance(part, tuple):
        parts = tuple(rebuilt(one, instead) for one in part)
        return part if all(map(is_, part, parts)) else parts
    if not is_dataclass(part) or isinstance(part, type):
        return part
    if id(part) in instead:
        return instead[id(part)]
    old = {one.name: getattr(part, one.name) for one in fields(part) if one.init}
    new = {name: rebuilt(value, instead) for name, value in old.items()}
    changed = {name: value for name, value in new.items() if value is not old[name]}
    return replace(part, **changed) if changed else part
