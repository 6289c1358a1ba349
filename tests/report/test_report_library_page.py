"""`docs/library.md` and `docs/library/` are what the table of routines says now."""

from pathlib import Path

from wrap_markdown import wrap

from rapidsim.library.catalogue import ROUTINES
from rapidsim.report.pages.library_page import library_pages, signature_text

DOCS = Path(__file__).parents[2] / "docs"


def test_the_pages_are_current() -> None:
    names = {"library.md", *(f"library/{file.name}" for file in (DOCS / "library").iterdir())}
    written = {name: (DOCS / name).read_text("utf-8") for name in names}
    pages = {name: wrap(page) for name, page in library_pages().items()}
    assert written == pages, "run `python scripts/build_library_page.py`"


def test_every_routine_has_one_entry() -> None:
    lines = [line for page in library_pages().values() for line in page.splitlines()]
    for row in ROUTINES.values():
        assert lines.count(f"- `{signature_text(row)}`  ") == 1, row.name


def test_a_signature_is_written_as_rapid_writes_it() -> None:
    assert signature_text(ROUTINES["setdo"]) == (
        r"PROC SetDO(\num SDelay | switch Sync, VAR signaldo Signal, dionum Value)"
    )
    assert signature_text(ROUTINES["strlen"]) == "FUNC num StrLen(string Str)"
