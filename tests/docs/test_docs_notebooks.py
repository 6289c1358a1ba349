"""The notebooks of the documentation: their cells run, and give the outputs that they show."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


def load_script() -> ModuleType:
    path = ROOT / "scripts" / "build_notebooks.py"
    spec = importlib.util.spec_from_file_location("build_notebooks", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def without_pictures(notebook: dict[str, Any]) -> list[object]:
    """The cells; of pictures only that they are there, for fonts differ."""
    for cell in notebook["cells"]:
        for output in cell.get("outputs", ()):
            if "image/png" in output.get("data", {}):
                output["data"]["image/png"] = "a picture"
    return list(notebook["cells"])


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_shows_what_its_cells_give(file: Path) -> None:
    notebook = json.loads(file.read_text(encoding="utf-8"))
    again = json.loads(json.dumps(load_script().executed(notebook)))
    assert without_pictures(again) == without_pictures(notebook), "run scripts/build_notebooks.py"


def test_there_are_notebooks() -> None:
    assert len(NOTEBOOKS) == 3
