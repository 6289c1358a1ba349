"""Clients see a controller and its connections fail, and a replay repeats it."""

from __future__ import annotations

import asyncio
import contextlib
import random
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from failing_program import PROGRAM
from served_controller import Served, serve

from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine
from rapidsim.server.http.fault_port import open_fault_port
from rapidsim.server.journal import read_journal
from rapidsim.server.link import DirectLink
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.replay import replayed
from rapidsim.server.settings import EngineSettings

STATION = """[signals]
diReset = { type = "di", action = "ResetEstop" }
diOn = { type = "di", action = "MotOn" }
diStart = { type = "di", action = "Start" }
doStop = { type = "do", system = "EmStop" }
[[fault]]
kind = "guard_stop"
when = "doStop"
after = 1000
"""
EXECUTION, CTRLSTATE = "rw/rapid/execution", "rw/panel/ctrlstate"
DROPPED = (aiohttp.ServerDisconnectedError, aiohttp.ClientOSError)


def failing(folder: Path, use: Any) -> None:
    """Let a client use the cell; the same life without a client gives the same journal."""
    cell, lines = folder / "cell", list[str]()
    cell.mkdir()
    (cell / "failing.mod").write_text(PROGRAM)
    (cell / "rapidsim.toml").write_text(STATION)
    (folder / "home").mkdir()
    made = ready(RunRequest(paths=(str(cell),), home=str(folder / "home")))

    async def used(served: Served) -> Engine:
        await use(served)
        return served.engine

    with recursion_limit(RUNNING_DEPTH):
        serve(folder, None, used, journal=lines.append).switch_off()
    told: list[str] = []
    for one in (folder / "home").iterdir():
        one.unlink()
    replayed(made, read_journal(lines, "lines"), told.append)
    assert told == []
    assert any('"fault"' in line for line in lines)


async def state(served: Served) -> str:
    (item,) = await served.get(CTRLSTATE)
    return str(item["ctrlstate"])


async def push(served: Served, name: str) -> None:
    for level in "10":
        await served.post(f"rw/iosystem/signals/{name}?action=set", lvalue=level)


async def codes(served: Served) -> list[str]:
    return [str(entry["code"]) for entry in await served.get("rw/elog/0?lang=en")]


