"""The page on the example programs names all of them."""

import re
from pathlib import Path

PROGRAMS = Path(__file__).parents[2] / "programs"


def test_every_example_has_its_line() -> None:
    text = (PROGRAMS / "README.md").read_text(encoding="utf-8")
    named = set(re.findall(r"^\| \[([^]]+)\]", text, re.MULTILINE))
    modules = {file.name for file in PROGRAMS.glob("*.mod")}
    folders = {folder.name for folder in PROGRAMS.iterdir() if any(folder.glob("*.toml"))}
    assert named == modules | folders
    assert set(re.findall(r"\]\(\.\./(docs/[\w./-]+)\)", text)) <= {
        file.relative_to(PROGRAMS.parent).as_posix()
        for file in (PROGRAMS.parent / "docs").rglob("*.*")
    }
