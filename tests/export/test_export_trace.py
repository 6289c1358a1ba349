"""Trace tables and event lines, read back by the readers people use."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from changed_run import with_robot

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.diagnostics import Source, Span
from rapidsim.export.events import write_events
from rapidsim.export.trace import WRITERS, write_trace
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Place
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation, TaskEnd
from rapidsim.station.task_kind import TaskKind

COLUMNS = [
    *("time_s", "move", "j1", "j2", "j3", "j4", "j5", "j6"),
    *("x_mm", "y_mm", "z_mm", "q1", "q2", "q3", "q4", "tcp_speed_mm_s"),
]


class Turning(Trajectory):
    """Every axis turns at its own even speed."""

    def __init__(self, robot: Robot, end_s: float) -> None:
        self.robot = robot
        self.end_s = end_s

    @property
    def duration(self) -> float:
        return self.end_s

    def at(self, times: Array, *, coarse: bool = False) -> Samples:
        joints = times[:, None] * np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        move = (times >= 0.5 * self.end_s).astype(np.int64)
        pose = self.robot.kinematics.forward(joints)
        return Samples(times, move, joints, pose, np.full(len(times), 0.25))


def run(end_s: float = 1.0) -> Simulation:
    robot = load_robot("irb120-3-0.58")
    source = Source("Turn.mod", "MODULE Turn\n  MoveJ p, v100, fine, tool0;\nENDMODULE\n")
    place = Place(Span(source, 14, 41), "main")
    return Simulation(
        program=("Turn.mod",),
        model=MotionModel(),
        end=End.ENDED,
        time_s=end_s,
        motion_s=end_s,
        wait_s=0.0,
        robots=(
            RobotRun(
                task="T_ROB1",
                robot=robot,
                world_from_base=Transform.identity(),
                moves=moves_of(()),
                lines=(),
                trajectory=Turning(robot, end_s),
                path_m=0.25 * end_s,
            ),
        ),
        tasks=(TaskEnd("T_ROB1", TaskKind.NORMAL, End.ENDED),),
        events=(
            Event(0.1, "T_ROB1", EventKind.TEXT, place, "Größe: 3 µm"),
            Event(
                0.2, "T_ROB1", EventKind.SIGNAL, None, "do1 = 1", {"signal": "do1", "value": 1.0}
            ),
        ),
        diagnostics=(),
        unsimulated=(),
        home_files=(),
    )


def read(path: Path) -> list[dict[str, float]]:
    match path.suffix:
        case ".csv":
            with path.open(newline="") as file:
                return [
                    {name: float(text) for name, text in row.items()}
                    for row in csv.DictReader(file)
                ]
        case ".json":
            rows: list[dict[str, float]] = json.loads(path.read_text())
            return rows
        case _:
            table: list[dict[str, float]] = pq.read_table(path).to_pylist()
            return table


@pytest.mark.parametrize("suffix", WRITERS)
def test_a_trace_gives_back_every_rounded_bit(suffix: str, tmp_path: Path) -> None:
    simulation = run()
    rows = read(write_trace(simulation, tmp_path / f"turn{suffix}", 0.3))
    assert [list(row) for row in rows] == [COLUMNS] * len(rows)
    times = np.array([0.0, 0.3, 0.6, 3 * 0.3, 1.0])
    samples = simulation.only.trajectory.at(times)
    expected = np.column_stack(
        [
            times.round(8),
            samples.move,
            np.degrees(samples.joints).round(6),
            (samples.base_from_tcp.translation * 1000.0).round(6),
            samples.base_from_tcp.quaternion.round(8),
            samples.tcp_speed * 1000.0,
        ]
    )
    assert np.array_equal(np.array([list(row.values()) for row in rows]), expected)


@pytest.mark.parametrize("dt", [0.1, 0.012, 0.25, 1.0 / 3.0, 1.0 / 49.0, 3.0])
def test_rows_are_a_beat_apart_and_the_last_is_the_end(dt: float, tmp_path: Path) -> None:
    times = [row["time_s"] for row in read(write_trace(run(), tmp_path / "turn.csv", dt))]
    assert times[-1] == 1.0
    assert times[:-1] == [round(k * dt, 8) for k in range(len(times) - 1)]
    assert all(earlier < later for earlier, later in pairwise(times))
    assert 1e-9 < times[-1] - times[-2] <= dt + 1e-8


def test_a_run_without_time_is_one_row(tmp_path: Path) -> None:
    assert len(read(write_trace(run(0.0), tmp_path / "turn.csv"))) == 1


def test_the_move_is_a_whole_number(tmp_path: Path) -> None:
    text = write_trace(run(), tmp_path / "turn.csv").read_text()
    assert {line.split(",")[1] for line in text.splitlines()[1:]} == {"0", "1"}
    schema = pq.read_schema(write_trace(run(), tmp_path / "turn.parquet"))
    assert str(schema.field("move").type) == "int64"


def test_a_suffix_nobody_knows_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        write_trace(run(), tmp_path / "turn.xlsx")
    assert "turn.xlsx" in caught.value.message
    assert caught.value.help == "use one of .csv, .parquet, .json"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("dt", [0.0, -0.1, float("nan"), 1e-12])
def test_a_beat_that_makes_no_sense_is_said(dt: float, tmp_path: Path) -> None:
    with pytest.raises(InputError):
        write_trace(run(), tmp_path / "turn.csv", dt)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", WRITERS)
def test_an_interrupted_trace_keeps_the_older_one(suffix: str, tmp_path: Path) -> None:
    class Interrupted(Turning):
        def at(self, times: Array, *, coarse: bool = False) -> Samples:
            raise KeyboardInterrupt

    path = tmp_path / f"turn{suffix}"
    path.write_text("older")
    simulation = run()
    broken = with_robot(simulation, trajectory=Interrupted(simulation.only.robot, 1.0))
    with pytest.raises(KeyboardInterrupt):
        write_trace(broken, path)
    assert [file.name for file in tmp_path.iterdir()] == [path.name]
    assert path.read_text() == "older"


def test_events_are_one_object_a_line(tmp_path: Path) -> None:
    path = write_events(run(), tmp_path / "turn.jsonl")
    lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    assert lines == [
        {
            "time_s": 0.1,
            "task": "T_ROB1",
            "kind": "text",
            "file": "Turn.mod",
            "line": 2,
            "message": "Größe: 3 µm",
        },
        {
            "time_s": 0.2,
            "task": "T_ROB1",
            "kind": "signal",
            "file": None,
            "line": None,
            "message": "do1 = 1",
            "signal": "do1",
            "value": 1.0,
        },
    ]


def test_numbers_in_events_are_finite(tmp_path: Path) -> None:
    simulation = replace(
        run(),
        events=(
            Event(0.0, "T_ROB1", EventKind.ERROR, None, "e", {"value": float("inf"), "of": (1, 2)}),
        ),
    )
    (line,) = write_events(simulation, tmp_path / "turn.jsonl").read_text().splitlines()
    assert json.loads(line)["value"] == "inf"
    assert json.loads(line)["of"] == [1, 2]
