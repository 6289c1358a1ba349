"""What checking by value judges is, field by field, what a run drives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import fields, is_dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from laws import examples
from simulation_program import arm
from test_simulation_reach_programs import PROGRAMS, names_a_move, read

from rapidsim.analysis.program import Program
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.files import InputError, SourceFile
from rapidsim.frames.transform import Transform
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.jobs.checked_program import load
from rapidsim.language.moves import Move
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.model import MotionModel
from rapidsim.reach.arm_configurations import ends_of
from rapidsim.reach.dataflow.interpretation import walk_program
from rapidsim.reach.move_segments import segments_of
from rapidsim.reach.path_findings import WayFinder
from rapidsim.reach.target_poses import posed
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate


def differences(a: object, b: object, name: str = "") -> Iterator[str]:
    """The fields in which two values differ by more than rounding."""
    if is_dataclass(a) and type(a) is type(b):
        for field in fields(a):
            if (type(a), field.name) != (Segment, "index"):
                inner = getattr(a, field.name), getattr(b, field.name)
                yield from differences(*inner, f"{name}.{field.name}")
    elif isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape or np.abs(a - b).max(initial=0.0) > 1e-9:
            yield f"{name}: {a} {b}"
    elif isinstance(a, float) and isinstance(b, float):
        if a != b and abs(a - b) > 1e-9:
            yield f"{name}: {a} {b}"
    elif a != b:
        yield f"{name}: {a} {b}"


AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
MODEL = MotionModel(payload_acceleration=0.5)
Key = tuple[int, Move, int, Move]
"""Where two moves in a row stand in the text, and what they are."""


def judged(program: Program) -> dict[Key, list[Segment]]:
    """The segments that a check makes of moves whose start and end it knows."""
    walked, robot, model = walk_program(program), arm(), MODEL
    placed = posed(walked.known, robot, Transform.identity())
    ways = WayFinder(program, placed, ends_of(placed, robot), robot, model, {}).survey()
    sure = ways.stances.sure
    others = [
        row
        for row, known in enumerate(walked.known)
        if row not in ways.segments
        and row not in placed.left_out
        and known.previous is not None
        and sure[[row, known.previous]].all()
    ]
    made = dict(
        zip(others, segments_of(placed, ways.stances.joints, robot, model, others), strict=True)
    )
    made |= {row: ways.driven(row) for row, way in ways.surveyed.items() if not way.broken}
    found: dict[Key, list[Segment]] = {}
    for row, segment in made.items():
        known = walked.known[row]
        if known.previous is not None and not known.uncertain:
            before = walked.known[known.previous]
            key = (known.call.start, known.move, before.call.start, before.move)
            found.setdefault(key, []).append(segment)
    return found


def driven(program: Program, monkeypatch: pytest.MonkeyPatch) -> dict[Key, list[Segment]]:
    """The segments that a run makes."""
    made: list[tuple[QueuedMove, Segment]] = []
    resolve = Resolver.resolve

    def recorded(*arguments: Any, **named: Any) -> QueuedMove:
        queued = resolve(*arguments, **named)
        made.append((queued, queued.segment))
        return queued

    with monkeypatch.context() as patch, suppress(InputError, NotExecutableError):
        patch.setattr(Resolver, "resolve", recorded)
        simulate(program, arm(), options=RunOptions(max_time_s=20.0, model=MODEL))
    found: dict[Key, list[Segment]] = {}
    for (before, _), (queued, segment) in pairwise(made):
        key = (queued.place.span.start, queued.move, before.place.span.start, before.move)
        found.setdefault(key, []).append(segment)
    return found


def compared(program: Program, monkeypatch: pytest.MonkeyPatch) -> int:
    """How many segments of a check were found among those of the run that made the same moves."""
    reach = judged(program)
    run = driven(program, monkeypatch) if reach else {}
    both = [(one, run[key]) for key, made in reach.items() if key in run for one in made]
    for one, others in both:
        differing = [list(differences(one, other)) for other in others]
        assert not all(differing), (program.modules[0].name.text, differing[0])
    return len(both)


def test_programs_of_the_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sum(count(path, monkeypatch) for path in PROGRAMS) > 50


def test_programs_of_the_rules(rule_programs: list[Path], monkeypatch: pytest.MonkeyPatch) -> None:
    assert sum(count(path, monkeypatch) for path in rule_programs) > 50


def count(path: Path, monkeypatch: pytest.MonkeyPatch) -> int:
    """The segments of a module that were compared; none where it is not to be run.

    Where a trap clears the path, what comes next begins where it came up, which no text tells.
    """
    cleared = {b"TRAP", b"ClearPath"} <= set(re.findall(rb"\w+", path.read_bytes()))
    if cleared or not names_a_move(path):
        return 0
    loaded = read(path)
    return 0 if loaded is None or loaded.program is None else compared(loaded.program, monkeypatch)


DATA = """
  PERS tooldata held:=[TRUE,[[30,0,90],[1,0,0,0]],[4,[0,0,50],[1,0,0,0],0,0,0]];
  PERS loaddata part:=[1.5,[0,0,1],[1,0,0,0],0,0,0];
  PERS wobjdata table:=[FALSE,TRUE,"",[[10,20,30],[1,0,0,0]],[[0,0,5],[1,0,0,0]]];
  CONST robtarget p:=[[700,-200,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""
BEFORE = {
    "AccSet": r"AccSet 60,40\FinePointRamp:=50;",
    "VelSet": "VelSet 40,120;",
    "GripLoad": "GripLoad part;",
    "PathAccLim": r"PathAccLim TRUE\AccMax:=2,TRUE\DecelMax:=1;",
    "WorldAccLim": r"WorldAccLim \On:=3;",
    "CirPathMode": r"CirPathMode \ObjectFrame;",
    "SingArea": r"SingArea \Wrist;",
}


@pytest.mark.parametrize("setting", BEFORE.values(), ids=BEFORE.keys())
def test_no_setting_is_ignored(setting: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text = f"""MODULE cell
{DATA}
  PROC main()
    {setting}
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,50,0,0),v500,z10,tool0;
    MoveC Offs(p,100,50,0),Offs(p,50,100,0),v300,z5,tool0;
    MoveL Offs(p,0,100,0),v100\\T:=2,fine,tool0;
    MoveJ p,vmax,z50,tool0;
    MoveJ Offs(p,0,20,0),v500,fine,held\\WObj:=table;
    MoveL Offs(p,0,40,0),v500,fine,held\\WObj:=table;
  ENDPROC
ENDMODULE
"""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    assert compared(loaded.program, monkeypatch) == 6


@examples(15)
@example([("MoveJ", -583, 0, 200, 0), ("MoveJ", 0, 0, 200, 0)])
@given(
    st.lists(
        st.tuples(
            st.sampled_from(["MoveJ", "MoveL"]),
            st.integers(-800, 1000),
            st.integers(-800, 800),
            st.integers(200, 1000),
            st.integers(0, 350),
        ),
        min_size=2,
        max_size=4,
    )
)
def test_where_no_configuration_is_asked_for(moves: list[tuple[str, int, int, int, int]]) -> None:
    body = "\n".join(
        f"{name} RelTool(Offs(p,{x},{y},{z}),0,0,0\\Rz:={turn}),v500,fine,tool0;"
        for name, x, y, z, turn in moves
    )
    text = f"""MODULE cell
  CONST robtarget p:=[[0,0,0],[0,0,1,0],[0,0,0,0],{AXES}];
  PROC main()
    ConfJ\\Off; ConfL\\Off;
    MoveAbsJ [[0,0,0,0,30,0],{AXES}],v500,fine,tool0;
    {body}
  ENDPROC
ENDMODULE
"""
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    with pytest.MonkeyPatch.context() as patch:
        compared(loaded.program, patch)
