"""The station file: what it says is taken, what it cannot say is refused by key."""

from math import radians
from pathlib import Path

import pytest

from rapidsim.files import InputError
from rapidsim.simulation.station import find_station, read_station


def station_file(folder: Path, text: str) -> Path:
    file = folder / "rapidsim.toml"
    file.write_text(text)
    return file


def test_everything_it_can_say_is_taken(tmp_path: Path) -> None:
    station = read_station(
        station_file(
            tmp_path,
            """
            [robot]
            model = "irb120"
            base = { position = [0, 0, 0], quaternion = [1, 0, 0, 0] }
            start = [0, 0, 0, 0, 30, 0]
            [motion]
            acceleration = [100, 200]
            filter_time = 0
            fine_dwell = 0.2
            corner = "parabola"
            [[task]]
            name = "T_ROB2"
            modules = ["Main.mod"]
            [check]
            ignore = ["S9"]
            """,
        )
    )
    assert station.robot == "irb120"
    assert station.start_joints_deg == (0.0, 0.0, 0.0, 0.0, 30.0, 0.0)
    assert station.model.acceleration == (radians(100.0), radians(200.0))
    assert (station.model.filter_time, station.model.fine_dwell) == (0.0, 0.2)
    assert station.model.corner == "parabola"
    assert (station.task, station.modules) == ("T_ROB2", (tmp_path / "Main.mod",))
    assert station.ignore == ("S9",)


def test_an_urdf_file_lies_beside_it(tmp_path: Path) -> None:
    station = read_station(station_file(tmp_path, '[robot]\nurdf = "my.urdf"\n'))
    assert station.robot == str(tmp_path / "my.urdf")


@pytest.mark.parametrize(
    ("text", "part", "help"),
    [
        ("[robot", "is not TOML", None),
        ("[robto]", "robto: no such key", "did you mean `robot`?"),
        ("[motion]\nfilter-time = 1", "motion.filter-time: no such key", "`filter_time`"),
        ('[robot]\nmodel = "a"\nurdf = "b"', "not both", None),
        ("[robot]\nmodel = 3", "robot.model: text in quotes", None),
        ("robot = 3", "robot: a table is needed", None),
        ('[robot]\nstart = ["a"]', "robot.start: a list of numbers", None),
        ("[robot]\nbase = { position = [1, 2] }", "robot.base.position: 3 numbers", None),
        ("[robot]\nbase = { position = [1, 2, 3] }", "not simulated yet", None),
        ("[robot]\nbase = { quaternion = [0, 1, 0, 0] }", "not simulated yet", None),
        ("[motion]\nacceleration_time = 0", "motion.acceleration_time: a number above 0", None),
        ("[motion]\nfine_dwell = -1", "motion.fine_dwell: a number that is not negative", None),
        ("[motion]\nfine_dwell = true", "motion.fine_dwell: a number", None),
        ("[motion]\nfine_dwell = nan", "motion.fine_dwell: a number", None),
        ("[motion]\nacceleration = [0]", "above 0", None),
        ('[motion]\ncorner = "round"', "`round` is neither `c2` nor `parabola`", None),
        ("[[task]]\n[[task]]", "several tasks are not simulated together yet", None),
        ("task = 3", "task: tasks are written as [[task]]", None),
        ("[signals]", "signals: signals cannot be declared", None),
        ("[[stimulus]]\nat = 1", "stimulus: inputs cannot be stimulated", None),
        ("[check]\ncycle-budget = 3", "cycle budgets are not checked yet", None),
    ],
)
def test_what_it_cannot_say_is_refused(
    text: str, part: str, help: str | None, tmp_path: Path
) -> None:
    with pytest.raises(InputError) as raised:
        read_station(station_file(tmp_path, text))
    assert part in raised.value.message
    assert "rapidsim.toml" in raised.value.message
    assert help is None or help in (raised.value.help or "")


def test_it_is_found_next_to_the_program_or_above(tmp_path: Path) -> None:
    cell = tmp_path / "line" / "cell"
    cell.mkdir(parents=True)
    program = cell / "a.mod"
    program.write_text("")
    above = station_file(tmp_path, "")
    assert find_station(["-", str(program)]) == above.resolve()
    beside = station_file(cell, "")
    assert find_station([str(program)]) == beside.resolve()
    assert find_station([str(cell)]) == beside.resolve()
