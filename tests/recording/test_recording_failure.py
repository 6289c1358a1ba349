"""No room for a recording: a plain message, no half file, the older file as it was."""

from __future__ import annotations

import os
import subprocess
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest
import rerun as rr
from recording_cell import cell

from rapidsim.files import InputError
from rapidsim.recording import stream
from rapidsim.recording.layout.write import record

RECORD = """
import resource, sys
from pathlib import Path
limit = int(sys.argv[2])
if limit:
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
sys.path.append("..")
from recording_cell import cell
from rapidsim.files import InputError
from rapidsim.recording.layout.write import record
try:
    record(cell(rounds=1), sys.argv[1])
except InputError as error:
    print(error.message)
    sys.exit(2)
"""

RECORD_LIVE = """
import resource, sys
from pathlib import Path
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]),) * 2)
from rapidsim.files import InputError
from rapidsim.recording.live_recording import LiveRecording
recording = LiveRecording(Path(sys.argv[1]), False)
recording.begin([])
try:
    for number in range(5000):
        recording.log_text(number, "texts", f"{number} " * 20)
    recording.close()
except (InputError, RuntimeError) as error:
    print(error)
    sys.exit(2)
"""


def record_elsewhere(path: Path, limit: int = 0, script: str = RECORD) -> tuple[int, str]:
    """Record in another process, with a limit [bytes] on the size of files."""
    done = subprocess.run(
        # -B: compiled modules would be cut off too, and stay so for whoever comes next.
        [sys.executable, "-B", "-c", script, str(path), str(limit)],
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    return done.returncode, done.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
@pytest.mark.parametrize("script", [RECORD, RECORD_LIVE], ids=["run", "served"])
def test_a_file_that_may_not_grow_is_said(script: str, tmp_path: Path) -> None:
    path = tmp_path / "frame.rrd"
    path.write_bytes(b"older")
    code, words = record_elsewhere(path, 200_000, script)
    assert code == 2
    assert "cannot write" in words
    assert "the older `frame.rrd` is as it was" in words
    assert [file.name for file in tmp_path.iterdir()] == ["frame.rrd"]
    assert path.read_bytes() == b"older"


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    disk = tmp_path / "small"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=300k", "tmpfs", str(disk)]
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("only root may mount a small disk")
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no disk may be mounted here")
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


def test_a_full_disk_is_said(small_disk: Path) -> None:
    code, words = record_elsewhere(small_disk / "frame.rrd")
    assert code == 2
    assert "the disk is full" in words
    assert list(small_disk.iterdir()) == []


def test_a_folder_that_may_not_be_written_to_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(InputError, match="may not be written to"):
        record(cell(rounds=1), tmp_path / "frame.rrd")
    assert list(tmp_path.iterdir()) == []


def test_a_writer_that_has_stopped_is_not_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a full disk rerun's writer may end without a word; its own wait never ends."""
    waits: list[float] = []

    def flush(_stream: rr.RecordingStream, *, timeout_sec: float = 1e38) -> None:
        waits.append(timeout_sec)
        raise RuntimeError("not flushed in time")

    monkeypatch.setattr(rr.RecordingStream, "flush", flush)
    with pytest.raises(InputError, match="cannot write"):
        record(cell(rounds=1), tmp_path / "frame.rrd")
    assert waits
    assert max(waits) < 60.0
    assert not list(tmp_path.iterdir())


def test_nothing_waits_for_a_writer_that_has_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a full disk rerun's writer stops unseen in one of thirty runs."""

    def flush(self: rr.RecordingStream, *, timeout_sec: float) -> None:
        raise RuntimeError(f"Flush timed out after {timeout_sec} s")

    unregistered: list[bool] = []
    file = tmp_path / "frame.rrd"
    file.write_bytes(b"begun")
    stopped = stream._FileStream(file, uuid.uuid4())
    with monkeypatch.context() as patched:
        patched.setattr(rr.RecordingStream, "flush", flush)
        patched.setattr(rr, "unregister_shutdown", lambda: unregistered.append(True))
        with pytest.raises(RuntimeError, match="has stopped"):
            stopped.flush()
    assert unregistered == [True]


@pytest.mark.process
def test_no_module_is_imported_where_ctrl_c_is_lost() -> None:
    # Arrow clears whatever error an import in C raises.
    script = (
        "import sys, rapidsim.recording.stream, pyarrow\n"
        "before = set(sys.modules)\n"
        "pyarrow.array(['text'])\n"
        "print(sorted(set(sys.modules) - before))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"
