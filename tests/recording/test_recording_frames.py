"""Frames that move, and a robot that does not stand in the origin of the world."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rerun.chunk import RrdReader

import rapidsim
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.recording.layout.write import record
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation

TRACK = ExternalAxis(
    unit="TRACK",
    letter="a",
    linear=True,
    lower=-1.0,
    upper=3.0,
    max_speed=1.0,
    max_acceleration=2.0,
    carries="robot",
    direction=(0.0, 1.0, 0.0),
)
RAISED = Transform(np.eye(3), np.array([0.0, 0.0, 0.5]))
PROGRAM = """MODULE Moving
  PERS tooldata tPen:=[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS tooldata tFixed:=[FALSE,[[900,0,1000],[0,0,1,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[800,0,800],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS wobjdata wHeld:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget a:=[[0,0,0],[0,0,1,0],[0,0,0,0],[0,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[100,600,0],[0,0,1,0],[0,0,0,0],[600,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[0,0,0],[1,0,0,0],[0,0,0,0],[0,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    ConfL\\Off;
    MoveJ a,v500,fine,tPen\\WObj:=wTable;
    MoveL b,v500,fine,tPen\\WObj:=wTable;
    MoveJ c,v500,fine,tFixed\\WObj:=wHeld;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    program = tmp_path_factory.mktemp("moving") / "Moving.mod"
    program.write_text(PROGRAM)
    options = RunOptions(external_axes=(TRACK,), world_from_base=RAISED)
    simulation = rapidsim.simulate([program], robot="irb1600", options=options)
    assert simulation.end == "ended", simulation.diagnostics
    return simulation


@pytest.fixture(scope="module")
def recording(run: Simulation, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(run, tmp_path_factory.mktemp("moving") / "moving.rrd")


def rows(path: Path, entity: str, component: str) -> list[Any]:
    found: list[tuple[int, Any]] = []
    for chunk in RrdReader(path).stream().filter(content=entity):
        batch = chunk.to_record_batch()
        if component in batch.schema.names:
            times = (
                [0] * batch.num_rows
                if chunk.is_static
                else batch.column("sim_time").cast("int64").to_pylist()
            )
            found += zip(times, batch.column(component).to_pylist(), strict=True)
    return sorted(found, key=lambda row: row[0])


def test_a_track_carries_the_base(run: Simulation, recording: Path) -> None:
    ((_, foot),) = rows(recording, "/foot", "Transform3D:translation")
    assert np.allclose(foot[0], [0.0, 0.0, 0.5])
    moving = rows(recording, "/base", "Transform3D:translation")
    times = np.array([time for time, _ in moving]) * 1e-9
    expected = run.only.trajectory.at(times).external[:, 0]
    assert np.allclose([place[0][1] for _, place in moving], expected, atol=1e-6)
    assert expected.max() == pytest.approx(0.6)


def test_on_a_track_the_path_is_where_the_tcp_is_in_the_world(
    run: Simulation, recording: Path
) -> None:
    ((_, strips),) = rows(recording, "/path/travelled/MoveL", "LineStrips3D:strips")
    ends = np.array([strips[0][0], strips[-1][-1]]) + RAISED.translation
    move = run.moves[1]
    found = run.only.trajectory.at(np.array([move.start_s, move.end_s]))
    world_from_base = world_from_base_at((TRACK,), RAISED, found.external)
    assert np.allclose(ends, (world_from_base @ found.base_from_tcp).translation, atol=1e-5)
    assert np.allclose(ends[1], [0.9, 0.6, 0.8], atol=1e-5)


def test_a_stationary_tool_stands_in_the_world(recording: Path) -> None:
    parents = [row[0] for _, row in rows(recording, "/robot/tcp", "Transform3D:parent_frame")]
    assert parents == ["tool0", "world"]
    places = [row[0] for _, row in rows(recording, "/robot/tcp", "Transform3D:translation")]
    assert np.allclose(places[1], [0.9, 0.0, 1.0])


def test_work_objects_stand_in_the_world_or_hang_on_the_flange(recording: Path) -> None:
    for name, parent in (("wTable", "world"), ("wHeld", "tool0")):
        entity = f"/work_objects/{name}/user"
        ((_, row),) = rows(recording, entity, "Transform3D:parent_frame")
        assert row == [parent]


def test_external_axes_have_their_curve(run: Simulation, recording: Path) -> None:
    curve = rows(recording, "/joints/external", "Scalars:scalars")
    assert max(values[0] for _, values in curve) == pytest.approx(600.0)


def test_what_is_not_drawn_is_said(recording: Path) -> None:
    words = [row[0] for _, row in rows(recording, "/log/recording", "TextLog:text")]
    assert any("on a track: its programmed path is not drawn" in text for text in words)
