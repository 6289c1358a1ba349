"""The drawing program through the real command line: the one path that uses every layer."""

import csv
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from command_line import call

from rapidsim.frames.transform import Transform, slerp
from rapidsim.motion.robot.robot import load_robot

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "programs" / "pentagon.mod"

# Where the TCP is, in mm in the robot's base: t4 and wobj1 composed by hand.
FIRST_DRAW = {
    "p10": (558.71558748, 57.616439, 231.84633475),
    "p20": (531.89475873, 33.85407206, -4.62304373),
    "p30": (528.35525207, -6.54082488, -4.43122496),
    "p40": (598.6330183, -12.68788662, -3.68731298),
    "p50": (602.19241518, 27.97714221, -3.50976319),
}
# The same with the sheet at x = 100, y = 50, turned by 30 degrees.
SECOND_DRAW = {
    "p10": (620.87076006, 25.98501404, 232.55078794),
    "p20": (658.73494105, 14.59589861, -3.32707399),
    "p30": (693.85191033, 34.86823478, -2.94831991),
    "p40": (658.57865531, 95.9653458, -3.44299694),
    "p50": (623.2242838, 75.55912856, -3.453626),
}
ROUND = ("p10", "p20", "p30", "p40", "p50", "p20")
SEGMENTS_MM = (239.169, 40.550, 70.550, 40.821, 70.552)

# Single precision keeps seven digits of a coordinate of some hundred mm.
SINGLE_MM = 1e-3


@dataclass(frozen=True)
class Drawing:
    report: Mapping[str, object]
    trace: list[dict[str, str]]
    log: list[str]
    folder: Path


def draw(folder: Path) -> Drawing:
    answers = folder / "answers.txt"
    answers.write_text("100\n50\n30\n")
    run = call(
        *("run", PROGRAM, "--robot", "irb1600", "--answers", "answers.txt", "--format", "json"),
        *("--trace", "trace.csv", "--events", "events.jsonl", "--home", "home"),
        cwd=folder,
    )
    assert run.code == 0, run.err
    with (folder / "trace.csv").open(newline="") as file:
        trace = list(csv.DictReader(file))
    log = (folder / "home" / "LOGFILE2.DOC").read_text().split("\n")
    return Drawing(json.loads(run.out), trace, log, folder)


@pytest.fixture(scope="module")
def drawing(tmp_path_factory: pytest.TempPathFactory) -> Drawing:
    folder = tmp_path_factory.mktemp("pentagon")
    (folder / "home").mkdir()
    return draw(folder)


def moves(drawing: Drawing) -> list[dict[str, object]]:
    found = drawing.report["moves"]
    assert isinstance(found, list)
    return found


def columns(drawing: Drawing, *names: str) -> np.ndarray:
    return np.array([[float(row[name]) for name in names] for row in drawing.trace])


def test_the_run_ends_as_programmed_and_names_its_files(drawing: Drawing) -> None:
    assert drawing.report["end"] == "ended"
    assert drawing.report["robot"] == "irb1600-6-1.2"
    assert (drawing.folder / "pentagon.rrd").stat().st_size > 100_000
    assert drawing.report["unsimulated"] == []


def test_segments_have_the_programmed_lengths(drawing: Drawing) -> None:
    lengths = [move["length_mm"] for move in moves(drawing)]
    assert lengths[1:6] == pytest.approx(SEGMENTS_MM, abs=0.01)
    assert lengths[7:12] == pytest.approx(SEGMENTS_MM, abs=0.01)


def test_targets_are_where_tool_and_work_object_put_them(drawing: Drawing) -> None:
    for number, move in enumerate(moves(drawing)):
        places = FIRST_DRAW if number < 6 else SECOND_DRAW
        assert move["to"] == ROUND[number % 6]
        target = move["target"]
        assert isinstance(target, dict)
        assert target["position_mm"] == pytest.approx(places[ROUND[number % 6]], abs=SINGLE_MM)


