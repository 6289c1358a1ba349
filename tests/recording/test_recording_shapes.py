"""What the arm looks like in a recording: bars, plain shapes, shapes that cannot be read."""

from __future__ import annotations

from pathlib import Path

import pytest
from recording_cell import with_description, without_description
from recording_read import SIMULATION, rows, texts
from rerun.chunk import RrdReader

from rapidsim.recording.layout.write import record


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
