"""`[robot] shapes`: the user's own meshes take the place of the drawn links."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from collision_cells import ARM, HEAD, TABLE, cell, codes, report
from command_line import call

from rapidsim import load_robot
from rapidsim.frames.transform import Array

ROBOT = load_robot("irb1600-6-1.2")
SHAPES = 'shapes = "arm"\nshapes-unit = "mm"\n'
NAMES = ("base_link", *(f"link_{number}" for number in range(1, 7)))


def own_arm(folder: Path, tip_mm: float = 40.0, *, in_base: bool = False) -> None:
    """Small cubes where the links are, and a rod along the flange as the last, in mm."""
    at_zero = ROBOT.kinematics.link_frames(np.zeros(6)).translation
    places: Array = 1e3 * np.vstack([np.zeros(3), at_zero])
    (folder / "arm").mkdir()
    for name, place in zip(NAMES, places, strict=True):
        body = trimesh.creation.box([20.0, 20.0, 20.0])
        if name == "link_6":
            # With all joints at zero the flange of this arm looks along x.
            body = trimesh.creation.box([tip_mm, 20.0, 20.0])
            body.apply_translation([0.5 * tip_mm, 0.0, 0.0])
        if in_base:
            body.apply_translation(place)
        body.export(folder / "arm" / f"{name}.stl")


def own_cell(folder: Path, wanted: str = SHAPES, station: str = "") -> None:
    """A move that ends 80 mm above a table, of an arm with other shapes."""
    moves = "    MoveL Offs(over,0,0,-40),v500,fine,tool0;"
    file = cell(folder, moves, "", HEAD)
    (file.parent / "rapidsim.toml").write_text(f"{ARM}{wanted}{TABLE}{station}", encoding="utf-8")


def test_what_the_user_has_counts_and_not_what_is_drawn(tmp_path: Path) -> None:
    own_cell(tmp_path, "")
    drawn = report(tmp_path, 0)
    assert drawn["clearance_mm"] > 50.0
    own_arm(tmp_path, 300.0)
    own_cell(tmp_path)
    assert codes(report(tmp_path, 1))[0] == "C101"
    ended = call("check", "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 1
    assert "C101" in ended.out


def test_drawings_of_a_whole_arm_are_taken_apart(tmp_path: Path) -> None:
    found = []
    for in_base in (False, True):
        folder = tmp_path / str(in_base)
        folder.mkdir()
        own_arm(folder, 80.0, in_base=in_base)
        own_cell(folder, SHAPES + ('shapes-frame = "base"\n' if in_base else ""))
        found.append(report(folder, 0)["clearance_mm"])
    assert found[0] == pytest.approx(found[1], abs=1e-3)


def test_recording_and_report_show_them(tmp_path: Path) -> None:
    own_arm(tmp_path)
    own_cell(tmp_path)
    ended = call("run", "cell.mod", "--report", "cell.html", cwd=tmp_path)
    assert ended.code == 0, ended
    assert "bars" not in ended.err + ended.out
    assert (tmp_path / "cell.rrd").stat().st_size > 10_000
    assert '"colour":"#f0781e"' in (tmp_path / "cell.html").read_text("utf-8").replace(" ", "")


@pytest.mark.parametrize(
    ("wanted", "remove", "add", "said"),
    [
        (SHAPES, ("link_3",), "", "has no file for link_3"),
        (SHAPES, NAMES, "", "has no file for base_link, link_1"),
        (SHAPES, (), "link_7.stl", "has no such link"),
        (SHAPES, (), "link_2.obj", "two files for link_2"),
        (SHAPES, ("link_2",), "link_2.stl", "not an STL file"),
        ('shapes = "arm"\n', (), "", "does not state its unit"),
        ('shapes = "arm"\nshapes-unit = "m"\n', (), "", "20000 mm long"),
        ('shapes = "arm"\nshapes-unit = "mile"\n', (), "", "not a unit of length"),
        (SHAPES + 'shapes-frame = "tool"\n', (), "", "neither `link` nor `base`"),
        ('shapes = "arms"\n', (), "", "is not a folder"),
        ('shapes = "../.."\n', (), "", "leads out of"),
        ('shapes-unit = "mm"\n', (), "", "`shapes`, which are missing"),
    ],
)
def test_shapes_that_are_not_those_of_the_arm_are_told(
    wanted: str, remove: tuple[str, ...], add: str, said: str, tmp_path: Path
) -> None:
    own_arm(tmp_path)
    own_cell(tmp_path, wanted)
    for name in remove:
        (tmp_path / "arm" / f"{name}.stl").unlink()
    if add:
        (tmp_path / "arm" / add).write_bytes(b"hello")
    command = "check" if add else "run"
    ended = call(command, "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 2, ended
    assert said in ended.err
    assert ended.err.count("error") == 1
    assert not list(tmp_path.glob("*.rrd"))


def test_a_link_out_of_the_folder_is_not_followed(tmp_path: Path) -> None:
    own_arm(tmp_path)
    own_cell(tmp_path)
    (tmp_path / "arm" / "link_2.stl").rename(tmp_path / "elsewhere.stl")
    (tmp_path / "arm" / "link_2.stl").symlink_to(tmp_path / "elsewhere.stl")
    ended = call("check", "cell.mod", cwd=tmp_path, columns=1000)
    assert ended.code == 2, ended
    assert "link_2.stl leads out of" in ended.err
