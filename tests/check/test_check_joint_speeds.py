"""Axes that cannot keep up with a programmed speed (K609)."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

import rapidsim
from rapidsim.motion.path import curve_feasibility

HEAD = "MODULE a\n  PROC main()\n    ConfL\\Off; MoveJ {start},v500,fine,tool0;\n"
SPEEDS = ("v20", "v100", "v300", "v500", "v1000", "v2500", "[800,20,500,500]")


def target(place: np.ndarray, dice: random.Random) -> str:
    """A target with the tool pointing down, or up to 20 degrees off."""
    off = np.radians(dice.uniform(-10, 10)) if dice.random() < 0.5 else 0.0
    trans, rot = (
        ",".join(f"{one:.9g}" for one in part)
        for part in (place, [np.sin(off), 0.0, np.cos(off), 0.0])
    )
    return f"[[{trans}],[{rot}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"


def program(dice: random.Random, moves: int) -> str:
    def place() -> np.ndarray:
        return np.array([dice.uniform(600, 900), dice.uniform(-400, 400), dice.uniform(500, 900)])

    here = place()
    lines = [HEAD.format(start=target(here, dice))]
    for _ in range(moves):
        there = place()
        to, speed = target(there, dice), dice.choice(SPEEDS)
        if dice.random() < 0.3:
            beside = 0.5 * (here + there) + [0.0, 0.0, 50.0]
            lines.append(f"    MoveC {target(beside, dice)},{to},{speed},fine,tool0;\n")
        else:
            lines.append(f"    MoveL {to},{speed},fine,tool0;\n")
        here = there
    return "".join([*lines, "  ENDPROC\nENDMODULE\n"])


def findings(file: Path) -> list[tuple[str, int | None, str]]:
    checked = rapidsim.load(file, robot="irb1600").check()
    return [(one.code, one.line, one.message) for one in checked.diagnostics]


@pytest.mark.parametrize("seed", [2])
def test_the_paths_left_out_have_no_axis_that_is_too_slow(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "a.mod"
    file.write_text(program(random.Random(seed), 120))
    found = findings(file)
    everywhere = lambda curves, *_: np.ones(len(curves.length), dtype=bool)  # noqa: E731
    monkeypatch.setattr(curve_feasibility, "_may_be_held_up", everywhere)
    assert findings(file) == found
    slow = [line for code, line, _ in found if code == "K609"]
    assert 10 < len(slow) < 140
