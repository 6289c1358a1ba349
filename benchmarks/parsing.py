"""How fast RAPID is read: `python benchmarks/parsing.py [ROUNDS]`.

Three texts of one megabyte each are parsed, and parsed and checked, beside CPython's `ast.parse` on
a Python text of the same size; then `rapidsim check` of a tiny module is timed beside a process
that imports numpy, lark and click. The minimum of the rounds is printed.
"""

from __future__ import annotations

import ast
import gc
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Source
from rapidsim.syntax.parser import parse

ROOT = Path(__file__).parents[1]
SIZE = 1_000_000
"""Characters of each text."""

TINY = 'MODULE tiny\n  PROC main()\n    TPWrite "hello";\n  ENDPROC\nENDMODULE\n'


def main() -> None:
    """Measure and print."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    python = _python_text()
    expected = _least(lambda: ast.parse(python), rounds)
    print(f"{'ast.parse':22}{expected:7.2f} s {_rate(python, expected)}")
    texts = {"logic": _logic(), "inline targets": _inline(), "declared targets": _declared()}
    for name, text in texts.items():
        source = Source(f"{name}.mod", text)
        parsing = _least(lambda source=source: parse(source), rounds)  # type: ignore[misc]
        file = parse(source).file
        checking = _least(lambda file=file: check([file]), rounds)  # type: ignore[misc]
        print(
            f"{name:18} read {parsing:6.2f} s {_rate(text, parsing)}"
            f" {parsing / expected:5.2f} times   check {checking:6.2f} s {_rate(text, checking)}"
        )
    with tempfile.TemporaryDirectory() as folder:
        tiny = Path(folder) / "tiny.mod"
        tiny.write_text(TINY)
        start = _least(
            lambda: _process("-m", "rapidsim", "check", "--no-cache", str(tiny)), 3 * rounds
        )
        others = _least(lambda: _process("-c", "import numpy, lark, click"), 3 * rounds)
        bare = _least(lambda: _process("-c", "pass"), 3 * rounds)
    print(
        f"start: check tiny.mod {1000 * start:.0f} ms, numpy + lark + click {1000 * others:.0f} ms,"
        f" Python alone {1000 * bare:.0f} ms"
    )


def _least(work: Callable[[], object], rounds: int) -> float:
    best = float("inf")
    for _ in range(rounds):
        gc.collect()
        begin = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - begin)
    return best


def _process(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)


def _rate(text: str, seconds: float) -> str:
    return f"{len(text) / seconds / 1e6:6.2f} MB/s"


def _python_text() -> str:
    """The interpreter's own files one after the other, without what must stand first in a file."""
    files = sorted((ROOT / "rapidsim" / "interpreter").glob("*.py"))
    whole = "".join(path.read_text().replace("from __future__", "from future") for path in files)
    return whole * (SIZE // len(whole) + 1)


def _logic() -> str:
    """The routines of a program of the repository again and again, each time with other names."""
    text = (ROOT / "programs" / "algorithms.mod").read_text()
    modules = []
    for number in range(SIZE // len(text) + 1):
        renamed = text.replace("MODULE Algorithms", f"MODULE Algorithms{number}", 1)
        # What is global in one module would clash with the other's.
        for word in ("PROC ", "FUNC ", "RECORD ", "CONST num P", "CONST num L", "CONST num Q"):
            renamed = renamed.replace(f"\n  {word}", f"\n  LOCAL {word}")
        modules.append(renamed.replace("\n  VAR ", "\n  LOCAL VAR "))
    return "".join(modules)


def _inline() -> str:
    """What a CAM system writes: a move a line with its target in it."""
    lines = []
    for number in cycle(range(360)):
        lines.append(
            f"    MoveL [[{300 + number * 0.37:.2f},{-120 + number * 0.91:.3f},{55 + number % 7}],"
            "[0.0498,-0.7013,0.7109,-0.0123],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],"
            "v200,z10,tool0\\WObj:=wobj0;\n"
        )
        if len(lines) * len(lines[0]) > SIZE:
            return f"MODULE path\n  PROC main()\n{''.join(lines)}  ENDPROC\nENDMODULE\n"
    raise AssertionError("a cycle has no end")


def _declared() -> str:
    """What an offline editor writes: named targets, then moves to them."""
    targets, moves = [], []
    for number in range(SIZE // 180):
        targets.append(
            f"  CONST robtarget Target_{number}:=[[{300 + number * 0.037:.3f},"
            f"{-120 + number * 0.091:.3f},55.5],[0.0498,-0.7013,0.7109,-0.0123],[-1,0,-1,0],"
            "[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];\n"
        )
        moves.append(f"    MoveL Target_{number},v200,z10,tool0\\WObj:=wobj0;\n")
    return f"MODULE path\n{''.join(targets)}  PROC main()\n{''.join(moves)}  ENDPROC\nENDMODULE\n"


if __name__ == "__main__":
    main()
