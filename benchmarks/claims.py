"""All that README and docs claim of speed and size: `python benchmarks/claims.py`.

    python benchmarks/claims.py [--json FILE] [--rapidchecker PYTHON]

Each claim of `stated.py` is measured, with its peer in the same run, and held to its bound: times
are those of the processor, of whole processes where a command is meant. What a peer that is not
installed is needed for is said to be not measured; PYTHON is the interpreter of an environment with
rapidchecker, which has other dependencies than we. The exit code is 1 if a claim does not hold.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import asdict
from functools import partial
from importlib.metadata import distribution, requires
from importlib.util import find_spec
from pathlib import Path

import execution
import planning
import rapidchecker
import recording
from exports import ROBOT, export
from scale import Cost, cost
from stated import STATED

from rapidsim.motion.robot.robot import load_robot

CELL = Path(__file__).parents[1] / "programs" / "cell"
TINY = "MODULE tiny\n  PROC main()\n    VAR num n:=1;\n    n:=n+1;\n  ENDPROC\nENDMODULE\n"
POLLING = """MODULE polling
  PROC main()
    WHILE TRUE DO
      Reset do1; Reset do2; Reset do3; Reset do4;
      IF di1=1 TPWrite "seen";
    ENDWHILE
  ENDPROC
ENDMODULE
"""
SIGNALS = "".join(f'do{n} = {{ type = "do" }}\n' for n in range(1, 5)) + 'di1 = { type = "di" }\n'
TEN = "".join(
    f"    MoveJ [[{700 + 30 * n},{20 * n - 100},{500 + 20 * n}],[0,0,1,0],[0,0,0,0],"
    "[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n"
    for n in range(1, 11)
)
PLACES = ("base.x=-245:245:10", "base.y=-245:245:10", "base.rz=-39:39:2")


MODULE = """MODULE part{n}
  VAR num count{n}:=0;
  PROC work{n}()
    FOR i FROM 1 TO {n}+1 DO
      count{n}:=count{n}+i;
      IF count{n}>100 TPWrite "many";
    ENDFOR
    MoveJ [[{x},0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    MoveL [[{x},50,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
  ENDPROC
ENDMODULE
"""
Measured = Iterator[tuple[str, float]]
"""Claims, by their words in `stated.py`, and what they come to."""
Measure = Callable[[Path], Measured]


def main() -> int:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--rapidchecker", metavar="PYTHON")
    asked = parser.parse_args()
    values: dict[str, float] = {}
    measures: list[Measure] = [*MEASURES, partial(_rapidchecker, asked.rapidchecker)]
    with tempfile.TemporaryDirectory() as name:
        for number, measure in enumerate(measures):
            folder = Path(name, str(number))
            folder.mkdir()
            # What is kept of other runs is no part of these.
            os.environ["RAPIDSIM_CACHE_DIR"] = str(folder / "kept")
            values |= dict(measure(folder))
    rows = []
    for claim in STATED:
        value = values.get(claim.what)
        holds = None if value is None else claim.holds(value)
        verdict = {None: "not measured", True: "holds", False: "DOES NOT HOLD"}[holds]
        shown = "-" if value is None else f"{value:.3g}"
        print(f"{claim.what:50}{shown:>9} {claim.unit}, {claim.bound}: {verdict}")
        rows.append(asdict(claim) | {"value": value, "holds": holds})
    if asked.json:
        asked.json.write_text(json.dumps(rows, indent=1) + "\n")
    return int(any(row["holds"] is False for row in rows))


def _start(folder: Path) -> Measured:
    (folder / "tiny.mod").write_text(TINY)
    # Beside a station, as most programs are.
    (folder / "rapidsim.toml").write_text('[signals]\ndoGrip = { type = "do" }\n')
    first, second, peer = [], [], []
    for _ in range(7):
        first.append(_run(folder, "check", "tiny.mod", "--no-cache").seconds)
        second.append(_run(folder, "check", "tiny.mod").seconds)
        peer.append(cost(str(folder), "-c", "import numpy, lark, click").seconds)
    yield "check of a tiny module, the first time", min(first) / min(peer)
    yield "check of a tiny module, the second time", min(second) / min(peer)


def _second_time(folder: Path) -> Measured:
    modules, moves = folder / "modules", folder / "moves"
    for one in (modules, moves):
        one.mkdir()
    for n in range(100):
        (modules / f"part{n}.mod").write_text(MODULE.format(n=n, x=700 + n))
    (moves / "export.mod").write_text(export("inline", "spiral", 100_000))
    for name, one in (("100 small modules", modules), ("100,000 moves", moves)):
        check = ("check", str(one), "--robot", ROBOT)
        first = min(_run(folder, *check, "--no-cache", codes=(0, 1)).seconds for _ in range(2))
        _run(folder, *check, codes=(0, 1))
        second = min(_run(folder, *check, codes=(0, 1)).seconds for _ in range(3))
        yield f"check of {name}, the second time", second / first


def _processes(folder: Path) -> Measured:
    names = [f"{n}.mod" for n in range(4)]
    for name in names:
        (folder / name).write_text(TINY)
    check = ("check", "--each", *names, "--no-cache")
    one, two = (min(_run(folder, *check, "-j", n).seconds for _ in range(3)) for n in ("1", "2"))
    # Two of them do what one did.
    yield "start of a second process", (two - one) / 2.0


def _pick_and_place(folder: Path) -> Measured:
    for file in CELL.iterdir():
        text = file.read_text(encoding="utf-8").replace("TO 2 DO", "TO 100000 DO")
        (folder / file.name).write_text(text, encoding="utf-8")
    minute, hour = (
        _run(folder, "run", ".", "--no-record", "--max-time", str(time_s), codes=(3,))
        for time_s in (60, 3600)
    )
    yield "an hour of pick and place", hour.seconds
    yield "  memory a virtual minute", (hour.megabytes - minute.megabytes) / 59.0


def _polling(folder: Path) -> Measured:
    # Something changes now and then, else the run says that it waits for ever.
    change = "[[stimulus]]\nat = 1.0\nevery = 10.0\nset = { di1 = 0 }\n"
    (folder / "rapidsim.toml").write_text(f"[signals]\n{SIGNALS}{change}")
    (folder / "polling.mod").write_text(POLLING)
    arguments = ("run", "polling.mod", "--no-record", "--max-time", "600")
    yield "ten minutes of polling", _run(folder, *arguments, codes=(3,)).seconds


def _sweep(folder: Path) -> Measured:
    (folder / "rapidsim.toml").write_text('[robot]\nmodel = "irb1600-6-1.2"\n')
    (folder / "ten.mod").write_text(f"MODULE ten\n  PROC main()\n{TEN}  ENDPROC\nENDMODULE\n")
    vary = [part for place in PLACES for part in ("--vary", place)]
    arguments = ("rapidsim.toml", "ten.mod", *vary, "--no-run", "--out", "places.csv")
    seconds = _run(folder, "sweep", *arguments, codes=(0, 1)).seconds
    yield "reach of 100,000 places of ten targets", seconds
    yield "  targets", 1_000_000 / seconds


def _loops(_folder: Path) -> Measured:
    ratios = [ours / plain for ours, plain, _ in execution.loop_times(9).values()]
    yield "loops of RAPID beside Python, geometric mean", execution.mean_of(ratios)
    yield "  the worst of them", max(ratios)


def _rapidchecker(python: str | None, _folder: Path) -> Measured:
    if python is not None:
        compared = rapidchecker.beside_rapidchecker(python)
        yield "a check of 24 KB beside rapidchecker", compared.times_faster


def _planning(_folder: Path) -> Measured:
    robot = load_robot(planning.ROBOT)
    if find_spec("toppra") is not None:
        found = next(planning.beside_toppra(robot))
        yield "time-optimal planning beside toppra", found.theirs_s / found.ours_s
        yield "  durations differ by", found.difference
    if find_spec("numba") is not None:
        segments = planning.print_moves(robot, 10_000, 0.1)
        seconds = []
        for use, way in ((False, "in NumPy"), (True, "with numba")):
            with planning.numba(use=use):
                planning.timed(robot, segments[-2000:], 1)
                seconds.append(planning.timed(robot, segments, 2)[0])
            yield f"moves of 2 mm planned, {way}", len(segments) / seconds[-1]
        yield "planning 10,000 moves with numba beside NumPy", seconds[0] / seconds[1]


def _sizes(folder: Path) -> Measured:
    root = Path(__file__).parents[1]
    ours = sum(_bytes(root / name) for name in ("rapidsim", "grammars", "robots"))
    files = (
        Path(str(file.locate()))
        for name in _needed("rapidsim", set())
        for file in distribution(name).files or ()
    )
    theirs = sum(file.stat().st_size for file in files if file.suffix != ".pyc" and file.is_file())
    yield "installed size of the core", (ours + theirs) / 1e6
    yield "recording of an hour under way", recording.recording_of_an_hour(folder)
    yield "report of 10,000 moves", recording.report_of_a_long_path(folder)


MEASURES: tuple[Measure, ...] = (
    *(_start, _second_time, _processes, _pick_and_place, _polling, _sweep),
    *(_loops, _planning, _sizes),
)


def _bytes(folder: Path) -> int:
    files = (file for file in folder.rglob("*") if file.is_file() and file.suffix != ".pyc")
    return sum(file.stat().st_size for file in files)


def _needed(name: str, known: set[str]) -> set[str]:
    """The packages that a package needs without extras, and those that these need."""
    for line in requires(name) or ():
        package = re.match(r"[\w.-]+", line)
        assert package is not None
        if ";" not in line and package[0] not in known:
            known.add(package[0])
            _needed(package[0], known)
    return known


def _run(folder: Path, *arguments: str, codes: tuple[int, ...] = (0,)) -> Cost:
    return cost(str(folder), "-m", "rapidsim", *arguments, codes=codes)


if __name__ == "__main__":
    sys.exit(main())
