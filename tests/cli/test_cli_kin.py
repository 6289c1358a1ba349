"""`rapidsim kin`: the JSON that scripts rely on, the tables, and every wrong input."""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli_helper import assert_golden, rapidsim

POSE = (
    "--position=294.800579580170,190.987803668695,227.698729810778",
    "--quaternion=0.0647047612756,-0.224143868042,-0.965925826289,-0.112071934021",
)
"""Where all joints of the IRB 120 are 30 deg."""
OFFSET_WRIST = """<robot name="bench">
  <link name="base"/>{joints}
</robot>
"""


def report(*arguments: object, code: int = 0) -> dict[str, Any]:
    ended = rapidsim("kin", *arguments, "--format", "json")
    assert ended.code == code, ended.err
    loaded: dict[str, Any] = json.loads(ended.out)
    return loaded


def test_forward() -> None:
    found = report("fk", "--robot", "irb120", "--joints", "30,30,30,30,30,30")
    assert found["robot"] == "irb120-3-0.58"
    assert found["joints_deg"] == [30.0] * 6
    assert found["position_mm"] == pytest.approx([294.80058, 190.987804, 227.69873], abs=1e-5)
    assert found["quaternion"] == pytest.approx([0.06470476, -0.22414387, -0.96592583, -0.11207193])
    assert np.array(found["matrix"])[:3, 3] == pytest.approx(found["position_mm"])
    assert [link["name"] for link in found["links"]] == [f"link_{n}" for n in range(1, 7)]
    assert found["conf"] == [0, 0, 0, 0]


def test_relative_transforms_multiply_to_the_tcp() -> None:
    joints = ("--joints", "30,30,30,30,30,30", "--tool", "0,0,100")
    found = report("fk", "--robot", "irb120", *joints)
    names = [frame["name"] for frame in found["relative"]]
    assert names == [*(f"T({k},{k + 1})" for k in range(6)), "T(6,TCP)"]
    product = np.linalg.multi_dot([np.array(frame["matrix"]) for frame in found["relative"]])
    assert product == pytest.approx(np.array(found["matrix"]), abs=1e-9)


def test_a_tool_moves_the_tcp() -> None:
    found = report("fk", "--robot", "irb120", "--joints", "0,0,0,0,0,0", "--tool", "0,0,100")
    assert found["position_mm"] == pytest.approx([474.0, 0.0, 630.0])
    turned = report(
        "fk", "--robot", "irb120", "--joints", "0,0,0,0,0,0", "--tool", "[0,0,100],[0,0,0,1]"
    )
    assert turned["position_mm"] == pytest.approx([474.0, 0.0, 630.0])
    assert turned["quaternion"] != pytest.approx(found["quaternion"])


def test_inverse_gives_a_solution_for_each_branch_within_limits() -> None:
    found = report("ik", "--robot", "irb120", *POSE)
    assert (found["solver"], found["reachable"], found["why"]) == ("analytic", True, None)
    assert [solution["conf"][3] for solution in found["solutions"]] == [0, 1]
    first = found["solutions"][0]
    assert first["joints_deg"] == pytest.approx([30.0] * 6, abs=1e-6)
    assert first["within_limits"]
    assert first["residual_mm"] < 1e-6
    assert first["residual_deg"] < 1e-6


def test_all_gives_every_branch_and_turn() -> None:
    found = report("ik", "--robot", "irb120", *POSE, "--all")
    assert {solution["conf"][3] for solution in found["solutions"]} == set(range(8))
    turns = [s["joints_deg"][5] for s in found["solutions"] if s["conf"][3] == 0]
    assert turns == pytest.approx([-330.0, 30.0, 390.0], abs=1e-6)
    assert not all(solution["within_limits"] for solution in found["solutions"])
    assert all(solution["residual_mm"] < 1e-6 for solution in found["solutions"])


def test_confdata_picks_one() -> None:
    found = report("ik", "--robot", "irb120", *POSE, "--conf", "0,0,4,0")
    assert len(found["solutions"]) == 1
    assert found["solutions"][0]["joints_deg"][5] == pytest.approx(390.0, abs=1e-6)


@pytest.mark.parametrize(
    ("conf", "why"),
    [
        ("0,3,0,1", "on branch cfx 1 cf4 is 2, not 3, cf6 is -2, not 0"),
        ("0,0,0,2", "at its lower limit"),
        ("0,0,0,9", "cfx 9 is not a branch; this arm has 0 to 7"),
    ],
)
def test_a_configuration_that_does_not_work_says_why(conf: str, why: str) -> None:
    found = report("ik", "--robot", "irb120", *POSE, "--conf", conf, code=1)
    assert not found["reachable"]
    assert why in found["why"]


