"""A SCARA through the real command line: check, run, and every output that says an axis' unit."""

import csv
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from command_line import call
from rerun.chunk import RrdReader

PROGRAM = Path(__file__).parent / "scara_pick.mod"
OUTPUTS = ("--trace", "trace.csv", "--report", "report.html", "--record", "run.rrd")


@dataclass(frozen=True)
class Picked:
    report: Mapping[str, Any]
    summary: str
    trace: list[dict[str, str]]
    folder: Path


@pytest.fixture(scope="module")
def picked(tmp_path_factory: pytest.TempPathFactory) -> Picked:
    folder = tmp_path_factory.mktemp("scara")
    arm = ("--robot", "irb910sc")
    run = call("run", PROGRAM, *arm, "--format", "json", *OUTPUTS, cwd=folder)
    assert run.code == 0, run.err
    ros = call("run", PROGRAM, *arm, "--trace", "trace.ros.json", cwd=folder)
    assert ros.code == 0, ros.err
    with (folder / "trace.csv").open(newline="") as file:
        trace = list(csv.DictReader(file))
    return Picked(json.loads(run.out), ros.out, trace, folder)


def test_checking_finds_nothing() -> None:
    found = call(
        "check", PROGRAM, "--robot", "irb910sc", "--output-format", "json", cwd=PROGRAM.parent
    )
    assert (found.code, json.loads(found.out)["diagnostics"]) == (0, [])


def test_axis_3_is_where_the_comments_say(picked: Picked) -> None:
    (noted,) = [one["new"] for one in picked.report["persistents"] if one["name"] == "axis_3"]
    assert noted == "[-10,-20,-120,-110]"
    (move,) = [one for one in picked.report["moves"] if one["line"] == 17]
    assert move["joints_deg"][2] == pytest.approx(-120.0, abs=1e-4)
    assert move["conf"] == [-1, 0, 0, 0]
    heights = [(float(row["j3"]), float(row["z_mm"])) for row in picked.trace]
    assert all(z == pytest.approx(140.0 + j3, abs=1e-6) for j3, z in heights)
    # After a slow move the next one begins before the arm is quite at rest.
    assert min(heights)[1] == pytest.approx(20.0, abs=0.15)


def test_the_line_takes_what_its_speed_says(picked: Picked) -> None:
    (text,) = [one["message"] for one in picked.report["events"] if "down in" in one["message"]]
    assert 1.0 < float(text.split()[-1]) < 1.3


def test_texts_say_mm(picked: Picked) -> None:
    margin = picked.report["min_joint_margin"]
    assert margin["joint"] == 3
    assert margin["margin_deg"] == pytest.approx(10.0, abs=1e-3)
    assert "joint 3 came within 10.0 mm of its limit" in " ".join(picked.summary.split())


def test_a_ros_trajectory_has_metres(picked: Picked) -> None:
    points = json.loads((picked.folder / "trace.ros.json").read_text())["points"]
    assert points[-1]["positions"][2] == pytest.approx(-0.01, abs=1e-6)
    assert max(abs(point["velocities"][2]) for point in points) < 1.02


def test_the_page_has_a_slider_in_mm(picked: Picked) -> None:
    page = (picked.folder / "report.html").read_text(encoding="utf-8")
    assert '"units":["°","°"," mm","°"]' in page.replace(", ", ",").replace(": ", ":")
    assert "deg, j3 in mm" in page
    assert "10.0 mm" in page


def test_the_recording_slides_link_3_in_link_2(picked: Picked) -> None:
    heights: list[float] = []
    for chunk in (
        RrdReader(picked.folder / "run.rrd").stream().filter(content="/robot/joints/joint_3")
    ):
        places = chunk.to_record_batch().column("Transform3D:translation").to_pylist()
        heights += [1000.0 * place[0][2] for place in places]
    # The flange, 220 mm high with axis 3 at 0, in arm 2, whose underside is 257.7 mm high.
    assert max(heights) == pytest.approx(220.0 - 257.7 - 10.0, abs=1e-3)
    assert min(heights) == pytest.approx(220.0 - 257.7 - 120.0, abs=0.15)
