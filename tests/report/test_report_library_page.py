"""`docs/library.md` is what the table of routines says now."""

from pathlib import Path

from rapidsim.library.catalogue import ROUTINES
from rapidsim.report.pages.library_page import library_page, signature_text

PAGE = Path(__file__).parents[2] / "docs" / "library.md"


def test_the_page_is_current() -> None:
    message = "run `python scripts/build_library_page.py`"
    assert PAGE.read_text("utf-8") == library_page(), message


def test_every_routine_has_one_entry() -> None:
    lines = library_page().splitlines()
    for row in ROUTINES.values():
        assert lines.count(f"- `{signature_text(row)}`  ") == 1, row.name


def test_a_signature_is_written_as_rapid_writes_it() -> None:
    assert signature_text(ROUTINES["setdo"]) == (
        r"PROC SetDO(\num SDelay | switch Sync, VAR signaldo Signal, dionum Value)"
    )
    assert signature_text(ROUTINES["strlen"]) == "FUNC num StrLen(string Str)"
