"""Long runs of moves are executed as runs; what comes of it is what each move by itself does."""

import json
import random
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest
from calls_between import with_calls
from command_line import Ended, call
from exports import ROBOT, export
from laws import cases

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.controller.moves import expected_lines
from rapidsim.controller.moves.expected_lines import ExpectedLines
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.files import SourceFile
from rapidsim.interpreter.codegen.bulk_loops import with_loops
from rapidsim.jobs.checking import load_tasks
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree

_COUNT = 16
_FEW = 10
"""Moves beyond which they are executed as runs here."""
_AT = 8
"""The move that something is done to."""
_SIGNALS = """[signals]
do1 = { type = "do" }
do2 = { type = "do" }
ao1 = { type = "ao", max = 1000 }
ao2 = { type = "ao", max = 1000 }
"""
_FAR = (r"\[\[[0-9.]+", "[[9000.000")


def _text(form: str = "inline") -> str:
    return export(form, "raster", _COUNT).replace("doExtruder", "do1")


def _at(old: str, new: str, text: str, number: int = _AT) -> str:
    """A program with one of its moves changed."""
    lines = text.split("\n")
    move = 2 + number
    lines[move] = re.sub(old, lambda match: match.expand(new), lines[move], count=1)
    return "\n".join(lines)


def _modules(text: str) -> list[tree.Module]:
    task = TaskFiles("T_ROB1", (SourceFile("m.mod", text, "utf-8"),))
    with patch.object(load_tasks, "MOST_STATEMENTS", _FEW):
        found = load_tasks.load_tasks([task], in_runs=True, keeps_data=False)
    return [one for task in found.tasks for one in task.program.modules]


def _rows(text: str) -> int:
    """How many moves are not in the tree, but rows of a run."""
    return sum(len(run) for one in _modules(text) for run in one.runs if not run.names)


def _in_loops(text: str) -> list[int]:
    """How many moves each loop executes, with those in the tree."""
    (module,) = _modules(text)
    runs: dict[tree.Node, tree.BulkStatements] = {run.like: run for run in module.runs}
    parts = with_loops(module.routines[-1].body, runs, text)
    return [len(part) for part in parts if isinstance(part, tree.BulkStatements)]


_NUMBER = re.compile(r"-?\d+\.\d+(?:e-?\d+)?")


def _numbers(texts: Iterable[bytes | str]) -> tuple[list[str], list[float]]:
    """Texts without their numbers, and these."""
    whole = [one if isinstance(one, str) else one.decode() for one in texts]
    return (
        [_NUMBER.sub("#", one) for one in whole],
        [float(number) for one in whole for number in _NUMBER.findall(one)],
    )


def _assert_the_same(text: str, folder: Path, *options: str) -> Ended:
    """Run a program in both ways: all that is printed and written is the same, but for rounding.

    Arrays are rounded otherwise than plain floats; a stop multiplies that by a hundred million.
    """
    made = []
    for most in (_FEW, 1_000_000):
        # In the same place, for its name is printed.
        home = folder / "here"
        home.mkdir()
        (home / "m.mod").write_text(text)
        (home / "rapidsim.toml").write_text(_SIGNALS)
        with patch.object(load_tasks, "MOST_STATEMENTS", most):
            ended = call(
                *("run", "m.mod", "--robot", ROBOT, "--no-record", "--format", "json"),
                *("--trace", "t.csv", "--events", "e.jsonl", "--dt", "0.1", *options),
                cwd=home,
            )
        files = {one.name: one.read_bytes() for one in home.iterdir() if one.is_file()}
        made.append((ended, files))
        home.rename(folder / f"done {most}")
    (one, files), (other, other_files) = made
    assert (one.code, files.keys()) == (other.code, other_files.keys())
    words, numbers = _numbers([one.out, one.err, *files.values()])
    other_words, other_numbers = _numbers([other.out, other.err, *other_files.values()])
    assert words == other_words
    assert numbers == pytest.approx(other_numbers, rel=1e-9, abs=1e-6)
    assert made[0][0].code != ExitCode.DEFECT
    return made[0][0]


@pytest.mark.parametrize("form", ["inline", "mixed", "named"])
def test_moves_are_executed_as_runs(form: str, tmp_path: Path) -> None:
    assert _assert_the_same(_text(form), tmp_path).code == 0
    # The first move is a MoveJ, the last one stops; of a run three lines are parsed.
    assert _rows(_text(form)) == _COUNT - 2 - 3


