"""The site is built without a warning, has a place for every page, and generated pages are new."""

import re
import runpy
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rapidsim.station.object_tables import SHAPES
from rapidsim.station.read import TABLES

ROOT = Path(__file__).parents[2]
GENERATED = {
    "api.md": "build_api_page.py",
    "commands.md": "build_commands_page.py",
    "station_keys.md": "build_station_page.py",
}


def pages(entries: list[dict[str, Any]]) -> Iterator[str]:
    """The files of a navigation, from top to bottom."""
    for entry in entries:
        for value in entry.values():
            if isinstance(value, str):
                yield value
            else:
                yield from pages(value)


def test_every_page_has_one_place_in_the_navigation() -> None:
    settings = tomllib.loads((ROOT / "zensical.toml").read_text(encoding="utf-8"))
    shown = list(pages(settings["project"]["nav"]))
    assert len(shown) == len(set(shown))
    assert set(shown) == {page.name for page in (ROOT / "docs").glob("*.md")}


def test_the_site_is_built_without_a_warning(tmp_path: Path) -> None:
    """Links and anchors that lead nowhere are warnings, and warnings end a strict build."""
    shutil.copytree(ROOT / "docs", tmp_path / "docs")
    (tmp_path / "zensical.toml").write_bytes((ROOT / "zensical.toml").read_bytes())
    command = [str(Path(sys.executable).parent / "zensical"), "build", "--strict", "--clean"]
    built = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stdout + built.stderr
    assert "No issues found" in built.stdout + built.stderr
    for page in (ROOT / "docs").glob("*.md"):
        assert (tmp_path / "site" / page.with_suffix(".html").name).is_file()


@pytest.mark.parametrize("page", GENERATED)
def test_a_generated_page_is_what_the_source_says_now(page: str) -> None:
    script = runpy.run_path(str(ROOT / "scripts" / GENERATED[page]))
    written = (ROOT / "docs" / page).read_text(encoding="utf-8")
    assert written == script["page"](), f"python scripts/{GENERATED[page]}"


def test_the_page_of_keys_has_every_table_of_the_station_file() -> None:
    script = runpy.run_path(str(ROOT / "scripts" / GENERATED["station_keys.md"]))
    assert [*script["TABLES"]] == [*TABLES]


def test_every_key_of_the_station_file_has_a_meaning() -> None:
    page = (ROOT / "docs" / "station_keys.md").read_text(encoding="utf-8")
    targets = page[page.index("### Camera target") : page.index("### Sphere")]
    empty = [line for line in page.replace(targets, "").splitlines() if line.endswith("|  |")]
    assert not empty


def test_the_page_of_collisions_has_every_shape() -> None:
    page = (ROOT / "docs" / "collisions.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\| `(\w+) = ", page, re.MULTILINE)
    assert sorted(shown) == sorted(SHAPES)
