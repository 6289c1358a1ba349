"""Robot Web Services 2.0: the same resources, other addresses, headers, masterships and sockets."""

import asyncio
import re
from base64 import b64encode
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from served_controller import Served, serve

HAL = {"Accept": "application/hal+json;v=2.0"}
FORM = {"Content-Type": "application/x-www-form-urlencoded;v=2.0"}
PROGRAM = """MODULE Counting
    PERS num rounds := 0;
    PROC main()
        rounds := rounds + 1;
        PulseDO \\PLength:=0.1, doPulse;
        WaitTime 1;
    ENDPROC
ENDMODULE
"""
ROUNDS = "rw/rapid/symbol/RAPID/T_ROB1/Counting/rounds"


def _who(password: str) -> dict[str, str]:
    return {"Authorization": "Basic " + b64encode(f"Admin:{password}".encode()).decode()}


class Client:
    """A client of RobotWare 7."""

    def __init__(self, served: Served, session: aiohttp.ClientSession) -> None:
        self.base, self.session = served.second, session

    async def get(self, path: str, **headers: str) -> tuple[int, Any]:
        async with self.session.get(f"{self.base}/{path}", headers={**HAL, **headers}) as found:
            return found.status, await found.json(content_type=None)

    async def post(self, path: str, **form: str) -> int:
        fields = {key.replace("_", "-"): value for key, value in form.items()}
        data = aiohttp.FormData(fields)() if fields else b""
        url = f"{self.base}/{path}"
        async with self.session.post(url, data=data, headers=FORM) as done:
            await done.read()
            return done.status

    async def state(self, path: str) -> dict[str, Any]:
        status, body = await self.get(path)
        assert (status, body["status"]) == (200, {"code": 294912})
        first: dict[str, Any] = body["state"][0]
        return first

    async def resources(self, path: str) -> list[dict[str, Any]]:
        status, body = await self.get(path)
        assert status == 200
        found: list[dict[str, Any]] = body["_embedded"]["resources"]
        return found


def serve_second(folder: Path, use: Callable[[Client, Served], Awaitable[None]]) -> None:
    async def used(served: Served) -> None:
        jar = aiohttp.CookieJar(unsafe=True)
        async with aiohttp.ClientSession(headers=_who("robotics"), cookie_jar=jar) as session:
            await use(Client(served, session), served)

    serve(folder, PROGRAM, used)


