"""What the arm looks like in a recording: bars, plain shapes, shapes that cannot be read."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from recording_cell import with_description, without_description
from recording_read import SIMULATION, rows, texts
from rerun.chunk import RrdReader

from rapidsim.motion.robot.catalogue import robots_folder
from rapidsim.recording.layout.write import record
from rapidsim.recording.scene.shading import shaded, smooth


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


def test_normals_follow_from_faces() -> None:
    """A box keeps its edges, the wall of a drum is round and its lids are flat."""
    box = trimesh.creation.box((0.2, 0.3, 0.4))
    vertices, normals, faces = smooth(box.vertices, box.faces)
    assert len(vertices) == 24
    np.testing.assert_allclose(normals[faces], np.repeat(box.face_normals[:, None], 3, axis=1))
    drum = trimesh.creation.cylinder(0.1, 0.5, sections=40)
    vertices, normals, faces = smooth(drum.vertices, drum.faces)
    np.testing.assert_array_equal(vertices[faces], drum.triangles)
    wall = np.abs(drum.face_normals[:, 2]) < 0.5
    radial = vertices[faces[wall]] * (10.0, 10.0, 0.0)
    np.testing.assert_allclose(normals[faces[wall]], radial, atol=0.03)
    np.testing.assert_allclose(np.abs(normals[faces[~wall]][..., 2]), 1.0)


def test_link_shapes_of_the_catalogue_are_recorded_with_normals() -> None:
    file = robots_folder() / "irb120-3-0.58" / "meshes" / "link_2.glb"
    bare, drawn = (
        trimesh.load_scene(io.BytesIO(data), "glb", process=False).geometry
        for data in (file.read_bytes(), shaded(file.read_bytes()))
    )
    assert bare.keys() == drawn.keys()
    for name, mesh in drawn.items():
        assert "vertex_normals" in mesh._cache
        np.testing.assert_array_equal(mesh.triangles, bare[name].triangles)
        assert mesh.visual.material.name == bare[name].visual.material.name


@pytest.mark.parametrize("damage", [lambda data: data[:40], lambda data: b"solid", shaded])
def test_other_files_are_drawn_as_they_are(damage: Callable[[bytes], bytes]) -> None:
    data = damage((robots_folder() / "irb120-3-0.58" / "meshes" / "link_2.glb").read_bytes())
    assert shaded(data) == data
