"""How the arm, its tool and its path move in a recording, against the trajectory itself."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from recording_cell import PEN
from recording_read import SIMULATION, rows, texts

from rapidsim.files import InputError
from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.language.data import Pos, Pose
from rapidsim.motion.configurations import targets
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.recording.layout.write import record


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(SIMULATION, tmp_path_factory.mktemp("recording") / "frame.rrd")


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
    joints = SIMULATION.only.trajectory.at(times).joints
    expected = SIMULATION.only.robot.kinematics.forward(joints)
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
    assert np.array_equal(angles, np.degrees(SIMULATION.only.trajectory.at(times).joints))


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


def test_a_tool_that_changes_is_followed(tmp_path: Path) -> None:
    longer = PEN._replace(tframe=Pose(Pos(0.0, 0.0, 300.0), PEN.tframe.rot))
    moves = tuple(
        replace(move, move=replace(move.move, tool=longer)) if move.index >= 5 else move
        for move in SIMULATION.moves
    )
    path = record(with_robot(SIMULATION, moves=moves), tmp_path / "tools.rrd")
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
    path = record(with_robot(SIMULATION, moves=moves), tmp_path / "names.rrd")
    frames = {
        row["Transform3D:child_frame"][0]
        for _, row in rows(path, "/work_objects/**")
        if row.get("Transform3D:child_frame")
    }
    assert {"wobjs{1}", "base (wobj)", "Cells{n}.wobj"} <= frames
    assert "base" not in frames


def test_the_path_is_there_in_the_colours_of_speed(recording: Path) -> None:
    ((_, row),) = rows(recording, "/path/speed")
    strips, colours = row["LineStrips3D:strips"], row["LineStrips3D:colors"]
    assert len(strips) == len(colours)
    assert len(set(colours)) > 3
    # All of the way, and nothing but the way.
    length = sum(np.linalg.norm(np.diff(strip, axis=0), axis=1).sum() for strip in strips)
    times = np.array([time for time, _ in rows(recording, "/joints/angle") if time is not None])
    way = SIMULATION.only.trajectory.at(times).base_from_tcp.translation
    assert length == pytest.approx(np.linalg.norm(np.diff(way, axis=0), axis=1).sum(), rel=1e-4)


def test_joint_speeds_and_accelerations_are_those_of_the_angles(recording: Path) -> None:
    limits = limits_of(SIMULATION.only.robot, SIMULATION.model)
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


def test_a_rod_turns_its_link_back_by_axis_2(tmp_path: Path) -> None:
    """The link that the description hangs link 3 on keeps the direction of link 1."""
    file = record(with_robot(SIMULATION, robot=load_robot("irb2400")), tmp_path / "rod.rrd")
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
