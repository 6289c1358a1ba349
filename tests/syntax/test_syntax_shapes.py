"""Statements of one shape are read by a compiled function: the trees are those of the driver."""

from __future__ import annotations

import random
from dataclasses import fields
from pathlib import Path

import pytest

from rapidsim.diagnostics import Source
from rapidsim.syntax import line_templates, tree
from rapidsim.syntax.parser import Parsed, parse

HERE = Path(__file__).parent
TEXTS = sorted(
    [*HERE.glob("programs/*"), *HERE.glob("broken/*.mod"), *HERE.parents[2].glob("programs/*.mod")]
)
FAULTS = (
    "",
    "(",
    "]",
    ";",
    "!",
    "\n",
    " MoveL ",
    "VAR num n;",
    "<SMT>",
    '"',
    "ENDPROC\n",
    ",",
    "%",
)
"""What is put in the place of a character or two."""


def seen(node: object) -> object:
    """All of a tree, places too."""
    if isinstance(node, tuple):
        return tuple(map(seen, node))
    if isinstance(node, tree.Node | tree.Comment | tree.File):
        parts = (getattr(node, one.name) for one in fields(node) if one.type != "Source")
        return (type(node).__name__, *map(seen, parts))
    return repr(node)


def read(text: str, often: int, monkeypatch: pytest.MonkeyPatch) -> Parsed:
    monkeypatch.setattr(line_templates, "_OFTEN", often)
    return parse(Source("a.mod", text))


def assert_read_alike(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    quick, step_by_step = (read(text, often, monkeypatch) for often in (1, 1 << 60))
    assert seen(quick.file) == seen(step_by_step.file)
    assert repr(quick.diagnostics) == repr(step_by_step.diagnostics)


@pytest.mark.parametrize("file", TEXTS, ids=lambda file: file.stem)
def test_programs_are_read_alike(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Twice, so that each of its statements is met again.
    assert_read_alike(2 * file.read_text(encoding="utf-8", errors="replace"), monkeypatch)


def generated(count: int) -> str:
    external = "[9E9,9E9,9E9,9E9,9E9,9E9]"
    targets = [f"[[{k}.25,-{k},{3 * k}],[1,0,0,0],[0,0,-1,0],{external}]" for k in range(count)]
    declared = [f"  CONST robtarget p{k}:={one};\n" for k, one in enumerate(targets)]
    moves = [
        f"    MoveL p{k},v200,z1,tool0\\WObj:=wobj0;\n"
        f"    MoveJ \\Conc,{targets[k]},v{k},fine,tool0;\n"
        f"    SetDO do1, {k} MOD 2; n:=n+{k}*(2-k);\n"
        for k in range(count)
    ]
    return f"MODULE m\n{''.join(declared)}  PROC main()\n{''.join(moves)}  ENDPROC\nENDMODULE\n"


@pytest.mark.parametrize("seed", range(40))
def test_a_fault_among_thousands_of_lines_is_found_where_it_is(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    draw = random.Random(seed)
    text = generated(12)
    at = draw.randrange(len(text))
    fault = draw.choice(FAULTS)
    assert_read_alike(text[:at] + fault + text[at + draw.randrange(3) :], monkeypatch)


def test_it_is_what_reads_them(monkeypatch: pytest.MonkeyPatch) -> None:
    met = line_templates.LineTemplates.at
    found: list[bool] = []

    def noted(self: line_templates.LineTemplates, position: int, state: int) -> object:
        shape = met(self, position, state)
        found.append(shape is not None)
        return shape

    monkeypatch.setattr(line_templates.LineTemplates, "at", noted)
    read(generated(200), line_templates._OFTEN, monkeypatch)
    assert sum(found) > 0.6 * len(found)
