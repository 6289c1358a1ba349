"""A served controller for an hour among clients that do everything wrong.

    python benchmarks/soak.py --minutes 60

Random clients of both generations on this computer send garbage, half requests and uploads that
break off, open more sessions than there are, subscribe and vanish, start and stop programs. One of
them lets the controller and its connections fail at random, and ends that again.
Meanwhile this script looks at the memory of the controller's processes, at what it says on standard
error, and at whether each file that was uploaded is one of those that somebody sent whole. At the
end it is killed in the midst of uploads, and the files must still be whole. It ends with 1 where
anything was not so.

Memory is judged by thirds of the time. In the first one caches fill; the mean of a process in the
last one must not be more than 3 MB above that in the second, which allows 12 MB in an hour.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import hashlib
import json
import os
import random
import re
import signal
import sys
import tempfile
import time
from base64 import b64encode
from collections.abc import Awaitable, Callable
from pathlib import Path
from statistics import fmean

import aiohttp

PROGRAM = r"""MODULE soaked
  PERS num rounds := 0;
  VAR num total := 0;
  PROC main()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, z10, tool0;
    MoveAbsJ [[0,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
    rounds := rounds + 1;
    total := total + 1;
    WaitDI diGo, 1 \MaxTime:=0.5;
    IF total MOD 50 = 0 ErrWrite \W, "Fifty", "rounds";
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
STATION = '[signals]\ndiGo = { type = "di" }\ndoOut = { type = "do" }\n'
USER = ("Default User", "robotics")
PAGE_BYTES = 4096
ROLES = ("engine", "guide")
"""Processes of a controller beside its frontend, in the order in which they begin."""


def text_of(number: int) -> bytes:
    """A file that says itself whether it is whole."""
    body = random.Random(number).randbytes(20_000 + number % 7 * 30_000)
    return hashlib.sha256(body).hexdigest().encode() + body


def is_whole(data: bytes) -> bool:
    """Whether that is such a file."""
    return hashlib.sha256(data[64:]).hexdigest().encode() == data[:64]


class Soak:
    """What the clients share."""

    def __init__(self, port: int, second: str, faulty: str, home: Path, until: float) -> None:
        """Begin; `second` is the address of Robot Web Services 2.0, `faulty` that of faults."""
        self.faulty = faulty
        self.port, self.second, self.home, self.until = port, second, home, until
        self.base = f"http://127.0.0.1:{port}"
        self.counts: dict[str, int] = {}
        self.faults: list[str] = []
        self.memory: list[dict[str, float]] = []

    def note(self, what: str) -> None:
        """Count something."""
        self.counts[what] = self.counts.get(what, 0) + 1

    def goes_on(self) -> bool:
        """Whether there is time left."""
        return time.monotonic() < self.until and len(self.faults) < 20

    def client(self) -> aiohttp.ClientSession:
        """Somebody who may come in."""
        digest = aiohttp.DigestAuthMiddleware(*USER)
        jar = aiohttp.CookieJar(unsafe=True)
        patience = aiohttp.ClientTimeout(total=60)
        return aiohttp.ClientSession(middlewares=(digest,), cookie_jar=jar, timeout=patience)

    async def endured(
        self, work: Callable[[Soak, random.Random], Awaitable[None]], seed: int
    ) -> None:
        """Let a client work, and begin again whenever a fault has cut it off."""
        dice = random.Random(seed)
        while self.goes_on():
            try:
                await work(self, dice)
            except (aiohttp.ClientError, OSError, TimeoutError):
                self.note("cut off")
                await asyncio.sleep(0.2)

    async def asked(
        self, client: aiohttp.ClientSession, method: str, path: str, **form: str
    ) -> int:
        """The status of a request; 500 is a fault."""
        async with client.request(method, f"{self.base}/{path}", data=form or None) as response:
            body = await response.read()
            self.note(str(response.status))
            if response.status == 500:
                self.faults.append(f"{method} {path}: {body[:200]!r}")
            return response.status


async def worker(soak: Soak, dice: random.Random) -> None:
    """Uses the controller as one should, in a random order."""
    async with soak.client() as client:
        while soak.goes_on():
            what = dice.choice(
                [
                    ("POST", "rw/rapid/execution?action=start", {"cycle": "forever"}),
                    ("POST", "rw/rapid/execution?action=stop", {"stopmode": "stop"}),
                    ("POST", "rw/rapid/execution?action=resetpp", {}),
                    ("POST", "rw/iosystem/signals/diGo?action=set", {"lvalue": dice.choice("01")}),
                    ("POST", "rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set", {"value": "1"}),
                    ("POST", "rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"}),
                    ("POST", "rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"}),
                    ("GET", "rw/motionsystem/mechunits/ROB_1/jointtarget?json=1", {}),
                    ("GET", "rw/elog/0?lang=en&json=1", {}),
                    ("GET", "rw/rapid/symbol/data/RAPID/T_ROB1/rounds", {}),
                    ("GET", "rw/cfg/MOC/ARM/instances", {}),
                    ("GET", "ui/state", {}),
                ]
            )
            await soak.asked(client, what[0], what[1], **what[2])
            await asyncio.sleep(dice.uniform(0.0, 0.2))


