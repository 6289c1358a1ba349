"""Shape files: each kind is read alike, and each bad one has its message and exit code 2."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from collision_cells import HEAD, cell, codes, report
from command_line import call
from fuzzing.step_prism import UNITS, step_prism

from rapidsim import extras
from rapidsim.collisions.meshes import step
from rapidsim.collisions.meshes.read import read_mesh
from rapidsim.collisions.meshes.triangles import components, hollowness
from rapidsim.files import InputError

BOX = trimesh.creation.box((100.0, 200.0, 300.0))
PRISM = ((0, 0), (100, 0), (100, 20), (20, 20), (20, 60), (0, 60))
OBJECT = """[[object]]
name = "vice"
mesh = "{0}"
unit = "mm"
pose = {{ position = [{1}] }}
"""
AWAY = "0, 0, 5000"


def export(folder: Path, kind: str) -> Path:
    """The box in a file of a kind."""
    match kind:
        case "gltf":
            for name, data in trimesh.Scene(BOX).export(file_type="gltf").items():  # type: ignore[no-untyped-call]
                (folder / name).write_bytes(data)
            return folder / "model.gltf"
        case "glb":
            trimesh.Scene(BOX).export(folder / "box.glb")  # type: ignore[no-untyped-call]
            return folder / "box.glb"
        case "ascii.stl":
            (folder / kind).write_text(trimesh.exchange.stl.export_stl_ascii(BOX))
        case "ascii.ply":
            (folder / kind).write_bytes(trimesh.exchange.ply.export_ply(BOX, encoding="ascii"))
        case _:
            BOX.export(folder / kind)
    return folder / kind


@pytest.mark.parametrize(
    "kind", ["box.stl", "ascii.stl", "box.obj", "box.ply", "ascii.ply", "glb", "gltf"]
)
def test_a_box_is_the_same_in_every_kind_of_file(kind: str, tmp_path: Path) -> None:
    mesh = read_mesh(export(tmp_path, kind), tmp_path)
    assert mesh.closed
    assert len(mesh.faces) == 12
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), (100.0, 200.0, 300.0))


@pytest.mark.parametrize("unit", UNITS)
def test_a_step_file_has_its_unit(unit: str, tmp_path: Path) -> None:
    """An L, closed, of the size that its unit says, with z up."""
    (tmp_path / "l.step").write_text(step_prism(PRISM, 30.0, unit))
    mesh = read_mesh(tmp_path / "l.step", tmp_path)
    assert mesh.closed
    assert len(mesh.faces) == 4 + 4 + 12
    sizes = np.ptp(mesh.vertices, axis=0)
    np.testing.assert_allclose(sizes, np.array([0.1, 0.06, 0.03]) * UNITS[unit], rtol=1e-6)


def test_a_step_file_needs_an_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    (tmp_path / "l.stp").write_text(step_prism(PRISM, 30.0))
    with pytest.raises(InputError, match=r"reading .*l\.stp needs cascadio") as raised:
        read_mesh(tmp_path / "l.stp", tmp_path)
    assert raised.value.help == 'pip install "rapidsim[step]"'


def test_a_step_file_that_takes_too_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A corner so far away that triangles are sought forever, or until memory ends."""
    monkeypatch.setattr(step, "_MOST_S", 1.5)
    (tmp_path / "l.step").write_text(step_prism(((0, 0), (1e300, 0), (0, 1)), 30.0))
    with pytest.raises(InputError):
        read_mesh(tmp_path / "l.step", tmp_path)


def test_bodies_that_touch_are_pieces_of_their_own(tmp_path: Path) -> None:
    upper = BOX.copy()
    upper.apply_translation((0.0, 0.0, 300.0))
    upper.apply_scale((0.5, 0.5, 1.0))
    trimesh.util.concatenate([BOX, upper, trimesh.creation.torus(500.0, 50.0)]).export(  # type: ignore[no-untyped-call]
        tmp_path / "three.stl"
    )
    mesh = read_mesh(tmp_path / "three.stl", tmp_path)
    pieces = components(mesh.faces, len(mesh.vertices))
    assert sorted(hollowness(mesh.vertices, one) > 1.0 for one in pieces) == [False, False, True]


