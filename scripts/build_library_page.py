"""Write `docs/library.md` from the table of routines: `python scripts/build_library_page.py`."""

from __future__ import annotations

from pathlib import Path

from rapidsim.report.pages.library_page import library_page

PAGE = Path(__file__).parents[1] / "docs" / "library.md"


def main() -> None:
    """Write the page."""
    PAGE.write_text(library_page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
