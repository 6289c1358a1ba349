"""The tools that settle taste and the layer contract, run as tests so that one command is all."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from mypy_command import MYPY
from wrap_markdown import sources, wrap

ROOT = Path(__file__).parents[1]
BIN = Path(sys.executable).parent

TOOLS = {
    "ruff-format": ["ruff", "format", "--check", "."],
    "ruff-check": ["ruff", "check", "."],
    "mypy": list(MYPY),
    "import-linter": ["lint-imports", "--no-cache"],
}

LONGEST_FILE = 500
"""Lines; a longer file holds more than one idea."""


@pytest.mark.parametrize("command", TOOLS.values(), ids=TOOLS.keys())
def test_tool_finds_nothing(command: list[str]) -> None:
    run = subprocess.run(
        [str(BIN / command[0]), *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_no_file_is_too_long() -> None:
    lengths = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines())
        for folder in ("rapidsim", "scripts", "benchmarks", "tests")
        for path in sorted((ROOT / folder).rglob("*.py"))
    }
    too_long = {path: lines for path, lines in lengths.items() if lines > LONGEST_FILE}
    assert not too_long


def test_markdown_is_wrapped() -> None:
    texts = {str(file.relative_to(ROOT)): file.read_text(encoding="utf-8") for file in sources()}
    unwrapped = [name for name, text in texts.items() if wrap(text) != text]
    assert not unwrapped, "python scripts/wrap_markdown.py"


def test_ci_runs_the_test_command_of_the_readme() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    commands = re.findall(r"^python3 -m venv .*pytest\b.*$", readme, flags=re.MULTILINE)
    assert len(commands) == 1
    assert commands[0] in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
