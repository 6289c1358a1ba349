"""`rapidsim serve`: the ready line, how it ends, what it refuses. Its services: tests/server."""

import http.client
import json
import socket
import sys
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import call

from rapidsim.pytest_plugin import ServedController

PROGRAM = "MODULE job\nPROC main()\nWaitTime 1;\nENDPROC\nENDMODULE\n"


def opener(address: str, name: str, password: str) -> urllib.request.OpenerDirector:
    """Opens pages as somebody."""
    passwords = urllib.request.HTTPPasswordMgrWithDefaultRealm()
    passwords.add_password(None, address, name, password)
    return urllib.request.build_opener(urllib.request.HTTPDigestAuthHandler(passwords))


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="ends it by a signal")
def test_it_says_where_it_listens_and_ends_when_told(
    tmp_path: Path,
    controller: Callable[..., ServedController],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # Who names logins wants no others: an image has the default one in this variable.
    monkeypatch.setenv("RAPIDSIM_USERS", "Default User:robotics")
    (tmp_path / "job.mod").write_text(PROGRAM)
    (tmp_path / "ram").mkdir()
    journal = tmp_path / "a.jsonl"
    (tmp_path / "users.txt").write_text("Somebody:secret\n\n")
    options = ("--journal", journal, "--ramdisk", tmp_path / "ram", "--lock-step", "--robotware", 6)
    (ready := tmp_path / "ready.json").write_text("of an earlier server")
    users = ("--user-file", tmp_path / "users.txt")
    served = controller(tmp_path / "job.mod", *options, *users, "--ready-file", ready)
    assert json.loads(ready.read_text())["rws1"] == served.rws1
    assert served.ramdisk == tmp_path / "ram"
    assert served.home.parent == tmp_path
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(f"{served.rws1}/rw/system", timeout=60)
    assert refused.value.code == 401
    refused.value.close()
    with opener(served.rws1, "Somebody", "secret").open(f"{served.rws1}/rw/system") as page:
        assert b"6.16.2027" in page.read()
    with pytest.raises((ValueError, urllib.error.HTTPError)):
        opener(served.rws1, "Default User", "robotics").open(f"{served.rws1}/rw/system")
    with pytest.raises(ValueError, match="earthquake"):
        served.fail("earthquake")
    served.fail("drop", count=1)
    with pytest.raises(http.client.RemoteDisconnected):
        urllib.request.urlopen(f"{served.rws1}/rw/system", timeout=60)
    served.fail("general_stop", for_=3.0)
    served.end_faults()
    assert (served.end(), ready.exists()) == (0, False)
    assert "General stop open" in served.errors
    lines = journal.read_text().splitlines()
    kinds = [json.loads(line)["what"].get("kind", "request") for line in lines]
    assert kinds.count("fault") == 4
    assert (kinds[:2], kinds[-1]) == (["on", "request"], "off")


def test_a_program_with_errors_is_not_served(tmp_path: Path) -> None:
    (tmp_path / "bad.mod").write_text(PROGRAM.replace("WaitTime 1", "WaitTime nothing"))
    # Of a server that was killed; a health check would believe it while this one starts.
    (ready := tmp_path / "ready.json").write_text("{}")
    ports = ("--rws1-port", "0", "--rws2-port", "off")
    done = call("serve", "bad.mod", *ports, "--ready-file", ready, cwd=tmp_path)
    assert (done.code, done.out) == (1, "")
    assert "N201" in done.err
    assert not ready.exists()


def test_a_port_that_is_taken_is_told(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        done = call("serve", "job.mod", "--rws1-port", port, "--rws2-port", "off", cwd=tmp_path)
    assert (done.code, done.out) == (2, "")
    assert f"127.0.0.1:{port} cannot be listened at" in done.err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("job.mod", "--host", "0.0.0.0"), "default passwords are known to all"),
        (("job.mod", "--speed", "fast"), "neither a positive number nor max"),
        (("job.mod", "--speed", "0"), "neither a positive number nor max"),
        (("job.mod", "--request-time", "1"), "needs --lock-step"),
        (("job.mod", "--user", "nobody"), "NAME:PASSWORD is needed"),
        (("job.mod", "--rws1-port", "off"), "no client could reach"),
        (("job.mod", "--rws1-port", "70000"), "neither a number from 0 to 65535 nor off"),
        (("job.mod", "--robotware", "8", "--rws1-port", "0"), "RobotWare 8 does not support it"),
        (("job.mod", "--allow-origin", "localhost:3000"), "is not an origin"),
        (("job.mod", "--user-file", "none.txt"), "none.txt"),
        (("-",), "no program from standard input"),
        (("none.mod",), "none.mod"),
    ],
)
def test_wrong_usage(arguments: tuple[str, ...], told: str, tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    done = call("serve", "--rws2-port", "off", *arguments, cwd=tmp_path)
    assert (done.code, done.out) == (2, "")
    assert told in done.err


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there always is a screen")
def test_a_recording_is_not_shown_live_where_there_is_no_screen(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    arguments = ("job.mod", "--record", "live.rrd", "--view", "--rws2-port", "off")
    screen = {"DISPLAY": "", "WAYLAND_DISPLAY": ""}
    done = call("serve", *arguments, cwd=tmp_path, environment=screen)
    assert (done.code, done.out) == (2, "")
    assert "no screen" in done.err
    assert not (tmp_path / "live.rrd").exists()
