"""What the viewer makes of a recording; needs a Vulkan driver, software or other."""

from __future__ import annotations

import importlib.util
import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from recording_cell import cell, two_robots

from rapidsim.recording.layout.write import record

pytestmark = pytest.mark.screen
TIMES_S = tuple(np.random.default_rng(8).uniform(0.3, 9.0, 2).round(3).tolist())


def load_script() -> ModuleType:
    path = Path(__file__).parents[2] / "scripts" / "screenshot.py"
    spec = importlib.util.spec_from_file_location("screenshot", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["screenshot"] = module
    spec.loader.exec_module(module)
    return module


def test_the_viewer_shows_it_without_complaint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    screenshot = load_script()
    # The viewer's command stands beside the interpreter, on PATH or not.
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent), prepend=os.pathsep)
    missing = screenshot.vulkan_missing()
    if missing or shutil.which("rerun") is None:
        pytest.skip(missing or "the `rerun` command is not on PATH")
    simulation = cell()
    path = record(simulation, tmp_path / "frame.rrd")
    shots = screenshot.shoot(path, TIMES_S, width=800, wait_s=1.0)
    sampled = [round(np.floor(time / 0.012) * 0.012, 9) for time in TIMES_S]
    samples = simulation.only.trajectory.at(np.array(sampled))
    robot = simulation.only.robot
    base_from_flange = robot.kinematics.forward(samples.joints)
    base_from_link = robot.kinematics.link_frames(samples.joints)
    for k, shot in enumerate(shots):
        assert shot.png.startswith(b"\x89PNG")
        assert shot.complaints == ()
        frames = shot.world_from_frame
        assert np.abs(frames["tool0"] - base_from_flange.matrix[k]).max() < 1e-6
        assert np.abs(frames["tcp"] - samples.base_from_tcp.matrix[k]).max() < 1e-6
        # The description's own fixed frame, reached over its links, is the flange as well.
        assert np.abs(frames[f"{robot.name}/tool0"] - base_from_flange.matrix[k]).max() < 1e-6
        for number in range(6):
            link = frames[f"{robot.name}/link_{number + 1}"]
            assert np.abs(link - base_from_link.matrix[k, number]).max() < 1e-6


def test_two_robots_stand_where_they_stand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    screenshot = load_script()
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent), prepend=os.pathsep)
    missing = screenshot.vulkan_missing()
    if missing or shutil.which("rerun") is None:
        pytest.skip(missing or "the `rerun` command is not on PATH")
    run = two_robots()
    path = record(run, tmp_path / "two.rrd")
    (shot,) = screenshot.shoot(path, [run.time_s], width=800, wait_s=1.0)
    assert shot.complaints == ()
    for robot in run.robots:
        tcp = robot.world_from_base @ robot.trajectory.at(np.array([run.time_s])).base_from_tcp
        assert np.abs(shot.world_from_frame[f"{robot.task}/tcp"] - tcp.matrix[0]).max() < 1e-6


@pytest.mark.parametrize(("late", "code"), [(0, 0), (2, 0), (3, 2)])
def test_a_late_viewer_gets_another_try_and_then_a_sentence(
    late: int,
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    screenshot = load_script()
    tries: list[Path] = []

    @contextmanager
    def viewer(recording: Path) -> Iterator[None]:
        tries.append(recording)
        if len(tries) <= late:
            raise RuntimeError("no answer in 15 s")
        yield

    monkeypatch.setattr(screenshot, "viewer", viewer)
    monkeypatch.setattr(screenshot, "vulkan_missing", lambda: None)
    monkeypatch.setattr(screenshot, "_looked_at", lambda *_: (screenshot.Shot(b"picture", (), {}),))
    picture = tmp_path / "a.png"
    monkeypatch.setattr(sys, "argv", ["screenshot.py", "a.rrd", str(picture)])
    assert screenshot.main() == code
    assert len(tries) == min(late + 1, 3)
    assert picture.exists() == (code == 0)
    said = "no picture: the viewer was late 3 times in a row: no answer in 15 s\n"
    assert capsys.readouterr().err == (said if code else "")