async def babbler(soak: Soak, dice: random.Random) -> None:
    """Sends what is no request, or half of one."""
    words = [
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n",
        b"POST /rw/rapid/execution?action=start HTTP/1.1\r\nContent-Length: 1000\r\n\r\ncyc",
        b"\x16\x03\x01" + b"\x00" * 50,
        b"PUT /fileservice/$HOME/x HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n",
        b"GET /" + b"a" * 20_000 + b" HTTP/1.1\r\n\r\n",
    ]
    async with soak.client() as client:
        while soak.goes_on():
            with contextlib.suppress(OSError):
                reader, writer = await asyncio.open_connection("127.0.0.1", soak.port)
                word = dice.choice(words) if dice.random() < 0.7 else dice.randbytes(300)
                writer.write(word[: dice.randrange(1, len(word) + 1)])
                await writer.drain()
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(reader.read(1000), dice.uniform(0.0, 0.5))
                writer.close()
                soak.note("garbage")
            path = dice.choice(
                ["rw/none", "rw/%00", "fileservice/$HOME/../../etc/passwd", "rw/cfg/x/y/instances"]
            )
            await soak.asked(client, "GET", path)
            wrong = {"value": dice.choice(['{"a"', "[1,2", "9" * 5000, "\0"])}
            await soak.asked(
                client, "POST", "rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set", **wrong
            )
            await asyncio.sleep(0.05)


async def crowd(soak: Soak, dice: random.Random) -> None:
    """More sessions than there are, and websockets that vanish."""
    while soak.goes_on():
        many = [soak.client() for _ in range(dice.choice([3, 12, 71]))]
        try:
            await crowded(soak, dice, many)
        finally:
            for one in many:
                await one.close()
        await asyncio.sleep(dice.uniform(0.2, 2.0))


async def crowded(soak: Soak, dice: random.Random, many: list[aiohttp.ClientSession]) -> None:
    """A crowd once: some of its clients say goodbye."""
    statuses = [await soak.asked(one, "GET", "rw/system?json=1") for one in many]
    if 503 in statuses:
        soak.note("too many sessions")
    for one in many[:5]:
        form = {"resources": "1", "1": "/rw/iosystem/signals/diGo;state", "1-p": "2"}
        async with one.post(f"{soak.base}/subscription", data=form) as response:
            where = response.headers.get("Location", "")
            soak.note(str(response.status))
        if response.status == 201:
            with contextlib.suppress(aiohttp.ClientError, TimeoutError):
                socket = await one.ws_connect(where, protocols=("robapi2_subscription",))
                await asyncio.wait_for(socket.receive(), 1.0)
                soak.note("events")
                if dice.random() < 0.5:
                    await socket.close()
    for one in many:
        if dice.random() < 0.7:
            with contextlib.suppress(aiohttp.ClientError):
                await soak.asked(one, "GET", "logout")


async def uploader(soak: Soak, dice: random.Random) -> None:
    """Uploads files, some of which break off, and reads them back."""
    async with soak.client() as client:
        while soak.goes_on():
            number, name = dice.randrange(1000), f"file{dice.randrange(5)}.bin"
            url, data = f"{soak.base}/fileservice/$HOME/up/{name}", text_of(number)
            if dice.random() < 0.5:
                with contextlib.suppress(aiohttp.ClientError, OSError):

                    async def broken(data: bytes = data) -> object:
                        yield data[: dice.randrange(len(data))]
                        raise OSError

                    await client.put(url, data=broken())
                soak.note("uploads cut off")
            else:
                async with client.put(url, data=data) as response:
                    soak.note(f"upload {response.status}")
            async with client.get(url) as response:
                if response.status == 200 and not is_whole(await response.read()):
                    soak.faults.append(f"{name} is not whole")
            await asyncio.sleep(dice.uniform(0.0, 0.1))


