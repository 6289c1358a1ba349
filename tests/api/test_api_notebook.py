"""Results in a notebook: cards of HTML, and pictures as figures."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure

import rapidsim
from rapidsim.notebook import card, line_drawing

CELL = Path(__file__).parents[2] / "programs" / "cell"


@pytest.fixture(scope="module")
def run() -> rapidsim.Run:
    return rapidsim.load(CELL).run()


def test_cards_of_results(run: rapidsim.Run) -> None:
    cards = {
        "run": run._repr_html_(),
        "check": rapidsim.load(CELL).check()._repr_html_(),
        "robot": rapidsim.load_robot("irb910sc-3-0.65")._repr_html_(),
    }
    for html in cards.values():
        ElementTree.fromstring(html)
        assert len(html) < 10_000
    assert f'<td style="text-align:left;vertical-align:top">{run.time_s:.3f} s</td>' in cards["run"]
    assert "<polyline" in cards["run"]
    assert "8 of 8" in cards["check"]
    assert "M502" in cards["check"]
    assert "1020 mm/s" in cards["robot"]


def test_a_card_is_small_and_escapes_what_it_shows() -> None:
    rows = [(f"<{number}>", "x" * 1000) for number in range(25)]
    html = card("a & b", {"c": "<d>"}, heads=("e", "f"), rows=rows)
    root = ElementTree.fromstring(html)
    assert len(root.findall(".//tr")) == 1 + 1 + 10
    assert "and 15 more" in html
    assert len(html) < 5_000
    assert not re.search(r"<\d", html)


def test_a_line_keeps_its_proportions() -> None:
    points = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)]
    assert 'points="4.0,120.0 236.0,120.0 236.0,4.0"' in line_drawing(points, "a line")
    assert line_drawing(points[:1], "a place") == ""
    assert "nan" not in line_drawing(points[:1] * 2, "a place")


def test_pictures_are_figures(run: rapidsim.Run) -> None:
    assert isinstance(run.plot("speed", dark=True), Figure)
    with pytest.raises(rapidsim.InputError, match="no picture `sped`") as refused:
        run.plot("sped")
    assert refused.value.help == "did you mean `speed`?"
    with pytest.raises(rapidsim.InputError, match="nothing for the picture `clearance`"):
        run.plot("clearance")
