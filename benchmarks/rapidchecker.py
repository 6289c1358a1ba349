"""Against the syntax checker on PyPI: `python benchmarks/rapidchecker.py PYTHON [KILOBYTES]`.

PYTHON is the interpreter of a virtual environment into which `pip install rapidchecker` has put it.
Both check the same valid file of targets and moves, each in a process of its own; what a process
takes for an empty module is taken off. Ours checks names, types, flow and data of motion besides.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

KILOBYTES = 24
EMPTY = "MODULE empty\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n"
OURS = [sys.executable, "-m", "rapidsim", "check", "--no-reach"]


def main() -> None:
    """Print CPU seconds of both and how many times faster ours is."""
    theirs = [sys.argv[1], "-m", "rapidchecker"]
    kilobytes = int(sys.argv[2]) if len(sys.argv) > 2 else KILOBYTES
    with tempfile.TemporaryDirectory() as folder:
        big, empty = Path(folder, "big.sys"), Path(folder, "empty.sys")
        big.write_text(_module(kilobytes * 1000), encoding="ascii")
        empty.write_text(EMPTY, encoding="ascii")
        start = [
            min(_cpu_s([*command, str(empty)]) for _ in range(3)) for command in (OURS, theirs)
        ]
        mine = min(_cpu_s([*OURS, str(big)]) for _ in range(3))
        other = _cpu_s([*theirs, str(big)])
        size = big.stat().st_size / 1000
    print(f"{size:.1f} KB: rapidsim {mine:.2f} s, of which {start[0]:.2f} s to start")
    print(f"         rapidchecker {other:.2f} s, of which {start[1]:.2f} s to start")
    print(
        f"{(other - start[1]) / (mine - start[0]):.0f} times faster, {other / mine:.0f} with start"
    )


def _cpu_s(command: list[str]) -> float:
    """CPU time of a process that must find nothing wrong."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
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
