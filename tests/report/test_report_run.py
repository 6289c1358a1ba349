"""The report of a run: the figures are right, the text fits, the JSON is what the contract says."""

import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from report_run import HOME, PICK, ROBOT, SOURCE, run
from rich.console import Console

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.findings.runs import QuestionUnanswered
from rapidsim.json_records.encoding import json_of
from rapidsim.motion.robot.motion_constants import MotionConstants
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, rejected_report, run_json
from rapidsim.report.run.run_models import models
from rapidsim.report.run.summary import ASCII_BARS, BLOCK_BARS, Bars, OutputFile, summary
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.results.verdict import run_verdict

RECORDING = OutputFile(Path("cell.rrd"), "recording", "rerun cell.rrd")


def text(simulation: Simulation, *, width: int = 80, bars: Bars = BLOCK_BARS) -> str:
    stream = io.StringIO()
    console = Console(file=stream, width=width, color_system=None, markup=False, emoji=False)
    found = figures(simulation)
    verdict = run_verdict(simulation)
    shown = summary(
        simulation,
        verdict,
        found,
        robot_reason="by default",
        written=[RECORDING],
        bars=bars,
    )
    console.print(shown)
    return stream.getvalue()


def test_figures_of_moves() -> None:
    found = figures(run())
    assert found.moves_by_instruction == (("MoveJ", 1), ("MoveL", 1))
    assert found.moves_by_corner == (
        (CornerKind.STOP, 1),
        (CornerKind.STOP_CORNER_PATH_FAILURE, 1),
    )
    slow, quick = found.slowest
    assert (slow.place.span.line, slow.goal, slow.seconds, slow.times) == (4, "pPick", 1.5, 1)
    assert (quick.place.span.line, quick.goal, quick.seconds) == (3, "pHome", 0.5)


def test_a_line_that_runs_often_counts_once_with_its_whole_time() -> None:
    first, second = run().moves
    again = replace(second, index=2, start_s=2.0, end_s=3.0)
    found = figures(with_robot(run(), moves=(first, second, again)))
    assert [(line.seconds, line.times) for line in found.slowest] == [(2.5, 2), (0.5, 1)]


def test_margin_and_singularity_are_the_least_along_the_path() -> None:
    found = figures(run())
    joints = HOME + np.linspace(0.0, 1.0, 5001)[:, None] * (PICK - HOME)
    left = np.minimum(joints - ROBOT.lower, ROBOT.upper - joints)
    assert found.joint_margin
    assert found.joint_margin.degrees == pytest.approx(np.degrees(left.min()), abs=0.01)
    smallest = np.linalg.svd(ROBOT.kinematics.jacobian(joints), compute_uv=False)[:, -1].min()
    assert found.singularity
    assert found.singularity.smallest_singular_value == pytest.approx(smallest, abs=1e-4)


def test_a_run_without_moves_has_a_report_too() -> None:
    idle = with_robot(run(), moves=(), path_m=0.0)
    simulation = replace(idle, motion_s=0.0, time_s=0.0, events=())
    assert "none" in text(simulation)
    report = run_json(simulation, figures(simulation), (), RunFiles())
    assert (report["moves"], report["min_joint_margin"], report["min_singularity"]) == (
        [],
        None,
        None,
    )


@pytest.mark.parametrize("width", [60, 80, 120])
def test_the_summary_fits(width: int) -> None:
    lines = text(run(), width=width).splitlines()
    assert max(map(len, lines)) <= width
    assert lines[-1] == "Open the recording with: rerun cell.rrd"


def test_the_summary_says_what_happened() -> None:
    shown = " ".join(text(run(), width=120).split())
    for part in (
        "cell.mod on ABB IRB 1600-6/1.2 ended after 2.500 s; 3 calls of ArcL not simulated",
        "irb1600-6-1.2 (by default)",
        "moving 2.000 s waiting 0.500 s",
        "2 (1 MoveJ, 1 MoveL), 300.0 mm travelled",
        "1 stop because the next move came too late (cf. ABB 50024)",
        "cell.mod:4 main MoveL pPick 1 1.500 s",
        "ArcL (3 times): treated as MoveL",
        "motion model 3; torques of axes 1 to 3 and accelerations of the wrist scaled from",
        "cell.home/log.txt (by the program)",
    ):
        assert part in shown
    assert "\x1b" not in shown


def test_bars_need_no_unicode() -> None:
    assert "#" * 19 + "." * 5 in text(run(), bars=ASCII_BARS)


@pytest.mark.parametrize("end", End)
def test_every_end_has_words(end: End) -> None:
    assert " after 2.500 s" in text(replace(run(), end=end))


