"""The page about motion: its station file is read as it stands."""

import re
from pathlib import Path

import pytest

from rapidsim.station.read import read_station

PAGE = Path(__file__).parents[2] / "docs" / "motion.md"


def test_the_station_file_of_the_page_is_right(tmp_path: Path) -> None:
    block = re.search(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert block is not None
    file = tmp_path / "rapidsim.toml"
    file.write_text(block[1], encoding="utf-8")
    station = read_station(file)
    track, table = station.external_axes
    assert (track.component, track.carries, track.max_acceleration) == ("eax_a", "robot", 3.0)
    assert table.world_from_user.translation == pytest.approx([1.2, 0.0, 0.6])
    assert station.units == ("TRACK", "STN1")
