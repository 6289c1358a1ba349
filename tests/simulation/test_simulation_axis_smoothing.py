"""Runs in which each axis is smoothed by itself: what programs and frames see of it."""

from __future__ import annotations

from math import radians
from typing import Any

import numpy as np
import pytest
import simulation_tasks
from simulation_program import Ran, ran

from rapidsim.controller.cell.description import CellIo, Stimulus
from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.report.run.run_models import models

AXES = MotionModel(smoothing="axes")
PATH = MotionModel(smoothing="path")
TABLE = ExternalAxis(
    "TABLE",
    "a",
    False,
    radians(-180.0),
    radians(180.0),
    radians(90.0),
    radians(360.0),
    carries="wobj",
    world_from_user=Transform(np.eye(3), np.array([0.9, 0.1, 0.4])),
)
TRACK = ExternalAxis(
    "TRACK", "a", True, -0.5, 3.0, 1.0, 4.0, carries="robot", direction=(0.0, 1.0, 0.0)
)


def both(text: str, **options: Any) -> tuple[Ran, Ran]:
    """The same program with smoothing along the path and with smoothing of each axis."""
    return ran(text, model=PATH, **options), ran(text, model=AXES, **options)


def target(name: str, x: float, y: float, z: float, axis: str = "9E9") -> str:
    axes = f"[{axis},9E9,9E9,9E9,9E9,9E9]"
    return f"  CONST robtarget {name}:=[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],{axes}];\n"


def program(data: str, *lines: str) -> str:
    body = "\n".join(f"    {line}" for line in lines)
    free = "    ConfJ\\Off;\n    ConfL\\Off;"
    return f"MODULE cell\n{data}  PROC main()\n{free}\n{body}\n  ENDPROC\nENDMODULE"


def test_outputs_and_texts_keep_their_times_and_positions_are_those_seen() -> None:
    data = target("a", 800, -200, 700) + target("b", 800, 0, 700) + target("c", 800, 0, 500)
    data += "  VAR triggdata glue;\n  VAR jointtarget now;\n"
    text = program(
        data,
        "TriggIO glue,20\\DOp:=doGlue,1;",
        "MoveJ a,v500,fine,tool0;",
        "TriggL b,v1000,glue,z10,tool0;",
        "MoveLDO c,v1000,z5,tool0,doValve,1;",
        "MoveL Offs(c,0,100,0),v1000,z5,tool0;",
        "WaitTime 0.05;",
        "now:=CJointT();",
        'TPWrite ""\\Num:=now.robax.rax_1;',
        "MoveL a,v1000,fine,tool0;",
        "now:=CJointT();",
        'TPWrite ""\\Num:=now.robax.rax_1;',
    )
    path, axes = both(text)
    assert (axes.end, axes.run.time_s) == ("ended", path.run.time_s)
    assert [e.time_s for e in axes.run.events] == [e.time_s for e in path.run.events]
    assert [(m.start_s, m.end_s) for m in axes.run.moves] == [
        (m.start_s, m.end_s) for m in path.run.moves
    ]
    at_s = next(e.time_s for e in axes.run.events if e.message == axes.texts[0])
    assert float(axes.texts[0]) == pytest.approx(
        np.degrees(axes.run.only.sample(at_s).joints[0, 0]), abs=1e-4
    )
    assert axes.texts[0] != path.texts[0]
    assert axes.texts[1] == path.texts[1]
    assert models(axes.run).smoothing == "axes"


def test_a_search_finds_the_place_that_is_seen() -> None:
    data = target("a", 800, -200, 700) + target("b", 800, 200, 700) + "  VAR robtarget hit;\n"
    text = program(
        data,
        "MoveJ a,v500,fine,tool0;",
        "SearchL\\PStop,diHit,hit,b,v500,tool0;",
        'TPWrite ""\\Num:=hit.trans.y;',
    )
    hit_s = 1.2
    io = CellIo(stimuli=(Stimulus(values={"diHit": 1.0}, at_s=hit_s),))
    _, axes = both(text, io=io)
    seen_m = axes.run.only.sample(hit_s).base_from_tcp.translation[0, 1]
    assert float(axes.texts[0]) == pytest.approx(1e3 * seen_m, abs=1e-3)


