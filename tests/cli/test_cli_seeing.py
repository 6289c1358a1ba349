"""What a run is looked at with: recording, report, pictures, viewer."""

from __future__ import annotations

import gzip
import os
import re
import signal
import subprocess
import sys
import time
from base64 import b64decode
from pathlib import Path

import pytest
from cli_helper import HEARS, rapidsim
from rerun.chunk import RrdReader

from rapidsim.cli import viewer
from rapidsim.cli.tools.opened_viewer import open_viewer
from rapidsim.plots import write
from rapidsim.plots.path_picture import path_picture
from rapidsim.recording.page import write_page
from rapidsim.recording.page.viewer_files import ViewerFiles

PROGRAM = """MODULE Short
  CONST robtarget p:=[[600,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\\Off;
    MoveJ p, v500, fine, tool0;
  ENDPROC
ENDMODULE
"""
LONG = PROGRAM.replace("PROC main()", "PROC main()\n    FOR k FROM 1 TO 50 DO").replace(
    "    MoveJ p, v500, fine, tool0;\n",
    "    MoveJ p, v500, fine, tool0;\n    MoveJ Offs(p,0,400,0), v50, z10, tool0;\n    ENDFOR\n",
)
MAIN = f"{HEARS}from rapidsim.cli import main; main()"
NO_SCREEN = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "Short.mod").write_text(PROGRAM)
    return tmp_path


