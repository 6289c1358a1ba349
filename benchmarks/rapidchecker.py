"""Against the syntax checker on PyPI: `python benchmarks/rapidchecker.py PYTHON [KILOBYTES]`.

PYTHON is the interpreter of a virtual environment into which `pip install rapidchecker` has put it.
Both check the same valid file of targets and moves, each in a process of its own; what a process
takes for an empty module is taken off. Ours checks names, types, flow and data of motion besides.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

KILOBYTES = 24
EMPTY = "MODULE empty\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n"
_ROUNDS = 15
"""Ours takes a hundredth of a second more than its start, which varies by as much."""
OURS = [sys.executable, "-m", "rapidsim", "check", "--no-reach", "--no-cache"]


def main() -> None:
    """Print CPU seconds of both and how many times faster ours is."""
    compared = beside_rapidchecker(
        sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else KILOBYTES
    )
    print(f"{compared.kilobytes:.1f} KB", end="")
    for name, spent in (("rapidsim", compared.ours), ("rapidchecker", compared.theirs)):
        print(f": {name} {spent.seconds:.2f} s, of which {spent.start:.2f} s to start", end="")
    print(f"\n{compared.times_faster:.0f} times faster, {compared.with_start:.0f} with start")


@dataclass(frozen=True)
class Spent:
    """Processor time [s]."""

    seconds: float
    start: float
    """Of which for an empty module."""


@dataclass(frozen=True)
class Compared:
    """What both take for the same file."""

    kilobytes: float
    ours: Spent
    theirs: Spent

    @property
    def times_faster(self) -> float:
        """Without start."""
        return (self.theirs.seconds - self.theirs.start) / (self.ours.seconds - self.ours.start)

    @property
    def with_start(self) -> float:
        """With it."""
        return self.theirs.seconds / self.ours.seconds


def beside_rapidchecker(python: str, kilobytes: int = KILOBYTES) -> Compared:
    """Measure both; theirs runs in the environment of an interpreter."""
    theirs = [python, "-m", "rapidchecker"]
    with tempfile.TemporaryDirectory() as folder:
        big, empty = Path(folder, "big.sys"), Path(folder, "empty.sys")
        big.write_text(_module(kilobytes * 1000), encoding="ascii")
        empty.write_text(EMPTY, encoding="ascii")
        start = [
            min(_cpu_s([*command, str(empty)]) for _ in range(_ROUNDS))
            for command in (OURS, theirs)
        ]
        mine = min(_cpu_s([*OURS, str(big)]) for _ in range(_ROUNDS))
        other = _cpu_s([*theirs, str(big)])
        size = big.stat().st_size / 1000
    return Compared(size, Spent(mine, start[0]), Spent(other, start[1]))


def _least(command: list[str]) -> float:
    return min(_cpu_s(command) for _ in range(_ROUNDS))


def _cpu_s(command: list[str]) -> float:
    """CPU time of a process that must find nothing wrong."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Where that is set every start compiles every module, which is no cost of the command.
    variables = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    # Beside this file Python would take it for the other checker.
    folder = Path(command[-1]).parent
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, env=variables, cwd=folder
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert done.returncode == 0, done.stdout + done.stderr
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _module(size: int) -> str:
    lines = ["MODULE big"]
    moves: list[str] = []
    count = length = 0
    while length < size:
        target = (
            f"  CONST robtarget p{count}:=[[{800 + count % 97},{count % 61 - 30},600],"
            "[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
        )
        move = (
            f"    MoveL p{count},v100,z1,tool0;" if count else f"    MoveJ p{count},v100,z1,tool0;"
        )
        lines.append(target)
        moves.append(move)
        length += len(target) + len(move) + 2
        count += 1
    return "\n".join([*lines, "  PROC main()", *moves, "  ENDPROC", "ENDMODULE", ""])


if __name__ == "__main__":
    main()
