"""What looking for contacts costs: processor time beyond the same run without bodies.

    python benchmarks/collisions.py [--objects 20] [--moves 2000]

Prints milliseconds per simulated second, for pick and place and for many small moves, among boxes
that stand around the arm without being hit.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import rapidsim

PICK_AND_PLACE = Path(__file__).parents[1] / "programs" / "cell"
SMALL = """MODULE small
  CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfL\\Off;
    FOR i FROM 1 TO {0} DO
      MoveL Offs(p,0,100*Sin(i),50*Cos(2*i)),v200,z1,tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""


def boxes(count: int) -> str:
    """Tables of a station file: a table under the arm, and walls and posts around it."""
    texts = ["[collisions]\nown-links = true\n"]
    for number in range(count):
        side, row = divmod(number, max(1, count // 2))
        x, y = 100.0 + 130.0 * row, (1.0 - 2.0 * side) * (950.0 + 40.0 * (row % 3))
        texts.append(
            f'[[object]]\nname = "box {number}"\nbox = [90, 60, 900]\n'
            f"pose = {{ position = [{x}, {y}, 300] }}\n"
        )
    return "\n".join(texts)


def cost_ms(files: dict[str, str], program: str, objects: int) -> tuple[float, float]:
    """Simulated time [s] and milliseconds per second of it."""
    spent = []
    simulated = 0.0
    for station in ("", boxes(objects)):
        with TemporaryDirectory() as folder:
            for name, text in files.items():
                extra = station if name == "rapidsim.toml" else ""
                (Path(folder) / name).write_text(f"{text}\n{extra}", encoding="utf-8")
            best = float("inf")
            for _ in range(2):
                started = time.process_time()
                run = rapidsim.simulate([f"{folder}/{program}"])
                best = min(best, time.process_time() - started)
            simulated = run.time_s
            spent.append(best)
            if run.collisions is not None:
                found = run.collisions.found
                print(f"  {len(found.contacts)} contacts, {len(run.collisions.scene.pairs)} pairs")
    return simulated, 1e3 * (spent[1] - spent[0]) / simulated


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--objects", type=int, default=20)
    parser.add_argument("--moves", type=int, default=2000)
    asked = parser.parse_args()
    cell = {one.name: one.read_text(encoding="utf-8") for one in PICK_AND_PLACE.iterdir()}
    small = {
        "small.mod": SMALL.format(asked.moves),
        "rapidsim.toml": '[robot]\nmodel = "irb1600-6-1.2"\n',
    }
    for name, files, program in (
        ("pick and place", cell, "PickAndPlace.mod"),
        (f"{asked.moves} small moves", small, "small.mod"),
    ):
        simulated, cost = cost_ms(files, program, asked.objects)
        print(f"{name}: {cost:.1f} ms per simulated second over {simulated:.1f} s")


if __name__ == "__main__":
    main()