def line_error(points: Array) -> float:
    along = (points[-1] - points[0]) / np.linalg.norm(points[-1] - points[0])
    off = points - points[0]
    return float(np.linalg.norm(off - np.outer(off @ along, along), axis=1).max())


@pytest.mark.parametrize("axis", [TABLE, TRACK], ids=["positioner", "track"])
def test_external_axes_are_smoothed_and_carry_their_frames(axis: ExternalAxis) -> None:
    """Off the line by little, at its end exactly; the speed is that against the work object."""
    on_table = axis is TABLE
    if on_table:
        data = target("a", 0, 0, 200, "0") + target("b", 0, 100, 200, "45")
    else:
        data = target("a", 800, 0, 700, "0") + target("b", 900, 1000, 600, "500")
    data += (
        '  PERS wobjdata turntable:=[FALSE,FALSE,"TABLE",[[0,0,0],[1,0,0,0]],'
        "[[0,0,0],[1,0,0,0]]];\n"
    )
    on = r"tool0\WObj:=turntable;" if on_table else "tool0;"
    text = program(data, f"MoveJ a,v500,fine,{on}", f"MoveL b,v100,fine,{on}")
    path, axes = both(text, external_axes=(axis,))
    assert axes.findings == []
    move = axes.run.moves[1]
    times = np.linspace(move.start_s, move.end_s, 120)
    seen, planned = axes.run.only.sample(times), path.run.only.sample(times)
    assert seen.external == pytest.approx(planned.external, abs=2e-3)
    assert seen.external[-1] == pytest.approx(planned.external[-1], abs=1e-12)
    assert seen.tcp_speed.max() == pytest.approx(0.1, abs=1e-3)
    if on_table:
        turn = rotation_from_vector(np.array([0.0, 0.0, -1.0]) * seen.external)
        on_it = seen.base_from_tcp.translation - axis.world_from_user.translation
        points = np.einsum("kij,kj->ki", turn, on_it)
    else:
        points = seen.base_from_tcp.translation + np.array([0.0, 1.0, 0.0]) * seen.external
    assert 1e-7 < line_error(points) < 2e-4
    assert seen.base_from_tcp.translation[-1] == pytest.approx(
        planned.base_from_tcp.translation[-1], abs=1e-9
    )


def test_robots_of_a_team_stay_together() -> None:
    joints = simulation_tasks.JOINTS

    def moves(y: float, x: float) -> str:
        first, second = (f"[[{at},{y},700],[0,0,1,0],[0,0,0,0],{joints}]" for at in (700, x))
        return f"""
PERS tasks both{{2}}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {first},v500,fine,tool0;
  SyncMoveOn on,both;
  MoveL {second}\\ID:=10,v500,z20,tool0;
  MoveL {first}\\ID:=20,v500,fine,tool0;
  SyncMoveOff off;
ENDPROC
"""

    programs = {"T_ROB1": moves(0, 900), "T_ROB2": moves(100, 800)}
    path, axes = (simulation_tasks.ran(programs, model=model) for model in (PATH, AXES))
    assert axes.end == path.end == "ended"
    assert axes.run.time_s == path.run.time_s
    for one, other in zip(axes.run.robots, path.run.robots, strict=True):
        times = np.linspace(0.0, one.trajectory.duration, 200)
        seen, planned = one.trajectory.at(times), other.trajectory.at(times)
        off = np.linalg.norm(
            seen.base_from_tcp.translation - planned.base_from_tcp.translation, axis=1
        )
        assert 1e-6 < off.max() < 5e-3
        assert off[-1] < 1e-9
        assert seen.move.tolist() == planned.move.tolist()
