"""Who comes in, and what nobody may do."""

import asyncio
import tempfile
from collections.abc import AsyncIterator
from pathlib import Path

import aiohttp
import pytest
from served_controller import Served, serve
from yarl import URL

from rapidsim.server.http.guard import Guard, is_loopback
from rapidsim.server.http.sessions import Sessions

IDLE = "MODULE Idle\nPROC main()\nENDPROC\nENDMODULE\n"


def test_nobody_comes_in_without_a_password_or_with_a_wrong_one(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async with aiohttp.ClientSession() as nobody:
            async with nobody.get(f"{served.base}/rw/system") as response:
                assert response.status == 401
                assert "Set-Cookie" not in response.headers
                challenge = response.headers["WWW-Authenticate"]
                assert challenge.startswith('Digest realm="validusers@robapi.abb"')
            wrong = aiohttp.DigestAuthMiddleware("Default User", "wrong")
            async with nobody.get(f"{served.base}/rw/system", middlewares=(wrong,)) as response:
                assert response.status == 401

    serve(tmp_path, IDLE, use)


def test_either_cookie_stands_for_a_session(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        await served.get("rw/system")
        cookies = {one.key: one.value for one in served.client.cookie_jar}
        assert set(cookies) == {"ABBCX", "-http-session-"}
        for name, value in cookies.items():
            headers = {"Cookie": f"{name}={value}"}
            async with (
                aiohttp.ClientSession(headers=headers) as other,
                other.get(f"{served.base}/rw/system") as response,
            ):
                assert response.status == 200

    serve(tmp_path, IDLE, use)


def test_there_are_only_so_many_sessions(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        others = []
        for _ in range(2):
            others.append(await served.second_client())
            await others[-1].get("rw/system")
        late = await served.second_client()
        async with late.client.get(f"{late.base}/rw/system") as response:
            assert response.status == 503
        await others[0].get("logout")
        await late.get("rw/system")
        for one in (*others, late):
            await one.client.close()

    serve(tmp_path, IDLE, use, most_sessions=2)


def test_clients_with_a_session_are_listed_with_their_rights(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async def titles(query: str = "") -> list[str]:
            return [one["_title"] for one in await served.get(f"users{query}")]

        assert await titles() == ["Default User"]
        async with (
            aiohttp.ClientSession(
                middlewares=(aiohttp.DigestAuthMiddleware("Default User", "robotics"),),
                cookie_jar=aiohttp.CookieJar(unsafe=True),
            ) as other,
            other.post(f"{served.base}/users", data={"username": "ada"}) as response,
        ):
            assert response.status == 201
            assert (await titles(), await titles("?user-type=self")) == (
                ["Default User", "ada"],
                ["Default User"],
            )
            (poll,) = await served.get("users/rmmp/poll")
            assert poll["status"] == "NO SUCH REQUEST"
            async with other.post(f"{served.base}/users/rmmp", data={"privilege": "modify"}):
                (state,) = await served.get("users/rmmp")
            assert (state["_type"], state["alias"]) == ("user-rmmp", "ada")
            assert (state["privilege"], state["rmmpheldbyme"]) == ("modify", "false")
            async with other.get(f"{served.base}/logout"):
                assert await titles() == ["Default User"]
        (state,) = await served.get("users/rmmp")
        assert state["privilege"] == "none"
        assert await served.post("users/rmmp", privilege="modify") == (202, 0)
        ((state,), (poll,)) = [await served.get(f"users/rmmp{one}") for one in ("", "/poll")]
        assert (state["privilege"], state["rmmpheldbyme"]) == ("modify", "true")
        assert poll["status"] == "GRANTED"
        assert await served.post("users/rmmp?action=cancel") == (204, 0)

    serve(tmp_path, IDLE, use)


def test_nothing_is_kept_of_clients_that_have_gone(tmp_path: Path) -> None:
    # With a subscription each, which one lets go, one forgets and one loses.
    listed = {"resources": "1", "1": "/rw/rapid/execution;ctrlexecstate", "1-p": "1"}

    async def use(served: Served) -> None:
        face, engine = served.face, served.engine
        for number in range(30):
            one = await served.second_client()
            await one.post("rw/mastership/rapid?action=request")
            async with one.client.post(f"{one.base}/subscription", data=listed) as done:
                link = done.headers["Location"]
            if number % 3:
                socket = await one.client.ws_connect(link, protocols=("robapi2_subscription",))
                await socket.receive()
                if number % 3 == 2:
                    await socket.close()
            await one.get("logout")
            await one.client.close()
        for _ in range(20):
            await served.get("rw/system")
        assert face.counts == (1, 0)
        assert engine.subscriptions.groups == 0
        assert engine.context.masters == {}

    serve(tmp_path, IDLE, use, most_sessions=3)


def test_an_idle_session_ends() -> None:
    now, ended = [0.0], list[int]()
    sessions = Sessions(2, 300.0, ended.append, lambda: now[0])
    first, second = sessions.begin("a", "http"), sessions.begin("b", "http")
    assert first
    assert second
    assert sessions.begin("c", "http") is None
    now[0] = 200.0
    assert sessions.find(first.cookies, "http") is first
    now[0] = 400.0
    assert sessions.find(second.cookies, "http") is None
    assert ended == [second.number]
    assert sessions.find(first.cookies, "http") is first
    with sessions.listening(first):
        now[0] = 800.0
        assert sessions.begin("d", "http") is not None
    now[0] = 1100.0
    assert sessions.find(first.cookies, "http") is first
    now[0] = 1401.0
    assert sessions.find(first.cookies, "http") is None


@pytest.mark.parametrize(
    ("headers", "lets_in"),
    [
        ({"Host": "127.0.0.1:8080"}, True),
        ({"Host": "localhost:8080"}, True),
        ({"Host": "[::1]:8080"}, True),
        ({"Host": "robot.evil.example:8080"}, False),
        ({"Host": "127.0.0.1.evil.example"}, False),
        ({}, False),
        ({"Host": "127.0.0.1:8080", "Origin": "http://127.0.0.1:8080"}, True),
        ({"Host": "127.0.0.1:8080", "Origin": "http://evil.example"}, False),
        ({"Host": "127.0.0.1:8080", "Origin": "ws://127.0.0.1:8080"}, True),
        ({"Host": "127.0.0.1:8080", "Origin": "http://127.0.0.1:3000"}, False),
        ({"Host": "127.0.0.1:8080", "Origin": "null"}, False),
    ],
)
def test_pages_from_elsewhere_do_not_come_in(headers: dict[str, str], lets_in: bool) -> None:
    refused = Guard("127.0.0.1").objection("GET", "/rw", headers)
    assert (refused is None) is lets_in
    assert lets_in or "--allow-" in str(refused)


def test_names_and_pages_come_in_that_are_allowed(tmp_path: Path) -> None:
    page = "http://localhost:3000"
    guard = Guard("127.0.0.1", frozenset({"robot"}), frozenset({page}))

    async def use(served: Served) -> None:
        url, host = f"{served.base}/rw/system", {"Host": "robot:8080"}
        asked = {**host, "Origin": page, "Access-Control-Request-Method": "POST"}
        async with aiohttp.ClientSession() as nobody:
            async with nobody.options(url, headers=asked) as response:
                assert response.status == 204
                assert "POST" in response.headers["Access-Control-Allow-Methods"]
            async with nobody.options(url, headers={**host, "Origin": "http://evil"}) as response:
                assert response.status == 403
            async with nobody.get(url, headers={**host, "Origin": page}) as response:
                assert response.status == 401
        async with served.client.get(url, headers={**host, "Origin": page}) as response:
            assert response.status == 200
            assert response.headers["Access-Control-Allow-Origin"] == page
        async with served.client.get(url, headers=host) as response:
            assert response.status == 200
            assert "Access-Control-Allow-Origin" not in response.headers

    serve(tmp_path, IDLE, use, guard=guard)


def test_a_link_elsewhere_leads_to_the_operator_page_only() -> None:
    headers = {"Host": "127.0.0.1:8080", "Sec-Fetch-Site": "cross-site"}
    guard = Guard("127.0.0.1")
    assert guard.objection("GET", "/ui", headers) is None
    for method, path in (("POST", "/ui"), ("GET", "/ui/state"), ("GET", "/logout")):
        assert guard.objection(method, path, headers)


def test_loopback_addresses_are_known() -> None:
    assert all(map(is_loopback, ("127.0.0.1", "localhost", "::1", "127.9.9.9")))
    assert not any(map(is_loopback, ("0.0.0.0", "192.168.1.5", "robot", "::")))


def test_files_come_and_go_and_nobody_leaves_the_home_folder(tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret")

    async def use(served: Served) -> None:
        url = f"{served.base}/fileservice"

        async def ask(method: str, path: str, **more: object) -> tuple[int, bytes]:
            target = URL(f"{url}/{path}", encoded=True)
            async with served.client.request(method, target, **more) as response:  # type: ignore[arg-type]
                return response.status, await response.read()

        assert await ask("PUT", "$HOME/logs/a.txt", data=b"one") == (201, b"")
        assert await ask("PUT", "$HOME/logs/A.TXT", data=b"two") == (200, b"")
        assert await ask("GET", "$HOME/Logs/a.txt") == (200, b"two")
        assert [one["_title"] for one in await served.get("fileservice/$HOME/logs")] == ["a.txt"]
        assert (await ask("PUT", "$RAMDISK/r.txt", data=b"r"))[0] == 201
        assert (tmp_path / "home" / "RAMDISK" / "r.txt").read_bytes() == b"r"
        (tmp_path / "home" / "out").symlink_to(tmp_path)
        for path in (
            "$HOME/../secret.txt",
            "$HOME/%2e%2e/secret.txt",
            "$HOME/..%2fsecret.txt",
            "$HOME/..%5csecret.txt",
            "$HOME/out/secret.txt",
            "$NOWHERE/a.txt",
            "etc/passwd",
        ):
            status, body = await ask("GET", path)
            assert status == 404, path
            assert b"secret" not in body.replace(b"secret.txt", b"")
            assert (await ask("PUT", path, data=b"x"))[0] in (400, 404), path
            assert (await ask("DELETE", path))[0] in (400, 404), path
        assert (await ask("DELETE", "$HOME"))[0] == 400
        assert [(await ask(method, ""))[0] for method in ("GET", "PUT", "DELETE")] == [
            200,
            400,
            400,
        ]
        assert (await ask("DELETE", "$HOME/logs/a.txt"))[0] == 204
        assert (await ask("DELETE", "$HOME/logs/a.txt"))[0] == 404
        assert (tmp_path / "secret.txt").read_text() == "secret"

    serve(tmp_path, IDLE, use)


def test_files_and_folders_are_copied_and_renamed(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async def change(address: str, action: str, name: str) -> int:
            url = f"{served.base}/fileservice/{address}"
            form = {"fs-action": action, "fs-newname": name}
            async with served.client.post(url, data=form) as response:
                return response.status

        # Statuses are those of ABB's reference.
        assert await change("$HOME", "create", "one/two") == 201
        home = tmp_path / "home"
        (home / "one" / "two" / "a.txt").write_text("a")
        assert await change("$HOME/one", "copy", "three") == 204
        assert await change("$HOME/one", "copy", "/fileservice/$TEMP/four") == 204
        assert await change("$HOME/three", "rename", "five") == 200
        assert await change("$HOME/five/two/a.txt", "copy", "b.txt") == 204
        assert await change("$HOME/five/two/a.txt", "rename", "c.txt") == 204
        found = {one.name for one in (home / "five" / "two").iterdir()}
        assert (found, (home / "TEMP" / "four" / "two" / "a.txt").read_text()) == (
            {"b.txt", "c.txt"},
            "a",
        )
        for action, name in (
            *(("copy", one) for one in ("five", "", "a/b", "/fileservice/$HOME/../x")),
            *(("rename", one) for one in ("five", "/fileservice/$HOME/six", "..")),
            *(("create", one) for one in ("two", "/", "../x", "/six")),
        ):
            assert await change("$HOME/one", action, name) in (400, 404), (action, name)
        assert await change("$HOME/one", "copy", "/fileservice/$HOME/one/inside") == 204
        assert (home / "one" / "inside" / "two" / "a.txt").is_file()
        assert not (home / "one" / "inside" / "inside").exists()

    serve(tmp_path, IDLE, use)


def test_a_file_is_on_the_disk_while_it_arrives(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    arriving = tmp_path / "arriving"
    arriving.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(arriving))

    async def use(served: Served) -> None:
        address, whole = f"{served.base}/fileservice/$HOME/a.bin", b"x" * 1_000_000

        async def parts() -> AsyncIterator[bytes]:
            yield whole
            while not any(one.stat().st_size for one in arriving.iterdir()):
                await asyncio.sleep(0.01)
            assert not (tmp_path / "home" / "a.bin").exists()
            yield b"end"

        await served.get("rw/system")
        async with served.client.put(address, data=parts()) as response:
            assert response.status == 201
        assert (tmp_path / "home" / "a.bin").read_bytes() == whole + b"end"
        async with served.client.put(address, data=b"") as response:
            assert response.status == 200
        assert (tmp_path / "home" / "a.bin").read_bytes() == b""
        assert list(arriving.iterdir()) == []

    serve(tmp_path, IDLE, use)


def test_half_a_request_and_none_are_no_faults_of_the_server(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    async def use(served: Served) -> None:
        await served.get("rw/system")
        cookie = "; ".join(f"{one.key}={one.value}" for one in served.client.cookie_jar)
        host = served.base.removeprefix("http://")
        head = f"PUT /fileservice/$HOME/x HTTP/1.1\r\nHost: {host}\r\nCookie: {cookie}\r\n"
        for sent in (
            f"{head}Content-Length: 100\r\n\r\nabc",
            f"{head}Transfer-Encoding: chunked\r\n\r\n10\r\nabc",
            f"GET /{'a' * 20_000} HTTP/1.1\r\n\r\n",
            "\x16\x03\x01\0\0",
        ):
            _, writer = await asyncio.open_connection(*host.split(":"))
            writer.write(sent.encode())
            await writer.drain()
            await asyncio.sleep(0.05)
            writer.close()
            await asyncio.sleep(0.05)
        await served.get("rw/system")

    serve(tmp_path, IDLE, use)
    assert not caplog.records
    assert not (tmp_path / "home" / "x").exists()


def test_an_answer_may_come_as_late_as_that_of_a_controller(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        loop = asyncio.get_running_loop()
        for action, wait_s in (("resetpp", 0.0), ("start", 0.3)):
            began_s = loop.time()
            assert await served.post(f"rw/rapid/execution?action={action}") == (204, 0)
            assert loop.time() - began_s >= wait_s

    serve(tmp_path, IDLE, use, latencies_s={"start": 0.3})


def test_nothing_that_a_client_sends_ends_the_server(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        for path in (
            "%00",
            "rw/%ff%fe",
            "rw/elog/99",
            "rw/elog/x",
            "poll/x",
            "poll/-1",
            "subscription/1",
        ):
            target = URL(f"{served.base}/{path}", encoded=True)
            for method in ("GET", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"):
                async with served.client.request(method, target, data=b"\xff=\x00&%zz") as response:
                    assert 200 <= response.status < 500, (method, path)
        for query in ("start=x", "limit=-1", "start=-5&limit=1e9"):
            async with served.client.get(f"{served.base}/rw/iosystem/signals?{query}") as response:
                assert response.status in (200, 400)
        huge = "[" * 100_000
        assert (await served.post("rw/rapid/symbol/data/RAPID/T_ROB1/n?action=set", value=huge))[
            0
        ] == 400
        await served.get("rw/system")

    data = "PERS num n := 0;\nPERS pos p := [0,0,0];\n"
    serve(tmp_path, IDLE.replace("PROC", f"{data}PROC", 1), use)
