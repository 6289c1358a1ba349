"""`rapidsim serve`: the ready line, how it ends, what it refuses. Its services: tests/server."""

import json
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from command_line import call

PROGRAM = "MODULE job\nPROC main()\nWaitTime 1;\nENDPROC\nENDMODULE\n"


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="ends it by a signal")
def test_it_says_where_it_listens_and_ends_when_told(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    (tmp_path / "ram").mkdir()
    command = [sys.executable, "-m", "rapidsim", "serve", "job.mod", "--rws1-port", "0"]
    command += ["--journal", "a.jsonl", "--ramdisk", "ram"]
    with subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout
        assert process.stderr
        ready = json.loads(process.stdout.readline())
        assert ready["ready"] is True
        assert ready["ramdisk"] == str(tmp_path / "ram")
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"{ready['rws1']}/rw/system", timeout=60)
        assert refused.value.code == 401
        refused.value.close()
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (0, "", "")
    lines = (tmp_path / "a.jsonl").read_text().splitlines()
    assert [json.loads(line)["what"]["kind"] for line in lines] == ["on", "off"]


def test_a_program_with_errors_is_not_served(tmp_path: Path) -> None:
    (tmp_path / "bad.mod").write_text(PROGRAM.replace("WaitTime 1", "WaitTime nothing"))
    done = call("serve", "bad.mod", "--rws1-port", "0", cwd=tmp_path)
    assert (done.code, done.out) == (1, "")
    assert "N201" in done.err


def test_a_port_that_is_taken_is_told(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        done = call("serve", "job.mod", "--rws1-port", port, cwd=tmp_path)
    assert (done.code, done.out) == (2, "")
    assert f"127.0.0.1:{port} cannot be listened at" in done.err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("job.mod", "--host", "0.0.0.0"), "default passwords are known to all"),
        (("job.mod", "--speed", "fast"), "neither a positive number nor max"),
        (("job.mod", "--speed", "0"), "neither a positive number nor max"),
        (("job.mod", "--request-time", "1"), "needs --lock-step"),
        (("job.mod", "--journal", "none/a.jsonl"), "--journal: none/a.jsonl: No such file"),
        (("job.mod", "--ramdisk", "none"), "--ramdisk: none is not a folder"),
        (("job.mod", "--user", "nobody"), "takes NAME:PASSWORD"),
        (("-",), "no program from standard input"),
        (("none.mod",), "none.mod"),
    ],
)
def test_wrong_usage(arguments: tuple[str, ...], told: str, tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    done = call("serve", *arguments, cwd=tmp_path)
    assert (done.code, done.out) == (2, "")
    assert told in done.err