def test_a_loop_executes_the_moves_around_a_run(tmp_path: Path) -> None:
    text = export("inline", "raster", 40)
    # The first move is a MoveJ, the last one stops.
    assert _in_loops(text) == [38]
    lines = text.split("\n")
    # The rule on the distance to the origin examines this one, so it is in the tree.
    near = re.sub(r"\[\[[^]]*\]", "[[0,0,7]", lines[20]).replace("[0,0,0,0]", "[0,0,0,1]")
    opened = "\n".join([*lines[:20], near, *lines[21:]])
    assert [len(run) for run in _modules(opened)[0].runs] == [13, 18]
    assert _in_loops(opened) == [38]
    stops = lines[20].replace("z1", "fine")
    apart = "\n".join([*lines[:20], stops, *lines[21:]])
    assert _in_loops(apart) == [16, 21]
    assert _in_loops(apart.replace(stops, "    SetDO do1,1;")) == [16, 21]
    # Moves by name are in loops without those around them.
    assert _in_loops(export("named", "raster", 40)) == [35]
    _assert_the_same(apart, tmp_path)


@pytest.mark.parametrize("number", [1, 2, 3, _COUNT - 3, _COUNT - 2])
def test_a_move_at_the_edge_of_a_run_that_fails(number: int, tmp_path: Path) -> None:
    clause = "ERROR\nSetDO do1,1;\nTRYNEXT;\n  ENDPROC"
    text = _at(*_FAR, _text(), number).replace("  ENDPROC", clause)
    ended = _assert_the_same(text, tmp_path)
    assert ended.code == 1, ended.out
    assert f'"line": {3 + number}' in ended.out


def test_moves_of_a_run_are_resolved_as_rows(tmp_path: Path) -> None:
    real, real_more = ExpectedLines.take, ExpectedLines.more
    rows: list[bool] = []
    together: list[int] = []

    def take(self: ExpectedLines, *of: Any) -> QueuedMove | None:
        queued = real(self, *of)
        rows.append(queued is not None)
        return queued

    def more(self: ExpectedLines, *of: Any) -> Sequence[QueuedMove]:
        queued = real_more(self, *of)
        together.append(len(queued))
        return queued

    # One turns axis 1 so far that it is no short line, nor is the way back from there.
    text = re.sub(r"(MoveL )\[\[[^]]*\]", r"\1[[750,650,700]", export("inline", "raster", 50))
    far = text.split("\n")[10]
    lines = export("inline", "raster", 50).split("\n")
    text = "\n".join([*lines[:24], far, *lines[25:]])
    # In several arrays, one after the other.
    with (
        patch.object(ExpectedLines, "take", take),
        patch.object(ExpectedLines, "more", more),
        patch.object(expected_lines, "_FIRST_ROWS", 16),
    ):
        _assert_the_same(text, tmp_path)
    assert rows.index(True) == 1
    # The moves after each are made together with it, as far as they are rows of the same arrays.
    assert sum(together) > 30
    assert sum(rows) + sum(together) > 40
    assert 0 < rows[1:].count(False) < expected_lines._FEWEST_ROWS


def test_the_last_move_of_a_run_may_be_a_row_alone(tmp_path: Path) -> None:
    # One is resolved by itself, twelve are rows of the first array, and one is left.
    assert _in_loops(_text()) == [14]
    with patch.object(expected_lines, "_FIRST_ROWS", 12):
        _assert_the_same(_text(), tmp_path)


@pytest.mark.parametrize(
    "statement",
    [
        "MoveL p7,v200,z1,tool0;",
        'GetDataVal "p"+ValToStr(7),other;\nMoveL other,v200,z1,tool0;',
        'Load \\Dynamic,"HOME:"\\File:="more.mod";',
    ],
)
def test_targets_that_something_else_may_name_stay_data(statement: str, tmp_path: Path) -> None:
    text = _text("named").replace("  ENDPROC", f"{statement}\n  ENDPROC")
    text = text.replace("  PROC", "  VAR robtarget other;\n  PROC")
    assert _rows(text) < _COUNT - 5
    _assert_the_same(text, tmp_path)


