"""Write the pages of the library, `docs/library.md` and `docs/library/`, from the source.

python scripts/build_library_page.py
"""

from __future__ import annotations

from pages_of_folder import write_pages

from rapidsim.report.pages.library_page import library_pages


def main() -> None:
    """Write the pages."""
    write_pages(library_pages(), "library")


if __name__ == "__main__":
    main()
