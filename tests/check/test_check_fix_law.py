"""Safe fixes of any text: never more errors than before, and a second time there is nothing to do.

The texts are the repository's programs with pieces cut, doubled and changed, as the fuzzer does it.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from pathlib import Path

import pytest
from fuzzing.texts import characters_changed, inside, random_tokens, spliced, tokens_changed

from rapidsim.analysis.rules.table import detectors_of
from rapidsim.cli.boundary import run_commands
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import SourceFile, decode
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.jobs.checking.fixes import apply_fixes, choose_fixes, harmless_fixes
from rapidsim.module_files import TaskFiles
from rapidsim.text_edits import edited_text

ROOT = Path(__file__).parents[2]
PROGRAMS = [decode(path.read_bytes())[0] for path in sorted((ROOT / "programs").rglob("*.mod"))]
EVERY_RULE = detectors_of(lambda rule: True)
SEEDS = range(40)

HARMED = [
    "MODULE example PROC ( switch pick ( switch",
    "MODULE example PROC  ( switch",
]
"""Without the end of the last line the parser finds fewer errors in these than with it."""


def as_task(text: str) -> tuple[TaskFiles, ...]:
    return (TaskFiles("T_ROB1", (SourceFile("m.mod", text, "utf-8"),)),)


def find(tasks: Sequence[TaskFiles]) -> tuple[Diagnostic, ...]:
    return check_tasks(tasks, EVERY_RULE).diagnostics


def errors(found: tuple[Diagnostic, ...]) -> int:
    return sum(one.severity is Severity.ERROR for one in found)


def law(text: str, *, unsafe: bool) -> None:
    before = as_task(text)
    found = find(before)
    once = apply_fixes(before, found, find, unsafe=unsafe)
    left = find(once.tasks)
    assert errors(left) <= errors(found)
    twice = apply_fixes(once.tasks, left, find, unsafe=unsafe)
    assert (twice.count, twice.tasks) == (0, once.tasks)


def mutant(seed: int) -> str:
    dice = random.Random(f"fix {seed}")
    text = dice.choice(PROGRAMS)
    match seed % 4:
        case 0:
            return characters_changed(text, dice)
        case 1:
            return tokens_changed(text, dice)
        case 2:
            return spliced(text, dice.choice(PROGRAMS), dice)
        case _:
            return inside(random_tokens(dice))


@pytest.mark.parametrize("seed", SEEDS)
def test_fixes_of_changed_programs(seed: int) -> None:
    law(mutant(seed), unsafe=bool(seed % 8 >= 4))


@pytest.mark.parametrize("text", HARMED)
def test_a_fix_that_would_do_harm_is_left_out(text: str) -> None:
    tasks = as_task(text)
    found = find(tasks)
    all_of_them = choose_fixes(found, unsafe=False).edits.get("m.mod", ())
    assert errors(find(as_task(edited_text(text, all_of_them)))) > errors(found)
    assert harmless_fixes(found, tasks, unsafe=False).skipped == 1
    law(text, unsafe=False)


def test_fixes_that_are_left_out_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "m.mod"
    file.write_text(HARMED[1])
    asked = ("check", str(file), "--fix", "--extend-select", "S905", "--output-format", "concise")
    run_commands(asked)
    assert "would cause more errors: 1." in capsys.readouterr().out
    fixed = file.read_text()
    run_commands(asked)
    assert file.read_text() == fixed