@pytest.mark.parametrize(
    ("robot", "position", "quaternion", "why"),
    [
        ("irb120", "900,0,500", "0,0,1,0", "wrist centre 363.1 mm beyond reach"),
        ("irb120", "-350,0,200", "0,0,1,0", "joint 1 over by 15.0 deg at its"),
        ("rvm1", "600,0,152", "0.5,0.5,0.5,0.5", "wrist centre 118.0 mm beyond reach"),
        ("rvm1", "300,0,152", "1,0,0,0", "joint 4 over by 67.3 deg at its upper limit"),
        ("rvm1", "300,100,200", "0.5,0.5,0.5,0.5", "deg from what the axes of this arm can give"),
    ],
)
def test_out_of_reach_says_how_far_and_why(
    robot: str, position: str, quaternion: str, why: str
) -> None:
    arguments = ("ik", "--robot", robot, "--position", position, "--quaternion", quaternion)
    found = report(*arguments, code=1)
    assert not found["reachable"]
    assert why in found["why"]
    assert not any(solution["within_limits"] for solution in found["solutions"])
    ended = rapidsim("kin", *arguments, columns=120)
    assert ended.code == 1
    assert f"unreachable: {found['why']}" in ended.out


@pytest.mark.parametrize("solver", ["lm", "bfgs", "trf"])
def test_scipy_solvers_report_what_they_did(solver: str) -> None:
    found = report("ik", "--robot", "irb120", *POSE, "--solver", solver)
    assert found["solver"] == solver
    assert found["solutions"][0]["within_limits"]
    assert found["solutions"][0]["residual_mm"] < 1e-3
    assert found["search"]["iterations"] > 0
    far = ("--position", "900,0,500", "--quaternion", "0,0,1,0")
    assert "363.1 mm" in report("ik", "--robot", "irb120", *far, "--solver", solver, code=1)["why"]


def test_jacobian() -> None:
    arguments = ("--robot", "irb120", "--joints", "10,20,-20,15,0,5", "--twist", "10,0,0,0,0,0")
    found = report("jacobian", *arguments)
    assert np.shape(found["jacobian"]) == (6, 6)
    assert found["frame"] == "base"
    assert (found["near"], found["rank"]) == (["wrist"], 5)
    assert found["manipulability"] == pytest.approx(0.0, abs=1e-12)
    assert len(found["singular_values"]) == 6
    given = np.array(found["jacobian"]) @ np.radians(found["joint_speeds_deg_s"])
    missed = np.array(found["missed"]["velocity_mm_s"])
    assert given[:3] * 1000.0 + missed == pytest.approx([10.0, 0.0, 0.0], abs=1e-9)


def test_five_axes_have_a_jacobian_of_five_columns() -> None:
    found = report("jacobian", "--robot", "rvm1", "--joints", "20,30,0,0,10")
    assert np.shape(found["jacobian"]) == (6, 5)
    assert (found["near"], found["rank"]) == (["elbow"], 4)


def offset_wrist(folder: Path) -> Path:
    """A URDF whose axis 6 passes beside the crossing of axes 4 and 5."""
    axes = (
        ("0 0 0", "0 0 1"),
        ("0 0 0.265", "0 1 0"),
        ("0 0 0.444", "0 1 0"),
        ("0 0 0.110", "1 0 0"),
        ("0.470 0 0", "0 1 0"),
        ("0.101 0 0.080", "1 0 0"),
    )
    joints = "".join(
        f'<link name="l{n}"/><joint name="j{n}" type="revolute"><parent link='
        f'"{f"l{n - 1}" if n else "base"}"/><child link="l{n}"/><origin xyz="{xyz}"/>'
        f'<axis xyz="{axis}"/><limit lower="-3" upper="3" velocity="2" effort="1"/></joint>'
        for n, (xyz, axis) in enumerate(axes)
    )
    file = folder / "bench.urdf"
    file.write_text(OFFSET_WRIST.format(joints=joints))
    return file


def test_an_arm_without_a_closed_form_is_searched_and_says_so(tmp_path: Path) -> None:
    file = offset_wrist(tmp_path)
    there = report("fk", "--robot", file, "--joints", "10,20,30,40,50,60")
    pose = [
        "--position=" + ",".join(map(str, there["position_mm"])),
        "--quaternion=" + ",".join(map(str, there["quaternion"])),
    ]
    ended = rapidsim("kin", "ik", "--robot", file, *pose, "--format", "json")
    assert "axes 4, 5 and 6 do not meet in one point" in ended.err
    found = json.loads(ended.out)
    assert found["solver"] == "damped-least-squares"
    apart = [np.abs(np.array(s["joints_deg"]) - range(10, 70, 10)) for s in found["solutions"]]
    assert min(float(row.max()) for row in apart) < 1e-4
    refused = rapidsim("kin", "ik", "--robot", file, *pose, "--solver", "analytic")
    assert refused.code == 2
    assert "bench has no closed form" in refused.err


