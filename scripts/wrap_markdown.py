"""Wrap the paragraphs of Markdown, so that a review shows the line that changed.

    python scripts/wrap_markdown.py [--check] [FILE ...]

A newline within a paragraph is rendered as a space. A paragraph or an item of a list in which a
line is longer than `WIDTH` is therefore filled anew, other ones stay as they are. Only paragraphs
are: code, tables, headings, quotes, HTML, definitions of links and front matter keep their lines.
Three things could change what is rendered, and none of them is done:

- to break within code, a tag or the target of a link, so these are one word;
- to begin a line with what opens a block, such as `-` or `1.`, so it follows the word before it;
- to join the lines of a hard break, so a line that ends in one ends a piece of the paragraph.

What was filled stays the same when it is filled again.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path

ROOT = Path(__file__).parents[1]
WIDTH = 120
SOURCES = (
    "*.md",
    "docs/**/*.md",
    "editors/*.md",
    "editors/vscode/*.md",
    "programs/**/*.md",
    "rapidsim/rules/*/page.md",
)

_CODE = r"(?P<ticks>`+)(?!`).+?(?<!`)(?P=ticks)(?!`)"
_WORD = re.compile(rf"(?:\\\S|{_CODE}|\]\([^)]*\)|<[^<>\s][^<>]*>|\S)+")
_OPENS_A_BLOCK = re.compile(
    r"([-+*]|\d+[.)]|#{1,6}|[=-]+|:|[>|<].*|(```|~~~|!!!|\?\?\?).*|\[.*\]:)$"
)
_FENCE = re.compile(r"\s*(```|~~~)")
_ITEM = re.compile(r" *([-*+]|\d+[.)]) +")
_VERBATIM = re.compile(r"\s*(#{1,6} |\||>|!!!|\?\?\?|(=+|-{2,}|\*{3,})\s*$|\[[^\]]+\]: )")
_HARD_BREAK = re.compile(r"(  +|\\)$")


def sources() -> Iterator[Path]:
    """All Markdown of the repository."""
    return (file for pattern in SOURCES for file in sorted(ROOT.glob(pattern)))


def wrap(text: str) -> str:
    """Return Markdown whose paragraphs have no longer lines than `WIDTH`, where words allow it."""
    return "\n".join(chain.from_iterable(_pieces(text.split("\n"))))


def _pieces(lines: Sequence[str]) -> Iterator[list[str]]:
    """The lines, paragraphs filled; one ends at its end, an item or a hard break."""
    piece: list[str] = []
    for line, is_text in zip(lines, _are_text(lines), strict=True):
        if piece and (not is_text or _ITEM.match(line)):
            yield _filled(piece)
            piece = []
        if is_text:
            piece.append(line)
        else:
            yield [line]
        if piece and _HARD_BREAK.search(line):
            yield _filled(piece)
            piece = []
    if piece:
        yield _filled(piece)


def _are_text(lines: Sequence[str]) -> Iterator[bool]:
    """Whether each line belongs to a paragraph."""
    verbatim_until: re.Pattern[str] | None = None
    content = 0
    in_paragraph = False
    for number, line in enumerate(lines):
        indent = len(line) - len(line.lstrip())
        if verbatim_until is not None:
            verbatim_until = None if verbatim_until.match(line) else verbatim_until
            is_text = False
        elif number == 0 and line == "---":
            verbatim_until, is_text = re.compile("---$"), False
        elif fence := _FENCE.match(line):
            verbatim_until, is_text = re.compile(rf"\s*{fence[1]}\s*$"), False
        elif line.lstrip().startswith("<"):
            verbatim_until, is_text = re.compile(r"\s*$"), False
        elif item := _ITEM.match(line):
            content, is_text = len(item[0]), indent < content + 4
        elif not line.strip() or _VERBATIM.match(line):
            is_text = False
        else:
            is_text = in_paragraph or indent < content + 4
            content = content if in_paragraph or indent else 0
        in_paragraph = is_text
        yield is_text


def _filled(piece: list[str]) -> list[str]:
    if max(map(len, piece)) <= WIDTH:
        return piece
    item = _ITEM.match(piece[0])
    first = item[0] if item else piece[0][: len(piece[0]) - len(piece[0].lstrip())]
    end = found[0] if (found := _HARD_BREAK.search(piece[-1])) else ""
    text = " ".join([piece[0][len(first) :].strip(), *(line.strip() for line in piece[1:])])
    filled = _fill(_words(text.removesuffix(end).rstrip()), WIDTH - len(first))
    filled[-1] += end
    return [first + filled[0], *(" " * len(first) + line for line in filled[1:])]


def _words(text: str) -> list[str]:
    """What no line is broken within; what opens a block belongs to the word before it."""
    words: list[str] = []
    for match in _WORD.finditer(text):
        if words and _OPENS_A_BLOCK.match(match[0]):
            words[-1] += f" {match[0]}"
        else:
            words.append(match[0])
    return words


def _fill(words: Sequence[str], width: int) -> list[str]:
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + 1 + len(word) <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def main() -> None:
    """Wrap files, or with `--check` print the lines that are too long and exit with 1."""
    parser = argparse.ArgumentParser(description="Wrap Markdown.")
    parser.add_argument("files", nargs="*", type=Path, help="all of the repository without any")
    parser.add_argument("--check", action="store_true", help="change nothing")
    arguments = parser.parse_args()
    is_wrapped = True
    for file in arguments.files or sources():
        text = file.read_text(encoding="utf-8")
        if (result := wrap(text)) == text:
            continue
        is_wrapped = False
        if not arguments.check:
            file.write_text(result, encoding="utf-8", newline="\n")
            continue
        kept = set(result.split("\n"))
        for number, line in enumerate(text.split("\n"), 1):
            if len(line) > WIDTH and line not in kept:
                print(f"{file}:{number}: {len(line)} characters")
    sys.exit(arguments.check and not is_wrapped)


if __name__ == "__main__":
    main()
