"""Markdown has lines of at most `WIDTH` characters wherever a paragraph can be broken."""

import pytest
from wrap_markdown import WIDTH, wrap

WORDS = " ".join(["word"] * 60)
LONG = "x" * (WIDTH - 2)


def test_a_paragraph_is_filled_once() -> None:
    filled = wrap(f"short\n{WORDS}\n\nnext\nparagraph\n")
    assert all(len(line) <= WIDTH for line in filled.splitlines())
    assert filled.endswith("\n\nnext\nparagraph\n")
    assert filled.split() == f"short {WORDS} next paragraph".split()
    assert wrap(filled) == filled


def test_an_item_is_filled_below_its_text() -> None:
    first, *rest, second = wrap(f"12. {WORDS}\n- next\n").rstrip("\n").split("\n")
    assert first.startswith("12. word")
    assert rest
    assert all(line.startswith("    word") for line in rest)
    assert second == "- next"


@pytest.mark.parametrize(
    "text",
    [
        f"```text\n{WORDS}\n```",
        f"- item\n\n  ```text\n{WORDS}\n  ```",
        f"paragraph\n\n    {WORDS}",
        f"| {WORDS} |",
        f"# {WORDS}",
        f"> {WORDS}",
        f"<p>\n{WORDS}\n</p>",
        f"<!-- edit a.mod: {WORDS} -> x -->",
        f"[name]: {WORDS}",
        f"---\ntitle: {WORDS}\n---",
        f"- `{WORDS}`  \n  text",
    ],
)
def test_other_lines_stay(text: str) -> None:
    assert wrap(text) == text


@pytest.mark.parametrize("whole", ["`a b`", "``a ` b``", "[x](y 'a b')", '<a href="a b">', "a - b"])
def test_what_is_rendered_otherwise_when_broken_stays_whole(whole: str) -> None:
    filled = wrap(f"{'x' * (WIDTH - 2)} {whole} {WORDS}")
    assert whole in filled
    assert wrap(filled) == filled


def test_lines_of_a_hard_break_are_not_joined() -> None:
    assert wrap(f"{LONG} xx  \nnext") == f"{LONG}\nxx  \nnext"
