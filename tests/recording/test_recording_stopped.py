"""Runs that failed and recordings that were broken off."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from recording_read import SIMULATION, failed_run, rows, texts

from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.findings.collisions import Collision
from rapidsim.findings.runs import UncaughtError
from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.recording.layout.write import record
from rapidsim.simulation.results.simulation import End, Simulation


def test_an_error_is_marked_where_the_robot_stopped(tmp_path: Path) -> None:
    stopped = replace(
        SIMULATION,
        end=End.ERROR,
        diagnostics=(Diagnostic(UncaughtError("division by zero"), None),),
    )
    path = record(stopped, tmp_path / "stopped.rrd")
    assert texts(path, "/stopped/name", "Points3D:labels") == ["stopped: R101 uncaught-error"]


def test_a_collision_stands_in_the_log_at_its_own_time(tmp_path: Path) -> None:
    line = SIMULATION.only.lines[0]
    hit = Collision("link 3", "post", 1.25, deep="", also="")
    found = Diagnostic(hit, line.place.span)
    assert line.time_s < hit.time_s < SIMULATION.time_s
    path = record(replace(SIMULATION, diagnostics=(found,)), tmp_path / "hit.rrd")
    ((time_s, row),) = rows(path, "/log/findings")
    assert time_s == pytest.approx(1.25)
    assert "C101" in row["TextLog:text"][0]


def test_what_the_arm_cannot_do_is_red_where_it_is_and_says_why(tmp_path: Path) -> None:
    run = failed_run()
    path = record(run, tmp_path / "failed.rrd")
    ((_, targets),) = rows(path, "/failed/targets")
    expected = [failed.base_from_tcp.translation for failed in run.only.failed_moves]
    assert np.allclose(targets["Points3D:positions"], expected, atol=1e-6)
    assert targets["Points3D:colors"] == [0xFF6B62FF]
    ((_, ways),) = rows(path, "/failed/ways")
    assert len(ways["LineStrips3D:strips"]) == 1
    ((_, crosses),) = rows(path, "/failed/places")
    middle = np.mean(np.concatenate(crosses["LineStrips3D:strips"]), axis=0)
    assert np.allclose(middle, run.only.failed_moves[1].fails_at, atol=1e-6)
    ((_, reasons),) = rows(path, "/failed/reasons")
    words = [" ".join(text.split()) for text in reasons["Points3D:labels"]]
    assert words[0].startswith("K601 line 11: p1 cannot be reached by ABB IRB 1600")
    assert "fails at 50 % (120.0 mm): axis 3 goes 8.0 deg past its limit" in words[1]


class Interrupting(Trajectory):
    """A trajectory during which the user presses Ctrl-C."""

    def __init__(self) -> None:
        pass

    @property
    def duration(self) -> float:
        return 1.0

    def at(self, times: Array, *, coarse: bool = False) -> Samples:
        raise KeyboardInterrupt


def interrupted(simulation: Simulation) -> Simulation:
    return with_robot(simulation, trajectory=Interrupting())


def test_an_interrupted_recording_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        record(interrupted(SIMULATION), tmp_path / "frame.rrd")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_recording_keeps_the_older_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "frame.rrd"
    path.write_bytes(b"older")

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("rapidsim.recording.layout.write.log_moves", interrupt)
    with pytest.raises(KeyboardInterrupt):
        record(SIMULATION, path)
    assert [file.name for file in tmp_path.iterdir()] == ["frame.rrd"]
    assert path.read_bytes() == b"older"


def test_a_folder_that_does_not_exist_is_said(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        record(SIMULATION, tmp_path / "nowhere" / "frame.rrd")
