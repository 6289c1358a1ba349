"""Arms that one can look at from the command line, poses as people have them, points that fit."""

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli_helper import rapidsim
from PIL import Image
from rerun.chunk import RrdReader

from rapidsim.colours import LIGHT
from rapidsim.plots import write

EXAMPLES = Path(__file__).parents[2] / "programs"
KR10 = ("--robot", "kr10", "--tool", "0,0,160")


def json_of(*arguments: object, code: int = 0) -> dict[str, Any]:
    ended = rapidsim(*arguments, "--format", "json")
    assert ended.code == code, ended.err
    loaded: dict[str, Any] = json.loads(ended.out)
    return loaded


def entities(recording: Path) -> set[str]:
    return set(RrdReader(recording).store().schema().entity_paths())


@pytest.mark.parametrize(
    ("arguments", "pictures"),
    [
        (("fk", "--robot", "rvm1", "--joints", "10,20,-30,40,50"), {"pose", "matrix"}),
        (("ik", "--position", "600,200,500", "--euler", "20,0,180", "--all"), {"pose", "matrix"}),
        (("jacobian", "--joints", "0,10,20,30,1,50"), {"pose", "matrix", "jacobian"}),
    ],
)
def test_a_posture_is_drawn_and_recorded(
    arguments: tuple[str, ...],
    pictures: set[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if "jacobian" not in arguments:
        # The darkness of pictures is that of their theme: one command draws all of its own in both.
        monkeypatch.setattr(write, "THEMES", (LIGHT,))
    recording, plots = tmp_path / "arm.rrd", tmp_path / "plots"
    ended = rapidsim("kin", *arguments, "--record", recording, "--plots", plots)
    assert ended.code == 0, ended.err
    assert "arm.rrd" in ended.out.replace("\n", "")
    assert {path.stem for path in plots.iterdir() if "-dark" not in path.stem} == pictures
    for path in plots.iterdir():
        picture = np.asarray(Image.open(path).convert("L"))
        assert np.count_nonzero(picture != picture[0, 0]) > 2000
    logged = entities(recording)
    branches = 8 if "ik" in arguments else 1
    assert {f"/frames/{number + 1}" for number in range(branches)} <= logged
    assert ("/weakest" in logged) == ("jacobian" in arguments)
    assert ("/names" in logged) == (branches > 1)


def test_euler_angles_in_and_out() -> None:
    """The tool straight down, turned by 30 deg: zyx 30, 0, 180."""
    pose = ("--position", "600,200,500")
    by_angles = json_of("kin", "ik", *pose, "--euler", "30,0,180")
    half = np.radians(15.0)
    by_quaternion = json_of("kin", "ik", *pose, f"--quaternion=0,{np.cos(half)},{np.sin(half)},0")
    ours = [one["joints_deg"] for one in by_angles["solutions"]]
    theirs = [one["joints_deg"] for one in by_quaternion["solutions"]]
    assert np.array(ours) == pytest.approx(np.array(theirs), abs=1e-6)
    joints = ",".join(map(str, ours[0]))
    told = json_of("kin", "fk", "--joints", joints, "--convention", "rpy")["euler"]
    assert told["convention"] == "rpy"
    assert told["names"] == ["roll", "pitch", "yaw"]
    assert np.abs(told["degrees"]) == pytest.approx([180.0, 0.0, 30.0], abs=1e-6)


def test_a_five_axis_arm_is_asked_by_pitch() -> None:
    found = json_of("kin", "ik", "--robot", "rvm1", "--position", "300,100,200", "--pitch=-45")
    (solution,) = found["solutions"]
    joints = ",".join(map(str, solution["joints_deg"]))
    matrix = json_of("kin", "fk", "--robot", "rvm1", "--joints", joints)["matrix"]
    assert np.degrees(np.arcsin(matrix[2][2])) == pytest.approx(-45.0)


@pytest.mark.parametrize("base", ["ceiling", "wall", "100,200,300,0.5,0.5,0.5,0.5"])
def test_a_robot_on_the_ceiling_is_asked_in_the_world(base: str) -> None:
    joints = "20,10,-20,30,40,50"
    seen = json_of("kin", "fk", "--joints", joints, "--base", base)
    own = json_of("kin", "fk", "--joints", joints)
    assert seen["matrix"] != own["matrix"]
    place = ",".join(map(str, seen["position_mm"]))
    turn = ",".join(map(str, seen["quaternion"]))
    found = json_of("kin", "ik", "--position", place, f"--quaternion={turn}", "--base", base)
    assert any(
        np.allclose(one["joints_deg"], [20, 10, -20, 30, 40, 50]) for one in found["solutions"]
    )


def test_the_attitude_is_named_once() -> None:
    ended = rapidsim("kin", "ik", "--position", "1,2,3", "--pitch", "0", "--euler", "0,0,0")
    assert ended.code == 2
    assert "one of --quaternion, --euler and --pitch, not by --euler and --pitch" in ended.err
    assert "not by none" in rapidsim("kin", "ik", "--position", "1,2,3").err
    ended = rapidsim("kin", "fk", "--joints", "0,0,0,0,0,0", "--base", "roof")
    assert "floor, wall, ceiling" in ended.err


def test_tables_of_an_arm() -> None:
    found = json_of("robots", "irb120", "--table")
    assert [row["a_mm"] for row in found["dh"]["rows"]] == pytest.approx([0, 270, 70, 0, 0, 0])
    assert found["screws"]["axes"][0]["direction"] == pytest.approx([0.0, 0.0, 1.0])
    shown = rapidsim("kin", "fk", "--robot", "irb120", "--joints", "0,0,0,0,0,0", "--tables").out
    assert "DH, standard form" in shown
    assert "q2 - 90" in shown
    assert "link_6" in shown
    assert "rods carry its links" in rapidsim("robots", "irb460", "--table").out


def test_the_workspace_of_an_arm_is_told_and_drawn(tmp_path: Path) -> None:
    plots = tmp_path / "plots"
    found = json_of("robots", "rvm1", "--workspace", "--plots", plots)["workspace"]
    assert found["volume_m3"] == pytest.approx(0.345, rel=0.05)
    assert {path.name for path in plots.iterdir()} == {"workspace.png", "workspace-dark.png"}


@pytest.mark.parametrize("way", ["line", "spline"])
def test_a_tour_through_all_eight_octants_works(way: str) -> None:
    found = json_of("follow", EXAMPLES / "kr10_tour.csv", *KR10, "--path", way, "--dt", "0.05")
    assert found["refused"] is None
    signs = {tuple(value > 0.0 for value in point["position_mm"]) for point in found["points"]}
    assert len(signs) == 8
    assert found["trajectory"]["deviation"]["max_mm"] < 1e-6


def test_a_line_needs_no_file_and_may_hang_from_the_ceiling() -> None:
    found = json_of("follow", "--line", "500,-200,-400,500,200,-400", "--count", "5", "--base",
                    "ceiling", "--tool", "0,0,100,0,1,0,0")  # fmt: skip
    assert [point["position_mm"][1] for point in found["points"]] == [-200, -100, 0, 100, 200]
    printed = rapidsim("points", "--line", "0,0,0,100,0,50", "--count", "3").out
    assert printed.splitlines() == ["x,y,z", "0.000,0.000,0.000", "50.000,0.000,25.000",
                                    "100.000,0.000,50.000"]  # fmt: skip


def test_several_steps_in_time_show_how_poses_grow() -> None:
    found = json_of("follow", EXAMPLES / "kr10_tour.csv", *KR10, "--dt", "0.05,0.025")
    coarse, fine = (one["trajectory"] for one in found["compared"])
    assert (coarse["dt_s"], fine["dt_s"]) == (0.05, 0.025)
    assert fine["poses_solved"] == pytest.approx(2 * coarse["poses_solved"], rel=0.01)
    ended = rapidsim("follow", EXAMPLES / "kr10_tour.csv", *KR10, "--dt", "0.05,0.025")
    assert "a pose" in ended.out
    assert (
        "--dt 0.1: it must be" in rapidsim("follow", EXAMPLES / "kr10_tour.csv", "--dt", "0.1").err
    )


def test_a_warm_start_saves_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rapidsim.motion.waypoints.solver_seeds._MOST_POSES", 8)
    line = ("--line", "600,-100,500,600,100,500", "--count", "2")
    found = json_of("follow", *line, "--speed", "500", "--starts")
    by_start = {(row["solver"], row["start"]): row for row in found["starts"]}
    assert {solver for solver, _ in by_start} == {"lm", "trf", "bfgs"}
    for solver in ("lm", "trf"):
        cold, warm = by_start[solver, "cold"], by_start[solver, "warm"]
        assert warm["found"] == cold["found"] == 8
        assert warm["iterations"] < cold["iterations"]


def test_points_for_an_arm_are_reached_by_it() -> None:
    table = rapidsim(
        "points", "--robot", "kr10", "--shell", "400,1000", "--count", "6", "--convention", "zyx"
    )
    assert table.code == 0
    rows = list(csv.DictReader(table.out.splitlines()))
    assert set(rows[0]) == {"x", "y", "z", "e1", "e2", "e3"}
    found = rapidsim("follow", "-", "--robot", "kr10", "--path", "joint", stdin=table.out.encode())
    assert "6 of 6 points reached" in found.out
    far = rapidsim("points", "--robot", "rvm1", "--shell", "2000,3000", "--count", "1")
    assert far.code == 1
    assert "reached 0 of them" in far.err


def test_an_arm_with_tags_out_of_place_is_recorded_with_its_shapes(tmp_path: Path) -> None:
    odd = tmp_path / "odd.urdf"
    joints = "".join(
        f'<joint name="j{k}" type="revolute"><parent link="l{k - 1}"/><child link="l{k}"/>'
        f'<origin xyz="{0.3 * (k > 2)} 0 0.2"/><axis xyz="0 {int(k > 1)} {int(k == 1)}"/>'
        '<limit lower="-3" upper="3" velocity="2" effort="1"/></joint>'
        for k in (1, 2, 3)
    )
    shape = '<visual><geometry><origin xyz="0 0 0"/><box size="0.1 0.1 0.3"/></geometry></visual>'
    links = f'<link name="l0"/><link name="l1">{shape}</link><link name="l2"/><link name="l3"/>'
    odd.write_text(f'<robot name="odd">\n{links}{joints}</robot>\n')
    recording = tmp_path / "odd.rrd"
    arguments = ("--robot", odd, "--joints", "10,20,30", "--record", recording)
    ended = rapidsim("kin", "fk", *arguments)
    assert ended.code == 0, ended.err
    assert "odd.urdf:2: `origin` is not allowed inside `geometry` and is skipped" in ended.err
    assert any("visual_geometries/l1" in entity for entity in entities(recording))
