"""Random programs on SCARAs, arms with offset wrists, seven-axis arms and palletizers.

What each of their motions keeps: speeds, torques or accelerations, and the programmed curves.
"""

from __future__ import annotations

import random

import numpy as np
import pytest
from laws import cases
from motion_law import command_of, excess_of, off_curve

from rapidsim.analysis.cell_names import CellNames
from rapidsim.files import SourceFile
from rapidsim.frames.transform import Array
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.report.run.figures import figures
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ARMS = (
    "irb910sc-3-0.65",
    "irb920t-6-0.45",
    "crb15000-5-0.95",
    "crb15000-12-1.27",
    "irb14000-0.5-0.5-left",
    "irb660-180-3.15",
)
_TOOL = "[TRUE,[[0,0,40],[1,0,0,0]],[{load},[0,0,50],[1,0,0,0],0,0,0]]"


def _program(robot: Robot, seed: int) -> str:
    """Moves of joints and lines between nearby postures, with and without stops."""
    dice = random.Random(seed)
    lines = [r"ConfJ\Off;", r"ConfL\Off;"]
    joints = robot.start.copy()
    for _ in range(6):
        step = np.array([dice.uniform(-0.3, 0.3) for _ in joints])
        joints = np.clip(joints + step, robot.lower + 0.02, robot.upper - 0.02)
        zone = dice.choice(("fine", "z1", "z10", "z50"))
        # Lines of arms with seven axes are not simulated.
        kind = dice.choice(("MoveAbsJ", "MoveJ", "MoveL" if len(joints) < 7 else "MoveJ"))
        to = _joint_target(robot, joints) if kind == "MoveAbsJ" else _target(robot, joints)
        lines.append(f"{kind} {to},v5000,{zone},tLoad;")
    body = "\n".join(lines)
    tool = _TOOL.format(load=max(0.5 * (robot.payload_kg or 0.0), 0.1))
    return f"MODULE cell\nPERS tooldata tLoad:={tool};\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"


def _joint_target(robot: Robot, joints: Array) -> str:
    values = np.full(12, 9e9)
    values[:6] = 0.0
    values[list(robot.kinematics.rapid_axes)] = np.degrees(joints)
    robax, extax = (",".join(f"{one:.6g}" for one in part) for part in np.split(values, 2))
    return f"[[{robax}],[{extax}]]"


def _target(robot: Robot, joints: Array) -> str:
    pose = robot.forward(joints)
    x, y, z = 1e3 * (pose.translation + 0.04 * pose.rotation[:, 2])
    q = ",".join(f"{one:.8f}" for one in pose.quaternion)
    extax = _joint_target(robot, joints).rpartition("[")[2]
    return f"[[{x:.4f},{y:.4f},{z:.4f}],[{q}],[0,0,0,0],[{extax}"


@pytest.mark.parametrize("name", ARMS)
def test_random_programs_keep_limits_and_curves(name: str) -> None:
    robot, ended = load_robot(name), 0
    for seed in range(cases(12)):
        loaded = load([SourceFile("cell.mod", _program(robot, seed), "utf-8")], cell=CellNames())
        assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
        run = simulate(loaded.program, robot, options=RunOptions())
        (one,) = run.robots
        if not one.trajectory.pieces:
            continue
        ended += run.end.value == "ended"
        limits, command = limits_of(robot, run.model), command_of(one.trajectory)
        kept, seen = excess_of(command, limits), excess_of(one.trajectory, limits)
        assert kept.axis_speed < 1.001, seed
        assert kept.axis_acceleration < 1.01, seed
        assert seen.axis_speed < 1.001, seed
        assert off_curve(command) < 1e-6, seed
        steps = np.abs(np.diff(one.trajectory.at(np.arange(0.0, run.time_s, 1e-3)).joints, axis=0))
        assert (steps <= 1.01e-3 * limits.max_speed).all(), seed
    assert ended > cases(12) // 3


@pytest.mark.parametrize(
    ("name", "factor"), [("irb14000-0.5-0.5-left", 1.3), ("crb15000-5-0.95", 1.5), ("kr10", 2.0)]
)
def test_a_run_is_varied_by_the_accuracy_known_of_the_arm(name: str, factor: float) -> None:
    robot = load_robot(name)
    to = _joint_target(robot, robot.start + 0.2)
    text = f"MODULE cell\nPROC main()\nMoveAbsJ {to},v5000,fine,tool0;\nENDPROC\nENDMODULE\n"
    loaded = load([SourceFile("cell.mod", text, "utf-8")], cell=CellNames())
    assert loaded.program is not None
    found = figures(simulate(loaded.program, robot, options=RunOptions())).sensitivity
    assert [one.factor for one in found] == pytest.approx([1.0 / factor, factor])
