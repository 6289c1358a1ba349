"""Hostile clients: none comes in, none ends the server, none keeps another one waiting."""

from __future__ import annotations

import asyncio
import os
import ssl
from base64 import b64encode
from pathlib import Path
from time import monotonic

import aiohttp
import pytest
from served_controller import Served, serve
from yarl import URL

from rapidsim.controller.cell import home_folder
from rapidsim.server.http.basic import BasicAuthentication
from rapidsim.server.http.connections import Connections
from rapidsim.server.http.failed_logins import DELAY_S, FREE, FailedLogins
from rapidsim.server.http.open_port import listen
from rapidsim.server.http.rws2 import Rws2Dialect
from rapidsim.server.http.sessions import Sessions
from rapidsim.server.settings import DEFAULT_USERS

PROGRAM = """MODULE Attacked
    PERS num aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa := 0;
    PERS num values{2} := [1,2];
    PROC main()
    ENDPROC
ENDMODULE
"""
PATIENCE_S = 0.5
"""Longest time [s] that a client waits because of another one."""
SEARCH = "rw/rapid/symbols?action=search-symbols"


async def _waited_s(served: Served) -> float:
    """Time [s] until a new client, who logs in, has its answer."""
    client = await served.second_client()
    began_s = monotonic()
    await client.get("rw/panel/opmode")
    waited_s = monotonic() - began_s
    await client.get("logout")
    await client.client.close()
    return waited_s


async def _raw(address: str, sent: bytes) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    host, _, port = address.rpartition("//")[2].rpartition(":")
    reader, writer = await asyncio.open_connection(host, int(port))
    writer.write(sent)
    return reader, writer


async def _status(reader: asyncio.StreamReader) -> int:
    line = await asyncio.wait_for(reader.readline(), 20)
    return int(line.split()[1]) if line else 0


