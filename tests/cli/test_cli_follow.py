"""`rapidsim follow` and `rapidsim points`: what is printed, files, exit codes, wrong input."""

import csv
import json
from pathlib import Path
from typing import Any

import pytest
from cli_helper import assert_golden, rapidsim

from rapidsim.motion.waypoints.follow import FollowedTrajectory

EXAMPLES = Path(__file__).parents[2] / "programs"
KR10 = ("--robot", "kr10", "--tool", "0,0,160")


def follow(name: str, *arguments: object, code: int = 0) -> dict[str, Any]:
    ended = rapidsim("follow", EXAMPLES / name, *arguments, "--format", "json")
    assert ended.code == code, ended.err
    loaded: dict[str, Any] = json.loads(ended.out)
    return loaded


def test_the_letter_is_tracked_and_written(tmp_path: Path) -> None:
    trace, recording = tmp_path / "d.csv", tmp_path / "d.rrd"
    arguments = ("--robot", "rvm1", "--path", "spline", "--speed", "50")
    found = follow("letter_d.csv", *arguments, "--trace", trace, "--record", recording)
    assert all(point["reachable"] for point in found["points"])
    made = found["trajectory"]
    assert made["deviation"]["rms_mm"] < 1e-6
    assert made["deviation"]["max_mm"] < 1e-6
    assert made["peak_tcp_speed_mm_s"] == pytest.approx(50.0)
    assert made["joints"][0]["limit_deg_s"] is None
    assert found["refused"] is None
    rows = list(csv.DictReader(trace.read_text(encoding="utf-8").splitlines()))
    assert len(rows) == made["samples"] == made["poses_solved"]
    assert float(rows[-1]["time_s"]) == round(made["duration_s"], 8)
    assert float(rows[-1]["y_mm"]) == pytest.approx(19.269549, abs=1e-6)
    assert recording.read_bytes()[:3] == b"RRF"
    # The same command gives the same answer, whatever time the solver took.
    assert follow("letter_d.csv", *arguments) == found


def test_a_single_point_gives_its_joints(tmp_path: Path) -> None:
    """Those nearest to 0, or to where the arm is; nothing is written."""
    point, trace = tmp_path / "point.csv", tmp_path / "trace.csv"
    point.write_text("x,y,z,e1,e2,e3\n900,0,700,0,90,0\n")
    for kind in ("line", "joint-quintic"):
        made = follow(str(point), "--path", kind, "--trace", trace)["trajectory"]
        assert (made["duration_s"], made["path_mm"], made["poses_solved"]) == (0.0, 0.0, 1)
        angles = [joint["start_deg"] for joint in made["joints"]]
        joints = ",".join(map(str, angles))
        reached = rapidsim("kin", "fk", "--joints", joints, "--format", "json").out
        assert json.loads(reached)["position_mm"] == pytest.approx([900, 0, 700])
        assert angles[0] == pytest.approx(0.0)
    flipped = follow(str(point), "--start", "0,0,0,180,0,180")["trajectory"]["joints"]
    assert flipped[3]["start_deg"] == pytest.approx(180.0)
    assert not trace.exists()
    assert "joint_6" in rapidsim("follow", point).out


def test_the_time_at_constant_speed_is_shorter() -> None:
    made = follow("letter_d.csv", "--robot", "rvm1", "--speed", "50")["trajectory"]
    assert made["constant_speed_s"] == pytest.approx(made["path_mm"] / 50.0)
    assert made["constant_speed_s"] < made["duration_s"]


TURNED = "x,y,z,e1,e2,e3\n900,0,700,0,90,0\n800,300,900,30,80,0\n"


def test_euler_angles_come_out_as_they_go_in(tmp_path: Path) -> None:
    points, trace = tmp_path / "turned.csv", tmp_path / "turned-trace.csv"
    points.write_text(TURNED)
    found = follow(str(points), "--convention", "zyz", "--trace", trace)
    assert found["euler"] == {"convention": "zyz", "names": ["rz1", "ry", "rz2"]}
    angles = [point["euler_deg"] for point in found["points"]]
    assert angles == [pytest.approx([0, 90, 0]), pytest.approx([30, 80, 0])]
    # The same attitude: half a turn back about z, a quarter forth about y.
    half = 2**-0.5
    assert found["points"][0]["quaternion"] == pytest.approx([half, 0, half, 0])
    rows = list(csv.DictReader(trace.read_text(encoding="utf-8").splitlines()))
    assert list(rows[0])[-4:] == ["tcp_speed_mm_s", "rz1_deg", "ry_deg", "rz2_deg"]
    assert [float(rows[-1][name]) for name in ("rz1_deg", "ry_deg", "rz2_deg")] == pytest.approx(
        [30, 80, 0], abs=1e-6
    )
    # On a wall the base looks along x of the world: what is shown is in the world.
    walled = follow(str(points), "--base", "wall")
    assert walled["points"][1]["euler_deg"] == pytest.approx([30, 80, 0])


