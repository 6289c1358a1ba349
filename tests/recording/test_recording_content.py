"""What a recording holds, read back from the file."""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from recording_cell import TEXT, cell, two_robots
from recording_read import SIMULATION, failed_run, rows, texts
from rerun.chunk import RrdReader

import rapidsim
from rapidsim.motion.model import MODELS
from rapidsim.recording.layout.write import acceleration_time_of, record

UNLISTED = ("/robot/fixed", "/robot/base", f"/robot/{SIMULATION.only.robot.name}")
"""Fixed frames of the description, and the root of its shapes."""


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(SIMULATION, tmp_path_factory.mktemp("recording") / "frame.rrd")


def test_the_acceleration_time_is_shown_where_it_limits_an_axis() -> None:
    assert acceleration_time_of(SIMULATION) is None
    first = replace(SIMULATION, model=MODELS["1"])
    assert acceleration_time_of(first) == MODELS["1"].acceleration_time


def test_everything_to_be_seen_is_there(recording: Path) -> None:
    entities = set(RrdReader(recording).store().schema().entity_paths())
    assert {
        "/base",
        "/robot/flange",
        "/robot/joints/joint_1",
        "/robot/joints/joint_6",
        "/robot/tcp",
        "/robot/tool",
        "/work_objects/wTable/name",
        "/work_objects/wTable/object",
        "/work_objects/wTable/plate",
        "/work_objects/wTable/user",
        "/targets/axes",
        "/targets/names/near",
        "/targets/points",
        "/path/programmed",
        "/path/travelled/MoveJ",
        "/path/travelled/MoveL",
        "/path/travelled/corner",
        "/program/text",
        "/log/events",
        "/log/findings",
        "/joints/angle",
        "/joints/range",
        "/joints/acceleration",
        "/joints/limits",
        "/joints/speed",
        "/path/speed",
        "/tcp/speed",
        "/tcp/programmed_speed",
        "/moves",
        "/signals/doPump",
    } <= entities


def documented() -> list[re.Pattern[str]]:
    """The entities that `docs/recording.md` lists, `*` and `<name>` for any name."""
    page = (Path(__file__).parents[2] / "docs" / "recording.md").read_text()
    columns = [row.split("|")[1] for row in page.splitlines() if row.startswith("| `/")]
    patterns = []
    for column in columns:
        first = ""
        for name in re.findall(r"`([^`]+)`", column):
            # A name without a slash stands beside the one before it.
            folder = first.rsplit("/", 1)[0]
            path = name if name.startswith("/") else f"{folder}/{name}"
            # `names/near` beside `/targets/points`; `names/far` is not below `names/near`.
            first = first or path
            patterns.append(path)
    return [
        re.compile(re.sub(r"\\\*|<name>", r"[^/]+", re.escape(path)) + r"(/[^/]+)?")
        for path in patterns
    ]


def test_every_entity_is_documented(recording: Path, tmp_path: Path) -> None:
    patterns = documented()
    failing = record(failed_run(), tmp_path / "failed.rrd")
    for path in (recording, failing):
        for entity in {chunk.entity_path for chunk in RrdReader(path).stream()}:
            # What the viewer itself adds, and fixed frames of the description.
            if not entity.startswith(("/__", *UNLISTED)) and entity != "/":
                assert any(pattern.fullmatch(entity) for pattern in patterns), entity


def test_the_layout_is_embedded(recording: Path) -> None:
    reader = RrdReader(recording)
    assert len(reader.blueprints()) == 1
    assert reader.recordings()[0].application_id == "rapidsim"


def test_time_is_virtual_time_and_the_number_of_the_move(recording: Path) -> None:
    names = {name for chunk in RrdReader(recording).stream() for name in chunk.timeline_names}
    assert names == {"sim_time", "move"}


def test_the_text_shows_both_pointers(recording: Path) -> None:
    listing = texts(recording, "/program/text", "TextDocument:text")
    assert all(shown != following for shown, following in pairwise(listing))
    # The program is a move ahead of the robot.
    assert any("▶   12" in text and " ●  11" in text for text in listing)
    lines = TEXT.splitlines()
    for text in listing:
        for row in text.splitlines():
            if row.startswith(" ●"):
                assert "Move" in row
                number = int(row[2:6])
                assert row[7:].strip() == lines[number - 1].strip()


