"""What looking for contacts costs: processor time beyond the same run without bodies.

    python benchmarks/collisions.py [--objects 20] [--moves 10000] [--rounds 3]

Prints milliseconds per simulated second, and that as a share of the run without, for pick and place
and for many small moves, among boxes that stand around the arm without being hit: far from all of
them, and with a wall 200 mm beside the way. Runs with and without take turns in one process, the
best of each counts: how fast a machine is changes while it is busy.
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
WALL = """
[[object]]
name = "wall"
box = [900, 40, 900]
pose = { position = [700, 350, 600] }
"""


def boxes(count: int) -> str:
    """Tables of a station file: posts on both sides of the arm."""
    texts = ["[collisions]\nown-links = true\n"]
    for number in range(count):
        side, row = divmod(number, max(1, count // 2))
        x, y = 100.0 + 130.0 * row, (1.0 - 2.0 * side) * (950.0 + 40.0 * (row % 3))
        texts.append(
            f'[[object]]\nname = "box {number}"\nbox = [90, 60, 900]\n'
            f"pose = {{ position = [{x}, {y}, 300] }}\n"
        )
    return "\n".join(texts)


def cost_ms(files: dict[str, str], program: str, bodies: str, rounds: int) -> tuple[float, ...]:
    """Simulated time [s], milliseconds per second of it, and the share of the run without."""
    best = {"": float("inf"), bodies: float("inf")}
    simulated = 0.0
    for _ in range(rounds):
        for station in best:
            with TemporaryDirectory() as folder:
                for name, text in files.items():
                    extra = station if name == "rapidsim.toml" else ""
                    (Path(folder) / name).write_text(f"{text}\n{extra}", encoding="utf-8")
                started = time.process_time()
                run = rapidsim.simulate([f"{folder}/{program}"])
                best[station] = min(best[station], time.process_time() - started)
            simulated = run.time_s
    assert run.collisions is not None
    found, pairs = run.collisions.report, run.collisions.pair_count
    print(f"  {pairs} pairs, {len(found.contacts)} contacts, {len(found.clearances)} clearances")
    more = best[bodies] - best[""]
    return simulated, 1e3 * more / simulated, more / best[""]


def main() -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--objects", type=int, default=20)
    parser.add_argument("--moves", type=int, default=10_000)
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    cell = {one.name: one.read_text(encoding="utf-8") for one in PICK_AND_PLACE.iterdir()}
    small = {
        "small.mod": SMALL.format(asked.moves),
        "rapidsim.toml": '[robot]\nmodel = "irb1600-6-1.2"\n',
    }
    far = boxes(asked.objects)
    near = boxes(asked.objects - 1) + WALL
    for name, files, program, bodies in (
        ("pick and place", cell, "PickAndPlace.mod", far),
        (f"{asked.moves} small moves", small, "small.mod", far),
        (f"{asked.moves} small moves beside a wall", small, "small.mod", near),
    ):
        simulated, cost, share = cost_ms(files, program, bodies, asked.rounds)
        print(
            f"{name}: {cost:.1f} ms per simulated second over {simulated:.1f} s, "
            f"{100.0 * share:.0f} % of the run without"
        )


if __name__ == "__main__":
    main()