def test_stop_points_are_met_and_corners_stay_in_their_zones(drawing: Drawing) -> None:
    tcp = columns(drawing, "x_mm", "y_mm", "z_mm")
    index = columns(drawing, "move")[:, 0]
    for number, move in enumerate(moves(drawing)):
        name = ROUND[number % 6]
        place = np.array((FIRST_DRAW if number < 6 else SECOND_DRAW)[name])
        same_draw = (index < 6) == (number < 6)
        nearest = np.linalg.norm(tcp[same_draw] - place, axis=1).min()
        if move["corner"] == "stop":
            # After a slow move the next one begins before the arm is quite at rest.
            assert nearest < 0.015
        elif name == "p20":
            continue  # The figure closes there with a stop.
        else:
            # z10: inside the zone, and never through the point.
            assert 1.0 < nearest < 10.0


def test_lines_are_straight_by_forward_kinematics_of_the_joints(drawing: Drawing) -> None:
    robot = load_robot("irb1600")
    joints = np.radians(columns(drawing, *(f"j{i}" for i in range(1, 7))))
    flange_from_tcp = Transform(np.eye(3), np.array([-0.105513, 0.00240649, 0.246356]))
    tcp = robot.forward(joints) @ flange_from_tcp
    index = np.array([int(row["move"]) for row in drawing.trace])
    found = moves(drawing)
    for number in (1, 2, 3, 4, 5, 7, 8, 9, 10, 11):
        ends = [found[number - 1]["target"], found[number]["target"]]
        start, end = (np.array(t["position_mm"]) / 1e3 for t in ends)  # type: ignore[index]
        qs, qe = (np.array(t["quaternion"]) for t in ends)  # type: ignore[index]
        way = end - start
        length = np.linalg.norm(way)
        here = tcp[index == number]
        along = (here.translation - start) @ way / length
        clear = (along > 0.0101) & (along < length - 0.0101)
        assert clear.any()
        off = here.translation - start - np.outer(along / length, way)
        # Each axis is smoothed by itself, which is felt a little beyond the zones: 72 um.
        assert np.linalg.norm(off[clear], axis=1).max() < 1e-4
        turned = slerp(qs, qe, along[clear] / length)
        # Orientation zones are 15 mm wide; between them the turn is even.
        even = (along[clear] > 0.0151) & (along[clear] < length - 0.0151)
        alike = np.abs(np.sum(turned * here[clear].quaternion, axis=1))
        assert np.all(alike[even] > 1.0 - 1e-9)


def test_speed_and_limits_are_kept(drawing: Drawing) -> None:
    robot = load_robot("irb1600")
    joints = np.radians(columns(drawing, *(f"j{i}" for i in range(1, 7))))
    assert np.all(joints > robot.lower)
    assert np.all(joints < robot.upper)
    times = columns(drawing, "time_s")[:, 0]
    speed = np.abs(np.diff(joints, axis=0)) / np.diff(times)[:, None]
    limits = np.array([joint.max_speed for joint in robot.joints])
    assert np.all(speed <= limits * 1.001)
    assert columns(drawing, "tcp_speed_mm_s").max() <= 200.0 * 1.001


def test_the_log_has_a_position_on_the_path_for_each_half_second(drawing: Drawing) -> None:
    values = [line.split(";") for line in drawing.log if line]
    assert [name for name, _ in values[:6]] == ["X", "Y", "Z", "X", "Y", "Z"]
    time_s = drawing.report["time_s"]
    assert isinstance(time_s, float)
    assert len(values) == 3 * int(time_s / 0.5)
    events = drawing.report["events"]
    assert isinstance(events, list)
    ticks = [event["time_s"] for event in events if event["kind"] == "interrupt"]
    assert ticks == pytest.approx([0.5 * (k + 1) for k in range(len(ticks))])
    # In the first draw the work object is the stored one: its poses composed by hand.
    uframe = Transform.from_quaternion(
        (0.999987, -0.00156359, -0.00487101, 7.47128e-05), (0.559804, 0.00550957, -0.00363248)
    )
    oframe = Transform.from_quaternion((0.67559, 0, 0, -0.737277), (0.005, 0.004, 0))
    trace_times = columns(drawing, "time_s")[:, 0]
    tcp = columns(drawing, "x_mm", "y_mm", "z_mm")
    draw_end = moves(drawing)[5]["end_s"]
    assert isinstance(draw_end, float)
    for k in range(int(draw_end / 0.5)):
        logged = np.array([float(values[3 * k + i][1]) for i in range(3)])
        in_base = (uframe @ oframe).apply(logged / 1e3) * 1e3
        seen = [np.interp(0.5 * (k + 1), trace_times, tcp[:, axis]) for axis in range(3)]
        # The log has six digits, and the trace is read between its rows.
        assert in_base == pytest.approx(seen, abs=0.2)