def test_a_named_target_of_a_run_out_of_reach(tmp_path: Path) -> None:
    text = re.sub(r"(p9:=)\[\[[0-9.]+", r"\g<1>[[9000.000", _text("named"))
    assert _rows(text)
    ended = _assert_the_same(text, tmp_path)
    assert ended.code == 1
    assert "p9" in ended.out


def test_assertions_may_name_the_targets_of_a_run(tmp_path: Path) -> None:
    ended = _assert_the_same(_text("named"), tmp_path, "--assert", "p9.trans.x > 9000")
    assert ended.code == ExitCode.FAILED


@pytest.mark.parametrize(
    "clause",
    [
        "",
        "ERROR\nTRYNEXT;",
        "ERROR\nSetDO do1,1;\nRETRY;",
        "ERROR\nRAISE;",
        "ERROR(LONG_JMP_ALL_ERR)\nTPWrite NumToStr(ERRNO,0);\nTRYNEXT;",
        "UNDO\nSetDO do2,1;",
    ],
)
def test_a_move_of_a_run_that_fails(clause: str, tmp_path: Path) -> None:
    text = _at(*_FAR, _text()).replace("  ENDPROC", f"{clause}\n  ENDPROC")
    ended = _assert_the_same(text, tmp_path)
    assert _rows(text)
    assert ended.code == 1, ended.out
    assert f'"line": {3 + _AT}' in ended.out


def test_no_caller_is_asked_about_a_move_of_a_run_that_fails(tmp_path: Path) -> None:
    main = "PROC main()\npath;\nSetDO do2,1;\nERROR\nSetDO do1,1;\nTRYNEXT;\nENDPROC\n"
    text = _at(*_FAR, _text()).replace("main()", "path()").replace("ENDMODULE", f"{main}ENDMODULE")
    assert _rows(text)
    assert _assert_the_same(text, tmp_path).code == 1


_TRAP = """  VAR intnum timer;
  TRAP now
    {}
  ENDTRAP
  PROC main()
    CONNECT timer WITH now;
    ITimer 0.37,timer;
"""


# The next one counts from here on: else it would be due at once, and the program never go on.
_ASIDE = """
    StopMove;
    StorePath;
    MoveL Offs(CRobT(),0,0,5),v100,fine,tool0;
    RestoPath;
    StartMove;
    IDelete timer;
    CONNECT timer WITH now;
    ITimer 1.1,timer;
"""


@pytest.mark.parametrize(
    "body",
    [
        "SetDO do1,1-DOutput(do1);",
        pytest.param(_ASIDE, id="aside"),
        "VelSet 50,100;\nPDispSet [[0,0,1],[1,0,0,0]];",
        "EXIT;",
        "RAISE 7;",
    ],
)
def test_interrupts_between_the_moves_of_a_run(body: str, tmp_path: Path) -> None:
    text = _text().replace("  PROC main()\n", _TRAP.format(body))
    assert _rows(text)
    _assert_the_same(text, tmp_path)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("ConfL\\Off;", "ConfL\\On;"),
        ("ConfL\\Off;", "PDispSet [[5,0,0],[1,0,0,0]];"),
        ("ConfL\\Off;", "again:\nreg1:=reg1+1;\nIF reg1<3 GOTO again;"),
        ("  ENDPROC", "reg1:=reg1+1;\nIF reg1<2 GOTO again;\n  ENDPROC"),
        ("[0,0,0,0]", "[-0,-1,0,0]"),
        ("z1", "z1\\Inpos:=inpos50"),
        ("MoveL ", "MoveL\\Conc,"),
        ("v200", "v200\\V:=50+reg1"),
        ("v200", "v7000\\T:=0.02"),
        ("\\WObj:=wobj0", "\\WObj:=wobj0\\TLoad:=load0"),
    ],
)
def test_other_programs(old: str, new: str, tmp_path: Path) -> None:
    text = _text().replace(old, new)
    if "again" in new and "ENDPROC" in new:
        text = text.replace("ConfL\\Off;", "again:\nConfL\\Off;")
    _assert_the_same(text, tmp_path)


