"""Our kinematics against numbers and solvers that others made."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rapidsim.frames.transform import Transform
from rapidsim.motion.opw import OrthoParallel
from rapidsim.motion.robot import load_robot

GROUND_TRUTH = Path(__file__).parents[2].parent / "shared" / "reference" / "ground_truth.json"
OPW_SLOT_OF_BRANCH = [0, 4, 1, 5, 2, 6, 3, 7]
"""py-opw-kinematics numbers wrist, shoulder, elbow; we number shoulder, elbow, wrist."""


@pytest.fixture(scope="module")
def ground_truth() -> dict[str, Any]:
    if not GROUND_TRUTH.is_file():
        pytest.skip(f"{GROUND_TRUTH} is not here")
    loaded: dict[str, Any] = json.loads(GROUND_TRUTH.read_text(encoding="utf-8"))
    return loaded


def test_irb_1600_forward(ground_truth: dict[str, Any]) -> None:
    robot = load_robot("irb1600")
    for case in ground_truth["irb1600"]["fk_random"]:
        pose = robot.forward(np.array(case["q"]))
        assert pose.translation == pytest.approx(case["p_m"], abs=1e-10)
        assert pose.rotation == pytest.approx(np.array(case["R"]), abs=1e-10)


def test_irb_120_forward(ground_truth: dict[str, Any]) -> None:
    """The exercise's last frame has x out of the flange, tool0 has z."""
    robot = load_robot("irb120")
    x_out_from_tool0 = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    for case in ground_truth["irb120"]["fk_random"]:
        pose = robot.forward(np.array(case["q"]))
        assert pose.translation == pytest.approx(case["p_m"], abs=1e-10)
        assert pose.rotation == pytest.approx(np.array(case["R"]) @ x_out_from_tool0, abs=1e-10)


def test_pentagon_targets_have_the_known_branches(ground_truth: dict[str, Any]) -> None:
    robot = load_robot("irb1600")
    for name, target in ground_truth["rapid_program"]["targets"].items():
        frame = target["tool0_base"]
        pose = Transform(np.array(frame["R"]), np.array(frame["p_m"]))
        branches = robot.inverse(pose)
        for solution in target["ik_6_12"]:
            difference = branches.joints[branches.exists] - np.array(solution["q"])
            difference -= 2.0 * np.pi * np.round(difference / (2.0 * np.pi))
            assert np.min(np.max(np.abs(difference), axis=-1)) < 1e-8, name


@pytest.mark.parametrize("name", ["irb120", "irb1600"])
def test_another_solver_finds_the_same_branches(name: str) -> None:
    opw = pytest.importorskip("py_opw_kinematics")
    rigid = pytest.importorskip("scipy.spatial.transform")
    arm = load_robot(name).kinematics
    assert isinstance(arm, OrthoParallel)
    g = arm.geometry
    model = opw.KinematicModel(
        a1=g.a1, a2=g.a2, b=g.b, c1=g.c1, c2=g.c2, c3=g.c3, c4=g.c4, offsets=(0, 0, -90, 0, 0, 0)
    )
    other = opw.Robot(model, degrees=True)
    joints = np.random.default_rng(9).uniform(-2.0, 2.0, (300, 6))
    pose = arm.forward(joints)
    branches = arm.inverse(pose)
    for row in range(300):
        theirs = np.radians(other.inverse(rigid.RigidTransform.from_matrix(pose[row].matrix)))
        ours = branches.joints[row][branches.exists[row]]
        assert len(theirs) == len(ours)
        difference = ours[:, None] - theirs[None]
        difference -= 2.0 * np.pi * np.round(difference / (2.0 * np.pi))
        assert np.max(np.min(np.max(np.abs(difference), axis=-1), axis=1)) < 1e-7