def stl(*corners: float) -> bytes:
    facets = np.array(corners, dtype="<f4").reshape(-1, 9)
    return (
        bytes(80)
        + struct.pack("<I", len(facets))
        + b"".join(struct.pack("<3f", 0, 0, 1) + one.tobytes() + bytes(2) for one in facets)
    )


def gltf(**changed: object) -> bytes:
    tree = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAA"}],
    }
    return json.dumps({**tree, **changed}).encode()


def ply(face: bytes) -> bytes:
    corners = b"element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
    faces = b"element face 1\nproperty list uchar float vertex_indices\n"
    return b"ply\nformat ascii 1.0\n" + corners + faces + b"end_header\n0 0 0\n" + face + b"\n"


BAD = {
    "missing.stl": (None, "does not exist"),
    "empty.stl": (b"", "not an STL file"),
    "cut.stl": (stl(0, 0, 0, 1, 0, 0, 0, 1, 0)[:-20], "truncated"),
    "bomb.stl": (bytes(80) + struct.pack("<I", 2**32 - 1), "truncated"),
    "flat.stl": (stl(0, 0, 0, 1, 0, 0, 2, 0, 0), "no triangle has an area"),
    "point.stl": (stl(*[5.0] * 9), "all corners are in one place"),
    "nan.stl": (stl(0, 0, 0, 1, 0, 0, 0, float("nan"), 0), "a corner has no finite position"),
    "open.stl": (stl(0, 0, 0, 100, 0, 0, 0, 100, 0), "is not closed"),
    "words.stl": (b"solid x\nfacet\nvertex 1 2 three\n", "is damaged"),
    "half.stl": (b"solid x\nvertex 1 2 3\n", "truncated"),
    "far.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "a corner that does not exist"),
    "beyond.obj": (b"v 0 0 0\nf 1 2 " + b"9" * 30, "a corner that does not exist"),
    "bad.obj": (b"v 0 0\n", "bad.obj:1"),
    "none.obj": (b"# nothing\n", "has no triangles"),
    "many.obj": (b"v 0 0 0\nf " + b"1 " * 200_000 + b"\n", "more than 100000 triangles"),
    "bad.ply": (
        b"ply\nformat ascii 1.0\nelement vertex 3\nend_header\n",
        "damaged or truncated PLY",
    ),
    "bomb.ply": (
        b"ply\nformat ascii 1.0\nelement vertex 999999999\nproperty float x\nend_header\n",
        "damaged or truncated PLY",
    ),
    "beyond.ply": (ply(b"3 0 1 " + b"9" * 30), "a corner that does not exist"),
    "nan.ply": (ply(b"3 0 1 nan"), "damaged or truncated PLY"),
    "text.ply": (b"hello", "not a PLY file"),
    "bad.gltf": (b"{", "not a readable glTF"),
    "list.gltf": (b"[1]", "not a readable glTF"),
    "deep.gltf": (b"[" * 100_000, "nested too deeply"),
    "short.gltf": (gltf(), "not a readable glTF"),
    "ring.gltf": (gltf(nodes=[{"children": [0]}]), "its nodes do not form a tree"),
    "outside.gltf": (gltf(buffers=[{"byteLength": 36, "uri": "../../secret.bin"}]), "leads out of"),
    "sparse.gltf": (gltf(accessors=[{"componentType": 5126, "count": 3}]), "sparse"),
    "huge.glb": (b"glTF" + struct.pack("<III", 2, 2**31, 2**31) + b"JSON", "not a readable glTF"),
    "shape.iges": (b"S      1", "unknown kind of shape file"),
    "text.step": (b"hello", "not a readable STEP"),
    "empty.stp": (step_prism(PRISM, 30.0).replace("FACE(", "FACT(").encode(), "has no triangles"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_told_in_one_message(name: str, tmp_path: Path) -> None:
    data, said = BAD[name]
    if data is not None:
        (tmp_path / name).write_bytes(data)
    cell(tmp_path, "", OBJECT.format(name, AWAY))
    ended = call("run", "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 2, ended
    assert said in ended.err
    assert name in ended.err
    assert ended.err.count("error") == 1
    assert not list(tmp_path.glob("*.rrd"))


def test_corners_that_no_triangle_names_are_left_out(tmp_path: Path) -> None:
    """A cloud of points with one triangle at its end."""
    corners = "".join(f"v {n} {n * n} 0\n" for n in range(20))
    (tmp_path / "cloud.obj").write_text(f"{corners}f 18 19 20\n")
    mesh = read_mesh(tmp_path / "cloud.obj", tmp_path)
    assert sorted(mesh.vertices[:, 0]) == [17.0, 18.0, 19.0]


def test_a_file_is_no_larger_than_it_may_be(tmp_path: Path) -> None:
    with (tmp_path / "vice.stl").open("wb") as stream:
        stream.truncate(51_000_000)
    cell(tmp_path, "", OBJECT.format("vice.stl", AWAY))
    ended = call("run", "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 2
    assert "larger than 50 MB" in ended.err


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ('mesh = "box.stl"', "the file does not give one"),
        ('mesh = "box.stl"\nunit = "mile"', "`mile` is not a unit of length"),
        ('mesh = "box.stl"\nunit = "m"', "300000 mm long in m"),
        ('mesh = "../box.stl"\nunit = "mm"', "leads out of"),
        ("box = [1, 2]", "3 numbers are needed"),
        ("box = [1, 2, -3]", "lengths are from"),
        ("box = [1, 2, 1e30]", "lengths are from"),
        ("box = [1, 2, inf]", "a list of numbers"),
        ("sphere = { diameter = 0 }", "a number above 0"),
        ("capsule = { diameter = 50, length = 40 }", "longer than the diameter"),
        ("cylinder = { diameter = 50 }", "length: is missing"),
        ("plane = false", "plane = true"),
        ('plane = true\nparent = "wobj"', "is none of `world`"),
        ('plane = true\ncolour = "red"', "is not a colour"),
        ("plane = true\nbox = [1, 1, 1]", "one of box"),
        ("plane = true\npose = { position = [1e30, 0, 0] }", "kilometre"),
    ],
)
def test_a_wrong_object_is_told(wrong: str, said: str, tmp_path: Path) -> None:
    export(tmp_path, "box.stl")
    cell(tmp_path, "", f'[[object]]\nname = "thing"\n{wrong}\n')
    ended = call("run", "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 2, ended
    assert said in ended.err


def test_an_arm_inside_a_hollow_body_is_found(tmp_path: Path) -> None:
    # A closed tube around the arm: its surface is never met, and yet the arm is in it.
    thick = trimesh.creation.torus(3000.0, 2500.0)
    thick.export(tmp_path / "ring.stl")
    cell(tmp_path, "", OBJECT.format("ring.stl", "-3000, 0, 500"))
    found = report(tmp_path, 1)
    assert codes(found)[0] == "C101"
    assert found["collisions"][0]["time_s"] == 0.0


def test_a_surface_needs_no_inside(tmp_path: Path) -> None:
    (tmp_path / "sheet.stl").write_bytes(stl(-300, -300, 0, 300, -300, 0, 0, 600, 0))
    station = OBJECT.format("sheet.stl", "700, 0, 500") + 'filling = "surface"\n'
    cell(tmp_path, "    MoveL Offs(over,0,0,-150),v200,fine,tool0;", station, HEAD)
    assert "C101" in codes(report(tmp_path, 1))
