"""The frame tree: poses compose, angles turn back, targets stand in their frame."""

import json
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidsim.files import SourceFile
from rapidsim.frames.quaternion import angle_between, from_zyx
from rapidsim.jobs.checking.checked_program import load
from rapidsim.json_records.encoding import json_of
from rapidsim.language.data import Orient, Pos, Pose
from rapidsim.report.tables.frame_text import euler_zyx_deg, frame_record
from rapidsim.report.tables.frame_tree import FrameNode, composed, frame_tree
from rapidsim.simulation.start_values import start_values

angles = st.floats(-math.pi, math.pi)
CELL = Path(__file__).parents[1] / "cli" / "programs" / "cell.mod"


@given(angles, st.floats(-math.pi / 2, math.pi / 2), angles)
def test_angles_turn_back_into_the_rotation(z: float, y: float, x: float) -> None:
    rotation = from_zyx(z, y, x)
    back = from_zyx(*(math.radians(angle) for angle in euler_zyx_deg(Orient(*rotation))))
    assert angle_between(rotation, back) < 1e-6


@pytest.mark.parametrize("y", [90.0, -90.0])
def test_where_two_axes_are_one_z_takes_the_turn(y: float) -> None:
    rotation = from_zyx(math.radians(30.0), math.radians(y), 0.0)
    assert euler_zyx_deg(Orient(*rotation)) == pytest.approx((30.0, y, 0.0), abs=1e-5)


def test_composing_poses_is_associative() -> None:
    a, b, c = (
        Pose(Pos(n, 2.0 * n, -n), Orient(*from_zyx(0.3 * n, 0.2, -0.1 * n)))
        for n in (1.0, 2.0, 3.0)
    )
    left, right = composed(composed(a, b), c), composed(a, composed(b, c))
    assert left.trans == pytest.approx(right.trans)
    assert left.rot == pytest.approx(right.rot)


def tree_of(text: str) -> FrameNode:
    loaded = load((SourceFile("a.mod", text, "utf-8"),))
    assert loaded.program, [d.violation.message for d in loaded.diagnostics]
    return frame_tree(loaded.program, start_values(loaded.program), "arm")


def named(frame: FrameNode) -> dict[str, tuple[str, FrameNode]]:
    """Each frame by name, with the name of the one above."""
    found = {}
    for child in frame.children:
        found[child.name] = (frame.name, child)
        found.update(named(child))
    return found


def test_frames_stand_where_the_program_puts_them() -> None:
    frames = named(tree_of(CELL.read_text()))
    assert {name: above for name, (above, _) in frames.items()} == {
        "base": "world",
        "tool0": "base",
        "tGrip": "tool0",
        "wPart.uframe": "tool0",
        "wPart.oframe": "wPart.uframe",
        "tNozzle": "world",
        "wTray.uframe": "world",
        "wTray.oframe": "wTray.uframe",
        "pAbove": "wTray.oframe",
        "pPick": "wTray.oframe",
        "pHome": "world",
        "pOld": "world",
    }
    in_world = frames["pPick"][1].world_from_frame
    assert in_world
    assert in_world.trans == pytest.approx((616.9615, -109.3782, 220.0), abs=1e-3)
    assert frames["tGrip"][1].world_from_frame is None


def test_a_target_under_two_work_objects_stands_twice() -> None:
    text = CELL.read_text().replace('TPWrite "Done";', "MoveL pHome,v100,fine,tGrip\\WObj:=wTray;")
    root = tree_of(text)
    assert json.dumps(json_of(frame_record(root))).count('"pHome"') == 2


def test_values_are_those_before_the_run() -> None:
    text = (
        'MODULE a\n  PERS wobjdata w:=[FALSE,TRUE,"",[[1,2,3],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
        "  VAR robtarget p;\n  PROC main()\n    w.uframe.trans.x:=100;\n    p:=CRobT();\n"
        "  ENDPROC\nENDMODULE\n"
    )
    frames = named(tree_of(text))
    assert frames["w.uframe"][1].parent_from_frame.trans.x == 1.0
    assert frames["p"][1].note == "not set before the program runs"
