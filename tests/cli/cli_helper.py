"""Call the real command line in a process of its own; compare text with golden files."""

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
PROGRAMS = HERE / "programs"
GOLDEN = HERE / "golden"


@dataclass(frozen=True)
class Ended:
    code: int
    out: str
    err: str


def rapidsim(
    *arguments: object,
    cwd: Path = PROGRAMS,
    stdin: bytes = b"",
    columns: int = 80,
    environment: Mapping[str, str] | None = None,
) -> Ended:
    """Run `rapidsim` with its arguments; output is never a terminal."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-m", "rapidsim", *map(str, arguments)],
        cwd=cwd,
        input=stdin,
        capture_output=True,
        env={
            **{name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ},
            "COLUMNS": str(columns),
            "PYTHONIOENCODING": "utf-8",
            **(environment or {}),
        },
        check=False,
    )
    ended = Ended(done.returncode, done.stdout.decode(), done.stderr.decode())
    assert "Traceback" not in ended.err
    return ended


def assert_golden(name: str, text: str) -> None:
    """Compare with a golden file; `UPDATE_GOLDEN=1 pytest tests/cli` rewrites it."""
    text = re.sub(r"\(\d+\.\d\d s\)", "(0.00 s)", text)
    text = "".join(f"{line.rstrip()}\n" for line in text.splitlines())
    file = GOLDEN / name
    if os.environ.get("UPDATE_GOLDEN"):
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
    assert text == file.read_text(encoding="utf-8")