def test_half_requests_keep_nobody_out(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    connections = Connections(most=150, most_of_owner=100, head_s=0.5)

    async def use(served: Served) -> None:
        await served.get("rw/system")
        half = [await _raw(served.base, b"GET /rw HTTP/1.1\r\nHost: 127") for _ in range(300)]
        assert await _waited_s(served) < PATIENCE_S
        assert len(connections) <= 110
        # The session that was there before keeps its connection.
        await served.get("rw/system")
        for _ in range(40):
            await asyncio.sleep(0.05)
            if len(connections) <= 1:
                break
        assert len(connections) <= 1
        for _, writer in half:
            writer.close()

    serve(tmp_path, PROGRAM, use, connections=connections)
    assert not caplog.records


def test_handshakes_without_end_keep_nobody_out(tmp_path: Path) -> None:
    tls_context = pytest.importorskip("rapidsim.server.http.certificate").tls_context
    tls = tls_context(tmp_path / "keys")
    connections = Connections(most=150, most_of_owner=60, head_s=0.5)

    async def use(served: Served) -> None:
        dialect = Rws2Dialect(BasicAuthentication(DEFAULT_USERS))
        listener = await listen(served.face.app(dialect), connections, "127.0.0.1", 0, tls)
        half = [await _raw(listener.address, b"\x16\x03\x01\x02") for _ in range(100)]
        none = [await _raw(listener.address, b"GET / HTTP/1.1\r\n\r\n") for _ in range(5)]
        trust = ssl.create_default_context()
        trust.check_hostname, trust.verify_mode = False, ssl.CERT_NONE
        login = {"Authorization": "Basic " + b64encode(b"Admin:robotics").decode()}
        url = f"{listener.address}/rw/system"
        async with served.client.get(url, headers=login, ssl=trust) as response:
            assert response.status == 200
            assert all("Secure" in one for one in response.headers.getall("Set-Cookie"))
        assert len(connections) <= 70
        for _ in range(40):
            await asyncio.sleep(0.05)
            if len(connections) <= 1:
                break
        assert len(connections) <= 1
        for _, writer in (*half, *none):
            writer.close()
        await listener.close()

    serve(tmp_path, PROGRAM, use, connections=connections)


def test_every_bad_request_is_the_fault_of_its_client(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, capsys: pytest.CaptureFixture[str]
) -> None:
    home = tmp_path / "home"
    home.mkdir()
    os.mkfifo(home / "pipe")
    (home / "link").symlink_to(tmp_path)

    async def use(served: Served) -> None:
        await served.get("rw/system")
        host = served.base.removeprefix("http://").encode()
        cookie = "; ".join(f"{one.key}={one.value}" for one in served.client.cookie_jar).encode()
        head = b"\r\nHost: " + host + b"\r\nConnection: close\r\n"
        known = head + b"Cookie: " + cookie + b"\r\n"
        form = b"Content-Type: application/x-www-form-urlencoded"
        long = b"n" * 300
        search = SEARCH.encode()
        for sent in (
            b"GET /rw HTTP/1.1" + head + b"Authorization: Digest username=\xff\xfe\r\n\r\n",
            b"GET /rw HTTP/1.1" + head + b'Authorization: Digest username="Admin", uri="/rw", '
            b'realm="\xe9", response="\xe9\xff"\r\n\r\n',
            b"GET /rw HTTP/1.1" + head + b"Authorization: Basic \xff\xfe\r\n\r\n",
            b"GET /rw HTTP/1.1" + head + b"Cookie: \xff=;;;=\r\n\r\n",
            b"GET /rw HTTP/1.1\r\nHost: [::\r\n\r\n",
            b"POST /%b HTTP/1.1%b%b; charset=nonsense\r\nContent-Length: 3\r\n\r\na=b"
            % (search, known, form),
            b"POST /%b HTTP/1.1%b%b; charset=utf-8\r\nContent-Length: 3\r\n\r\na=\xff"
            % (search, known, form),
            b"POST /%b HTTP/1.1%b%b\r\nContent-Encoding: gzip\r\nContent-Length: 3\r\n\r\na=b"
            % (search, known, form),
            b"POST /%b HTTP/1.1%b%b\r\nContent-Encoding: deflate\r\nContent-Length: 3\r\n\r\na=b"
            % (search, known, form),
            b"POST /%b HTTP/1.1%b%b\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"
            % (search, known, form),
            b"POST /%b HTTP/1.1%b%b\r\nContent-Length: 2000000\r\n\r\n" % (search, known, form),
            b"PUT /fileservice/$HOME/x HTTP/1.1%bContent-Length: 99999999999\r\n\r\n" % known,
            b"GET /poll/%b HTTP/1.1%b\r\n" % (b"9" * 5000, known),
            b"GET /subscription/\xd9\xa1 HTTP/1.1%b\r\n" % known,
            b"DELETE /subscription/%%C2%%B2 HTTP/1.1%b\r\n" % known,
            b"GET /%b HTTP/1.1%b\r\n" % (b"a" * 20_000, known),
            b"GET /rw/iosystem/signals?start=%b HTTP/1.1%b\r\n" % (b"1" * 400, known),
            b"BREW / HTTP/1.1%b\r\n" % known,
            b"GET http://[::1:80/rw HTTP/1.1%b\r\n" % known,
            b"\x16\x03\x01\x00\r\n\r\n",
            *(
                b"%b /fileservice/$HOME/%b HTTP/1.1%bContent-Length: 0\r\n\r\n"
                % (verb, name, known)
                for name in (long, b"pipe", b"pipe/x", b"link", b"link/x", b"%00", b"%ff" * 200)
                for verb in (b"GET", b"DELETE")
            ),
            b"PUT /fileservice/$HOME/%b HTTP/1.1%bContent-Length: 1\r\n\r\nx" % (long, known),
            b"PUT /fileservice/$HOME/pipe HTTP/1.1%bContent-Length: 1\r\n\r\nx" % known,
        ):
            reader, writer = await _raw(served.base, sent)
            assert 400 <= await _status(reader) < 500, sent[:200]
            writer.close()
        for pattern in ("a{99999999999}", "(" * 1000, "(a", "\\", "[", "(?P<a>", "*"):
            status, _ = await served.post(SEARCH, regexp=pattern)
            assert status == 400, pattern
        for action in ("create", "copy", "rename"):
            for name in ("n" * 300, "../x", "a/b", "\0", ""):
                url = f"{served.base}/fileservice/$HOME/pipe"
                data = {"fs-action": action, "fs-newname": name}
                async with served.client.post(url, data=data) as done:
                    assert 400 <= done.status < 500, (action, name)

    serve(tmp_path, PROGRAM, use)
    assert not caplog.records
    assert "defect" not in capsys.readouterr().out
    assert sorted(one.name for one in home.iterdir()) == ["link", "pipe"]


def test_work_for_one_client_does_not_hold_others_up(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        waited_s = []
        for pattern in ("(a|a)*!", "(a*)*(a*)*b", "(.*.*.*.*){60}z", "((a?){30}){8}b"):
            attack = asyncio.gather(*(served.post(SEARCH, regexp=pattern) for _ in range(3)))
            waited_s.append(await _waited_s(served))
            await attack
        form = {"resources": "1", **{f"{n}": "/rw/panel/opmode" for n in range(5000)}}
        async with served.client.post(f"{served.base}/subscription", data=form) as done:
            assert done.status == 400
        waited_s.append(await _waited_s(served))
        assert max(waited_s) < PATIENCE_S

    serve(tmp_path, PROGRAM, use)


def test_what_a_session_has_is_no_other_sessions(tmp_path: Path) -> None:
    listed = {"resources": "1", "1": "/rw/panel/opmode", "1-p": "1"}

    async def use(served: Served) -> None:
        other = await served.second_client()
        assert await served.post("rw/dipc?action=dipc-create", dipc_queue_name="mine") == (201, 0)
        assert await other.post("rw/dipc/mine?action=dipc-send", dipc_data="num;5") == (204, 0)
        assert await other.status("rw/dipc/mine?action=dipc-read") == (404, -1073414146)
        assert await other.status("rw/dipc/mine") == (404, -1073414146)
        async with served.client.post(f"{served.base}/subscription", data=listed) as done:
            link = done.headers["Location"]
        async with other.client.delete(f"{other.base}/subscription/1") as response:
            assert response.status == 404
        assert (await other.status("poll/1"))[0] == 404
        queue = {"resources": "1", "1": "/rw/dipc/mine", "1-p": "1"}
        async with other.client.post(f"{other.base}/subscription", data=queue) as response:
            assert response.status == 404
        protocols = ("robapi2_subscription",)
        socket = await served.client.ws_connect(link, protocols=protocols)
        assert "pnl-opmode-ev" in await socket.receive_str(timeout=20)
        # Its one websocket has it alone.
        with pytest.raises(aiohttp.WSServerHandshakeError):
            await served.client.ws_connect(link, protocols=protocols)
        # The limits of one are not those of another.
        for number in range(49):
            await served.post("rw/dipc?action=dipc-create", dipc_queue_name=f"q{number}")
        assert (await served.post("rw/dipc?action=dipc-create", dipc_queue_name="more"))[0] == 400
        assert await other.post("rw/dipc?action=dipc-create", dipc_queue_name="more") == (201, 0)
        (message,) = await served.get("rw/dipc/mine?action=dipc-read")
        assert message["dipc-data"] == "num;5"
        await other.get("logout")
        await other.client.close()

    serve(tmp_path, PROGRAM, use)


def test_clients_write_into_the_disk_of_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(home_folder, "DISK_BYTES", 1000)
    monkeypatch.setattr(home_folder, "DISK_FILES", 4)

    async def use(served: Served) -> None:
        async def put(name: str, count: int) -> int:
            target = URL(f"{served.base}/fileservice/$HOME/{name}", encoded=True)
            async with served.client.put(target, data=b"x" * count) as response:
                return response.status

        assert await put("a", 600) == 201
        assert await put("b", 600) == 400
        # A file that is replaced takes no more room, nor does one that is gone.
        for _ in range(3):
            assert await put("a", 900) == 200
        url = f"{served.base}/fileservice/$HOME/a"
        copied = {"fs-action": "copy", "fs-newname": "c"}
        async with served.client.post(url, data=copied) as response:
            assert response.status == 400
        async with served.client.delete(url) as response:
            assert response.status == 204
        assert await put("b", 600) == 201
        assert [await put(f"n{number}", 1) for number in range(4)] == [201, 201, 201, 400]

    serve(tmp_path, PROGRAM, use)


def test_who_has_sent_wrong_passwords_waits(tmp_path: Path) -> None:
    now_s = [0.0]
    failed = FailedLogins(lambda: now_s[0])
    for _ in range(FREE):
        assert failed.delay_s("a") == 0.0
        failed.add("a")
    assert (failed.delay_s("a"), failed.delay_s("b")) == (DELAY_S, 0.0)
    now_s[0] = 61.0
    assert failed.delay_s("a") == 0.0

    async def use(served: Served) -> None:
        await served.get("rw/system")
        headers = {"Authorization": "Digest username=Admin"}
        began_s = monotonic()
        async with aiohttp.ClientSession(headers=headers) as other:
            for _ in range(FREE + 1):
                async with other.get(f"{served.base}/rw/system") as response:
                    assert response.status == 401
        assert monotonic() - began_s > 0.9 * DELAY_S
        # Who is in does not wait for those who guess.
        began_s = monotonic()
        await served.get("rw/system")
        assert monotonic() - began_s < DELAY_S

    serve(tmp_path, PROGRAM, use)


def test_cookies_of_a_scheme_are_none_of_the_other() -> None:
    sessions = Sessions(2, 300.0, list[int]().append)
    plain = sessions.begin("a", "http")
    assert plain
    assert sessions.find(plain.cookies, "https") is None
    assert sessions.find(plain.cookies, "http") is plain