def test_the_line_of_five_misses_for_people() -> None:
    ended = rapidsim("follow", EXAMPLES / "rvm1_line.csv", "--robot", "rvm1")
    assert ended.code == 1
    assert ended.err == "note: no column gives the pitch of the tool: it is chosen point by point\n"
    assert_golden("follow_line.txt", ended.out)


def test_points_out_of_reach_can_be_left_out() -> None:
    found = follow("rvm1_line.csv", "--robot", "rvm1", "--skip-unreachable", code=1)
    assert [point["reachable"] for point in found["points"]] == [False] * 5 + [True] * 6
    assert [round(-point["over_deg"], 1) for point in found["points"][:5]] == [
        22.6,
        19.1,
        14.3,
        8.6,
        3.0,
    ]
    assert found["points"][5]["pitch_range_deg"] == pytest.approx([-127.5, -114.0])
    assert found["trajectory"]["deviation"]["max_mm"] < 1e-6


def test_octants_are_unreachable_with_distances() -> None:
    found = follow("kr10_octants.csv", *KR10, code=1)
    shortfalls = [point["shortfall_mm"] for point in found["points"]]
    assert shortfalls == pytest.approx(
        [361.6, 159.1, 201.9, 868.9, 308.5, 937.8, 940.9, 859.3], abs=0.05
    )
    assert found["trajectory"] is None
    assert found["refused"]["message"] == "8 of 8 points are out of reach"


def test_the_row_as_a_joint_quintic() -> None:
    still = follow("kr10_row.csv", *KR10, "--path", "joint-quintic")["trajectory"]
    assert still["from_straight_lines_max_mm"] == pytest.approx(3.1, abs=0.05)
    speed = 5.729577951308232
    signs = (-1, -1, 1, -1, 1, -1)
    moving = follow(
        "kr10_row.csv",
        *KR10,
        "--path",
        "joint-quintic",
        "--conf=-1,0,1,0",
        "--via-speed=" + ",".join(str(sign * speed) for sign in signs),
    )["trajectory"]
    assert moving["from_straight_lines_max_mm"] == pytest.approx(23.8, abs=0.05)
    assert max(joint["overshoot_deg"] for joint in moving["joints"]) > 1.0


def test_ways_side_by_side() -> None:
    found = follow("kr10_row.csv", *KR10, "--compare")
    ways = {one["path"]: one["trajectory"] for one in found["compared"]}
    assert list(ways) == ["line", "spline", "joint", "joint-quintic"]
    assert ways["line"]["poses_solved"] > 100 > ways["joint"]["poses_solved"] == 10
    assert ways["line"]["from_straight_lines_max_mm"] < 1e-6
    assert ways["joint"]["from_straight_lines_max_mm"] == pytest.approx(3.08, abs=0.01)
    text = rapidsim("follow", EXAMPLES / "kr10_row.csv", *KR10, "--compare").out
    assert "joint-quintic     10" in text


def test_turns_are_compared_with_linear_interpolation(tmp_path: Path) -> None:
    table = tmp_path / "turn.csv"
    table.write_text(
        "x,y,z,q1,q2,q3,q4\n900,0,800,0.7071068,0,0.7071068,0\n900,0,800,0.5,0.5,0.5,0.5\n",
        encoding="utf-8",
    )
    text = rapidsim("follow", table, "--compare").out
    assert "1 - 2 90.00 deg 90.00 81.03 94.93" in " ".join(text.split())


def test_too_fast_an_axis_is_a_finding(tmp_path: Path) -> None:
    table = tmp_path / "fast.csv"
    table.write_text("x,y,z\n700,-300,700\n700,300,700\n", encoding="utf-8")
    arguments = ("--speed", "6000", "--acceleration", "60000")
    ended = rapidsim("follow", table, *arguments)
    assert ended.code == 1
    assert "joint 1 would need " in ended.out
    assert "its limit is 150 deg/s" in ended.out
    assert rapidsim("follow", table, "--speed", "200").code == 0