async def modern(soak: Soak, dice: random.Random) -> None:
    """Comes in by TLS, does a little, and leaves in the midst of it or as one should."""
    accepted = {"Accept": "application/hal+json;v=2.0"}
    written = {"Content-Type": "application/x-www-form-urlencoded;v=2.0"}
    who = {"Authorization": "Basic " + b64encode(":".join(USER).encode()).decode()}
    gets = ["rw/rapid/execution", "rw/iosystem/signals", "rw/elog/0?lang=en", "rw/none", "rw/cfg"]
    posts = ["rw/mastership/edit/request", "rw/rapid/execution/resetpp", "rw/panel/speedratio"]
    while soak.goes_on():
        jar = aiohttp.CookieJar(unsafe=True)
        patience, door = aiohttp.ClientTimeout(total=60), aiohttp.TCPConnector(ssl=False)
        async with aiohttp.ClientSession(
            headers=who, cookie_jar=jar, timeout=patience, connector=door
        ) as client:
            for _ in range(dice.randrange(6)):
                address = f"{soak.second}/{dice.choice(gets)}"
                async with client.get(address, headers=accepted) as response:
                    if dice.random() < 0.8:
                        await response.read()
                    soak.note(f"2.0 {response.status}")
                    if response.status == 500:
                        soak.faults.append(address)
                address = f"{soak.second}/{dice.choice(posts)}"
                async with client.post(address, headers=written, data=b"{") as response:
                    soak.note(f"2.0 {response.status}")
            form = {"resources": "1", "1": "/rw/iosystem/signals/diGo;state", "1-p": "1"}
            data = aiohttp.FormData(form)()
            address = f"{soak.second}/subscription"
            async with client.post(address, headers=written, data=data) as response:
                soak.note(f"2.0 {response.status}")
                where = response.headers.get("Location", "")
            if response.status == 201 and dice.random() < 0.8:
                with contextlib.suppress(aiohttp.ClientError, TimeoutError):
                    socket = await client.ws_connect(where, protocols=("rws_subscription",))
                    await asyncio.wait_for(socket.receive(), 1.0)
                    soak.note("2.0 events")
            if dice.random() < 0.7:
                async with client.get(f"{soak.second}/logout", headers=accepted) as response:
                    await response.read()
        with contextlib.suppress(OSError):
            # Half of a handshake.
            _, writer = await asyncio.open_connection(
                "127.0.0.1", int(soak.second.rpartition(":")[2])
            )
            writer.write(b"\x16\x03\x01\x02\x00\x01\x00"[: dice.randrange(8)])
            writer.close()
        await asyncio.sleep(dice.uniform(0.1, 0.5))


FAULTS: tuple[dict[str, object], ...] = (
    {"kind": "emergency_stop"},
    {"kind": "guard_stop", "for": 0.5},
    {"kind": "general_stop", "for": 0.5},
    {"kind": "restart", "for": 0.3},
    {"kind": "restart", "mode": "cold", "for": 0.1},
    {"kind": "full_disk", "for": 1},
    {"kind": "device_lost", "device": "board", "for": 1},
    {"kind": "elog", "code": 38103, "severity": "warning"},
    *(
        {"kind": kind, "on": on, "count": 5}
        for kind in ("drop", "delay", "duplicate", "refuse")
        for on in ("http", "websocket", "egm", "socket")
    ),
    {"kind": "none"},
)


async def saboteur(soak: Soak, dice: random.Random) -> None:
    """Makes it fail, and ends that."""
    async with aiohttp.ClientSession() as client:
        while soak.goes_on():
            for _ in range(dice.randrange(1, 5)):
                fault = dice.choice(FAULTS)
                async with client.post(f"{soak.faulty}/faults", json=fault) as response:
                    soak.note(f"fault {response.status}")
                    if response.status != (400 if fault["kind"] == "none" else 204):
                        soak.faults.append(f"{fault}: {await response.text()}")
                await asyncio.sleep(dice.uniform(0.0, 0.5))
            await client.delete(f"{soak.faulty}/faults")
            await asyncio.sleep(dice.uniform(0.5, 3.0))


MOST_GROWTH_MB = 3.0
LOOKS_S = 5.0