def test_nothing_is_said_of_the_drawing(drawing: Drawing) -> None:
    assert drawing.report["diagnostics"] == []


STALE = "[0,0,0,4]"


def stale_drawing(folder: Path, station: str, *arguments: object) -> tuple[int, dict[str, object]]:
    """The drawing with the configurations of another table: exit code and report."""
    text = PROGRAM.read_text()
    for stored in ("[0,0,1,0]", "[0,0,0,0]", "[0,0,0,0]"):
        text = text.replace(f"    {stored},[9E", f"    {STALE},[9E", 1)
    (folder / "stale.mod").write_text(text)
    (folder / "rapidsim.toml").write_text(station)
    (folder / "answers.txt").write_text("100\n50\n30\n")
    files = ("--answers", "answers.txt", "--no-record", "--format", "json")
    done = call("run", "stale.mod", *arguments, *files, cwd=folder)
    return done.code, json.loads(done.out)


def test_a_stale_configuration_stops_the_drawing(tmp_path: Path) -> None:
    code, report = stale_drawing(tmp_path, "", "--robot", "irb1600")
    assert (code, report["end"], report["moves"]) == (1, "error", [])
    found = report["diagnostics"]
    assert isinstance(found, list)
    assert [(one["code"], one["severity"]) for one in found] == [("K603", "error")]
    assert found[0]["message"].startswith("`p10` cannot be reached in its stored configuration")
    assert STALE in found[0]["message"]
    check = call(
        *("check", "stale.mod", "--robot", "irb1600", "--output-format", "json"),
        *("--select", "K6"),
        cwd=tmp_path,
    )
    told = json.loads(check.out)["diagnostics"]
    assert check.code == 1
    assert (told[0]["message"], told[0]["line"]) == (found[0]["message"], found[0]["line"])


@pytest.mark.parametrize(
    ("station", "arguments"),
    [('[motion]\nconfiguration = "nearest"\n', ("--robot", "irb1600")), ("", ())],
    ids=["where the station says so", "on an arm that nobody named"],
)
def test_the_drawing_goes_on_in_the_nearest(
    station: str, arguments: tuple[str, ...], tmp_path: Path
) -> None:
    code, report = stale_drawing(tmp_path, station, *arguments)
    assert (code, report["end"]) == (0, "ended")
    found = report["diagnostics"]
    assert isinstance(found, list)
    assert {(one["code"], one["severity"]) for one in found} == {("K603", "warning")}
    said = [one["message"].split("`")[1] for one in found]
    assert said == ["p10", "p20", "p30"]


@pytest.mark.process  # Each orders its sets in its own way.
def test_two_runs_are_the_same_to_the_last_bit(drawing: Drawing, tmp_path: Path) -> None:
    (tmp_path / "home").mkdir()
    again = draw(tmp_path)
    for name in ("trace.csv", "events.jsonl", "home/LOGFILE2.DOC"):
        assert (tmp_path / name).read_bytes() == (drawing.folder / name).read_bytes()
    here, there = str(tmp_path), str(drawing.folder)
    assert json.dumps(again.report).replace(here, there) == json.dumps(drawing.report)
