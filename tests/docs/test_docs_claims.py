"""What pages claim of speed and size is listed in `benchmarks/stated.py`, which is measured."""

import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
_SPEC = importlib.util.spec_from_file_location("stated", ROOT / "benchmarks" / "stated.py")
assert _SPEC is not None
assert _SPEC.loader is not None
stated = importlib.util.module_from_spec(_SPEC)
sys.modules["stated"] = stated
_SPEC.loader.exec_module(stated)

PAGES = [(page, words) for claim in stated.STATED for page, words in claim.pages]


@pytest.mark.parametrize(("page", "words"), dict.fromkeys(PAGES))
def test_a_claim_stands_where_it_is_said_to(page: str, words: str) -> None:
    assert words in (ROOT / page).read_text(encoding="utf-8")


def test_every_figure_of_the_readme_s_table_is_listed() -> None:
    """But for fidelity and findings, which tests of their own hold to the logs and the corpus."""
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if line.startswith("| ") and "measured" not in line]
    others = ("| durations of ", "| errors found in one run ")
    listed = [words for page, words in PAGES if page == "README.md"]
    for row in rows:
        assert row.startswith(others) or any(words in row for words in listed), row
