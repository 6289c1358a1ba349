"""Attaching to a controller that `rapidsim serve` serves."""

from __future__ import annotations

import json
import socket
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from command_line import call
from dap_client import Client, RefusedError

from rapidsim.dap.wire import Message
from rapidsim.pytest_plugin import ServedController

pytestmark = pytest.mark.process

CELL = """MODULE cell
  PERS num rounds:=0;
  PERS num limit:=3;
  PROC main()
    VAR num own:=7;
    add own;
    WaitTime 0.05;
    IF rounds>limit rounds:=limit;
  ENDPROC
  PROC add(num n)
    rounds:=rounds+1;
    n:=n+rounds;
  ENDPROC
ENDMODULE
"""
ADD, NEXT, WAIT = 11, 12, 7


TASKS = """[[task]]
modules = ["cell.mod"]

[[task]]
name = "T_TWO"
type = "normal"
motion = false
modules = ["two.mod"]
"""


class Rws:
    """A client of Robot Web Services 1.0."""

    def __init__(self, served: ServedController) -> None:
        passwords = urllib.request.HTTPPasswordMgrWithDefaultRealm()
        passwords.add_password(None, served.rws1, "Default User", "robotics")
        digest = urllib.request.HTTPDigestAuthHandler(passwords)
        self._root = served.rws1
        self._opener = urllib.request.build_opener(
            digest, urllib.request.HTTPCookieProcessor(), urllib.request.ProxyHandler({})
        )

    def get(self, path: str) -> str:
        with self._opener.open(f"{self._root}/{path}", timeout=20) as answer:
            return str(answer.read().decode())

    def post(self, path: str, data: str = "") -> int:
        with self._opener.open(f"{self._root}/{path}", data.encode(), timeout=20) as answer:
            return int(answer.status)

    def state(self) -> str:
        text = self.get("rw/rapid/execution?json=1")
        return str(json.loads(text)["_embedded"]["_state"][0]["ctrlexecstate"])

    def start(self) -> None:
        form = "regain=continue&execmode=continue&cycle=forever&condition=none&stopatbp=disabled"
        assert self.post("rw/rapid/execution?action=start", f"{form}&alltaskbytsp=false") == 204


@pytest.fixture
def served(tmp_path: Path, controller: Callable[..., ServedController]) -> ServedController:
    (tmp_path / "cell.mod").write_text(CELL)
    journal = tmp_path / "journal.jsonl"
    return controller(tmp_path / "cell.mod", "--debug", "0", "--journal", journal)


def attach(client: Client, served: ServedController, *breaks: int | Message) -> None:
    client.request("initialize", adapterID="rapidsim")
    attached = client.send("attach", port=int(str(served.debug).rpartition(":")[2]))
    client.event("initialized")
    client.breaks("cell.mod", *breaks)
    client.request("setExceptionBreakpoints", filters=[])
    client.request("configurationDone")
    client.answer(attached)


def test_it_stops_steps_and_shows_values_while_clients_are_answered(
    tmp_path: Path, served: ServedController
) -> None:
    rws = Rws(served)
    rws.start()
    with Client(tmp_path) as client:
        attach(client, served, {"line": ADD, "condition": "n=7"})
        assert client.stopped()["reason"] == "breakpoint"
        assert [one["line"] for one in client.stack()] == [ADD, 6]
        before = int(client.value("rounds"))
        assert client.value("n*2+Abs(-1)") == "15"
        assert rws.state() == "running"
        client.go("next")
        assert client.place() == ("add", NEXT)
        assert client.scope("Persistents") == {"rounds": f"{before + 1}", "limit": "3"}
        client.breaks("cell.mod")
        client.go("stepOut")
        assert client.place() == ("main", WAIT)
        assert client.value("own") == "7"
        client.request("continue")
        assert rws.state() == "running"
        time.sleep(0.3)
        assert client.go("pause")["reason"] == "pause"
        with pytest.raises(RefusedError, match="does not go back"):
            client.request("stepBack", threadId=1)
        with pytest.raises(RefusedError, match="no copies"):
            client.request("runToTime", time=9)
    time.sleep(0.3)
    assert rws.state() == "running"
    assert rws.post("rw/rapid/execution?action=stop", "stopmode=stop") == 204
    assert rws.state() == "stopped"


