"""Call the command line beside the programs of this folder; compare text with golden files."""

import os
import re
from collections.abc import Mapping
from pathlib import Path

from command_line import Ended as Ended
from command_line import call

HERE = Path(__file__).parent
PROGRAMS = HERE / "programs"
GOLDEN = HERE / "golden"
# Tests that run in the background are deaf to Ctrl-C, and so are their children.
HEARS = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"


def rapidsim(
    *arguments: object,
    cwd: Path = PROGRAMS,
    stdin: bytes = b"",
    columns: int = 80,
    environment: Mapping[str, str] | None = None,
    terminal: bool = False,
) -> Ended:
    """Run `rapidsim` with its arguments."""
    return call(
        *arguments,
        cwd=cwd,
        stdin=stdin,
        columns=columns,
        environment=environment,
        terminal=terminal,
    )


def assert_golden(name: str, text: str) -> None:
    """Compare with a golden file; `UPDATE_GOLDEN=1 pytest tests/cli` rewrites it."""
    text = re.sub(r"\(\d+\.\d\d s\)", "(0.00 s)", text)
    text = "".join(f"{line.rstrip()}\n" for line in text.splitlines())
    file = GOLDEN / name
    if os.environ.get("UPDATE_GOLDEN"):
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
    assert text == file.read_text(encoding="utf-8")
