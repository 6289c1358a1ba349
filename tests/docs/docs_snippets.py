"""The snippets of a page: what is fenced, in which language, and how it is marked.

A mark is a comment on the line before the fence, which no reader sees:

| mark | says |
|---|---|
| `<!-- exits: 1 -->` | the last command of the block ends with this code, not with 0 |
| `<!-- not run: REASON -->` | the block is not executed, and why: a viewer, a network, ... |
| `<!-- edit FILE: OLD -> NEW -->` | not before a fence: what the text tells the reader to change |

| fence | what becomes of it |
|---|---|
| `sh` | each line is executed: `rapidsim` commands, with comments, `\\` at the end, `|` and `>` |
| `python` | executed, in one namespace a page |
| `text` behind one of these | must be what it printed; `...` stands for anything |
| `rapid` | parsed; with a title, a file beside the commands, else perhaps statements alone |
| `powershell` | marked as not run |
| `toml`, `ini`, `yaml`, `json` | read; TOML without a title as a station file, with one a file |
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
GENERATED = ("library.md", "rules.md", "commands.md", "api.md")
"""Written from the source, which other tests execute: programs of rules, docstrings, usage."""
PAGES = [
    ROOT / "README.md",
    ROOT / "programs" / "README.md",
    *(page for page in sorted((ROOT / "docs").glob("*.md")) if page.name not in GENERATED),
]

_EDIT = r"<!-- edit (?P<file>\S+): (?P<old>.+?) -> (?P<new>.+?) -->$"
_FENCE = re.compile(
    rf"^(?:{_EDIT}|(?:<!-- (?P<mark>[^\n]*?) -->\n)?"
    r"```(?P<language>\w*)(?: title=\"(?P<title>[^\"\n]+)\")?\n(?P<text>.*?)^```$)",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True)
class Snippet:
    language: str
    text: str
    title: str | None
    exits: int
    not_run: str | None
    line: int
    whole: str
    """As it stands in the page, with its fence."""


@dataclass(frozen=True)
class Edit:
    """What a reader is told to change in a file."""

    file: str
    old: str
    new: str
    line: int


def snippets(page: Path) -> Iterator[Snippet | Edit]:
    """What a page fences, and has its reader do, from top to bottom."""
    shown = page.read_text(encoding="utf-8")
    for fence in _FENCE.finditer(shown):
        line = shown.count("\n", 0, fence.start()) + 1
        if fence["file"]:
            yield Edit(fence["file"], fence["old"], fence["new"], line)
            continue
        name, _, words = (fence["mark"] or "").partition(": ")
        assert name in ("", "exits", "not run"), f"{page.name}: unknown mark {name}"
        assert name == "" or words, f"{page.name}: {name} says nothing"
        yield Snippet(
            language=fence["language"],
            text=fence["text"],
            title=fence["title"],
            exits=int(words) if name == "exits" else 0,
            not_run=words if name == "not run" else None,
            line=line,
            whole=fence[0],
        )


def paragraphs(page: Path) -> list[str]:
    """Paragraphs, items of lists and rows of tables, each as one line."""
    parts = re.split(r"\n(?=\s*(?:[-*] |\d+\. |\||\n))", page.read_text(encoding="utf-8"))
    return [" ".join(part.split()) for part in parts]


def commands(text: str) -> Iterator[str]:
    """The lines of a block of commands; one that ends in a backslash goes on."""
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip() and not line.lstrip().startswith("#"):
            yield line


def printed_as(shown: str, printed: str) -> bool:
    """Whether something printed is what a page shows; `...` stands for anything."""
    parts = [re.escape(part) for part in shown.strip().split("...")]
    return re.fullmatch(".*".join(parts), printed.strip(), re.DOTALL) is not None
