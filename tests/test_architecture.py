"""The house is as ARCHITECTURE.md draws it, and each folder says what it promises."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "rapidsim"
PAGE = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
FOLDERS = sorted(path.parent for path in PACKAGE.rglob("__init__.py") if path.parent != PACKAGE)
DOORS = {PACKAGE / "cli", PACKAGE / "syntax" / "tree"}
"""Folders whose `__init__` hands out names too."""
ENTRIES = [" ".join(text.split()) for text in re.split(r"\n(?=- |\d+\. |\n)", PAGE)]
"""Paragraphs and items of lists, each as one line."""
ROWS = {
    room: entry
    for entry in ENTRIES
    if entry.startswith("- `")
    for room in re.findall(r"`(\w+)/`", entry.split(": ")[0])
}
"""The entries of the list of rooms, by room."""
BASES = (ROOT, PACKAGE)
PATH = re.compile(r"`([\w./-]+/|[\w./-]+\.(?:py|md|toml|lark|txt))`")


def named(folder: Path) -> str:
    return folder.relative_to(PACKAGE).as_posix()


@pytest.mark.parametrize("folder", FOLDERS, ids=named)
def test_a_folder_promises_one_line(folder: Path) -> None:
    module = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    promise = ast.get_docstring(module) or ""
    assert promise.partition("\n")[0].endswith((".", ":"))
    if folder not in DOORS:
        assert "\n" not in promise
        assert len(module.body) == 1


@pytest.mark.parametrize("folder", FOLDERS, ids=named)
def test_the_page_names_every_folder(folder: Path) -> None:
    room, *within = folder.relative_to(PACKAGE).parts
    assert room in ROWS
    assert all(f"`{name}/`" in ROWS[room] for name in within)


def test_whatever_the_page_names_exists() -> None:
    room_of = {row: PACKAGE / room for room, row in ROWS.items()}
    missing = [
        name
        for line in ENTRIES
        for name in PATH.findall(line)
        if not any((base / name).exists() for base in (*BASES, room_of.get(line, ROOT)))
        and not any(room_of.get(line, ROOT / "tests").rglob(name))
        and name not in ("__init__.py", "rules/CODE-name/")
    ]
    assert not missing
