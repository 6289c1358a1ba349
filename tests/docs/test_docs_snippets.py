"""Whatever the pages show as Python runs, and prints what they say it prints."""

import contextlib
import io
import os
import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    page for page in (ROOT / "docs").glob("*.md") if "```python" in page.read_text(encoding="utf-8")
)
BLOCK = re.compile(
    r"^```(?P<language>\w+)(?: title=\"(?P<title>[^\"]+)\")?\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_python_on_a_page_prints_what_the_page_says(page: Path, tmp_path: Path) -> None:
    """Blocks run in order, in one namespace; a block with a title is a file beside them.

    `UPDATE_GOLDEN=1` writes what they print into the page.
    """
    shutil.copytree(ROOT / "programs", tmp_path / "programs")
    shown = page.read_text(encoding="utf-8")
    space: dict[str, object] = {"__name__": "page"}
    printed: str | None = None
    told = shown
    with contextlib.chdir(tmp_path):
        for block in BLOCK.finditer(shown):
            text = block["text"]
            if block["title"]:
                Path(block["title"]).write_text(text, encoding="utf-8")
            elif block["language"] == "python":
                out = io.StringIO()
                with contextlib.redirect_stdout(out):
                    exec(compile(text, str(page), "exec"), space)
                printed = out.getvalue()
            elif block["language"] == "text" and printed is not None:
                if os.environ.get("UPDATE_GOLDEN"):
                    told = told.replace(block[0], f"```text\n{printed}```", 1)
                else:
                    assert printed == text
                printed = None
    if told != shown:
        page.write_text(told, encoding="utf-8")
