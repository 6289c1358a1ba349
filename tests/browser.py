"""A real browser without a window, driven by its own protocol for developers."""

from __future__ import annotations

import asyncio
import json
import shutil
from base64 import b64decode
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

import aiohttp

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "google-chrome", "chrome"))), None)
_PATIENCE_S = 60.0


@dataclass
class Page:
    """The one page that is open."""

    socket: aiohttp.ClientWebSocketResponse
    _numbers: count[int]
    errors: list[str] = field(default_factory=list)
    """What scripts threw and nothing caught."""

    async def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        number = next(self._numbers)
        await self.socket.send_json({"id": number, "method": method, "params": parameters})
        while True:
            told = json.loads((await self.socket.receive(timeout=_PATIENCE_S)).data)
            if told.get("method") == "Runtime.exceptionThrown":
                self.errors.append(str(told["params"]["exceptionDetails"]))
            if told.get("id") == number:
                assert "error" not in told, told
                result: dict[str, Any] = told["result"]
                return result

    async def value(self, script: str) -> Any:
        """What a script gives, a promise awaited."""
        told = await self.call(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True
        )
        assert "exceptionDetails" not in told, told
        return told["result"].get("value")

    async def key(self, name: str) -> None:
        """Press a key and release it."""
        for kind in ("keyDown", "keyUp"):
            await self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name)

    async def mouse(self, kind: str, element: str) -> None:
        """Press or release the mouse on an element, `mousePressed` or `mouseReleased`."""
        x, y = await self.value(
            f"(() => {{ const one = {element}; one.scrollIntoView({{ block: 'center' }});"
            " const box = one.getBoundingClientRect();"
            " return [box.x + box.width / 2, box.y + box.height / 2]; })()"
        )
        await self.call(
            "Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1
        )

    async def until(self, script: str) -> None:
        """Wait until a script gives something true."""
        for _ in range(int(_PATIENCE_S / 0.1)):
            if await self.value(f"!!({script})"):
                return
            await asyncio.sleep(0.1)
        body = await self.value("document.body ? document.body.innerText : ''")
        raise AssertionError(f"{script} never holds on\n{body}")

    async def picture(self, file: Path, width: int, height: int, *, dark: bool = False) -> None:
        """Write what it looks like."""
        await self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=width < 600,
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        await self.call("Emulation.setEmulatedMedia", features=[scheme])
        await asyncio.sleep(0.7)
        shot = await self.call("Page.captureScreenshot", captureBeyondViewport=True)
        file.write_bytes(b64decode(shot["data"]))


DRAWN_WITHOUT_CARD = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
"""What a page that draws with WebGL needs on a machine without a graphics card."""


@asynccontextmanager
async def opened(url: str, folder: Path, *, webgl: bool = False) -> AsyncIterator[Page]:
    """Open a page in a browser whose profile lies in a folder."""
    assert CHROMIUM is not None
    process = await asyncio.create_subprocess_exec(
        CHROMIUM,
        *("--headless=new", "--no-sandbox", "--remote-debugging-port=0"),
        *(DRAWN_WITHOUT_CARD if webgl else ("--disable-gpu",)),
        *("--disable-dev-shm-usage", "--disable-background-networking", "--no-first-run"),
        *(f"--user-data-dir={folder / 'profile'}", "about:blank"),
        stdout=asyncio.subprocess.DEVNULL,
        stderr=asyncio.subprocess.DEVNULL,
    )
    try:
        told = folder / "profile" / "DevToolsActivePort"
        for _ in range(int(_PATIENCE_S / 0.1)):
            if told.exists() and "\n" in told.read_text():
                break
            await asyncio.sleep(0.1)
        port = told.read_text().split()[0]
        async with aiohttp.ClientSession() as client:
            async with client.get(f"http://127.0.0.1:{port}/json") as listed:
                pages = [one for one in await listed.json() if one["type"] == "page"]
            async with client.ws_connect(
                pages[0]["webSocketDebuggerUrl"], max_msg_size=2**26
            ) as socket:
                page = Page(socket, count(1))
                await page.call("Runtime.enable")
                await page.call("Page.navigate", url=url)
                yield page
    finally:
        process.kill()
        await process.wait()
