"""A recording as a page: what a browser without network or server shows of it."""

from __future__ import annotations

import asyncio
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from browser import CHROMIUM, opened
from PIL import Image
from recording_cell import cell

from rapidsim.recording.layout.write import record
from rapidsim.recording.page.write_page import write_page

ORANGE = np.array([240, 120, 30])
"""Colour of the arm, in full light."""


def share_of_orange(picture: bytes) -> float:
    """Share of a picture that is nearly of the arm's hue."""
    pixels = np.asarray(Image.open(BytesIO(picture)).convert("RGB"), dtype=float)
    lights = pixels.max(axis=-1)
    hues = pixels / np.maximum(lights, 1.0)[..., None]
    alike = np.abs(hues - ORANGE / ORANGE.max()).max(axis=-1) < 0.15
    return float(np.mean(alike & (lights > 60.0)))


@pytest.mark.screen
@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium")
def test_a_browser_shows_the_arm_and_fetches_nothing(tmp_path: Path) -> None:
    page = write_page(record(cell(), tmp_path / "cell.rrd"), tmp_path / "page")
    assert (page.parent / "THIRD_PARTY_NOTICES.md").stat().st_size > 10_000
    picture = tmp_path / "page.png"

    async def look() -> object:
        async with opened(f"{page.as_uri()}?renderer=webgl", tmp_path, webgl=True) as browser:
            await browser.until("!document.getElementById('state')")
            for _ in range(30):
                await browser.picture(picture, 1200, 800)
                if share_of_orange(picture.read_bytes()) > 0.01:
                    break
            return await browser.value(
                "[document.title, performance.getEntriesByType('resource').length]"
            )

    assert asyncio.run(look()) == ["cell", 0]
    assert share_of_orange(picture.read_bytes()) > 0.01