def test_everything_asked_for_is_written_and_named(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # One of the pictures; tests of pictures draw them all.
    monkeypatch.setattr(write, "PICTURES", {"path": path_picture})
    ended = rapidsim(
        "run", "Short.mod", "--report", "s.html", "--plots", "plots", "--trace", "s.ros.json",
        cwd=folder,
    )  # fmt: skip
    assert ended.code == 0
    for name in ("Short.rrd (recording)", "s.html (report)", "plots (plots)", "s.ros.json (trace)"):
        assert name in " ".join(ended.out.split())
    assert (folder / "plots" / "path-dark.png").is_file()


def test_the_step_of_the_recording_can_be_chosen(folder: Path) -> None:
    rapidsim("run", "Short.mod", "--record-dt", "0.1", cwd=folder)
    chunks = RrdReader(folder / "Short.rrd").stream().filter(content="/joints/angle")
    times = [chunk.num_rows for chunk in chunks if not chunk.is_static]
    assert 5 < sum(times) < 40
    ended = rapidsim("run", "Short.mod", "--record-dt", "0", cwd=folder)
    assert ended.code == 2
    assert "record-dt" in ended.err


@pytest.mark.process
def test_what_was_found_is_not_lost_over_a_file_that_cannot_be_written(folder: Path) -> None:
    """The recording fits on no disk of 1 MB, the summary does."""
    (folder / "s.html").write_text("older")
    script = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000));"
        "from rapidsim.cli import main; import sys; sys.exit(main())"
    )
    done = subprocess.run(
        # -B: compiled modules would be cut off too, and stay so for whoever comes next.
        [
            sys.executable,
            "-B",
            "-c",
            script,
            "run",
            "Short.mod",
            "--no-record",
            "--report",
            "s.html",
        ],
        cwd=folder,
        # Python's own cache would be cut as well, and stay so.
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "ended as programmed" in done.stdout
    assert "cannot write `s.html`" in done.stderr
    assert (folder / "s.html").read_text() == "older"
    assert not list(folder.glob(".*.part"))


def test_places_are_refused_before_the_run(folder: Path) -> None:
    for arguments, words in (
        (("--report", "s.pdf"), "must end in .html"),
        (("--report", "nowhere/s.html"), "nowhere is not a folder"),
        (("--plots", "Short.mod"), "is a file"),
        (("--view",), "no screen"),
        (("--view", "--no-record"), "exclude each other"),
    ):
        ended = rapidsim("run", "Short.mod", *arguments, cwd=folder, environment=NO_SCREEN)
        assert ended.code == 2, arguments
        assert words in ended.err
    assert not list(folder.glob("*.rrd"))


@pytest.mark.parametrize(
    ("wrote", "said"),
    [("log\nError: winit: No X server", "No X server"), ("", "exit code 3")],
)
def test_a_viewer_that_does_not_open_is_told(
    wrote: str, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    dies = f"import sys; sys.stderr.write({wrote!r}); sys.exit(3)"
    monkeypatch.setattr(viewer, "_command", lambda _: [sys.executable, "-c", dies])
    monkeypatch.setattr(viewer, "_SETTLED_AFTER_S", 300.0)
    open_viewer(Path("x.rrd"))
    assert capsys.readouterr().err == f"note: the viewer did not open: {said}\n"


def test_a_viewer_that_hands_over_to_an_open_one_is_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(viewer, "_command", lambda _: [sys.executable, "-c", ""])
    monkeypatch.setattr(viewer, "_SETTLED_AFTER_S", 300.0)
    assert viewer.leave_open(Path("x.rrd")) is None


def test_the_viewer_is_given_recordings_only(folder: Path) -> None:
    assert "no recording nix.rrd" in rapidsim("view", "nix.rrd", cwd=folder).err
    ended = rapidsim("view", "Short.mod", cwd=folder)
    assert ended.code == 2
    assert "Short.mod is not a recording" in ended.err
    rapidsim("run", "Short.mod", cwd=folder)
    if sys.platform == "linux":
        assert "no screen" in rapidsim("view", "Short.rrd", cwd=folder, environment=NO_SCREEN).err


def test_a_page_has_the_recording_and_the_viewer(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    served = ViewerFiles("var glue = 1;", b"program" * 100, "MIT")
    monkeypatch.setattr(write_page, "viewer_files", lambda: served)
    recording = b"RRF2 <b>data</b>"
    (folder / "a&b.rrd").write_bytes(recording)
    ended = rapidsim("view", "a&b.rrd", "--export", "page", cwd=folder, environment=NO_SCREEN)
    assert (ended.code, ended.err) == (0, "")
    assert ended.out == f"{Path('page', 'index.html')} shows it in any browser (0.0 MB)\n"
    page = (folder / "page" / "index.html").read_text()
    assert "<title>a&amp;b</title>" in page
    assert "<script>var glue = 1;</script>" in page
    found = re.search(r'id="recording">([^<]*)<', page)
    program = re.search(r'id="program">([^<]*)<', page)
    assert found is not None
    assert program is not None
    assert b64decode(found[1]) == recording
    assert gzip.decompress(b64decode(program[1])) == served.program
    assert (folder / "page" / "THIRD_PARTY_NOTICES.md").read_text() == "MIT"
    quiet = rapidsim("view", "a&b.rrd", "--export", "page", "-q", cwd=folder)
    assert (quiet.code, quiet.out) == (0, "")
    again = rapidsim("view", "a&b.rrd", "--export", "Short.mod", cwd=folder)
    assert (again.code, again.err) == (2, "error: Short.mod is a file; a folder is needed\n")
    nowhere = rapidsim("view", "a&b.rrd", "--export", "no/page", cwd=folder)
    assert nowhere.code == 2
    assert "no is not a folder" in nowhere.err
    monkeypatch.setattr(write_page, "_MOST_BYTES", 10)
    large = rapidsim("view", "a&b.rrd", "--export", "page", cwd=folder)
    assert large.code == 2
    assert (folder / "page" / "index.html").read_text() == page


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_ctrl_c_leaves_the_older_recording(folder: Path) -> None:
    (folder / "Long.mod").write_text(LONG)
    (folder / "Long.rrd").write_bytes(b"older")
    process = subprocess.Popen(
        [*(sys.executable, "-c", MAIN), "run", "Long.mod", "--record-dt", "0.002"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    # Before this size pyarrow imports modules, once, and loses a signal that comes meanwhile.
    while not any(part.stat().st_size > 200_000 for part in folder.glob(".Long.rrd.*.part")):
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, words = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "interrupted" in words
    assert (folder / "Long.rrd").read_bytes() == b"older"
    assert not list(folder.glob(".*.part"))
