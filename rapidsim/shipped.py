"""Location of the data that ship with rapidsim: the grammar, the robots, the rules.

An installation has them in the package. In a checkout `grammars/` and `robots/` are at the top of
the repository, where people look for them.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

_PACKAGE = Path(__file__).parent


def shipped(name: str) -> Path:
    """Return the folder of that name, in the package or in its parent folder."""
    inside = _PACKAGE / name
    return inside if inside.is_dir() else _PACKAGE.parent / name


def filled(page: str, parts: Mapping[str, str]) -> str:
    """Return a page that ships with `{{name}}` replaced by the parts of those names."""
    begin, *pieces = page.split("{{")
    parts_of_page = [begin]
    for piece in pieces:
        name, rest = piece.split("}}", 1)
        parts_of_page += [parts[name], rest]
    return "".join(parts_of_page)
