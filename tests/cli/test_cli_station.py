"""The station file: what it says is taken, what it cannot say is refused by key."""

import json
import re
from math import radians
from pathlib import Path

import pytest
from cli_helper import rapidsim

from rapidsim.files import InputError
from rapidsim.shipped import shipped
from rapidsim.station.read import read_station
from rapidsim.station.station import find_station


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
            smoothing = "axes"
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
    assert (station.model.corner, station.model.smoothing) == ("parabola", "axes")
    assert (station.task, station.modules) == ("T_ROB2", (tmp_path / "Main.mod",))
    assert station.check.ignore == ("S9",)


def test_an_urdf_file_lies_beside_it(tmp_path: Path) -> None:
    station = read_station(station_file(tmp_path, '[robot]\nurdf = "my.urdf"\n'))
    assert station.robot == str(tmp_path / "my.urdf")


TURNS = """MODULE turns
  PROC main()
    MoveAbsJ [[20,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def in_millimetres(tmp_path: Path) -> Path:
    """A folder with a program and an IRB 120 whose description has its lengths in mm."""
    text = shipped("robots/irb120-3-0.58/irb120-3-0.58.urdf").read_text()

    def longer(found: re.Match[str]) -> str:
        return f'<origin xyz="{" ".join(str(1000.0 * float(x)) for x in found[1].split())}"'

    (tmp_path / "arm.urdf").write_text(re.sub(r'<origin xyz="([^"]*)"', longer, text))
    (tmp_path / "turns.mod").write_text(TURNS)
    return tmp_path


def test_an_arm_in_millimetres_runs_and_is_checked_when_it_is_scaled(in_millimetres: Path) -> None:
    def path_mm(*arguments: str) -> float:
        ended = rapidsim(
            *("run", "turns.mod", *arguments, "--no-record", "--format", "json"),
            cwd=in_millimetres,
        )
        return float(json.loads(ended.out)["path_mm"])

    plain = path_mm("--robot", "irb120")
    assert path_mm("--robot", "arm.urdf", "--scale", "0.001") == pytest.approx(plain)
    station_file(in_millimetres, '[robot]\nurdf = "arm.urdf"\nscale = 0.001\n')
    assert path_mm() == pytest.approx(plain)
    for command in (("check", "turns.mod"), ("frames", "turns.mod")):
        assert rapidsim(*command, cwd=in_millimetres).code == 0
    named = ("--robot", "arm.urdf", "--scale", "0.001")
    joints = ("--joints", "20,10,0,0,30,0", "--format", "json")
    plain_at, scaled_at = (
        json.loads(rapidsim("kin", "fk", *arm, *joints, cwd=in_millimetres).out)["position_mm"]
        for arm in (("--robot", "irb120"), named)
    )
    assert scaled_at == pytest.approx(plain_at)
    ended = rapidsim("points", "--shell", "300,400", *named, "--count", "2", cwd=in_millimetres)
    assert ended.code == 0
    assert rapidsim("points", "--shell", "300,400", "--scale", "2", cwd=in_millimetres).code == 2


@pytest.mark.parametrize(
    ("text", "part", "help"),
    [
        ("[robot", "is not TOML", None),
        ("[robot]\nmodel = 'irb120'\nscale = 0.001", "robot.scale: only lengths of a `urdf`", None),
        ("[robot]\nurdf = 'a.urdf'\nscale = 0", "robot.scale: must be greater than 0", None),
        ("[robot]\nurdf = 'a.urdf'\nscale = inf", "robot.scale: a number is needed", None),
        ("[robto]", "robto: no such key", "did you mean `robot`?"),
        ("[motion]\nfilter-time = 1", "motion.filter-time: no such key", "`filter_time`"),
        ('[robot]\nmodel = "a"\nurdf = "b"', "not both", None),
        ("[robot]\nmodel = 3", "robot.model: text in quotes", None),
        ("robot = 3", "robot: a table is needed", None),
        ('[robot]\nstart = ["a"]', "robot.start: a list of numbers", None),
        ("[robot]\nbase = { position = [1, 2] }", "robot.base.position: 3 numbers", None),
        ("[motion]\nacceleration_time = 0", "motion.acceleration_time: a number above 0", None),
        ("[motion]\nfine_dwell = -1", "motion.fine_dwell: a number that is not negative", None),
        ("[motion]\nfine_dwell = true", "motion.fine_dwell: a number", None),
        ("[motion]\nfine_dwell = nan", "motion.fine_dwell: a number", None),
        ("[motion]\nacceleration = [0]", "above 0", None),
        ('[motion]\ncorner = "round"', "`round` is none of `abb`, `c2`, `parabola`", None),
        ('[motion]\nsmoothing = "joints"', "`joints` is neither `path` nor `axes`", None),
        ("[[task]]\n[[task]]", "there are two tasks T_ROB1", None),
        ("task = 3", "task: they are written as [[task]]", None),
        ("[signals]\ndi1 = 3", "signals.di1: a table is needed", None),
        ('[signals]\ndi1 = { type = "dj" }', "unknown signal type `dj`", None),
        ('[signals]\ngo1 = { type = "go", width = 40 }', "go1.width: a whole number", None),
        ('[signals]\ndi1 = { type = "di", min = 1 }', "di1.min: a di has no such key", None),
        ('[signals]\ngo1 = { type = "go", width = 2, value = 4 }', "4 is outside", None),
        ("[[stimulus]]\nat = 1", "stimulus.set: name signals", None),
        ("[[stimulus]]\nset = { a = 1 }", "stimulus: give `at`, `every` or `when`", None),
        ('[[stimulus]]\nwhen = "a = b"\nset = { c = 1 }', "`a = b` is not a valid condition", None),
        ('[[cross]]\nset = "a"\nfrom = "b and a"', "`a` depends on itself", None),
        ('[check]\nfail-on = "never"', "`never` is not a severity", None),
        ("[[socket]]\naccept = 5000\nafter = 1", "socket.after: only for peers that", None),
        (
            "[robot]\nmodel = 'irb120'\nshapes-frame = 'base'",
            "robot.shapes-frame: describes `shapes`, which are missing",
            None,
        ),
        (
            f"[[camera]]\nname = 'cam1'\nparameters = {{ A = 1{'0' * 400} }}",
            "camera.parameters.A: a number, a text, true or false is needed",
            None,
        ),
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


def test_all_mistakes_of_tables_are_reported_once(tmp_path: Path) -> None:
    text = """controller = 3
