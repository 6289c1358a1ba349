"""The protocol of a gripper, over the routines of the cell in `programs/cell`.

The program is right; each change makes one mistake, at one statement, in a check as in a run.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

import rapidsim
from rapidsim.diagnostics import Source, Span
from rapidsim.language.moves import Place
from rapidsim.simulation.results import gripper_protocol

CELL = Path(__file__).parents[2] / "programs" / "cell"
GRIPPER = '\n[gripper]\nclose = "doGrip = 1"\nclosed = "diGripped = 1"\nat = "stand"\n'
LOAD = "PERS loaddata part:=[1.5,[0,0,40],[1,0,0,0],0,0,0];\n\n  PROC main()"
CLOSED = "# It is closed at the start.\n"
WAITS = "    WaitDI diGripped, 1;\n"


@dataclass(frozen=True)
class Mistake:
    """A text of the program, what replaces it, and what is found where."""

    old: str
    new: str
    found: tuple[tuple[str, int], ...]
    station: str = GRIPPER


MISTAKES = {
    "none": Mistake("", "", ()),
    "polling": Mistake(WAITS, "    WHILE diGripped=0 DO\n      WaitTime 0.01;\n    ENDWHILE\n", ()),
    "closes on the way": Mistake(
        "MoveL pPick, v200, fine", "MoveL pPick, v200, z10", (("I810", 30),)
    ),
    "opens on the way": Mistake(
        "MoveL pPlace, v200, fine", "MoveL pPlace, v200, z10", (("I810", 39),)
    ),
    "closes above the part": Mistake(
        "    MoveL pPick, v200, fine, tGrip\\WObj:=wConveyor;\n    SetDO doGrip, 1;\n" + WAITS,
        "    SetDO doGrip, 1;\n" + WAITS + "    MoveL pPick, v200, fine, tGrip\\WObj:=wConveyor;\n",
        # The second part is there before the arm: then it closes while the arm moves.
        (("I810", 29), ("I815", 29)),
    ),
    "allowed on the way": Mistake(
        "MoveL pPick, v200, fine",
        "MoveL pPick, v200, z10",
        (),
        GRIPPER.replace('"stand"', '"anywhere"'),
    ),
    "no wait": Mistake(WAITS, "", (("I811", 30),)),
    "too short a wait": Mistake(WAITS, "    WaitTime 0.2;\n", (("I811", 30),)),
    "a wait that looks at nothing": Mistake(WAITS, "    WaitTime 0.6;\n", (("I811", 30),)),
    "no feedback to wait for": Mistake(
        WAITS, "    WaitTime 0.6;\n", (), GRIPPER.replace('closed = "diGripped = 1"\n', "")
    ),
    "never opens": Mistake("    SetDO doGrip, 0;\n    WaitDI diGripped, 0;\n", "", (("I812", 30),)),
    "no load": Mistake("", "", (("I813", 30),), GRIPPER + "load = 1.5\n"),
    "load": Mistake(WAITS, WAITS + "    GripLoad part;\n", (("I813", 44),)),
    "opens first": Mistake(
        "    FOR part", "    SetDO doGrip, 0;\n    FOR part", (("I814", 18),), CLOSED + GRIPPER
    ),
    "is reset at first": Mistake(
        "PROC main()\n", "PROC main()\n    SetDO doGrip, 0;\n", (), CLOSED + GRIPPER
    ),
}


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_is_found_at_its_statement(name: str, command: str, tmp_path: Path) -> None:
    mistake = MISTAKES[name]
    text = (CELL / "PickAndPlace.mod").read_text()
    station = (
        re.sub(r"\[gripper\][^[]*", "", (CELL / "rapidsim.toml").read_text()) + mistake.station
    )
    assert mistake.old in text
    changed = text.replace(mistake.old, mistake.new, 1) if mistake.old else text
    if "GripLoad part" in mistake.new:
        changed = changed.replace("PROC main()", LOAD, 1)
    if CLOSED in station:
        station = station.replace('doGrip = { type = "do" }', 'doGrip = { type = "do", value = 1 }')
    (tmp_path / "PickAndPlace.mod").write_text(changed)
    (tmp_path / "rapidsim.toml").write_text(station)
    cell = rapidsim.load(tmp_path)
    diagnostics = (cell.run() if command == "run" else cell.check()).diagnostics
    found = [(one.code, one.line) for one in diagnostics if one.code.startswith("I81")]
    assert tuple(sorted(found)) == mistake.found


ROUTINES = """PROC a()
  grip;
  after_it;
ENDPROC
PROC b()
  between;
ENDPROC
PROC c()
  before_it;
  move;
ENDPROC
"""


@pytest.mark.parametrize(
    ("first", "last", "texts"),
    [
        ("grip", "after_it", ["grip;\n  "]),
        ("grip", "move", ["grip;\n  after_it;\n", "\nPROC c()\n  before_it;\n  "]),
        ("between", "move", ["between;\n", "\nPROC c()\n  before_it;\n  "]),
        ("grip", "between", ["grip;\n  after_it;\n", "\nPROC b()\n  "]),
        ("after_it", "grip", ["after_it;\n", "PROC a()\n  "]),
    ],
)
def test_what_stands_between_two_statements(first: str, last: str, texts: list[str]) -> None:
    source = Source("m.mod", ROUTINES)
    routines = {"grip": "a", "after_it": "a", "between": "b", "move": "c"}
    begin, end = (
        Place(Span(source, at, at + len(word)), routines[word])
        for word, at in ((one, ROUTINES.index(f"  {one};") + 2) for one in (first, last))
    )
    assert list(gripper_protocol._texts_between(begin, end)) == texts