def memory_mb(pid: int) -> dict[str, float]:
    """Resident memory of a served controller: its frontend, its engine, the guide of sensors."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/status"):
        with contextlib.suppress(OSError):
            text, command = status.read_text(), status.with_name("cmdline").read_text()
            # Python's own process that tidies up after others does not count.
            is_own = re.search(rf"^(Pid|PPid):\s+{pid}$", text, re.M) is not None
            if is_own and "resource_tracker" not in command:
                pages = int(status.with_name("statm").read_text().split()[1])
                found[int(status.parent.name)] = pages * PAGE_BYTES / 2**20
    names = {pid: "frontend"} | dict(zip(sorted(found.keys() - {pid}), ROLES, strict=False))
    return {names[one]: megabytes for one, megabytes in found.items() if one in names}


async def watch(soak: Soak, pid: int) -> None:
    """Look at the memory, and tell every minute how it goes."""
    began = told = time.monotonic()
    while soak.goes_on():
        now_s, megabytes = time.monotonic(), memory_mb(pid)
        soak.memory.append(megabytes)
        if now_s >= told:
            told += 60.0
            shown = ", ".join(f"{name} {one:.1f}" for name, one in megabytes.items())
            print(f"{now_s - began:7.0f} s  {shown} MB  {soak.counts}", flush=True)
        await asyncio.sleep(min(LOOKS_S, max(1.0, soak.until - now_s)))


def judged(memory: list[dict[str, float]]) -> tuple[list[str], list[str]]:
    """What there is to say of the memory of processes, and of those that have grown."""
    told, grown = [], []
    third = len(memory) // 3
    if not third:
        return ["too short to judge memory"], []
    for name in memory[0]:
        course = [one[name] for one in memory if name in one]
        warm, last = (fmean(part) for part in (course[third:-third], course[-third:]))
        told.append(
            f"{name}: {course[0]:.1f} MB at first, {max(course):.1f} at most; means of the thirds "
            f"{fmean(course[:third]):.1f}, {warm:.1f}, {last:.1f}"
        )
        if last - warm > MOST_GROWTH_MB:
            grown.append(f"the {name} has grown by {last - warm:.1f} MB after its caches were full")
    return told, grown


async def soaked(folder: Path, minutes: float, speed: str, seed: int) -> list[str]:
    """Serve, soak, kill; what was not as it must be."""
    home = folder / "home"
    (folder / "cell").mkdir()
    home.mkdir()
    (folder / "cell" / "soaked.mod").write_text(PROGRAM)
    (folder / "cell" / "rapidsim.toml").write_text(STATION)
    errors = (folder / "errors.txt").open("w")
    process = await asyncio.create_subprocess_exec(
        *(sys.executable, "-m", "rapidsim", "serve", str(folder / "cell"), "--home", str(home)),
        *("--rws1-port", "0", "--rws2-port", "0", "--speed", speed, "--session-timeout", "20"),
        *("--faults-port", "0"),
        *("--journal", str(folder / "journal.jsonl")),
        env=os.environ | {"XDG_STATE_HOME": str(folder / "state")},
        stdout=asyncio.subprocess.PIPE,
        stderr=errors,
    )
    assert process.stdout is not None
    ready = json.loads(await process.stdout.readline())
    until = time.monotonic() + 60.0 * minutes
    port = int(ready["rws1"].rpartition(":")[2])
    soak = Soak(port, ready["rws2"], ready["faults"], home, until)
    workers = [
        soak.endured(one, seed + k)
        for k, one in enumerate((worker, babbler, crowd, uploader, modern, saboteur))
    ]
    results = await asyncio.gather(*workers, watch(soak, ready["pid"]), return_exceptions=True)
    faults = soak.faults + [repr(one) for one in results if isinstance(one, BaseException)]
    told, grown = judged(soak.memory)
    faults += grown
    if process.returncode is not None:
        faults.append(f"the controller has ended with {process.returncode}")
    # Killed in the midst of uploads.
    soak.until = time.monotonic() + 5.0
    last = asyncio.create_task(uploader(soak, random.Random(seed)))
    await asyncio.sleep(1.0)
    process.send_signal(signal.SIGKILL)
    await process.wait()
    last.cancel()
    await asyncio.gather(last, return_exceptions=True)
    faults += [
        f"{one.name} is not whole"
        for one in (home / "up").glob("file*")
        if not is_whole(one.read_bytes())
    ]
    said = (folder / "errors.txt").read_text()
    if "defect" in said or "Traceback" in said:
        faults.append(said[-5000:])
    journal = (folder / "journal.jsonl").stat().st_size / 2**20
    print("\n".join((f"journal {journal:.1f} MB; {soak.counts}", *told)))
    return faults


def main() -> None:
    """Soak and tell."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--speed", default="1")
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        faults = asyncio.run(soaked(Path(folder), asked.minutes, asked.speed, asked.seed))
    print("\n".join(faults) or "nothing was wrong")
    raise SystemExit(bool(faults))


if __name__ == "__main__":
    main()