def test_a_program_that_is_started_into_a_breakpoint_answers_and_goes_on_when_it_detaches(
    tmp_path: Path, served: ServedController
) -> None:
    rws = Rws(served)
    with Client(tmp_path) as client:
        attach(client, served, 6)
        rws.start()
        client.stopped()
        assert client.place() == ("main", 6)
        assert client.request("threads") == {"threads": [{"id": 1, "name": "T_ROB1"}]}
        answers = [rws.state(), rws.get("rw/rapid/tasks/T_ROB1/pcp?json=1")]
        assert answers[0] == "running"
        time.sleep(0.5)
        client.request("setExpression", expression="limit", value="9")
        client.request("disconnect")
    time.sleep(0.3)
    with Client(tmp_path) as again:
        attach(again, served, {"line": NEXT, "hitCondition": "2"})
        again.stopped()
        assert int(again.value("rounds")) > 1
        assert again.value("limit") == "9"
        # Time at the first stop has not passed for the program.
        journal = (tmp_path / "journal.jsonl").read_text().splitlines()
        start, last = (json.loads(journal[k])["t"] for k in (3, -1))
        assert last - start < 5
    assert rws.post("rw/rapid/execution?action=stop", "stopmode=stop") == 204
    assert rws.state() == "stopped"


def test_a_client_may_stop_the_program_and_the_server_may_end_at_a_stop(
    tmp_path: Path, controller: Callable[..., ServedController]
) -> None:
    (tmp_path / "cell.mod").write_text(CELL)
    (tmp_path / "two.mod").write_text(CELL.replace("MODULE cell", "MODULE two"))
    (tmp_path / "rapidsim.toml").write_text(TASKS)
    served = controller(tmp_path / "cell.mod", "--debug", "0")
    rws = Rws(served)
    rws.start()
    with Client(tmp_path) as client:
        attach(client, served)
        client.breaks("two.mod", ADD)
        assert client.stopped()["threadId"] == 2
        assert client.place(2) == ("add", ADD)
        assert client.stack(1)[-1]["name"] == "main"
        rounds = client.value("rounds")
        assert rws.post("rw/rapid/execution?action=stop", "stopmode=stop") == 204
        assert client.value("rounds") == rounds
        client.breaks("two.mod")
        client.request("continue")
        time.sleep(0.2)
        assert rws.state() == "stopped"
        rws.start()
        client.breaks("two.mod", WAIT)
        client.stopped()
        assert (served.end(), served.errors) == (0, "")
        client.event("terminated")
        with pytest.raises(RefusedError, match="the controller has ended"):
            client.request("continue")


def test_a_run_that_is_debugged_is_in_the_journal_as_one_that_is_not(
    tmp_path: Path, served: ServedController
) -> None:
    rws = Rws(served)
    rws.start()
    with Client(tmp_path) as client:
        attach(client, served, ADD)
        for command in ("next", "stepOut", "continue", "stepIn"):
            client.stopped()
            rws.state()
            client.request(command, threadId=1)
        client.stopped()
    assert rws.post("rw/rapid/execution?action=stop", "stopmode=stop") == 204
    assert (served.end(), served.errors) == (0, "")
    done = call("run", "cell.mod", "--replay", "journal.jsonl", "--no-record", cwd=tmp_path)
    assert (done.code, done.err) == (0, "")


def test_what_is_no_debugger_is_refused(tmp_path: Path, served: ServedController) -> None:
    assert served.debug is not None
    place = "127.0.0.1", int(served.debug.rpartition(":")[2])
    body = b'{"seq":1,"type":"request","command":"attach","arguments":{}}'
    headers = b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: %d\r\n\r\n" % len(body)
    for data in (headers + body, b"\r\n\r\n" + body, b"x" * 2000, b"Content-Length: -1\r\n\r\n"):
        with socket.create_connection(place, 10) as page:
            page.sendall(data)
            with suppress(ConnectionResetError):
                assert page.recv(100) == b""
    rws = Rws(served)
    with Client(tmp_path) as client:
        client.request("initialize")
        with pytest.raises(RefusedError, match="`rapidsim serve --debug PORT`"):
            client.request("attach")
    with Client(tmp_path) as client:
        client.request("initialize")
        with pytest.raises(RefusedError, match="no controller is debugged there"):
            client.request("attach", port=1)
    with Client(tmp_path) as client:
        attach(client, served)
        with pytest.raises(RefusedError, match="pause it first"):
            client.request("stackTrace", threadId=1)
        form = "regain=continue&execmode=stepin&cycle=forever&condition=none&stopatbp=disabled"
        with pytest.raises(urllib.error.HTTPError):
            rws.post("rw/rapid/execution?action=start", f"{form}&alltaskbytsp=false")
    assert rws.state() == "stopped"
