"""Recipes for editors: short, complete, and readable by the editor's own format."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from rapidsim.module_files import MODULE_SUFFIXES

ROOT = Path(__file__).parents[2]
RECIPES = sorted(path for path in (ROOT / "editors").iterdir() if path.is_file())


@pytest.mark.parametrize("recipe", RECIPES, ids=lambda path: path.name)
def test_a_recipe_is_short_and_names_what_it_needs(recipe: Path) -> None:
    text = recipe.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 40
    assert 'pip install "rapidsim[edit]"' in text
    assert "lsp" in text
    assert [one for one in MODULE_SUFFIXES if one[1:] not in text] == []
    assert recipe.name in (ROOT / "docs" / "editor.md").read_text(encoding="utf-8")


def test_recipes_can_be_read() -> None:
    helix = tomllib.loads((ROOT / "editors" / "helix.toml").read_text(encoding="utf-8"))
    assert helix["language-server"]["rapidsim"]["args"] == ["lsp"]
    lines = (ROOT / "editors" / "sublime.json").read_text(encoding="utf-8").splitlines()
    sublime = json.loads("\n".join(line for line in lines if not line.startswith("//")))
    assert sublime["clients"]["rapidsim"]["command"] == ["rapidsim", "lsp"]