[[stimulus]]
every = 1
pulse = 2
after = 1
[[object]]
name = "post"
cylinder = {}
"""
    with pytest.raises(InputError) as raised:
        read_station(station_file(tmp_path, text))
    mistakes = [line.partition("rapidsim.toml: ")[2] for line in raised.value.message.split("\n")]
    assert mistakes == [
        "stimulus.after: it needs `when`; with the clock, use `at`",
        "stimulus.set: name signals and their values, as in { diReady = 1 }",
        "stimulus.pulse: 2 s is not shorter than every, 1 s",
        "controller: a table is needed, as in [controller]",
        "object.cylinder.diameter: is missing",
        "object.cylinder.length: is missing",
    ]


@pytest.mark.parametrize(
    ("start", "said"),
    [
        ("[0, 0, 0]", "irb1600-6-1.2 has 6 joints, not 3"),
        ("[0, 0, 0, 0, 120, 0]", "joint 5 of irb1600-6-1.2 goes from -115 to 115 deg, not to 120"),
    ],
)
def test_a_start_the_arm_cannot_have_is_refused(start: str, said: str, tmp_path: Path) -> None:
    station_file(tmp_path, f"[robot]\nstart = {start}\n")
    (tmp_path / "a.mod").write_text("MODULE a\nPROC main()\nENDPROC\nENDMODULE\n")
    ended = rapidsim("run", "a.mod", "--no-record", cwd=tmp_path)
    assert (ended.code, f"robot.start: {said}" in ended.err) == (2, True)


def test_all_mistakes_are_told_at_once(tmp_path: Path) -> None:
    file = station_file(tmp_path, "[robot]\nmodle = 1\n[motion]\nfine_dwell = -1\n[cell]\n")
    with pytest.raises(InputError) as raised:
        read_station(file)
    said = [line.split("toml: ")[1].split(":")[0] for line in raised.value.message.splitlines()]
    assert said == ["cell", "robot.modle", "motion.fine_dwell"]


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
