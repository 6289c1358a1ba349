"""Lines break between words, never between a number and its unit."""

import pytest
from rich.console import Console

from rapidsim.report.unbreakable_units import UnbreakableUnits


@pytest.mark.parametrize("width", range(12, 60))
def test_a_number_keeps_its_unit_at_any_width(width: int) -> None:
    said = "a.mod ended as programmed after 11.463 s, 5155.1 mm travelled, 30 % and 9 deg left"
    console = Console(width=width)
    with console.capture() as capture:
        console.print(UnbreakableUnits(said))
    lines = capture.get().splitlines()
    assert " ".join(" ".join(lines).split()) == said
    assert all(len(line.rstrip()) <= width for line in lines)
    for quantity in ("11.463 s", "5155.1 mm", "30 %", "9 deg"):
        assert any(quantity in line for line in lines)