@pytest.mark.parametrize(("old", "new"), [("MoveL", "MovL"), (r"\]\],v", "],v")])
def test_a_fault_is_found_where_it_stands(old: str, new: str, tmp_path: Path) -> None:
    ended = _assert_the_same(_at(old, new, _text()), tmp_path)
    assert f'"line": {3 + _AT}' in ended.out


@pytest.mark.parametrize("limit", ["0.2"])
def test_the_time_limit_comes_within_a_run(limit: str, tmp_path: Path) -> None:
    assert _assert_the_same(_text(), tmp_path, "--max-time", limit).code == 3


def test_moves_are_executed_again_and_again(tmp_path: Path) -> None:
    text = _text("mixed").replace("main()", "path()")
    main = "PROC main()\nFOR i FROM 1 TO 2 DO\npath;\nENDFOR\npath;\nENDPROC\n"
    text = text.replace("ENDMODULE", f"{main}ENDMODULE")
    assert _rows(text)
    assert _assert_the_same(text, tmp_path).code == 0


@pytest.mark.parametrize("seed", range(cases(10)))
def test_whatever_goes_wrong_in_a_program(seed: int, tmp_path: Path) -> None:
    dice = random.Random(f"runs {seed}")
    text = export(dice.choice(("inline", "mixed")), dice.choice(("spiral", "tilted")), _COUNT, seed)
    lines = text.replace("doExtruder", "do1").split("\n")
    for _ in range(dice.randrange(1, 3)):
        harm = [_FAR, ("z1", "fine"), ("1150|700", "0"), (r"\.", "9."), (r"9E9", "0")]
        old, new = dice.choice(harm)
        at = dice.randrange(4, len(lines) - 4)
        lines[at] = re.sub(old, new, lines[at])
    _assert_the_same("\n".join(lines), tmp_path, "--max-time", "30")


_BETWEEN = """  VAR intnum seen;
  TRAP changed
    SetAO ao1,AOutput(ao1)+1;
  ENDTRAP
  PROC main()
    {}
"""
_CALLS = ["SetDO do1,1;", "SetDO do1,0;\nSetAO ao2,reg1;"]


def _between(begin: str, end: str = "", calls: Sequence[str] = _CALLS) -> str:
    """A program of moves with calls between them, which has runs with such calls."""
    text = with_calls(calls, 50, 2)
    text = text.replace("  PROC main()\n", _BETWEEN.format(begin))
    text = text.replace("  ENDPROC", f"  {end}\n  ENDPROC")
    (run,) = _modules(text)[0].runs
    assert sum(len(one.starts) for one in run.between) > 10
    return text


@pytest.mark.parametrize(
    ("begin", "end"),
    [
        ("", ""),
        ("reg1:=5;", ""),
        ("again:\nreg1:=reg1+1;", "IF reg1<3 GOTO again;"),
        # Calls that fail: each is answered by itself.
        ("reg1:=1E4;", ""),
        ("reg1:=1E4;", "ERROR\nSetDO do2,1-DOutput(do2);\nTRYNEXT;"),
        ("reg1:=1E4;", "ERROR\nreg1:=1;\nRETRY;"),
        ("CONNECT seen WITH changed;\nISignalDO do1,1,seen;", ""),
        ("CONNECT seen WITH changed;\nISignalDO do1,edge,seen;", "ERROR\nTRYNEXT;"),
    ],
)
def test_calls_between_the_moves_of_a_run(begin: str, end: str, tmp_path: Path) -> None:
    _assert_the_same(_between(begin, end), tmp_path)


def test_a_call_between_the_moves_of_a_run_that_fails_is_found_where_it_stands(
    tmp_path: Path,
) -> None:
    text = _between("", calls=["SetAO ao1,reg1;", "SetDO do1,1;", "SetDO do1,0;"])
    # A trap makes the value too large for a repetition.
    text = text.replace("SetAO ao1,AOutput(ao1)+1;", "reg1:=1E4;")
    text = text.replace("main()\n", "main()\nCONNECT seen WITH changed;\nITimer 3,seen;\n")
    ended = _assert_the_same(text, tmp_path)
    assert ended.code == 1
    (run,) = _modules(text)[0].runs
    lines = text.splitlines()
    failed = json.loads(ended.out)["diagnostics"][-1]["line"]
    assert lines[failed - 1].strip() == "SetAO ao1,reg1;"
    assert text[: run.start].count("\n") < failed < text[: run.end].count("\n")
