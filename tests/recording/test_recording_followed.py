"""The recording of a trajectory through points, read back from the file."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from rerun.chunk import RrdReader

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.waypoints.follow import FollowedTrajectory, follow
from rapidsim.motion.waypoints.plan import Plan
from rapidsim.motion.waypoints.points import Points
from rapidsim.recording.layout.waypoint_recording import record_followed

ROBOT = load_robot("rv-m1")
PEN = Transform(np.eye(3), np.array([0.0, 0.0, 0.08]))


def zigzag() -> FollowedTrajectory:
    positions = np.array([[0.40, -0.1, 0.2], [0.42, 0.0, 0.3], [0.40, 0.1, 0.2]])
    pitches = np.zeros((3, 1))
    result = follow(ROBOT, Points(positions, pitches), pitches, PEN, Plan(speed=0.2))
    assert isinstance(result, FollowedTrajectory)
    return result


def column(path: Path, entity: str, component: str) -> Array:
    """The rows of a component, in order of time."""
    batches = [chunk.to_record_batch() for chunk in RrdReader(path).stream().filter(content=entity)]
    table = pa.Table.from_batches(
        [
            batch.select(["sim_time", component])
            for batch in batches
            if "sim_time" in batch.schema.names
        ]
    )
    rows: Array = np.array(
        table.sort_by("sim_time").column(component).to_pylist(), dtype=np.float64
    )
    return rows


def test_arm_path_points_and_figures_are_there(tmp_path: Path) -> None:
    made = zigzag()
    path = record_followed(made, "zigzag.csv", tmp_path / "zigzag.rrd")
    entities = set(RrdReader(path).store().schema().entity_paths())
    assert {
        "/points",
        "/path/travelled",
        "/path/straight",
        "/figures",
        "/joints/angle",
        "/joints/speed",
        "/tcp/speed",
        "/tcp/deviation",
        "/robot/joints/joint_5",
        "/robot/tcp",
        "/robot/tool",
    } <= entities
    angles = column(path, "/joints/angle", "Scalars:scalars")
    assert angles == pytest.approx(np.degrees(made.samples.joints))
    # Joint by joint the frames add up to the flange that forward kinematics gives.
    last = Transform.identity()
    for name in (joint.name for joint in ROBOT.joints):
        place = column(path, f"/robot/joints/{name}", "Transform3D:translation")[-1, 0]
        x, y, z, w = column(path, f"/robot/joints/{name}", "Transform3D:quaternion")[-1, 0]
        last = last @ Transform.from_quaternion([w, x, y, z], place)
    links = ROBOT.kinematics.link_frames(made.samples.joints[-1])
    assert last.translation == pytest.approx(links[-1].translation, abs=1e-6)


def test_the_same_trajectory_is_the_same_recording(tmp_path: Path) -> None:
    first, second = (
        record_followed(zigzag(), "zigzag.csv", tmp_path / f"{name}.rrd") for name in "ab"
    )
    assert (
        RrdReader(first).store().schema().entity_paths()
        == RrdReader(second).store().schema().entity_paths()
    )
    for entity, component in (("/joints/angle", "Scalars:scalars"),):
        assert (column(first, entity, component) == column(second, entity, component)).all()
