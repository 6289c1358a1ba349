"""The pictures of the concept pages show what the programs of these pages do now."""

import runpy
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
SCRIPT = runpy.run_path(str(ROOT / "scripts" / "build_concepts.py"))


def alike(one: Any, other: Any) -> bool:
    """The same words, and numbers that no eye tells apart."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(alike, one, other))
    if isinstance(one, float | int) and isinstance(other, float | int):
        return one == pytest.approx(other, rel=1e-3, abs=2e-3)
    return bool(one == other)


@pytest.mark.parametrize("name", SCRIPT["PICTURES"])
def test_a_picture_shows_what_is_drawn_now(name: str) -> None:
    shown = SCRIPT["written_content"](name)
    drawn = SCRIPT["content"](SCRIPT["figure_of"](name))
    assert alike(shown, drawn), "python scripts/build_concepts.py"
