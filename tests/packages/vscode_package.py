"""Builds the VS Code extension in a temporary folder."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

EXTENSION = Path(__file__).parents[2] / "editors" / "vscode"
_NO_NETWORK = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ETIMEDOUT", "ECONNRESET", "E404", "E403")


def npm(*arguments: str, cwd: Path) -> None:
    """Run npm in a folder; the test is skipped without npm or its registry."""
    program = shutil.which("npm")
    if program is None:
        pytest.skip("npm is not installed")
    ended = subprocess.run(
        [program, *arguments], cwd=cwd, capture_output=True, text=True, timeout=300, check=False
    )
    output = ended.stdout + ended.stderr
    if ended.returncode and any(code in output for code in _NO_NETWORK):
        pytest.skip(f"no npm registry is reachable: {output.strip().splitlines()[0]}")
    assert ended.returncode == 0, output


def built(folder: Path) -> Path:
    """Return the package of the extension, built in a folder."""
    source, package = folder / "extension", folder / "rapidsim.vsix"
    unwanted = shutil.ignore_patterns("node_modules", "dist", "*.vsix")
    shutil.copytree(EXTENSION, source, ignore=unwanted)
    npm("ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error", cwd=source)
    npm("run", "package", "--", "--out", str(package), cwd=source)
    return package