def test_the_log_has_levels(recording: Path) -> None:
    levels = texts(recording, "/log/events", "TextLog:level")
    words = texts(recording, "/log/events", "TextLog:text")
    assert levels == ["INFO", "DEBUG", "DEBUG", "WARN", "DEBUG", "INFO"]
    assert words[0] == "main:7  Frame: start"
    assert texts(recording, "/log/findings", "TextLog:level") == ["WARN"]


def test_signals_are_lanes(recording: Path) -> None:
    states = texts(recording, "/signals/doPump", "StateChange:state")
    assert states == ["off", "on", "off"]


def test_a_signal_has_its_value_from_the_start_and_a_lane_if_it_never_changes(
    tmp_path: Path,
) -> None:
    starts = {"diReady": 1.0, "aoFlow": 2.5}
    path = record(replace(SIMULATION, signal_starts=starts), tmp_path / "signals.rrd")
    assert texts(path, "/signals/diReady", "StateChange:state") == ["on"]
    assert texts(path, "/signals/aoFlow", "StateChange:state") == ["2.5"]
    first = next(time for time, _ in rows(path, "/signals/diReady") if time is not None)
    assert first == 0.0


def test_the_active_limit_has_a_lane(tmp_path: Path) -> None:
    program, path = tmp_path / "line.mod", tmp_path / "line.rrd"
    program.write_text(
        "MODULE m\n PROC main()\n"
        "  MoveAbsJ [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
        " ENDPROC\nENDMODULE\n"
    )
    record(rapidsim.simulate([program], robot="irb1600"), path)
    states = texts(path, "/limits", "StateChange:state")
    assert states == ["at rest", "torque of axis 1", "TCP speed", "torque of axis 1", "at rest"]


def test_two_recordings_of_a_run_are_equal(recording: Path, tmp_path: Path) -> None:
    again = record(cell(), tmp_path / "again.rrd")
    assert compare(recording, again) == 0


def test_another_run_makes_another_recording(recording: Path, tmp_path: Path) -> None:
    other = record(cell(rounds=1), tmp_path / "other.rrd")
    assert compare(recording, other) != 0


def compare(one: Path, other: Path) -> int:
    return subprocess.run(
        [sys.executable, "-m", "rerun", "rrd", "compare", "--unordered", str(one), str(other)],
        capture_output=True,
        check=False,
    ).returncode


def test_two_robots_have_entities_and_frames_of_their_own(tmp_path: Path) -> None:
    run = two_robots()
    path = record(run, tmp_path / "two.rrd")
    entities = set(RrdReader(path).store().schema().entity_paths())
    for task in ("T_ROB1", "T_ROB2"):
        assert {f"/{task}/robot/joints/joint_1", f"/{task}/joints/angle", f"/{task}/moves"} <= (
            entities
        )
    # Each arm's own frames; the same base frame twice would be an error in the viewer.
    frames = [
        row["Transform3D:child_frame"][0]
        for entity in ("/T_ROB1/base", "/T_ROB2/base")
        for _, row in rows(path, entity)
    ]
    assert frames == ["T_ROB1/base", "T_ROB2/base"]
    ((_, base),) = rows(path, "/T_ROB2/base")
    assert np.allclose(base["Transform3D:translation"][0], [1.6, 0.3, 0.0], atol=1e-6)


def test_a_run_without_moves_is_recorded(tmp_path: Path) -> None:
    idle = replace(with_robot(SIMULATION, moves=(), lines=()), events=(), diagnostics=())
    path = record(idle, tmp_path / "idle.rrd")
    entities = RrdReader(path).store().schema().entity_paths()
    assert "/joints/angle" in entities
    assert "/path/programmed" not in entities


def test_many_places_of_one_name_share_a_label(tmp_path: Path) -> None:
    (tmp_path / "rows.mod").write_text(
        """MODULE rows
  CONST robtarget pSlot:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    FOR i FROM 1 TO 80 DO
      MoveL Offs(pSlot,0,i,0),v500,z1,tool0;
    ENDFOR
    FOR i FROM 1 TO 2 DO
      MoveL Offs(pSlot,0,0,-50*i),v500,fine,tool0;
      MoveL pSlot,v500,fine,tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""
    )
    recording = tmp_path / "rows.rrd"
    record(rapidsim.load(tmp_path / "rows.mod").run().simulation, recording)
    ((_, named),) = rows(recording, "/targets/names/near")
    assert named["Points3D:labels"] == [
        "80 places of Offs(pSlot,0,i,0), pSlot (2x)",
        "Offs(pSlot,0,0,-50*i)",
        "Offs(pSlot,0,0,-50*i)",
    ]
