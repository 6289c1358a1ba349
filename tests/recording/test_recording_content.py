"""What a recording holds, read back from the file."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from recording_cell import PEN, TEXT, cell, two_robots, with_description, without_description
from rerun.chunk import RrdReader

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion
from rapidsim.language.data import Pos, Pose
from rapidsim.motion import targets
from rapidsim.motion.limits import limits_of
from rapidsim.motion.robot import load_robot
from rapidsim.motion.trajectory import Samples, Trajectory
from rapidsim.motion.violations import PathNotReachable, UnreachableTarget
from rapidsim.recording.write import record
from rapidsim.simulation.failed_moves import FailedMove
from rapidsim.simulation.result import End, Simulation
from rapidsim.simulation.violations import UncaughtError

SIMULATION = cell()
UNLISTED = ("/robot/fixed", "/robot/base", f"/robot/{SIMULATION.robot.name}")
"""Fixed frames of the description, and the root of its shapes."""


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(SIMULATION, tmp_path_factory.mktemp("recording") / "frame.rrd")


def rows(path: Path, entity: str) -> Iterator[tuple[float | None, dict[str, Any]]]:
    """Time [s] (None where static) and components of each row of an entity, in order of time."""
    found: list[tuple[float | None, dict[str, Any]]] = []
    for chunk in RrdReader(path).stream().filter(content=entity):
        batch = chunk.to_record_batch()
        names = [name for name in batch.schema.names if name != "sim_time"]
        # Nanoseconds, which Python's own time spans would cut to microseconds.
        times = (
            [None] * batch.num_rows
            if chunk.is_static
            else [ns / 1e9 for ns in batch.column("sim_time").cast("int64").to_pylist()]
        )
        found += zip(times, batch.select(names).to_pylist(), strict=True)
    return iter(sorted(found, key=lambda item: -1.0 if item[0] is None else item[0]))


def texts(path: Path, entity: str, component: str) -> list[str]:
    return [row[component][0] for time, row in rows(path, entity) if row.get(component)]


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


def test_link_frames_chain_up_to_forward_kinematics(recording: Path) -> None:
    chain = []
    for number in range(1, 7):
        edges = [row for _, row in rows(recording, f"/robot/joints/joint_{number}")]
        turn = np.array([row["Transform3D:quaternion"][0] for row in edges])
        shift = np.array([row["Transform3D:translation"][0] for row in edges])
        chain.append(Transform(matrix_from_quaternion(np.roll(turn, 1, axis=1)), shift))
    times = np.array([time for time, _ in rows(recording, "/robot/joints/joint_1")])
    ((_, flange),) = rows(recording, "/robot/flange")
    link_from_flange = Transform.from_quaternion(
        np.roll(flange["Transform3D:quaternion"][0], 1), flange["Transform3D:translation"][0]
    )
    found = chain[0]
    for edge in chain[1:]:
        found = found @ edge
    found = found @ link_from_flange
    joints = SIMULATION.trajectory.at(times).joints
    expected = SIMULATION.robot.kinematics.forward(joints)
    assert np.abs(found.translation - expected.translation).max() < 1e-6
    assert np.abs(found.rotation - expected.rotation).max() < 1e-6


def test_every_row_of_a_moving_frame_names_its_frames(recording: Path) -> None:
    for _, row in rows(recording, "/robot/joints/joint_2"):
        assert row["Transform3D:parent_frame"] == ["irb1600-6-1.2/link_1"]
        assert row["Transform3D:child_frame"] == ["irb1600-6-1.2/link_2"]


def test_joint_angles_keep_full_precision(recording: Path) -> None:
    logged = [
        (time, row["Scalars:scalars"])
        for time, row in rows(recording, "/joints/angle")
        if time is not None
    ]
    times = np.array([time for time, _ in logged])
    angles = np.array([values for _, values in logged])
    assert np.array_equal(angles, np.degrees(SIMULATION.trajectory.at(times).joints))


def test_starts_and_ends_of_moves_are_samples(recording: Path) -> None:
    times = {time for time, _ in rows(recording, "/joints/angle")}
    for move in SIMULATION.moves:
        assert {round(move.start_s, 9), round(move.end_s, 9)} <= times
    assert round(SIMULATION.time_s, 9) in times


def test_the_tool_frame_is_the_program_s(recording: Path) -> None:
    edges = [row for time, row in rows(recording, "/robot/tcp") if time is not None]
    assert len(edges) == 1
    expected = targets.transform(PEN.tframe)
    assert np.allclose(edges[0]["Transform3D:translation"][0], expected.translation, atol=1e-6)


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


def test_a_robot_without_description_is_drawn_as_bars(tmp_path: Path) -> None:
    path = record(without_description(SIMULATION), tmp_path / "bars.rrd")
    entities = set(RrdReader(path).store().schema().entity_paths())
    assert "/robot/bars/1/bar" in entities
    assert "has no description" in texts(path, "/log/recording", "TextLog:text")[0]


URDF = """<robot name="mine">
  <link name="foot"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>
  {links}
  {joints}
