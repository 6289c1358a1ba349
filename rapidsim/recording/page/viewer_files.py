"""The parts of rerun's viewer for browsers, taken from the installed version.

The viewer's program contains them and serves them over HTTP. It is started on a free port of
loopback for as long as that takes.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.error import URLError
from urllib.request import ProxyHandler, build_opener

import rerun_cli

from rapidsim.files import InputError
from rapidsim.values import value_class

_HOST = "127.0.0.1"
_GLUE, _PROGRAM = "re_viewer.js", "re_viewer_bg.wasm"
_NOTICES = "THIRD_PARTY_NOTICES.md"
_START_S = 30.0
"""Time [s] that the viewer has to start."""
_STEP_S = 0.05


@value_class(frozen=True, slots=True)
class ViewerFiles:
    """The parts of the viewer that a page contains."""

    glue: str
    """JavaScript that loads the program."""
    program: bytes
    """WebAssembly."""
    notices: str
    """Licences of its parts."""


def viewer_files() -> ViewerFiles:
    """Return the parts of the installed viewer.

    Raises:
        InputError: If the installed viewer does not serve them.
    """
    folder = viewer_program().parent
    with _served() as address:
        glue, program = (_fetched(f"{address}/{name}") for name in (_GLUE, _PROGRAM))
    notices = folder / _NOTICES
    text = notices.read_text(encoding="utf-8") if notices.is_file() else ""
    return ViewerFiles(glue.decode("utf-8"), program, text)


@contextmanager
def _served() -> Iterator[str]:
    """Serve the viewer's files while the block runs; yields the address."""
    port = free_port()
    arguments = ("--serve-web", "--bind", _HOST, "--port", "0", "--web-viewer-port", str(port))
    server = subprocess.Popen(
        [str(viewer_program()), *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield f"http://{_HOST}:{port}"
    finally:
        server.kill()
        server.wait()


def _fetched(url: str) -> bytes:
    """Return a file of the viewer, as soon as it is served."""
    # Without a proxy: the address is this computer's.
    opener = build_opener(ProxyHandler({}))
    deadline_s = time.monotonic() + _START_S
    while True:
        try:
            with opener.open(url, timeout=_START_S) as answer:
                data: bytes = answer.read()
            return data
        except (URLError, OSError) as error:
            if time.monotonic() > deadline_s:
                raise InputError(
                    f"the installed viewer does not serve its files: {error}",
                    "`rapidsim view FILE.rrd` opens the recording in a window",
                ) from error
        time.sleep(_STEP_S)


def viewer_program() -> Path:
    """Return the program of the installed viewer."""
    return Path(rerun_cli.__file__).parent / ("rerun.exe" if sys.platform == "win32" else "rerun")


def free_port() -> int:
    """Return a port of loopback that nobody uses now."""
    with socket.socket() as probe:
        probe.bind((_HOST, 0))
        port: int = probe.getsockname()[1]
    return port
