"""Write generated pages of the documentation, and remove those that are generated no more."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from wrap_markdown import wrap

DOCS = Path(__file__).parents[1] / "docs"


def write_pages(pages: Mapping[str, str], folder: str) -> None:
    """Write pages by their paths below `docs`; a folder has no others afterwards."""
    (DOCS / folder).mkdir(exist_ok=True)
    for file in (DOCS / folder).glob("*.md"):
        if f"{folder}/{file.name}" not in pages:
            file.unlink()
    for name, text in pages.items():
        (DOCS / name).write_text(wrap(text), encoding="utf-8", newline="\n")