def test_the_sphere_is_kept_or_the_line_refused(tmp_path: Path) -> None:
    table = tmp_path / "near.csv"
    table.write_text("x,y,z\n500,-300,300\n500,300,300\n", encoding="utf-8")
    refused = rapidsim("follow", table, *KR10, "--min-radius", "620")
    assert refused.code == 1
    said = "no trajectory: the line between points 1 and 2 comes within 583.1 mm of the origin"
    assert said in " ".join(refused.out.split())
    led = rapidsim("follow", table, *KR10, "--min-radius", "620", "--avoid", "--format", "json")
    assert led.code == 0
    assert json.loads(led.out)["trajectory"]["path_mm"] > 605.0
    table.write_text("x,y,z\n500,-300,300\n450,0,300\n500,300,300\n", encoding="utf-8")
    moved = rapidsim("follow", table, *KR10, "--min-radius", "620", "--avoid")
    assert moved.code == 0
    assert "points inside the sphere are moved to its surface: 1" in moved.err
    assert "515.9" in moved.out


def test_points_by_lot_can_be_followed() -> None:
    drawn = rapidsim("points", "--shell", "300,900", "--count", "8", "--seed", "3")
    assert drawn.code == 0
    assert len(drawn.out.splitlines()) == 9
    assert rapidsim("points", "--shell", "300,900", "--seed", "3").out == drawn.out
    ended = rapidsim("follow", "-", "--robot", "kr10", stdin=drawn.out.encode())
    assert ended.code in (0, 1)
    assert "of 8 points reached" in ended.out


def test_a_comparison_has_pictures_of_every_kind_of_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each kind in a folder of its own; how they are drawn others test."""
    drawn = {}

    def draw(result: FollowedTrajectory, title: str, folder: Path) -> None:
        drawn[folder.name] = (result.plan.kind.value, title)

    monkeypatch.setattr("rapidsim.plots.followed_pictures.write_followed_plots", draw)
    row = (EXAMPLES / "kr10_row.csv", *KR10, "--compare")
    ended = rapidsim("follow", *row, "--plots", "kinds", cwd=tmp_path)
    assert ended.code == 0
    assert "kinds (plots)" in ended.out
    kinds = ("line", "spline", "joint", "joint-quintic")
    assert drawn == {kind: (kind, "kr10_row.csv") for kind in kinds}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("-",), "- is empty"),
        (("nowhere.csv",), "nowhere.csv does not exist"),
        ((EXAMPLES / "kr10_row.csv", "--avoid"), "--avoid needs to know the sphere"),
        ((EXAMPLES / "kr10_row.csv", "--via-speed", "1,2"), "--via-speed has 2 numbers"),
        ((EXAMPLES / "kr10_row.csv", "--conf", "0,0,0,9"), "cfx 9 is not a branch"),
        ((EXAMPLES / "kr10_row.csv", "--start", "1"), "--start has 1 numbers"),
        ((EXAMPLES / "kr10_row.csv", "--record", "x.csv"), "x.csv must end in .rrd"),
        (
            (EXAMPLES / "kr10_row.csv", "--compare", "--trace", "x.csv"),
            "--compare writes no files but pictures",
        ),
        ((EXAMPLES / "kr10_row.csv", "--tool", "0,0,1,2,0,0,0"), "quaternion has length 2"),
    ],
)
def test_a_wrong_option_is_told(arguments: tuple[object, ...], said: str, tmp_path: Path) -> None:
    ended = rapidsim("follow", *arguments, cwd=tmp_path)
    assert (ended.code, ended.out) == (2, "")
    assert said in ended.err


def test_what_is_given_in_vain_is_said() -> None:
    ended = rapidsim("follow", EXAMPLES / "kr10_row.csv", *KR10, "--via-speed", "5")
    assert ended.code == 0
    assert "joint speeds at the points count for --path joint-quintic only" in ended.err


def test_the_page_shows_what_is_true(capsys: pytest.CaptureFixture[str]) -> None:
    """Its Python runs, and every option of the command is on it."""
    page = (EXAMPLES.parent / "docs" / "follow.md").read_text(encoding="utf-8")
    code = page.partition("```python\n")[2].partition("```")[0]
    exec(compile(code.replace('"programs/', f'"{EXAMPLES}/'), "follow.md", "exec"), {})
    duration, rms, *shape = capsys.readouterr().out.split()
    assert float(duration) == pytest.approx(11.72, abs=0.01)
    assert float(rms) < 1e-6
    assert shape[1] == "5)"
    offered = rapidsim("follow", "--help").out
    for option in ("--conf", "--start", "--compare", "--via-speed", "--min-radius", "--avoid"):
        assert option in page
        assert option in offered


def test_points_in_metres_are_noticed() -> None:
    table = b"x,y,z\n0.7,0,0.5\n0.7,0.1,0.5\n"
    ended = rapidsim("follow", "-", stdin=table)
    assert "no coordinate is beyond 0.7 mm" in ended.err
    assert "no coordinate" not in rapidsim("follow", "-", stdin=table.replace(b"0.7", b"700")).err