def test_the_relative_transforms_multiply_to_the_pose_of_the_tcp() -> None:
    words = ("kin", "fk", "--robot", "irb120", "--joints", "30,20,10,40,50,60", "--tool", "10,0,90")
    shown = rapidsim(*words, "--tables").out
    tables = re.findall(r"^(T\(\w+,\w+\)|TCP)  .*position.*((?:\n.*){4})", shown, re.MULTILINE)
    numbers = {
        name: np.array([line.split() for line in text.splitlines()[1:]], dtype=np.float64)
        for name, text in tables
    }
    chain = [numbers[f"T({k},{k + 1 if k < 6 else 'TCP'})"] for k in range(7)]
    assert np.allclose(np.linalg.multi_dot(chain), numbers["TCP"], atol=2e-3)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("kin-fk.txt", ("fk", "--robot", "irb120", "--joints", "30,30,30,30,30,30")),
        ("kin-ik.txt", ("ik", "--robot", "irb120", *POSE, "--all")),
        (
            "kin-jacobian.txt",
            (
                "jacobian",
                "--robot",
                "irb120",
                "--joints",
                "0,20,-30,0,1,0",
                "--twist",
                "0,100,0,0,0,0",
            ),
        ),
    ],
)
def test_tables_for_people(name: str, arguments: Sequence[str]) -> None:
    ended = rapidsim("kin", *arguments)
    assert ended.code == 0
    text = "\n".join(line for line in ended.out.splitlines() if "residual" not in line)
    assert "…" not in text
    assert_golden(name, text)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("fk", "--joints", "1,2"), "--joints has 2 numbers, but irb1600-6-1.2 has 6 joints"),
        (("fk", "--joints", "1,2,x"), "`x` in `1,2,x` is not a number"),
        (("fk", "--joints", "1,2,nan"), "`nan` in `1,2,nan` is not a finite number"),
        (("fk",), "missing option '--joints'"),
        (("ik", "--position", "1,2", "--quaternion", "1,0,0,0"), "expected 3 numbers, got 2"),
        (("ik", "--position", "1,2,3", "--quaternion", "0,0,2,0"), "has length 2, not 1"),
        (("ik", "--position", "1,2,3", "--quaternion", "0,0,0,0"), "has length 0, not 1"),
        (("ik", *POSE, "--conf", "0,0,0.5,0"), "--conf takes whole numbers"),
        (("ik", *POSE, "--solver", "lm", "--all"), "--solver lm finds one solution"),
        (("ik", *POSE, "--robot", "irb12"), "robot `irb12` is not in the catalogue"),
        (("fk", "--joints", "0,0,0,0,0,0", "--tool", "1,2"), "expected 3 or 7 numbers, got 2"),
        (("turn",), "no such command 'turn'"),
    ],
)
def test_wrong_input_is_refused(arguments: Sequence[str], message: str) -> None:
    ended = rapidsim("kin", *arguments)
    assert ended.code == 2
    assert ended.out == ""
    assert message in ended.err
    assert len(ended.err.splitlines()) <= 2


def test_joints_outside_the_limits_are_noted() -> None:
    ended = rapidsim("kin", "fk", "--robot", "irb120", "--joints", "200,0,0,0,0,0")
    assert ended.code == 0
    assert ended.err == "note: joint 1 over by 35.0 deg at its upper limit\n"


PROGRAM = """MODULE job
  PROC main()
    VAR robtarget here;
    MoveAbsJ [[10,{axes}],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    here:=CRobT();
    MoveL Offs(here,0,0,-20),v200,z5,tool0;
    MoveL Offs(here,0,0,-40),v200,fine,tool0;
    MoveJ here,v200,fine,tool0;
  ENDPROC
ENDMODULE
"""


def test_a_program_runs_on_an_arm_without_a_closed_form(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM.format(axes="20,30,20,40,10"))
    ended = rapidsim(
        *("run", "job.mod", "--robot", offset_wrist(tmp_path), "--no-record", "--format", "json"),
        cwd=tmp_path,
    )
    assert ended.code == 0, ended.err
    assert ended.err.startswith("note: bench: axes 4, 5 and 6 do not meet in one point")
    found = json.loads(ended.out)
    assert (found["end"], found["diagnostics"]) == ("ended", [])
    assert found["moves"][-1]["joints_deg"] == pytest.approx([10, 20, 30, 20, 40, 10], abs=0.2)


def test_a_program_runs_on_five_axes(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM.format(axes="40,-70,-20,20,0"))
    (tmp_path / "rapidsim.toml").write_text(
        '[robot]\nmodel = "rv-m1"\n[motion]\naxis_speed = [120, 72, 109, 100, 163]\n'
    )
    ended = rapidsim("run", "job.mod", "--no-record", "--format", "json", cwd=tmp_path)
    assert ended.code == 0, ended.err
    found = json.loads(ended.out)
    assert (found["end"], found["diagnostics"]) == ("ended", [])
    assert found["moves"][-1]["joints_deg"] == pytest.approx([10, 40, -70, -20, 20], abs=0.2)