</robot>"""


def primitive_urdf(folder: Path, shape: str) -> Path:
    links = "".join(
        f'<link name="l{k}"><visual><geometry>{shape}</geometry></visual></link>'
        for k in range(1, 7)
    )
    joints = "".join(
        f'<joint name="joint_{k}" type="revolute">'
        f'<parent link="{f"l{k - 1}" if k > 1 else "foot"}"/>'
        f'<child link="l{k}"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1"'
        ' effort="1"/></joint>'
        for k in range(1, 7)
    )
    path = folder / "mine.urdf"
    path.write_text(URDF.format(links=links, joints=joints))
    return path


def test_a_robot_of_plain_shapes_is_drawn_solid(tmp_path: Path) -> None:
    urdf = primitive_urdf(tmp_path, '<cylinder radius="0.05" length="0.2"/>')
    path = record(with_description(SIMULATION, urdf), tmp_path / "plain.rrd")
    entities = RrdReader(path).store().schema().entity_paths()
    assert not any(entity.startswith("/robot/bars") for entity in entities)
    entity = "/robot/mine/visual_geometries/l3/visual_0"
    fills = [row for _, row in rows(path, entity) if row.get("Cylinders3D:fill_mode")]
    assert fills


@pytest.mark.filterwarnings("default")
def test_a_shape_that_cannot_be_read_is_said_and_replaced(tmp_path: Path) -> None:
    urdf = primitive_urdf(tmp_path, '<mesh filename="lost.stl"/>')
    path = record(with_description(SIMULATION, urdf), tmp_path / "lost.rrd")
    entities = set(RrdReader(path).store().schema().entity_paths())
    assert "/robot/bars/2/ball" in entities
    assert "cannot read the shape of l1" in texts(path, "/log/recording", "TextLog:text")[0]


def test_an_error_is_marked_where_the_robot_stopped(tmp_path: Path) -> None:
    stopped = replace(
        SIMULATION,
        end=End.ERROR,
        diagnostics=(Diagnostic(UncaughtError("division by zero"), None),),
    )
    path = record(stopped, tmp_path / "stopped.rrd")
    assert texts(path, "/stopped/name", "Points3D:labels") == ["stopped: R101 uncaught-error"]


def failed_run() -> Simulation:
    """A target that cannot be reached and a way that fails half-way."""
    moves = SIMULATION.moves
    far, way = moves[1], moves[2]
    start, end = far.base_from_tcp.translation, way.base_from_tcp.translation
    return replace(
        SIMULATION,
        failed_moves=(
            FailedMove(
                far.place,
                UnreachableTarget("p1", "ABB IRB 1600", "wrist centre 47.2 mm beyond reach"),
                far.base_from_tcp,
                start[None],
                start,
            ),
            FailedMove(
                way.place,
                PathNotReachable("p2", 50.0, 120.0, "axis 3 goes 8.0 deg past its limit"),
                way.base_from_tcp,
                np.stack([start, end]),
                0.5 * (start + end),
            ),
        ),
    )


def test_what_the_arm_cannot_do_is_red_where_it_is_and_says_why(tmp_path: Path) -> None:
    run = failed_run()
    path = record(run, tmp_path / "failed.rrd")
    ((_, targets),) = rows(path, "/failed/targets")
    expected = [failed.base_from_tcp.translation for failed in run.failed_moves]
    assert np.allclose(targets["Points3D:positions"], expected, atol=1e-6)
    assert targets["Points3D:colors"] == [0xFF4040FF]
    ((_, ways),) = rows(path, "/failed/ways")
    assert len(ways["LineStrips3D:strips"]) == 1
    ((_, crosses),) = rows(path, "/failed/places")
    middle = np.mean(np.concatenate(crosses["LineStrips3D:strips"]), axis=0)
    assert np.allclose(middle, run.failed_moves[1].fails_at, atol=1e-6)
    ((_, reasons),) = rows(path, "/failed/reasons")
    words = [" ".join(text.split()) for text in reasons["Points3D:labels"]]
    assert words[0].startswith("K601 line 11: p1 cannot be reached by ABB IRB 1600")
    assert "fails at 50 % (120.0 mm): axis 3 goes 8.0 deg past its limit" in words[1]


def test_the_path_is_there_in_the_colours_of_speed(recording: Path) -> None:
    ((_, row),) = rows(recording, "/path/speed")
    strips, colours = row["LineStrips3D:strips"], row["LineStrips3D:colors"]
    assert len(strips) == len(colours)
    assert len(set(colours)) > 3
    # All of the way, and nothing but the way.
    length = sum(np.linalg.norm(np.diff(strip, axis=0), axis=1).sum() for strip in strips)
    times = np.array([time for time, _ in rows(recording, "/joints/angle") if time is not None])
    way = SIMULATION.trajectory.at(times).base_from_tcp.translation
    assert length == pytest.approx(np.linalg.norm(np.diff(way, axis=0), axis=1).sum(), rel=1e-4)


def test_joint_speeds_and_accelerations_are_those_of_the_angles(recording: Path) -> None:
    limits = limits_of(SIMULATION.robot, SIMULATION.model)
    curves = {
        entity: (
            np.array([time for time, _ in rows(recording, entity) if time is not None]),
            np.array([r["Scalars:scalars"] for time, r in rows(recording, entity) if time]),
        )
        for entity in ("/joints/angle", "/joints/speed", "/joints/acceleration")
    }
    times, angles = curves["/joints/angle"][0][1:], curves["/joints/angle"][1]
    speeds = curves["/joints/speed"][1] * np.degrees(limits.max_speed) / 100.0
    # The trapezoids under the speed are the way; they are off by the curvature in 12 ms.
    way = np.sum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times)[:, None], axis=0)
    assert np.allclose(way, angles[-1] - angles[0], atol=0.2)
    assert np.abs(curves["/joints/acceleration"][1]).max() > 1.0


def test_a_longer_step_makes_fewer_rows_and_says_so(tmp_path: Path) -> None:
    path = record(SIMULATION, tmp_path / "coarse.rrd", dt=0.1)
    times = [time for time, _ in rows(path, "/joints/angle") if time is not None]
    assert len(times) < SIMULATION.time_s / 0.1 + 2 * len(SIMULATION.moves) + 5
    assert "every 100 ms" in texts(path, "/log/recording", "TextLog:text")[0]
    with pytest.raises(InputError, match="greater than 0"):
        record(SIMULATION, tmp_path / "none.rrd", dt=0.0)


def test_an_arm_that_stands_still_adds_no_rows(tmp_path: Path, recording: Path) -> None:
    longer = replace(SIMULATION, time_s=SIMULATION.time_s + 30.0)
    path = record(longer, tmp_path / "longer.rrd")
    before, after = (sum(1 for _ in rows(one, "/joints/angle")) for one in (recording, path))
    assert after <= before + 4


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
    idle = replace(SIMULATION, moves=(), lines=(), events=(), diagnostics=())
    path = record(idle, tmp_path / "idle.rrd")
    entities = RrdReader(path).store().schema().entity_paths()
    assert "/joints/angle" in entities
    assert "/path/programmed" not in entities


def test_a_tool_that_changes_is_followed(tmp_path: Path) -> None:
    longer = PEN._replace(tframe=Pose(Pos(0.0, 0.0, 300.0), PEN.tframe.rot))
    moves = tuple(
        replace(move, move=replace(move.move, tool=longer)) if move.index >= 5 else move
        for move in SIMULATION.moves
    )
    path = record(replace(SIMULATION, moves=moves), tmp_path / "tools.rrd")
    edges = [(time, row) for time, row in rows(path, "/robot/tcp") if time is not None]
    assert [time for time, _ in edges] == [0.0, round(moves[5].start_s, 9)]
    assert np.allclose(edges[1][1]["Transform3D:translation"][0], [0.0, 0.0, 0.3])


def test_a_work_object_may_be_an_expression_or_named_like_a_frame(tmp_path: Path) -> None:
    names = ["wobjs{1}", "base", r"Cells{n}.wobj"]
    moves = tuple(
        replace(
            move,
            place=replace(
                move.place, arguments={**move.place.arguments, "wobj": names[move.index % 3]}
            ),
        )
        for move in SIMULATION.moves
    )
    path = record(replace(SIMULATION, moves=moves), tmp_path / "names.rrd")
    frames = {
        row["Transform3D:child_frame"][0]
        for _, row in rows(path, "/work_objects/**")
        if row.get("Transform3D:child_frame")
    }
    assert {"wobjs{1}", "base (wobj)", "Cells{n}.wobj"} <= frames
    assert "base" not in frames


class Interrupting(Trajectory):
    """A trajectory during which the user presses Ctrl-C."""

    def __init__(self) -> None:
        pass

    @property
    def duration(self) -> float:
        return 1.0

    def at(self, times: Array) -> Samples:
        raise KeyboardInterrupt


def interrupted(simulation: Simulation) -> Simulation:
    return replace(simulation, trajectory=Interrupting())


def test_an_interrupted_recording_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        record(interrupted(SIMULATION), tmp_path / "frame.rrd")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_recording_keeps_the_older_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "frame.rrd"
    path.write_bytes(b"older")

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rapidsim.recording.write.log_moves", interrupt)
    with pytest.raises(KeyboardInterrupt):
        record(SIMULATION, path)
    assert [file.name for file in tmp_path.iterdir()] == ["frame.rrd"]
    assert path.read_bytes() == b"older"


def test_a_folder_that_does_not_exist_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        record(SIMULATION, tmp_path / "nowhere" / "frame.rrd")


def test_a_rod_turns_its_link_back_by_axis_2(tmp_path: Path) -> None:
    """The link that the description hangs link 3 on keeps the direction of link 1."""
    file = record(replace(SIMULATION, robot=load_robot("irb2400")), tmp_path / "rod.rrd")
    level = [row for _, row in rows(file, "/robot/joints/joint_3_rod")]
    upper = [row for _, row in rows(file, "/robot/joints/joint_2")]
    assert len(level) == len(upper) > 2
    link_2_from_level, link_1_from_link_2 = (
        matrix_from_quaternion(
            np.roll([row["Transform3D:quaternion"][0] for row in edges], 1, axis=1)
        )
        for edges in (level, upper)
    )
    assert np.abs(link_1_from_link_2 - np.eye(3)).max() > 0.1
    assert np.allclose(link_1_from_link_2 @ link_2_from_level, np.eye(3), atol=1e-6)
