"""What pages say of speed and size is measured by a benchmark, and nothing else is said."""

import re
import runpy
from pathlib import Path
from typing import Any

import pytest
from docs_snippets import paragraphs

ROOT = Path(__file__).parents[2]
STATED: tuple[Any, ...] = runpy.run_path(str(ROOT / "benchmarks" / "stated.py"))["STATED"]
GENERATED = {"api.md", "commands.md", "library.md", "rules.md"}
PAGES = [
    ROOT / "README.md",
    *sorted(page for page in (ROOT / "docs").glob("*.md") if page.name not in GENERATED),
]
_NUMBER = r"(\d[\d,.]*|two|three|four|five|ten|hundred|thousand)"
FIGURE = re.compile(
    rf"{_NUMBER} (\w+ )?times (as fast|faster|slower)|slower than Python|\d (MB|GB|kB)\b"
    rf"|{_NUMBER} \w+ (a|per) second|tenth of the time|of a second to start|percentile"
)
NO_CLAIMS = (
    # Limits, and sizes of what others make.
    *(
        "beyond 200 MB",
        "The limit is 50 MB",
        "more than 200 MB",
        "at most 1 GB",
        "limited to 64 MB",
        "may write 1 GB in total",
        "| 1 GB, 10,000, 100 |",
        "at most 500 MB in total",
        "| 500 MB | 1, before it runs |",
        "a program has 2 GB of memory",
        "on Linux with 2 GB of memory",
    ),
    "a container of about 900 MB",
    # The tests of packages hold these.
    *("The wheel has 8 MB", "everything takes 1.4 GB", "scipy 140 MB"),
)


SLOTS = {
    **{"100 small modules": "{name}", "100,000 moves": "{name}"},
    **{"planned, in NumPy": "planned, {way}", "planned, with numba": "planned, {way}"},
}
"""Claims that are measured alike are named so."""


def _with_figures() -> list[Any]:
    return [
        pytest.param(page, text, id=f"{page.name}-{number}")
        for page in PAGES
        for number, text in enumerate(paragraphs(page), 1)
        if FIGURE.search(text)
    ]


@pytest.mark.parametrize(("page", "text"), _with_figures())
def test_a_figure_has_its_benchmark(page: Path, text: str) -> None:
    name = page.relative_to(ROOT).as_posix()
    known = [words for one in STATED for where, words in one.pages if where == name]
    for words in (*known, *NO_CLAIMS):
        text = text.replace(words, "")
    assert not FIGURE.search(text), "add it to benchmarks/stated.py and measure it in claims.py"


@pytest.mark.parametrize("claim", STATED, ids=lambda one: one.what.strip())
def test_a_claim_stands_where_it_is_said_to_and_is_measured(claim: Any) -> None:
    for page, words in claim.pages:
        assert any(words in text for text in paragraphs(ROOT / page))
    assert claim.most is not None or claim.least is not None
    assert not (claim.holds(float("inf")) and claim.holds(float("-inf")))
    measuring = (ROOT / "benchmarks" / "claims.py").read_text(encoding="utf-8")
    named = claim.what
    for several, slot in SLOTS.items():
        if f'"{several.removeprefix("planned, ")}"' in measuring:
            named = named.replace(several, slot)
    assert f'"{named}"' in measuring
