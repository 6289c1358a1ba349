"""What commands cost, against their bounds: `python benchmarks/claims.py [--json FILE]`.

Processor time and peak memory of whole processes, and for each the bound that it is held to: start
against imports, an hour of pick and place, ten minutes of polling, a sweep of 100,000 places. Costs
of programs of many moves are `scale.py`'s, of loops `execution.py`'s, of planning `planning.py`'s.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path

from scale import Cost, cost

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


@dataclass(frozen=True)
class Claim:
    """A number, and at most how large it is to be."""

    what: str
    value: float
    bound: float
    unit: str

    @property
    def holds(self) -> bool:
        """Whether it is no larger than that."""
        return self.value <= self.bound


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path)
    asked = parser.parse_args()
    claims = []
    with tempfile.TemporaryDirectory() as name:
        for measured in (_start, _pick_and_place, _polling, _sweep):
            folder = Path(name) / measured.__name__
            folder.mkdir()
            for claim in measured(folder):
                verdict = "holds" if claim.holds else "DOES NOT HOLD"
                print(
                    f"{claim.what:52}{claim.value:9.2f} of {claim.bound:g} {claim.unit}: {verdict}"
                )
                claims.append(claim)
    if asked.json:
        rows = [asdict(claim) | {"holds": claim.holds} for claim in claims]
        asked.json.write_text(json.dumps(rows, indent=1) + "\n")


def _start(folder: Path) -> list[Claim]:
    (folder / "tiny.mod").write_text(TINY)
    ours, peer = [], []
    for _ in range(7):
        ours.append(_run(folder, "check", "tiny.mod").seconds)
        peer.append(cost(str(folder), "-c", "import numpy, lark, click").seconds)
    return [Claim("check tiny.mod", min(ours) / min(peer), 1.5, "x import numpy, lark, click")]


def _pick_and_place(folder: Path) -> list[Claim]:
    for file in CELL.iterdir():
        text = file.read_text(encoding="utf-8").replace("TO 2 DO", "TO 100000 DO")
        (folder / file.name).write_text(text, encoding="utf-8")
    minute, hour = (
        _run(folder, "run", ".", "--no-record", "--max-time", str(time_s), codes=(3,))
        for time_s in (60, 3600)
    )
    growth = (hour.megabytes - minute.megabytes) / 59.0
    return [
        Claim("an hour of pick and place", hour.seconds, 25.0, "s of processor"),
        Claim("  memory a virtual minute", growth, 0.2, "MB"),
    ]


def _polling(folder: Path) -> list[Claim]:
    # Something changes now and then, else the run says that it waits for ever.
    change = "[[stimulus]]\nat = 1.0\nevery = 10.0\nset = { di1 = 0 }\n"
    (folder / "rapidsim.toml").write_text(f"[signals]\n{SIGNALS}{change}")
    (folder / "polling.mod").write_text(POLLING)
    arguments = ("run", "polling.mod", "--no-record", "--max-time", "600")
    spent = _run(folder, *arguments, codes=(3,))
    return [Claim("ten minutes of polling", spent.seconds, 5.0, "s of processor")]


def _sweep(folder: Path) -> list[Claim]:
    (folder / "rapidsim.toml").write_text('[robot]\nmodel = "irb1600-6-1.2"\n')
    (folder / "ten.mod").write_text(f"MODULE ten\n  PROC main()\n{TEN}  ENDPROC\nENDMODULE\n")
    vary = [part for place in PLACES for part in ("--vary", place)]
    arguments = ("rapidsim.toml", "ten.mod", *vary, "--no-run", "--out", "places.csv")
    spent = _run(folder, "sweep", *arguments, codes=(0, 1))
    return [Claim("100,000 places of ten targets", spent.seconds, 20.0, "s of processor")]


def _run(folder: Path, *arguments: str, codes: tuple[int, ...] = (0,)) -> Cost:
    return cost(str(folder), "-m", "rapidsim", *arguments, codes=codes)


if __name__ == "__main__":
    main()
