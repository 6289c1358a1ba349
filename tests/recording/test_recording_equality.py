"""Two recordings of one run have the same content, whatever their bytes; `diff` says so."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from changed_run import with_robot
from command_line import call
from recording_read import SIMULATION

from rapidsim.frames.transform import Transform
from rapidsim.recording.layout.write import record


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recordings")
    record(SIMULATION, folder / "a.rrd")
    record(SIMULATION, folder / "b.rrd")
    record(replace(SIMULATION, events=SIMULATION.events[:-1]), folder / "event.rrd")
    millimetre = Transform(np.eye(3), np.array([0.0, 0.0, 1e-3]))
    record(with_robot(SIMULATION, world_from_base=millimetre), folder / "place.rrd")
    (folder / "bad.rrd").write_bytes(b"RRF2" + bytes(100))
    (folder / "job.mod").write_text("MODULE job\nENDMODULE\n")
    return folder


@pytest.mark.parametrize(
    ("other", "code", "message"),
    [
        ("b.rrd", 0, "No difference."),
        ("event.rrd", 1, "the content differs"),
        ("place.rrd", 1, "the content differs"),
        ("bad.rrd", 2, "bad.rrd is a damaged recording"),
        ("job.mod", 2, "a.rrd can only be compared with another recording"),
        ("job.rrd", 2, "there is no recording job.rrd"),
    ],
)
def test_recordings_are_compared_by_content(
    other: str, code: int, message: str, folder: Path
) -> None:
    ended = call("diff", "a.rrd", other, cwd=folder)
    assert ended.code == code
    assert message in ended.out + ended.err


def test_bytes_of_equal_recordings_differ(folder: Path) -> None:
    """Or the test above would compare nothing."""
    assert (folder / "a.rrd").read_bytes() != (folder / "b.rrd").read_bytes()