def test_json_is_the_contract() -> None:
    simulation = run()
    report = json.loads(
        json.dumps(
            run_json(simulation, figures(simulation), (), RunFiles(recording="cell.rrd")),
            allow_nan=False,
        )
    )
    assert list(report) == [
        "schema",
        "program",
        "robot",
        "ok",
        "qualifications",
        "end",
        "time_s",
        "motion_s",
        "wait_s",
        "path_mm",
        "moves",
        "slowest",
        "min_joint_margin",
        "min_singularity",
        "max_off_path",
        "diagnostics",
        "waits",
        "slowest_waits",
        "stretches",
        "regions",
        "events",
        "errors",
        "unsimulated",
        "skipped",
        "persistents",
        "assertions",
        "cycle_budget",
        "models",
        "files",
    ]
    move = report["moves"][1]
    position = move.pop("target")
    joints = move.pop("joints_deg")
    assert move == {
        "index": 1,
        "task": "T_ROB1",
        "instruction": "MoveL",
        "file": "cell/cell.mod",
        "line": 4,
        "routine": "main",
        "to": "pPick",
        "tool": "tGrip",
        "wobj": "wTable",
        "speed_mm_s": 200.0,
        "zone_mm": 0.0,
        "start_s": 0.5,
        "end_s": 2.0,
        "length_mm": 200.0,
        "deviation": None,
        "corner": "stop(corner path failure)",
        "corner_reason": "",
        "limit": "",
        "conf": [0, 0, 1, 0],
    }
    assert joints == pytest.approx([20.0, 10.0, -5.0, 0.0, 30.0, 197.0])
    flange = ROBOT.kinematics.forward(PICK)
    assert position["position_mm"] == pytest.approx(list(flange.translation * 1000.0))
    assert position["frame"] == "base"
    assert report["unsimulated"] == [{"name": "ArcL", "count": 3, "treated_as": "treated as MoveL"}]
    assert report["events"][0] == {
        "time_s": 2.0,
        "task": "T_ROB1",
        "kind": "corner",
        "file": "cell/cell.mod",
        "line": 4,
        "message": "corner path failure",
        "move": 1,
    }
    assert report["models"]["corner"] == "abb"


def test_json_has_no_number_that_is_none() -> None:
    simulation = replace(run(), time_s=float("inf"), wait_s=float("nan"))
    report = run_json(simulation, figures(simulation), (), RunFiles())
    assert (report["time_s"], report["wait_s"]) == (None, None)


def test_a_rejected_program_has_the_same_keys() -> None:
    finding = Diagnostic(QuestionUnanswered("Which part?", "0"), Span(SOURCE, 0, 6))
    rejected = json_of(rejected_report(["a.mod"], "irb120-3-0.58", [finding]))
    simulation = run()
    assert list(rejected) == list(run_json(simulation, figures(simulation), (), RunFiles()))
    assert rejected["end"] == "error"


def both() -> Simulation:
    """The run, and beside it an arm of another kind that comes nearer to its limits."""
    only = run().only
    tight = [replace(joint, lower=joint.lower / 2, upper=joint.upper / 2) for joint in ROBOT.joints]
    cable = ("its cable",)
    arm = replace(ROBOT, name="twin", title="Twin", not_modelled=cable, joints=tuple(tight))
    moves = moves_of(replace(move, task="T_ROB2") for move in only.moves)
    return replace(run(), robots=(only, replace(only, task="T_ROB2", robot=arm, moves=moves)))


def test_all_robots_are_told_of() -> None:
    shown = " ".join(text(both(), width=200).split())
    assert f"on {ROBOT.title} and Twin" in shown
    assert f"robot {ROBOT.name} of T_ROB1 (by default) twin of T_ROB2" in shown
    assert "4 (2 MoveJ, 2 MoveL), 600.0 mm travelled" in shown
    assert "of T_ROB2 came within" in shown
    assert "closest to singular of T_ROB1" in shown
    assert "Not modelled: twin: its cable." in shown


def test_what_is_true_of_all_robots_is_said_once() -> None:
    shown = models(both())
    assert shown.acceleration == models(run()).acceleration
    one, other = both().robots
    unknown = replace(other, robot=replace(other.robot, constants=MotionConstants()))
    said = models(replace(both(), robots=(one, unknown))).acceleration
    assert said == (
        f"{ROBOT.name}: {shown.acceleration}; twin: axis acceleration = axis speed / 0.16 s, "
        "assumed, accurate within a factor of 2"
    )
