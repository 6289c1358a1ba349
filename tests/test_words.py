"""The vocabulary of names and docstrings: terms of the field, no metaphors or participles as nouns.

The number of a pattern is that of the legitimate uses that are left, such as `left` and `right` of
an operator; it may only fall.
"""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "rapidsim"
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)

OF_NAMES = {
    r"(^|_)(told|asked|given|found|said|kept|held|led|shown|taken|begun|heard|judged|watched"
    r"|mended|cured|stood|gone|drawn|made|left|known)$": 74,
    r"(^|_)(nobody|somebody|besides?|aside|together|apart|meanwhile|otherwise|instead|anew|alike"
    r"|there|here|outside|likewise)(_|$)": 15,
    r"(^|_)(who|whom|whose|why|what|where)(_|$)": 4,
    r"(^|_)(tells?|asks?|asking|says?|say|stands?|comes?|goes|looks?|wants?|hears?|talks?|lets?)"
    r"(_|$)": 19,
    r"(^|_)(ghosts?|seat|bell|chief|deeds?|honesty|meetings?|stretch(es)?|happenings?|cures?|ring"
    r"|reckoned|glance|life|ways?|people|offer)(_|$)": 5,
    r"^(one|ones|whole|others?)$": 28,
}
OF_FIRST_LINES = {
    r"^(What|How|Where|Who|Whose|Whom|So|Such|As|Of|In which|The same|Whatever|Whoever|Up to"
    r"|Beside|Beyond)\b": 4,
}


@cache
def trees() -> list[tuple[Path, ast.Module]]:
    return [
        (path, ast.parse(path.read_text(encoding="utf-8")))
        for path in sorted(PACKAGE.rglob("*.py"))
    ]


@cache
def names() -> list[str]:
    """Modules, classes, functions, parameters, and fields of classes."""
    found = []
    for path, module in trees():
        found.append(path.stem)
        for node in ast.walk(module):
            if isinstance(node, ast.ClassDef):
                found.append(node.name)
                found += [
                    part.target.id
                    for part in node.body
                    if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name)
                ]
            elif isinstance(node, FUNCTIONS):
                found.append(node.name)
                arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
                found += [one.arg for one in arguments]
    return found


def first_lines() -> Iterator[str]:
    """The first lines of docstrings, those of fields included."""
    for _, module in trees():
        for node in ast.walk(module):
            value = node.value if isinstance(node, ast.Expr) else None
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                yield value.value.lstrip().partition("\n")[0]


@pytest.mark.parametrize(("pattern", "most"), OF_NAMES.items())
def test_names_are_terms_of_the_field(pattern: str, most: int) -> None:
    hits = sorted(name for name in names() if re.search(pattern, name))
    assert len(hits) <= most, hits


@pytest.mark.parametrize(("pattern", "most"), OF_FIRST_LINES.items())
def test_docstrings_begin_with_a_noun_or_a_verb(pattern: str, most: int) -> None:
    hits = sorted(line for line in first_lines() if re.search(pattern, line))
    assert len(hits) <= most, hits


def test_a_public_class_has_its_name_alone() -> None:
    """But `Cell`, of the API and of the controller."""
    homes: dict[str, set[Path]] = {}
    for path, module in trees():
        for node in ast.walk(module):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes.setdefault(node.name, set()).add(path)
    assert [name for name, paths in homes.items() if len(paths) > 1] == ["Cell"]
