"""`scripts/code_server.py`, for tests: what it lacks makes them skip."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

_PATH = Path(__file__).parents[1] / "scripts" / "code_server.py"


def _loaded() -> ModuleType:
    spec = importlib.util.spec_from_file_location("code_server", _PATH)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["code_server"] = module
    spec.loader.exec_module(module)
    return module


SCRIPT: Any = _loaded()


def or_skip(function: Callable[[Path], Any], folder: Path) -> Any:
    """Call a function of the script; skip the test, with the reason, where it cannot work."""
    try:
        return function(folder)
    except SCRIPT.UnavailableError as missing:
        pytest.skip(str(missing))
