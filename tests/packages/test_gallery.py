"""The gallery of the published site: pages with recordings, their reports, and an index."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

pytestmark = pytest.mark.packages
SCRIPTS = Path(__file__).parents[2] / "scripts"


def test_every_link_of_the_gallery_leads_to_a_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    gallery = import_module("build_gallery")
    shown = {name: gallery.RUNS[name] for name in ("circle", "out_of_reach")}
    monkeypatch.setattr(gallery, "RUNS", shown)
    monkeypatch.setattr(sys, "argv", ["build_gallery.py", str(tmp_path / "site" / "gallery")])
    gallery.main()
    folder = tmp_path / "site" / "gallery"
    page = (folder / "index.html").read_text(encoding="utf-8")
    links = set(re.findall(r'(?:href|src)="([^"]+)"', page))
    recordings, reports = {f"{one}/index.html" for one in shown}, {f"{one}.html" for one in shown}
    assert links == recordings | reports | {f"{one}-2.png" for one in shown}
    assert all((folder / one).stat().st_size > 10_000 for one in links)
    assert "{{" not in page