def test_an_emergency_stop_is_reset_by_a_client_and_by_inputs(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        await served.post(f"{EXECUTION}?action=start", cycle="forever")
        assert await served.fail(kind="emergency_stop") == (204, "")
        assert (await state(served), await served.executes()) == ("emergencystop", False)
        assert (await served.get("rw/iosystem/signals/doStop"))[0]["lvalue"] == "1"
        refused = await served.post(f"{CTRLSTATE}?action=setctrlstate", ctrl_state="motoron")
        assert refused == (400, -1073442809)
        assert await served.mend() == 204
        assert await state(served) == "emergencystopreset"
        for name, shown in (("diReset", "motoroff"), ("diOn", "motoron"), ("diStart", "motoron")):
            await push(served, name)
            assert await state(served) == shown
        assert await served.executes()
        form = {"resources": "1", "1": "/rw/panel/ctrlstate", "1-p": "1"}
        async with served.client.post(f"{served.base}/subscription", data=form) as response:
            link = response.headers["Location"]
        socket = await served.client.ws_connect(link, protocols=("robapi2_subscription",))
        assert "motoron" in await socket.receive_str(timeout=20)
        await served.fail(kind="general_stop", for_=0.2)
        await served.fail(kind="guard_stop", for_=0.1)
        assert await state(served) == "guardstop"
        assert "guardstop" in await socket.receive_str(timeout=20)
        for _ in range(5):
            await served.get(EXECUTION)
        assert await state(served) == "motoroff"
        await served.post(f"{CTRLSTATE}?action=setctrlstate", ctrl_state="motoron")
        await served.post(f"{EXECUTION}?action=start")
        assert await served.executes()
        assert {"20202", "10013", "20205", "20206", "10012"} <= set(await codes(served))

    failing(tmp_path, use)


def test_requests_are_dropped_delayed_repeated_and_refused(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        await served.post("rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set", value="5")
        await served.fail(kind="drop", count=1)
        with pytest.raises(DROPPED):
            await served.post("rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set", value="6")
        assert await served.value("rounds") == "5"
        clock = asyncio.get_running_loop().time
        await served.fail(kind="delay", by=0.3, count=1)
        began_s = clock()
        await served.get(EXECUTION)
        assert clock() - began_s >= 0.3
        await served.fail(kind="duplicate", count=1)
        # A second start is refused, which the client gets to know.
        assert (await served.post(f"{EXECUTION}?action=start"))[0] == 400
        assert await served.executes()
        await served.fail(kind="refuse")
        async with aiohttp.ClientSession() as other:
            with pytest.raises(aiohttp.ClientConnectionError):
                await other.get(f"{served.base}/rw")
        await served.mend()
        async with aiohttp.ClientSession() as other, other.get(f"{served.base}/rw") as response:
            assert response.status == 401

    failing(tmp_path, use)


def test_events_are_delayed_repeated_and_their_websockets_broken(tmp_path: Path) -> None:
    async def subscribed(served: Served) -> aiohttp.ClientWebSocketResponse:
        form = {"resources": "1", "1": "/rw/iosystem/signals/diReset;state", "1-p": "2"}
        async with served.client.post(f"{served.base}/subscription", data=form) as response:
            link = response.headers["Location"]
        return await served.client.ws_connect(link, protocols=("robapi2_subscription",))

    async def use(served: Served) -> None:
        socket = await subscribed(served)
        first = await socket.receive_str(timeout=20)
        await served.fail(kind="duplicate", on="websocket", count=1)
        await served.fail(kind="delay", on="websocket", by=0.2)
        began_s = asyncio.get_running_loop().time()
        await served.post("rw/iosystem/signals/diReset?action=set", lvalue="1")
        twice = {await socket.receive_str(timeout=20) for _ in range(2)}
        assert len(twice) == 1
        assert first not in twice
        assert asyncio.get_running_loop().time() - began_s >= 0.2
        await served.mend()
        await served.fail(kind="drop", on="websocket")
        message = await socket.receive(timeout=20)
        assert message.type in (aiohttp.WSMsgType.CLOSED, aiohttp.WSMsgType.ERROR)
        await served.mend()
        await served.fail(kind="refuse", on="websocket")
        with pytest.raises(aiohttp.WSServerHandshakeError):
            await subscribed(served)
        await served.mend()

    failing(tmp_path, use)


def test_a_restart_ends_sessions_and_the_controller_is_back_with_motors_off(
    tmp_path: Path,
) -> None:
    async def use(served: Served) -> None:
        await served.post(f"{EXECUTION}?action=start", cycle="forever")
        cookies = {one.key for one in served.client.cookie_jar}
        assert cookies
        assert (await served.fail(kind="restart", for_=0.3))[0] == 204
        with pytest.raises(aiohttp.ClientConnectionError):
            await served.get(EXECUTION)
        await asyncio.sleep(0.4)
        assert served.face.counts == (0, 0)
        assert (await state(served), await served.executes()) == ("motoroff", False)
        await served.post(f"{CTRLSTATE}?action=setctrlstate", ctrl_state="motoron")
        assert (await served.post(f"{EXECUTION}?action=start"))[0] == 204
        assert "10045" in await codes(served)
        for _ in range(40):
            await served.get(EXECUTION)
        assert await served.value("rounds") != "0"
        # A client gets the answer, then its connection ends.
        assert await served.post("rw/panel?action=restart", restart_mode="pstart") == (204, 0)
        await asyncio.sleep(0.2)
        with pytest.raises(aiohttp.ClientConnectionError):
            await served.get(EXECUTION)
        await asyncio.sleep(1.0)
        assert await served.value("rounds") == "0"

    failing(tmp_path, use)


def test_uploads_fail_on_a_full_disk_and_entries_of_the_log_are_seen(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        url = f"{served.base}/fileservice/$HOME/a.txt"
        await served.fail(kind="full_disk")
        async with served.client.put(url, data=b"content") as response:
            assert response.status == 400
        await served.mend()
        async with served.client.put(url, data=b"content") as response:
            assert response.status in (200, 201)
        await served.fail(kind="elog", code=38103, severity="warning", title="Seen", texts=["x"])
        entry = (await served.get("rw/elog/3?lang=en"))[0]
        assert (entry["code"], entry["msgtype"], entry["title"]) == ("38103", "2", "Seen")
        await served.fail(kind="device_lost", device="board")
        assert (await codes(served))[0] == "70058"
        await served.mend()
        assert (await codes(served))[0] == "70059"

    failing(tmp_path, use)


RANDOM_FAULTS: tuple[dict[str, object], ...] = (
    {"kind": "emergency_stop"},
    {"kind": "guard_stop", "for_": 0.2},
    {"kind": "restart", "for_": 0.01},
    {"kind": "restart", "for_": 0.01, "mode": "cold"},
    {"kind": "full_disk", "for_": 0.3},
    {"kind": "device_lost", "device": "board", "for_": 0.2},
    {"kind": "elog"},
    *(
        dict[str, object](kind=kind, on=on, count=2, **({"by": 0.01} if kind == "delay" else {}))
        for kind in ("drop", "delay", "duplicate", "refuse")
        for on in ("http", "websocket")
    ),
)


def test_a_random_session_with_faults_leaves_the_controller_as_it_was(tmp_path: Path) -> None:
    """A short sample of `benchmarks/soak.py`."""
    dice = random.Random(5)
    requests: tuple[tuple[str, dict[str, str]], ...] = (
        (f"{EXECUTION}?action=start", {"cycle": "forever"}),
        (f"{EXECUTION}?action=stop", {}),
        (f"{EXECUTION}?action=resetpp", {}),
        (f"{CTRLSTATE}?action=setctrlstate", {"ctrl_state": "motoron"}),
        ("rw/iosystem/signals/diReset?action=set", {"lvalue": "1"}),
        ("rw/iosystem/signals/diReset?action=set", {"lvalue": "0"}),
        ("rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set", {"value": "3"}),
    )

    async def use(served: Served) -> None:
        for _ in range(80):
            if dice.random() < 0.3:
                assert (await served.fail(**dice.choice(RANDOM_FAULTS)))[0] == 204
            elif dice.random() < 0.1:
                assert await served.mend() == 204
            with contextlib.suppress(aiohttp.ClientError):
                path, form = dice.choice(requests)
                await served.post(path, **form)
            with contextlib.suppress(aiohttp.ClientError):
                url = f"{served.base}/fileservice/$HOME/a.txt"
                async with served.client.put(url, data=b"whole") as response:
                    await response.read()
        await served.mend()
        await asyncio.sleep(0.2)
        for path in (f"{EXECUTION}?action=stop", f"{CTRLSTATE}?action=setctrlstate"):
            await served.post(path, ctrl_state="motoron")
        assert (await state(served), await served.executes()) == ("motoron", False)
        assert not served.engine.live.faults.lasting
        assert len(served.face.connections) <= 2
        assert (tmp_path / "home" / "a.txt").read_bytes() == b"whole"

    failing(tmp_path, use)


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("[]", "JSON object"),
        ("{", "JSON object"),
        ("[" * 50_000, "JSON object"),
        ("{}", "emergency_stop"),
        ('{"kind": "earthquake"}', "earthquake"),
        ('{"kind": "drop", "on": "phone"}', "phone"),
        ('{"kind": "elog", "by": 2}', "no such key"),
        ('{"kind": "elog", "code": 3}', "10000"),
        ('{"kind": "device_lost"}', "name the device"),
        ('{"kind": "drop", "for": -1}', "negative"),
        ('{"kind": "drop", "when": "a b"}', "condition"),
        ('{"kind": "drop", "nth": [1]}', "counts how often"),
    ],
)
def test_what_is_no_fault_is_refused_with_a_sentence(
    body: str, says: str, fault_port: tuple[str, Any]
) -> None:
    address, run = fault_port

    async def ask() -> tuple[int, str]:
        async with (
            aiohttp.ClientSession() as tester,
            tester.post(f"{address}/faults", data=body) as response,
        ):
            return response.status, await response.text()

    status, text = run(ask())
    assert status == 400
    assert says in text
    assert "\n" not in text.rstrip("\n")


@pytest.fixture(scope="module")
def fault_port(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A port for faults, and a function that runs a coroutine while it listens."""
    folder = tmp_path_factory.mktemp("faults")
    (folder / "failing.mod").write_text(PROGRAM)
    made = ready(RunRequest(paths=(str(folder / "failing.mod"),), home=str(folder)))
    with asyncio.Runner() as runner:
        link = DirectLink(lambda told: engine_of(made, EngineSettings(request_s=0.05), told))
        port = runner.run(open_fault_port(link, 0))
        yield port.address, runner.run
        runner.run(port.close())


def test_pages_of_others_and_other_addresses_are_refused(fault_port: tuple[str, Any]) -> None:
    address, run = fault_port

    async def ask() -> list[int]:
        statuses = []
        async with aiohttp.ClientSession() as tester:
            fault = {"kind": "emergency_stop"}
            for path, headers in (("faults", {"Origin": "http://a.b"}), ("rw", {})):
                url = f"{address}/{path}"
                async with tester.post(url, json=fault, headers=headers) as response:
                    statuses.append(response.status)
            async with tester.get(f"{address}/faults") as response:
                statuses.append(response.status)
        return statuses

    assert run(ask()) == [403, 404, 405]
