"""What programs of many moves cost, from file to recording.

    python benchmarks/scale.py [--moves 1000 10000 100000] [--forms inline named mixed]
        [--paths spiral] [--commands check run] [--json FILE]

Exports as CAM systems write them (`exports.py`) are checked, run, and run with a recording, each in
a process of its own. Printed are processor time and peak memory of the process, both a move once
the cost of the smallest export is taken off, and how often Python's own parser would have read a
Python text with the same moves in that time: a peer that is measured in the same run.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from exports import FORMS, PATHS, ROBOT, export

COMMANDS = {
    "check": ("check", "--no-cache", "--robot", ROBOT),
    "run": ("run", "--robot", ROBOT, "--no-record"),
    "record": ("run", "--robot", ROBOT),
}
_NO_BYTECODE = "PYTHONDONTWRITEBYTECODE"
_PEER = "import ast, sys; ast.parse(open(sys.argv[1]).read())"
_SIGNAL = '[signals]\ndoExtruder = { type = "do" }\n'


@dataclass(frozen=True)
class Cost:
    """What a process took."""

    seconds: float
    """Of processor, user and system."""
    megabytes: float
    """The most memory it had."""


@dataclass(frozen=True)
class Row:
    """One measurement."""

    form: str
    path: str
    moves: int
    command: str
    cost: Cost
    peer: Cost


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, nargs="+", default=[1000, 10_000, 100_000])
    parser.add_argument("--forms", nargs="+", choices=FORMS, default=list(FORMS))
    parser.add_argument("--paths", nargs="+", choices=PATHS, default=["spiral"])
    parser.add_argument("--commands", nargs="+", choices=COMMANDS, default=list(COMMANDS))
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    rows: list[Row] = []
    print(f"{'form':8}{'path':8}{'moves':>8}  {'command':8}{'CPU s':>9}{'MB':>7}", end="")
    print(f"{'us/move':>9}{'KB/move':>9}{'x ast.parse':>13}")
    for form in asked.forms:
        for path in asked.paths:
            rows += _measured(form, path, sorted(asked.moves), asked.commands)
    if asked.json:
        asked.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n")


def _measured(form: str, path: str, counts: Sequence[int], commands: Sequence[str]) -> list[Row]:
    rows: list[Row] = []
    first: dict[str, Row] = {}
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "rapidsim.toml").write_text(_SIGNAL)
        for count in counts:
            module, python = Path(folder) / "export.mod", Path(folder) / "export.py"
            text = export(form, path, count)
            module.write_text(text)
            python.write_text(_as_python(text))
            peer = cost(folder, "-c", _PEER, python.name)
            for command in commands:
                arguments = COMMANDS[command]
                ours = cost(folder, "-m", "rapidsim", *arguments, module.name)
                row = Row(form, path, count, command, ours, peer)
                _show(row, first.setdefault(command, row))
                rows.append(row)
    return rows


def _show(row: Row, smallest: Row) -> None:
    more = row.moves - smallest.moves
    print(f"{row.form:8}{row.path:8}{row.moves:8}  {row.command:8}", end="")
    print(f"{row.cost.seconds:9.2f}{row.cost.megabytes:7.0f}", end="")
    if more:
        seconds = row.cost.seconds - smallest.cost.seconds
        kilobytes = 1000.0 * (row.cost.megabytes - smallest.cost.megabytes)
        peer = row.peer.seconds - smallest.peer.seconds
        print(f"{1e6 * seconds / more:9.0f}{kilobytes / more:9.1f}{seconds / peer:13.1f}", end="")
    print(flush=True)


def cost(folder: str, *arguments: str, codes: Sequence[int] = (0,)) -> Cost:
    """What Python with some arguments takes, which must end with one of some codes."""
    process = subprocess.Popen(
        [sys.executable, *arguments],
        cwd=folder,
        # Where that is set every start compiles every module, which is no cost of the command.
        env={name: value for name, value in os.environ.items() if name != _NO_BYTECODE},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    assert process.stderr is not None
    said = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in codes:
        raise SystemExit(f"{' '.join(arguments[:3])}: {said.decode()}")
    # Of Linux in KB, of macOS in bytes.
    scale = 1e6 if sys.platform == "darwin" else 1e3
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / scale)


def _as_python(text: str) -> str:
    """The same moves as Python calls: `MoveL([[1.0,..],..],v200,z1,tool0,wobj0)`."""
    lines = []
    for line in text.splitlines():
        words = line.strip().rstrip(";")
        if words.startswith("CONST"):
            lines.append(words.removeprefix("CONST robtarget ").replace(":=", "="))
        elif words.startswith(("Move", "SetDO")):
            name, _, arguments = words.partition(" ")
            lines.append(f"{name}({arguments.replace(chr(92) + 'WObj:=', ',')})")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
