"""The published schemas are what the declarations of the records say now."""

from pathlib import Path
from types import ModuleType

import pytest

from rapidsim.shipped import shipped

SCRIPTS = Path(__file__).parents[2] / "scripts"


@pytest.fixture
def generator(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    found = pytest.importorskip("build_schemas", reason="scripts/ is not part of a wheel")
    assert isinstance(found, ModuleType)
    return found


def test_the_schemas_are_current(generator: ModuleType) -> None:
    message = "run `python scripts/build_schemas.py`"
    published = {file.stem: file.read_text("utf-8") for file in shipped("schemas").iterdir()}
    assert dict(generator.schemas()) == published, message