def test_a_program_is_started_and_its_data_are_set_with_mastership(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        del served
        assert (await client.state("rw/panel/ctrl-state"))["ctrlstate"] == "motoron"
        assert await client.post("rw/rapid/execution/resetpp") == 403
        assert await client.post(f"{ROUNDS}/data?initval=true", value="5") == 403
        for _ in range(2):
            assert await client.post("rw/mastership/request") == 204
        assert await client.post("rw/rapid/execution/resetpp") == 204
        assert await client.post(f"{ROUNDS}/data?initval=true", value="5") == 204
        assert (
            await client.post("rw/panel/speedratio?action=setspeedratio", speed_ratio="50") == 204
        )
        assert await client.post("rw/mastership/edit/release") == 204
        held = [await client.state(f"rw/mastership/{one}") for one in ("edit", "motion")]
        assert [one["mastership"] for one in held] == ["nomaster", "remote"]
        assert [one["mastershipheldbyme"] for one in held] == ["FALSE", "TRUE"]
        start = "rw/rapid/execution/start?mastership=implicit"
        assert await client.post(start, execmode="continue", cycle="once") == 204
        assert (await client.state("rw/rapid/execution"))["ctrlexecstate"] == "running"
        assert (await client.state(f"{ROUNDS}/data"))["value"] == "6"
        (listed,) = await client.resources(f"{ROUNDS}/properties")
        assert listed["dattyp"] == "num"
        assert await client.post("rw/rapid/execution/stop", stopmode="stop") == 204
        signal = "rw/iosystem/signals/doPulse"
        assert await client.post(f"{signal}/set-value", lvalue="1") == 204
        assert (await client.state(signal))["lvalue"] == "1"
        module = "rw/rapid/tasks/T_ROB1/modules/counting"
        assert (await client.state(module))["modname"] == "Counting"
        assert "PulseDO" in (await client.state(f"{module}/text"))["module-text"]

    serve_second(tmp_path, use)


def test_headers_name_the_version(tmp_path: Path) -> None:
    cases: tuple[tuple[str, dict[str, str], int], ...] = (
        ("GET", {"Accept": "application/json"}, 406),
        ("GET", {"Accept": "application/hal+json"}, 406),
        ("GET", {"Accept": "text/html, application/xhtml+xml; v=2.0"}, 200),
        ("GET", {"Accept": "*/*"}, 200),
        ("POST", {"Content-Type": "application/x-www-form-urlencoded"}, 415),
        ("POST", {"Content-Type": "application/x-www-form-urlencoded; v=2.0"}, 400),
        ("DELETE", {}, 400),
    )

    async def use(client: Client, served: Served) -> None:
        del served
        url = f"{client.base}/rw/rapid/execution"
        for method, headers, status in cases:
            body = None if method == "DELETE" else b""
            async with client.session.request(method, url, headers=headers, data=body) as found:
                assert found.status == status, headers
                if status == 200:
                    assert found.headers["Content-Type"] == "application/xhtml+xml;v=2.0"

    serve_second(tmp_path, use)


def test_the_event_log_begins_with_the_oldest_entry_and_has_pages(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        for number in range(60):
            await served.fail(kind="elog", code=38103, title=f"entry {number}")
        total = int((await client.resources("rw/elog"))[0]["numevts"])
        status, body = await client.get("rw/elog/0?lang=en")
        assert len(body["_embedded"]["resources"]) == 50
        following = "0?order=fifo&amp;lang=en&amp;start=2&amp;limit=50"
        assert body["_links"]["next"]["href"] == following
        rest = await client.resources("rw/elog/0?order=fifo&lang=en&start=2&limit=50")
        assert (len(rest), rest[-1]["title"]) == (total - 50, "entry 59")
        (last,) = await client.resources(f"rw/elog/0?lang=en&limit=1&start={total}")
        assert last == rest[-1]
        status, body = await client.get("rw/elog/0?limit=50&start=9")
        assert (status, body["status"]["code"]) == (400, -1073445883)
        number = last["_title"].rpartition("/")[2]
        (entry,) = (await client.get(f"rw/elog/seqnum/{number}"))[1]["state"]
        assert (entry["_type"], entry["title"]) == ("elog-message", "entry 59")
        # Only the version 2.1 of the event log has the newest entry first.
        later = {"Accept": "application/hal+json;v=2.1"}
        newest = "rw/elog/0?order=lifo&limit=2"
        assert (await client.get(newest))[0] == 400
        status, body = await client.get(newest, **later)
        assert [one["title"] for one in body["_embedded"]["resources"]] == ["entry 59", "entry 58"]
        url = f"{client.base}/rw/system"
        async with client.session.get(url, headers=later) as found:
            assert found.status == 406

    serve_second(tmp_path, use)


def test_refusals_have_the_form_of_the_generation(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        del served
        status, body = await client.get("rw/iosystem/signals/none")
        assert (status, body["status"]["code"]) == (404, -1073445866)
        for path, expected in (
            ("rw/rapid/tasks/T_ROB1/modules/none", (400, -1073442813)),
            ("rw/rapid/symbol/RAPID/T_ROB1/none/data", (404, -1073442816)),
            ("fileservice/NONE/none.txt", (400, -1073438716)),
            ("uas/ldap/enabled", (403, -1073445867)),
        ):
            status, body = await client.get(path)
            assert (status, body["status"]["code"]) == expected
        async with client.session.get(f"{client.base}/fileservice/HOME/none.txt") as found:
            assert (found.status, found.content_type) == (404, "text/html")
            body = await found.json(content_type=None)
            assert body["status"]["code"] == -1073438713
        page = {"Accept": "application/xhtml+xml;v=2.0"}
        url = f"{client.base}/rw/rapid/tasks/T_ROB1/modules/none"
        async with client.session.get(url, headers=page) as found:
            text = await found.text()
            assert "<head><base href=" in text
            assert '<div class="status"><span class="code">-1073442813</span>' in text
        # A wrong password is no session.
        async with (
            aiohttp.ClientSession(headers=_who("guess")) as other,
            other.get(f"{client.base}/rw/system", headers=HAL) as refused,
        ):
            assert refused.status == 401
            assert refused.headers["WWW-Authenticate"].startswith("Basic ")
            assert "Set-Cookie" not in refused.headers

    serve_second(tmp_path, use)


def test_who_is_not_master_does_not_start(tmp_path: Path) -> None:
    # In RobotWare 6 a start takes no mastership; in 7 nobody starts beside who has it.
    start = "rw/rapid/execution/start"

    async def use(client: Client, served: Served) -> None:
        assert await served.post("rw/mastership/rapid?action=request") == (204, 0)
        assert await client.post(start, cycle="once") == 403
        assert await served.post("rw/mastership/rapid?action=release") == (204, 0)
        assert await client.post("rw/mastership/edit/request") == 204
        assert await client.post(start, cycle="once") == 204

    serve_second(tmp_path, use)


def test_masterships_count_across_generations(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        assert await client.post("rw/mastership/edit/request") == 204
        data = "rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set"
        assert await served.post(data, value="1") == (403, -1073445862)

    serve_second(tmp_path, use)


def test_what_changes_is_told_and_a_client_that_speaks_is_cut_off(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        del served
        listed = ("/rw/panel/ctrl-state", f"/{ROUNDS}/data;value")
        form = {"resources": ["1", "2"], "1": listed[0], "1-p": "1", "2": listed[1], "2-p": "1"}
        data = "&".join(
            f"{key}={one}"
            for key, value in form.items()
            for one in ([value] if isinstance(value, str) else value)
        )
        url = f"{client.base}/subscription"
        async with client.session.post(url, data=data, headers=FORM) as done:
            assert done.status == 201
            link = done.headers["Location"]
            assert f'href="{link}"' in await done.text()
        assert link.startswith("wss://")
        plain = link.replace("wss:", "ws:")
        with pytest.raises(aiohttp.WSServerHandshakeError) as wrong:
            await client.session.ws_connect(plain, protocols=("robapi2_subscription",))
        assert wrong.value.status == 400
        socket = await client.session.ws_connect(plain, protocols=("rws_subscription",))
        heard = [await socket.receive_str(timeout=20) for _ in range(2)]
        found = [re.search(r'<li class="([^"]+)"', text) for text in heard]
        assert sorted(one[1] for one in found if one) == ["pnl-ctrlstate-ev", "rap-value-ev"]
        assert f'href="{listed[1]}"' in "".join(heard)
        await socket.send_str("hello")
        await asyncio.wait_for(socket.receive(), 20)
        assert socket.close_code == 1008

    serve_second(tmp_path, use)


def test_signals_come_in_pages(tmp_path: Path) -> None:
    async def use(client: Client, served: Served) -> None:
        del served
        _, body = await client.get("rw/iosystem/signals?limit=1")
        assert "next" not in body["_links"]
        assert [one["name"] for one in body["_embedded"]["resources"]] == ["doPulse"]

    serve_second(tmp_path, use)


def test_the_key_is_made_once_and_for_its_owner(tmp_path: Path) -> None:
    tls_context = pytest.importorskip("rapidsim.server.http.certificate").tls_context
    folder = tmp_path / "keys"
    tls_context(folder)
    (made,) = folder.iterdir()
    first = made.read_bytes()
    assert made.stat().st_mode & 0o077 == 0
    tls_context(folder)
    assert made.read_bytes() == first
